"""Processes that the tests start and interrupt."""

import signal


def interruptible() -> None:
    """For `preexec_fn`: Ctrl-C reaches the child even where the tests run with it ignored.

    A shell without job control starts what runs in its background with SIGINT ignored, and children
    inherit that.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)

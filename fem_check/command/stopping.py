"""SIGTERM, as of a batch system or `kill`, ends the program as Ctrl-C does."""

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class Stop:
    """Whether SIGTERM has come."""

    def __init__(self) -> None:
        self.asked = False
        self._process = os.getpid()

    def __call__(self, number: int, frame: Any) -> None:
        """Interrupt what runs, once: what is kept then must not be interrupted by a second signal."""
        if os.getpid() != self._process:  # a forked child, which its parent ends
            os._exit(128 + number)
        if not self.asked:
            self.asked = True
            raise KeyboardInterrupt


@contextmanager
def terminable() -> Iterator[Stop]:
    """Within it SIGTERM raises KeyboardInterrupt; not in other threads, which receive no signals."""
    stop = Stop()
    if threading.current_thread() is not threading.main_thread():
        yield stop
        return
    before = signal.signal(signal.SIGTERM, stop)
    try:
        yield stop
    finally:
        signal.signal(signal.SIGTERM, before if before is not None else signal.SIG_DFL)

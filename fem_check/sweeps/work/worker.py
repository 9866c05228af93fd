"""What a worker of a local cluster does when it starts, as Dask's `preload`."""

import signal
import threading
from typing import Any

import fem_check.sweeps.work.answering  # noqa: F401, loaded before the first scene is there


def dask_setup(worker: Any) -> None:
    """Leave Ctrl-C to the process that began the sweep: it ends its workers."""
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.SIG_IGN)

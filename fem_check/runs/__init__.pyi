"""Scenes run to folders: the answer, the motion as arrays, pictures, a film and a page to look at."""

# Read by lazy_loader as it runs, and by type checkers.

from .capture import recorded
from .finished import Finished, finished
from .recording import Recording
from .running import run

__all__ = ["Finished", "Recording", "finished", "recorded", "run"]

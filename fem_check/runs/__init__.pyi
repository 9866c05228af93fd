"""What `fem_check.runs` offers: read by `lazy_loader` as it runs, and by type checkers."""

from .finished import Finished, finished
from .recording import Recording, recorded
from .running import run

__all__ = ["Finished", "Recording", "finished", "recorded", "run"]

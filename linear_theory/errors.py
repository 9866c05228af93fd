"""What is raised when a solver misses its tolerance."""

from typing import Any


class NotConvergedError(RuntimeError):
    """A tolerance was not reached; `best` keeps the best result that was found."""

    def __init__(self, message: str, best: Any) -> None:
        super().__init__(message)
        self.best = best

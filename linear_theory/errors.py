"""What is raised when a solver misses its tolerance, and what is warned of."""

from typing import Any


class NotConvergedError(RuntimeError):
    """A tolerance was not reached; `best` keeps the best result that was found."""

    def __init__(self, message: str, best: Any) -> None:
        super().__init__(message)
        self.best = best


class ViscousRegimeWarning(UserWarning):
    """A law that stands for dry friction acts as viscous: its slip speed is above all speeds."""

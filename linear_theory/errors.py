"""What is raised when a solver misses its tolerance, and what is warned of."""

from typing import Any


class NotConvergedError(RuntimeError):
    """A tolerance was not reached; `best` keeps the best result that was found, None if there is none.

    >>> from linear_theory import NotConvergedError, Sheet, SineWave, ritz_field
    >>> try:
    ...     field = ritz_field(Sheet(), SineWave(count=400), rtol=1e-6)
    ... except NotConvergedError as missed:
    ...     print(missed.best)  # not even the first degrees fit in memory
    None
    """

    def __init__(self, message: str, best: Any) -> None:
        super().__init__(message)
        self.best = best


class ViscousRegimeWarning(UserWarning):
    """A law that stands for dry friction acts as viscous: its slip speed is above all speeds.

    >>> import warnings
    >>> from linear_theory import SineWave, line_balance
    >>> with warnings.catch_warnings(record=True, action="always") as seen:
    ...     speed = line_balance(SineWave(), alpha=0.25, friction="tanh", slip_speed=1.0)
    >>> print(f"{seen[0].category.__name__}: friction is {speed.regime}, V = {speed.mean:.4f} L/T")
    ViscousRegimeWarning: friction is viscous, V = 0.0317 L/T
    """


class Unidentifiable(ValueError):
    """A value without a content that could be known again, in another process or at another time."""

"""How a scene is to be answered: by which level, to which tolerance, over how many periods."""

from dataclasses import dataclass

from linear_theory.common import validation
from linear_theory.common.shown import Value

RTOL = 1e-2
"""Of the speed, unless it is given."""

SHARE = 0.5
"""Fraction of the tolerance allotted to the numerical error; the rest is for the model error."""


@dataclass(frozen=True)
class RunSettings(Value):
    """How a scene is to be answered: the table [run] of a scene file.

    level: "auto", or one by name, see `solve`. rtol: relative tolerance of the speed. periods, steps to
    a period: of a scene that is stepped through time; where steps are given, they take the place of the
    tolerance, and rtol is None. Raises ValueError for numbers out of range.

    >>> from fem_check import RunSettings
    >>> print(RunSettings(steps=64).rtol)
    None
    """

    level: str = "auto"
    rtol: float | None = RTOL
    periods: int = 2
    steps: int | None = None

    def __post_init__(self) -> None:
        validation.integer("periods", self.periods, 1)
        if self.steps is not None:
            validation.integer("steps", self.steps, 1)
            object.__setattr__(self, "rtol", None)
        elif self.rtol is None:
            object.__setattr__(self, "rtol", RTOL)
        else:
            object.__setattr__(self, "rtol", validation.tolerance(self.rtol))

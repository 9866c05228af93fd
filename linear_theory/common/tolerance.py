"""The tolerance of an answer."""

from dataclasses import dataclass

from linear_theory.common import validation
from linear_theory.common.shown import Value


@dataclass(frozen=True)
class Tolerance(Value):
    """An answer is converged where its error <= max(rtol |answer|, atol).

    rtol: relative, in [1e-13, 1); atol: absolute, length per time, > 0; None if it follows from the
    scene, see `of_speed`. Raises ValueError otherwise.

    >>> from linear_theory import Tolerance
    >>> tolerance = Tolerance(rtol=1e-3).of_speed(alpha=0.1, unit=1.0)
    >>> print(f"{tolerance.allowed(0.0):.0e} {tolerance.allowed(-0.5):.0e}")
    1e-08 5e-04
    """

    rtol: float
    atol: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "rtol", validation.tolerance(self.rtol))
        if self.atol is not None:
            object.__setattr__(self, "atol", validation.positive("atol", self.atol))

    def of_speed(self, alpha: float, unit: float) -> "Tolerance":
        """The tolerance with atol = 1e-3 rtol alpha^2 L/T unless given; unit: L/T, > 0."""
        validation.positive("unit", unit)
        return Tolerance(self.rtol, validation.absolute_tolerance(self.atol, self.rtol, alpha, unit))

    def allowed(self, size: float) -> float:
        """Largest admissible error of an answer of that size."""
        return max(self.rtol * abs(size), self.atol or 0.0)

    def share(self, part: float) -> "Tolerance":
        """A fraction of the tolerance, for one of several errors."""
        rtol = max(part * self.rtol, validation.SMALLEST_RTOL)
        return Tolerance(rtol, None if self.atol is None else part * self.atol)

    def scaled(self, length: float) -> "Tolerance":
        """The tolerance for speeds in units of that length."""
        return Tolerance(self.rtol, None if self.atol is None else self.atol / length)

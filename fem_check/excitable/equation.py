"""The FitzHugh–Nagumo equation (eq. 12 of the paper), as plain data."""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.starts import Pacing, RationalStart, Start
from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FitzHughNagumo(Value):
    """c_t = γ² ∇²c + c (1 - c)(c - ν) - w,  w_t = ε (c - κ w), with Neumann edges (eq. 12).

    threshold: ν, > 0 excitable, < -εκ about oscillatory; recovery_decay: κ; recovery_rate: ε, both
    1/time; diffusion_length: γ, units of length (time has the unit of the reaction, 1). start: c and w
    at time 0, by default the paper's from the rear end. pacing: a periodic stimulus, none by default.

    Raises ValueError for numbers that are not finite, rates below 0 and a length that is not positive.

    >>> from fem_check.excitable import FitzHughNagumo
    >>> from linear_theory import Sheet
    >>> equation = FitzHughNagumo(-0.1, 1e-4, 0.05, 0.02)
    >>> solution = equation.on(Sheet(), until=100.0, rtol=1e-3)
    >>> print(f"c from {solution.smallest:.2f} to {solution.largest:.2f}")
    c from -0.48 to 0.77
    """

    threshold: float
    recovery_decay: float
    recovery_rate: float
    diffusion_length: float
    start: Start = field(default_factory=RationalStart)
    pacing: Pacing | None = None

    def __post_init__(self) -> None:
        validation.real("threshold", self.threshold)
        for name in ("recovery_decay", "recovery_rate"):
            if validation.real(name, getattr(self, name)) < 0:
                raise ValueError(f"{name} = {getattr(self, name):g}: must be >= 0")
        validation.positive("diffusion_length", self.diffusion_length)
        validation.instance("start", self.start, Start)  # type: ignore[type-abstract]
        if self.pacing is not None:
            validation.instance("pacing", self.pacing, Pacing)

    def but(self, **changes: Any) -> "FitzHughNagumo":
        """A copy with the given arguments replaced."""
        return replace(self, **changes)

    def reaction(self, c: Array, w: Array) -> tuple[Array, Array]:
        """dc/dt without diffusion, and dw/dt."""
        cubic = c * (1 - c) * (c - self.threshold)
        return cubic - w, self.recovery_rate * (c - self.recovery_decay * w)

    def slope(self, c: Array) -> Array:
        """Derivative of the cubic with respect to c."""
        return -3 * c**2 + 2 * (1 + self.threshold) * c - self.threshold

    def on(self, body: Any, until: float, rtol: float = 1e-3, method: Any = None) -> Any:
        """The solution on a body from time 0 to `until`, see `Excitation`.

        body: a Sheet or an Outline; rtol: largest error of c, relative to the largest |c|; method:
        `Adaptive` by default, or `Euler`.
        """
        from fem_check.excitable.excitation import Excitation  # which imports the equation

        return Excitation(self, body, until, rtol, method)

"""Reaction and diffusion of the FitzHugh–Nagumo equation (eq. 12 of the paper), as plain data."""

from dataclasses import dataclass, field, replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.feedback import StrainFeedback
from fem_check.excitable.starts import Pacing, RationalStart, Start
from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Equation(Value):
    """c_t = γ² ∇²c + c (1 - c)(c - ν) - w,  w_t = ε (c - κ w): see `FitzHughNagumo`."""

    threshold: float
    recovery_decay: float
    recovery_rate: float
    diffusion_length: float
    start: Start = field(default_factory=RationalStart)
    pacing: Pacing | None = None
    feedback: StrainFeedback | None = None

    def __post_init__(self) -> None:
        validation.real("threshold", self.threshold)
        for name in ("recovery_decay", "recovery_rate"):
            if validation.real(name, getattr(self, name)) < 0:
                raise ValueError(f"{name} = {getattr(self, name):g}: must be >= 0")
        validation.positive("diffusion_length", self.diffusion_length)
        validation.instance("start", self.start, Start)  # type: ignore[type-abstract]
        if self.pacing is not None:
            validation.instance("pacing", self.pacing, Pacing)
        if self.feedback is not None:
            hint = "write StrainFeedback(coefficient)"
            validation.instance("feedback", self.feedback, StrainFeedback, hint)

    @property
    def acts_back(self) -> bool:
        """Whether c depends on the motion of the sheet."""
        return self.feedback is not None and self.feedback.coefficient != 0

    def but(self, **changes: Any) -> Self:
        """A copy with the given arguments replaced."""
        return replace(self, **changes)

    def scaled(self, factor: float) -> Self:
        """The same with all lengths times a factor: what is said of a sheet of length 1 elsewhere.

        >>> from fem_check import excitable_preset
        >>> print(excitable_preset("nu = -0.1").scaled(50.0).diffusion_length)
        1.0
        """
        return self.but(
            diffusion_length=factor * self.diffusion_length,
            start=self.start.scaled(factor),
            pacing=None if self.pacing is None else self.pacing.scaled(factor),
        )

    def reaction(self, c: Array, w: Array) -> tuple[Array, Array]:
        """dc/dt without diffusion, and dw/dt."""
        found = np.empty((2, *c.shape))
        self.react(c, w, *found)
        return found[0], found[1]

    def react(self, c: Array, w: Array, dc: Array, dw: Array) -> None:
        """The same into given arrays: steps in time do little else."""
        np.subtract(1, c, out=dc)
        dc *= c
        dc *= c - self.threshold
        dc -= w
        np.multiply(w, -self.recovery_decay, out=dw)
        dw += c
        dw *= self.recovery_rate

    def slope(self, c: Array) -> Array:
        """Derivative of the cubic with respect to c."""
        return -3 * c**2 + 2 * (1 + self.threshold) * c - self.threshold

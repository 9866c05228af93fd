"""Growth by a wave c: couplings, law of the stretch, and the options left open by eqs 1 and 4."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.growth.laws import Exp, GrowthLaw, growth_law

Array = NDArray[np.float64]


class Reference(StrEnum):
    """The surface that a quantity refers to."""

    GROWN = "grown"
    UNDEFORMED = "undeformed"

    @classmethod
    def named(cls, name: str, value: object) -> "Reference":
        """A member, or the one with that name; name: of the argument. Raises ValueError otherwise."""
        return cls(validation.choice(name, value, tuple(cls)))


EXPONENTIAL = Exp()


@dataclass(frozen=True, init=False)
class Growth(Value):
    """Rest metric g(alpha c) A and rest curvature -beta c (eq. 4).

    alpha: growth strain per c; law: of g, a `GrowthLaw` or its name; curvature_coupling: beta,
    1/length; curvature: GROWN, -beta c abar, so that the rest curvature is exactly -beta c, or
    UNDEFORMED, -beta c A; energy_area: reference area of the elastic energy density, GROWN
    sqrt(det abar) (appendix A.2) or UNDEFORMED sqrt(det A) (eq. 1). Raises ValueError for numbers that
    are not finite and unknown names.

    >>> from linear_theory import Growth
    >>> print(Growth(0.25).metric([0.0, 1.0]).round(6), Growth(0.25, law="linear").metric(1.0))
    [1.       1.648721] 1.5625
    """

    alpha: float
    law: GrowthLaw
    curvature_coupling: float
    curvature: Reference
    energy_area: Reference

    def __init__(
        self,
        alpha: float,
        law: GrowthLaw | str = EXPONENTIAL,
        curvature_coupling: float = 0.0,
        curvature: Reference | str = Reference.GROWN,
        energy_area: Reference | str = Reference.GROWN,
    ) -> None:
        for name, value in {"alpha": alpha, "curvature_coupling": curvature_coupling}.items():
            object.__setattr__(self, name, validation.real(name, value))
        object.__setattr__(self, "law", growth_law(law, "law"))
        object.__setattr__(self, "curvature", Reference.named("curvature", curvature))
        object.__setattr__(self, "energy_area", Reference.named("energy_area", energy_area))

    def metric(self, growth: ArrayLike) -> Array:
        """g at growth c, same shape. Raises ValueError where lengths would vanish."""
        c = validation.real_array("growth", growth)
        self.law.check(self.alpha, c)
        with np.errstate(over="ignore"):
            found = np.asarray(self.law.metric(self.alpha * c))
            overflow = not np.isfinite(found**2).all()
        if overflow:
            worst = self.alpha * c.flat[found.argmax()]
            raise ValueError(
                f"alpha = {self.alpha:g}: alpha c = {worst:g} stretches by more than a number can hold"
            )
        return found

    @property
    def energy_weight(self) -> float:
        """m in 1 + alpha m c + ..., the factor of the energy density at small alpha.

        The inverse rest metric in the elastic tensor contributes -4, the grown area +2.
        """
        return -2.0 if self.energy_area is Reference.GROWN else -4.0

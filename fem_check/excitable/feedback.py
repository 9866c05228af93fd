"""Feedback of the strain of the sheet on the kinetics of the wave, as plain data."""

from dataclasses import dataclass

from linear_theory.common import validation
from linear_theory.common.shown import Value


@dataclass(frozen=True)
class StrainFeedback(Value):
    """c_t = γ² ∇²c + c (1 - c)(c - ν) - w + coefficient tr ε: stretching excites, or inhibits.

    coefficient: 1/time, of any sign; 0 is no feedback, with the same bits as without it. tr ε: trace of
    the logarithmic strain of the mid-surface, the logarithm of its area over that of the *ungrown*
    sheet. A concentration and the distances of reacting molecules follow the whole swelling, which is
    also all that is left of a strain where the sheet grows freely: tr ε = 2 alpha c for growth by
    exp(alpha c), while the elastic strain, relative to the grown reference, vanishes there.

    Mechanical feedback is in the outlook of the paper (section 4), without an equation. Only
    `simulate`, which follows wave and sheet together, represents it.

    Raises ValueError for a coefficient that is not finite.

    >>> from fem_check import StrainFeedback, excitable_preset
    >>> equation = excitable_preset("nu = -0.1").but(feedback=StrainFeedback(0.1))
    >>> print(equation.acts_back, equation.but(feedback=StrainFeedback(0.0)).acts_back)
    True False
    """

    coefficient: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficient", validation.real("coefficient", self.coefficient))

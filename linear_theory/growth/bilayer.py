"""The growth couplings of a bilayer of which one layer grows."""

import math
from typing import NamedTuple

from linear_theory.common import validation
from linear_theory.common.shown import Shown

LARGEST_RATIO = 1e50
"""Of the layers, either way: products of powers of both ratios stay within double precision."""


class _Couplings(NamedTuple):
    alpha: float
    curvature: float


class Couplings(Shown, _Couplings):
    """alpha: strain of the mid-surface per c (dimensionless). curvature: beta of eq. 4, 1/length."""


def bilayer(
    growth: float, thickness: float, thickness_ratio: float = 1.0, modulus_ratio: float = 1.0
) -> Couplings:
    """Couplings of two bonded layers, of which the upper one grows by the strain growth * c.

    thickness: total thickness. thickness_ratio and modulus_ratio: upper over lower layer; both have
    the same Poisson ratio. Timoshenko's bimetal (J. Opt. Soc. Am. 11:233, 1925) has the curvature
    6 eps (1 + m)^2 / (h [3 (1 + m)^2 + (1 + m n)(m^2 + 1/(m n))]), which for equal layers is
    3 eps/(2 h). alpha is the accompanying strain of the mid-surface of the stack, eps/2 for equal
    layers. A positive growth bends the sheet away from its upper side, b = -curvature * c * a.

    With the mean strain eps/2 of equal layers, this law gives the paper's beta = 100 alpha at h = 0.03.
    Raises ValueError for a thickness <= 0, a ratio outside [1e-50, 1e50], and a growth so large, or a
    thickness so small, that the curvature is not finite.

    >>> from fem_check import Bending, Material, Membrane, Scene, bilayer
    >>> from linear_theory import Sheet, SineWave
    >>> alpha, beta = bilayer(growth=0.2, thickness=0.03)
    >>> effects = [part(Material(thickness=0.03, poisson=0.5)) for part in (Membrane, Bending)]
    >>> scene = Scene(Sheet(), SineWave(), alpha, curvature_coupling=beta, effects=effects)
    >>> print(f"alpha = {scene.alpha:.2f}, beta = {scene.curvature_coupling:.0f}/L")
    alpha = 0.10, beta = 10/L
    """
    eps = validation.real("growth", growth)
    h = validation.positive("thickness", thickness)
    m, n = _ratio("thickness_ratio", thickness_ratio), _ratio("modulus_ratio", modulus_ratio)
    curvature = 6 * eps * (1 + m) ** 2 / (h * (3 * (1 + m) ** 2 + (1 + m * n) * (m**2 + 1 / (m * n))))
    if not math.isfinite(curvature):
        raise ValueError(f"growth = {eps:g}: must have a finite ratio to thickness = {h:g}")
    upper, lower = h * m / (1 + m), h / (1 + m)
    # No net force: n upper (e_u - eps) + lower e_l = 0 with e the strain at the layer's middle.
    above, below = (h - upper) / 2, (lower - h) / 2
    shift = (n * upper * above + lower * below) / (n * upper + lower)
    return Couplings(eps * n * upper / (n * upper + lower) - curvature * shift, curvature)


def _ratio(name: str, value: object) -> float:
    """A ratio of the upper to the lower layer."""
    number = validation.positive(name, value)
    if not 1 / LARGEST_RATIO <= number <= LARGEST_RATIO:
        raise ValueError(f"{name} = {number:g}: must be in [{1 / LARGEST_RATIO:g}, {LARGEST_RATIO:g}]")
    return number

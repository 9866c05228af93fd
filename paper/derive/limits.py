"""Limits of the plate on its ground, and the heavy elastica beyond lift-off."""

import sympy as sp

from paper.derive.proof import Step, prove
from tests import test_derivations_limits as on_limits


def strip() -> Step:
    """V_ab and V_bb of a strip on soft and on stiff ground."""
    soft = on_limits.soft_mixed(), on_limits.soft_bent()
    stiff = on_limits.stiff_mixed(), on_limits.stiff_bent()
    for found, stated in ((soft, on_limits.stated_soft()), (stiff, on_limits.stated_stiff())):
        for name, one, other in zip(("V_ab", "V_bb"), found, stated, strict=True):
            prove(name, one, other)
    return Step(
        "Limits",
        "A strip, $D = h^3\\/12$, under one sine, lengths over $L$, times over $T$, $k = 2 pi$, $ell = "
        "(D\\/s)^(1\\/4)$. Soft ground, $ell -> infinity$, leaves it the shape of a free strip, "
        "$zeta'' = -c$. On stiff ground, or as $D -> 0$, $zeta = ell^4 k^2 c$ but for layers of "
        "length $ell$ at the ends, where $zeta = -c ell^2 e^(-z) (cos z - sin z)$, $z = "
        "d\\/(sqrt(2) ell)$. $V_(alpha beta)$ under viscous friction, twice as large under dry, and "
        "$V_(beta beta)$ under dry friction tend to",
        (
            "V_(alpha beta) -> -frac(s, q) frac(1 - 12\\/k^2, 2 k^2), quad "
            "V_(beta beta) -> -frac(1 - 144\\/k^4, 4 k^2) quad (ell -> infinity)",
            "V_(alpha beta) -> -frac(D k^2, 2 q) (1 - 2 sqrt(2) ell), quad "
            "V_(beta beta) -> frac(sqrt(2), 8) k^2 ell^3 (3 ell^2 - h^2) quad (ell -> 0)",
        ),
    )


def elastica() -> Step:
    """The end of a strip with natural curvature, in contact and off the ground."""
    prove("integral", on_limits.elastica_balance(), 0)
    depth, rise = on_limits.DEPTH, on_limits.RISE
    spring = 2 * on_limits.WEIGHT / depth
    stated = spring * rise**2 / 2 * (1 - rise / (3 * depth))
    prove("contact", on_limits.elastica_work(rise - depth), stated)
    prove("lift-off", on_limits.elastica_work(0), sp.Rational(2, 3) * on_limits.WEIGHT * depth)
    return Step(
        "Lift-off",
        "A strip with rest curvature $kappa$, its ends up, at any slope $theta$: $D theta'' = Q cos "
        "theta$, $Q' = r - q$, $z' = sin theta$, $r = k z^2$ below the ground. Times $theta'$ this has "
        "an integral. Its end rises by $Delta$ above the middle at the depth $d = sqrt(q\\/k)$; it "
        "leaves the ground at $Delta = d$, at $sqrt(8\\/3)$ times the curvature $q\\/sqrt(D s)$ at "
        "which the linearised ground of the theory lets go. The last is that of rigid ground:",
        (
            "frac(D kappa^2, 2) = frac(s Delta^2, 2) (1 - frac(Delta, 3 d)) quad (Delta <= d)",
            "frac(D kappa^2, 2) = q (Delta - frac(d, 3)) quad (Delta >= d), quad "
            "Delta = frac(D kappa^2, 2 q) quad (d = 0)",
        ),
    )

"""Limits of the plate on its ground."""

from paper.derive.proof import Step, prove
from tests.plate import test_derivations_limits as on_limits


def limits() -> Step:
    """V_ab and V_bb of a strip on soft and on stiff ground."""
    soft = on_limits.soft_mixed(), on_limits.soft_bent()
    stiff = on_limits.stiff_mixed(), on_limits.stiff_bent()
    for found, stated in ((soft, on_limits.stated_soft()), (stiff, on_limits.stated_stiff())):
        for name, one, other in zip(("V_ab", "V_bb"), found, stated, strict=True):
            prove(name, one, other)
    return Step(
        "Limits",
        "Dry strip, $k = 2 pi$, $L = T = 1$, $ell = (D\\/s)^(1\\/4)$:",
        (
            "V_(alpha beta) -> -frac(s, q k^2) (1 - 12\\/k^2), quad "
            "V_(beta beta) -> -frac(1, 4 k^2) (1 - 144\\/k^4) quad (ell -> infinity)",
            "V_(alpha beta) -> -frac(D k^2, q) (1 - 2 sqrt(2) ell), quad "
            "V_(beta beta) -> frac(sqrt(2), 8) k^2 ell^3 (3 ell^2 - h^2) quad (ell -> 0)",
        ),
    )

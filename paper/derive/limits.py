"""Limits of the plate on its ground."""

from paper.derive.proof import Step, prove
from tests.plate import test_derivations_limits as on_limits


def limits() -> Step:
    """V_ab and V_bb of a strip on soft and on stiff ground."""
    dry = on_limits.dry_over_viscous()
    soft = dry * on_limits.soft_mixed(), on_limits.soft_bent()
    stiff = dry * on_limits.stiff_mixed(), on_limits.stiff_bent()
    for found, (mixed, bent) in ((soft, on_limits.stated_soft()), (stiff, on_limits.stated_stiff())):
        prove("V_ab", found[0], 2 * mixed)
        prove("V_bb", found[1], bent)
    return Step(
        "Limits",
        "Dry strip, $k = 2 pi$, $L = T = 1$, $ell = (D\\/s)^(1\\/4)$:",
        (
            "V_(alpha beta) -> frac(s, q) frac(12\\/k^2 - 1, k^2), space "
            "V_(beta beta) -> frac(144\\/k^4 - 1, 4 k^2) space (ell -> infinity)",
            "V_(alpha beta) -> -frac(D k^2, q) (1 - 2 sqrt(2) ell), space "
            "V_(beta beta) -> frac(sqrt(2), 8) k^2 ell^3 (3 ell^2 - h^2) space (ell -> 0)",
        ),
    )

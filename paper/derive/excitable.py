"""The excitable wave near its state of rest (F8)."""

from paper.derive.proof import Step, prove
from tests.excitable import test_derivations_excitable as on_waves
from tests.excitable.test_derivations_excitable import EPSILON, GAMMA, KAPPA, NU, K


def oscillation() -> Step:
    """How fast waves of eq. 12 grow, and how far."""
    rate = (-NU - GAMMA**2 * K**2 - EPSILON * KAPPA) / 2
    prove("rate", on_waves.growth_rate(), rate)
    prove("amplitude", on_waves.amplitude_squared(), -4 * NU / 3)
    return Step(
        "F8",
        "Eq. 12 linear about rest for $e^(upright(i) k y)$, mean of both rates; and the amplitude at "
        "which the work of $f = c (1 - c) (c - nu)$ on $c = A cos s$ in a cycle vanishes, $c_(t t) + "
        "epsilon c = f'(c) c_t$ for $kappa = 0$:",
        (
            "frac(1, 2) (-nu - gamma^2 k^2 - epsilon kappa)",
            "integral f'(A cos s) sin^2 s dif s = 0 quad => quad A = 2 sqrt(-nu\\/3)",
        ),
    )

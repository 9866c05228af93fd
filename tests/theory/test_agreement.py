"""Three solutions of one problem: Airy series, Legendre-Ritz, finite elements.

They share the sheet, the wave and nothing else. Each claims a relative L2 error of the displacement
at its worst phase; any two must differ by no more than the sum of their claims.
"""

import itertools

import numpy as np
import pytest

from fem_check.plane_stress.field import plane_stress_field
from linear_theory import Sheet, SineWave, TravellingWave, airy_series, ritz_field
from linear_theory.balance.crawl import Crawl, first_resolution
from linear_theory.friction.contact import Contact

WAVES = {
    "sine": SineWave(),
    "two waves": SineWave(2),
    "backwards": SineWave(-1, 2.0),
    "pulse": TravellingWave(np.array([0.5, 0.3, 0.1]), np.array([0.2, 0.1, 0.3]), mean=0.2),
}
CASES = list(itertools.product([0.1, 0.5, 1.0, 2.0], [-0.5, 0.0, 0.5], WAVES))


def fields(width, poisson, name):
    sheet, wave = Sheet(width=width, poisson=poisson), WAVES[name]
    size = min(width / 2, 0.125 / max(1, wave.orders[-1] / 2))
    return {
        "airy": airy_series(sheet, wave, rtol=1e-5),
        "ritz": ritz_field(sheet, wave, rtol=1e-5),
        "fem": plane_stress_field(sheet, wave, degree=4, size=size),
    }


@pytest.mark.parametrize(("width", "poisson", "name"), CASES)
def test_three_solutions_agree_within_their_claims(width, poisson, name):
    solutions = fields(width, poisson, name)
    x, w_x = np.polynomial.legendre.leggauss(12)
    y, w_y = np.polynomial.legendre.leggauss(24)
    x, y, weights = x[:, None] * width / 2, y / 2, np.multiply.outer(w_x, w_y)

    def norm(u):
        return np.sqrt(np.sum(weights * u * u))

    for t in np.array([0.0, 0.13, 0.25]) * WAVES[name].period:
        values = {key: field.displacement(x, y, t) for key, field in solutions.items()}
        for one, two in itertools.combinations(values, 2):
            claim = solutions[one].error + solutions[two].error
            assert norm(values[one] - values[two]) <= claim * norm(values[one])
        # claims that are met because they are large would prove nothing
        assert solutions["airy"].error <= 1e-5
        assert solutions["ritz"].error <= 1e-5
        assert solutions["fem"].error <= 5e-3


@pytest.mark.parametrize(("width", "name"), [(0.5, "sine"), (1.0, "two waves"), (0.2, "pulse")])
def test_one_balance_serves_all_three(width, name):
    solutions = fields(width, 0.3, name)
    times = np.array([0.07, 0.31]) * WAVES[name].period
    speeds = {}
    for key, field in solutions.items():
        crawl = Crawl(field, 0.1, Contact(), first_resolution(1e-5))
        motion = crawl.balance(times)
        speeds[key] = 0.1 * (motion.leading + 0.1 * motion.remainder)[:, 1]
    for key in ("ritz", "fem"):
        # the balance does not amplify the error of the field (5e-3 at most), nor hide it
        bound = 1e-6 + solutions[key].error * abs(speeds["airy"]).max()
        np.testing.assert_allclose(speeds[key], speeds["airy"], atol=bound)

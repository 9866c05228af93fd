"""Maps of viscous friction: the closed formula, the sheet, and the optimiser on its adjoint."""

import itertools

import numpy as np
import pytest

from linear_theory import (
    Contact,
    GivenMap,
    Mapped,
    Patches,
    Scene,
    Sheet,
    SineWave,
    TravellingWave,
    Viscous,
    speed_gradient,
)
from linear_theory.line.best.viscous_map import map_share, slowest_share
from linear_theory.optimisation.problem import Evaluation, Linear, Region
from linear_theory.optimisation.search import Ascent, climb

ALPHA, COUNT = 0.02, 4
NAMES = [f"friction.map.mu.{k}" for k in range(COUNT)]


def patches(mu):
    """Equal lengths of the body, with soft edges."""
    ends = np.linspace(-0.5, 0.5, COUNT + 1)
    ends[[0, -1]] += [-1, 1]
    return Patches([(-1, 1, a, b, m) for a, b, m in zip(ends, ends[1:], mu, strict=False)], edge=0.02)


def of_strip(mu):
    """Speed over alpha^2 and its gradient by the mu, of a narrow strip."""
    contact = Contact("current", Mapped(Viscous(1.0), patches(mu)))
    found = speed_gradient(
        Scene(Sheet(width=0.05), SineWave(), ALPHA, contact=contact), NAMES, rtol=3e-3
    )
    return Evaluation(
        found.speed.mean / ALPHA**2,
        found.speed.error / ALPHA**2,
        found.values / ALPHA**2,
        found.errors / ALPHA**2,
    )


def test_formula_is_that_of_the_narrow_strip_and_so_is_its_gradient():
    mu = np.random.default_rng(3).uniform(0.5, 2.0, COUNT)
    found, step = of_strip(mu), 1e-4
    assert found.value == pytest.approx(map_share(SineWave(), patches(mu)), rel=1e-3)
    slopes = [
        (
            map_share(SineWave(), patches(mu + step * one))
            - map_share(SineWave(), patches(mu - step * one))
        )
        / (2 * step)
        for one in np.eye(COUNT)
    ]
    assert found.gradient == pytest.approx(slopes, rel=2e-2, abs=1e-4)
    uniform = of_strip(np.ones(COUNT))
    assert uniform.value == pytest.approx(1.0, rel=1e-3)
    assert abs(uniform.gradient).max() <= 1e-3


def test_the_optimiser_finds_the_slowest_map_at_its_bounds():
    """Of mean 1, 1/2 <= mu <= 3/2: against all maps at bounds, and the bound of sharp edges."""
    rest = np.vstack([np.eye(COUNT - 1), -np.ones(COUNT - 1)])  # the last mu follows from the mean

    def objective(point):
        mu = 1 + rest @ point
        found = of_strip(mu)
        return Evaluation(-found.value, found.error, -found.gradient @ rest, abs(rest.T) @ found.doubt)

    last = Linear("mean", rest[-1:], np.array([0.5])), Linear("mean", -rest[-1:], np.array([0.5]))
    ends = np.full(COUNT - 1, 0.5)
    region = Region(-ends, ends, np.zeros(COUNT - 1), ends, last)
    start = np.array([0.1, -0.05, -0.1])
    end = climb([objective], objective, region, start, Ascent(change=1e-4))
    shares = [
        map_share(SineWave(), patches(mu))
        for mu in itertools.product((0.5, 1.5), repeat=COUNT)
        if sum(mu) == COUNT
    ]
    assert -end.value == pytest.approx(min(shares), rel=2e-3)
    assert abs(rest @ end.point) == pytest.approx(np.full(COUNT, 0.5), abs=1e-3)
    assert min(shares) == pytest.approx(slowest_share(0.5, 1.5), rel=2e-3)


def test_bad_input_is_refused_by_name():
    kinetic = GivenMap(lambda x, y, t: 1 + 0 * y, kinetic=True)
    with pytest.raises(ValueError, match="must not depend on time"):
        map_share(SineWave(), kinetic)
    with pytest.raises(ValueError, match="wave"):
        map_share("sine", patches(np.ones(COUNT)))
    with pytest.raises(ValueError, match=r"low = 1\.2"):
        slowest_share(1.2, 2.0)
    still = TravellingWave(np.zeros(1), np.zeros(1))
    with pytest.raises(ValueError, match="must move"):
        map_share(still, patches(np.ones(COUNT)))

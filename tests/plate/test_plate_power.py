"""Power of the plate on its ground, to second order in (alpha, beta): beside cycles and steps."""

import math
from functools import cache

import numpy as np
import pytest

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, cycle_speed, simulate
from figures.measure import saddle
from linear_theory import (
    FieldWave,
    Scale,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    crawl_speed,
)

SKEW = TravellingWave([1.0, 0.4], [0.0, 0.3])
LAWS = {"tanh": Tanh(0.3), "viscous": Viscous()}
PLACE = saddle.PLACES["paper"]._replace(cells=(2, 4))
ALPHA, BETA = 0.01, 0.1
WEIGHED = 1e-3 * PLACE.weight * PLACE.sheet.area  # mu times the weight
CORNERS = [(a, b) for a in (ALPHA, -ALPHA) for b in (BETA, -BETA)]


@cache
def theory(name, alpha, beta, rtol=1e-3):
    return crawl_speed(saddle.scene(PLACE, SKEW, LAWS[name], alpha, beta), order=2, rtol=rtol)


@cache
def stepped(name, alpha, beta):
    asked = saddle.scene(PLACE, SKEW, LAWS[name], alpha, beta)
    return simulate(asked, 1, steps=32, mesh_error=False).speed


def cycled(name, alpha, beta, rtol):
    fine = PLACE._replace(cells=(4, 8))
    return cycle_speed(saddle.scene(fine, SKEW, LAWS[name], alpha, beta), rtol=rtol)


def mixed(powers):
    """Coefficient of |alpha| beta, without the next order, which is odd in alpha."""
    values = dict(zip(CORNERS, powers, strict=True))
    return sum(math.copysign(1, b) * p for (_, b), p in values.items()) / (4 * ALPHA * BETA)


def test_power_is_that_of_the_stepper_and_so_is_what_bending_adds():
    one, other = ([f("tanh", *c).power for c in CORNERS] for f in (theory, stepped))
    for exact, found in zip(one, other, strict=True):
        assert abs(exact.value - found.value) <= exact.error + found.error
        assert found.error < 0.05 * found.value
    added, steps = (mixed([p.value for p in powers]) for powers in (one, other))
    assert added < -0.05
    assert steps == pytest.approx(added, rel=0.05)  # 4 % by these few elements


def test_power_is_that_of_a_cycle_with_cost_and_efficiency():
    exact, found = (f("tanh", ALPHA, -BETA, rtol=3e-2) for f in (theory, cycled))
    assert exact.power.value == pytest.approx(found.power.value, rel=3e-3)
    for name in ("cost_of_transport", "efficiency"):
        one, other = getattr(exact, name), getattr(found, name)
        assert abs(one.value - other.value) <= one.error + other.error + 0.02 * one.value, name
    assert math.isnan(exact.energy.model_error)


def test_errors_of_the_power_are_honest():
    random = np.random.default_rng(4)
    for _ in range(3):
        beta, name = random.uniform(-0.3, 0.3), random.choice([*LAWS])
        rough, fine = (theory(str(name), ALPHA, beta, r).power for r in (2e-2, 5e-4))
        assert abs(rough.value - fine.value) <= rough.error + fine.error
        assert rough.error < 0.1 * rough.value


def test_works_of_growth_are_those_of_a_cycle():
    """Stored by stretching, by bending and on the ground: three quarters of it by the last two."""
    fine = PLACE._replace(cells=(4, 8))
    asked = saddle.scene(fine, SineWave(), Viscous(), 0.001, 0.05)
    strain = WEIGHED / PLACE.sheet.area / PLACE.sheet.thickness
    exact = crawl_speed(asked, order=2, rtol=1e-2).growth_power(strain)
    found = cycle_speed(asked, rtol=1e-1).growth_power(strain)
    assert exact.positive.value == pytest.approx(found.positive.value, rel=1e-2)
    off = np.sqrt(np.mean((exact.stored - found.stored) ** 2) / np.mean(found.stored**2))
    assert off < 0.02
    flat = crawl_speed(asked.but(curvature_coupling=0.0), order=2, rtol=1e-2).growth_power(strain)
    assert flat.positive.value < 0.35 * exact.positive.value


def test_a_wave_that_changes_the_weight_has_a_power_but_no_course_of_it():
    """Growth then lifts and lowers weight, by how much depends on mu alone, not on the strain."""
    wave = FieldWave(lambda x, y, t: (1 + y) * np.sin(2 * np.pi * t) + 0 * x, 1.0)
    found = crawl_speed(saddle.scene(PLACE, wave, Viscous(), 0.01, 0.05), order=2, rtol=1e-1)
    assert found.power.value > 0
    with pytest.raises(ValueError, match=r"load = 'grown': must be 'material' .* simulate\(scene\)"):
        found.growth_power(1e-2)


def test_power_of_bending_alone():
    """Without growth the slip is beta^2 v_b; dry, so is the power."""
    one, other = (
        crawl_speed(saddle.scene(PLACE, SKEW, Tanh(1e-9), 1.0, b).but(alpha=0.0), order=2, rtol=5e-2)
        for b in (0.1, 0.2)
    )
    assert other.power.value == pytest.approx(4 * one.power.value, rel=1e-6)
    assert one.efficiency.value == pytest.approx(abs(one.mean) / one.power.value)
    used = Scale(0.04, 8.0).energy(other, weight_n=2e-3, friction=0.5)
    assert used.power_w == pytest.approx(0.5 * 2e-3 * other.power.value * 0.04 / 8)


def test_power_of_steps_does_not_count_the_height_that_the_sheet_happens_to_have():
    """Energy of the weight at the end of a period that does not quite repeat is stored, not spent."""
    sheet = Sheet()
    material = Material(sheet.thickness, sheet.poisson)
    rubbing = Friction(1e-3, law="viscous")  # so that the height is some 3 % of the work
    effects = (Membrane(material), Bending(material), Gravity(2.5e-4), Ground(0.5), rubbing)
    asked = Scene(sheet, SineWave(), 0.002, -0.2, effects, cells=(3, 6))
    expected = cycle_speed(asked, rtol=3e-2)
    for steps in (40, 64):
        found = simulate(asked, 1, steps=steps).speed
        for name in ("power", "cost_of_transport"):
            one, other = getattr(found, name), getattr(expected, name)
            assert abs(one.value - other.value) <= one.error + other.error, name

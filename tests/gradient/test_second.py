"""Gradients of order 2 of planar sheets: parameters that break a symmetry, costs, kinks."""

import numpy as np
import pytest

from fem_check.optimisation.adjoint import Adjoint
from fem_check.optimisation.objectives import Speed
from fem_check.optimisation.unknowns import Unknowns
from linear_theory import Contact, Coulomb, FieldWave, Scene, Sheet, Tanh, TravellingWave, crawl_speed
from linear_theory.gradient import WaveFamily, cost_gradient, motion_gradient, speed_gradient

COSINES = TravellingWave([1.0, 0.3], [0.0, 0.0])
"""V(t_0 - t) = V(t): half a period is solved for."""

SCENE = Scene(Sheet(width=0.4, poisson=0.3), COSINES, alpha=0.1, contact=Contact("grown", Tanh(0.1)))


def differences(scene, one, quantity, steps, rtol=1e-5):
    """Of whole evaluations, extrapolated."""
    value, (far, near) = one.value(scene), steps
    ends = {
        s * h: quantity(crawl_speed(one.changed(scene, value + s * h), rtol=rtol, order=2))
        for h in steps
        for s in (1, -1)
    }
    slopes = [(ends[h] - ends[-h]) / (2 * h) for h in (far, near)]
    return slopes[1] + (slopes[1] - slopes[0]) / ((far / near) ** 2 - 1)


def test_parameters_that_break_the_reversal_of_time():
    """V is even in all sines together, as -sines are the wave at -t seen from the other end."""
    over = ["wave.sine.0", "wave.sine.1", "wave.sine.2", "wave.cosine.1"]
    found = speed_gradient(SCENE, over, order=2, rtol=1e-3)
    size = abs(found.values[-1])
    assert np.all(abs(found.values[:3]) < 1e-12 * size)
    assert np.all(found.errors < 1e-2 * size)
    want = differences(SCENE, found.parameters[-1], lambda speed: speed.mean, (0.02, 0.01))
    assert found.values[-1] == pytest.approx(want, abs=found.errors[-1])


@pytest.mark.parametrize("order", [1, 2])
def test_waves_that_break_the_mirror_symmetry_too(order):
    """Of a change of the wave that is neither even nor odd in x, its even part alone counts."""

    def make(s):
        def value(x, y, t):
            phi = 2 * np.pi * (y - t)
            more = np.cos(2 * np.pi * (y - 2 * t) + 4 * x + 3 * x**2)
            return np.cos(phi) + 0.3 * np.cos(2 * phi) + s * more

        return FieldWave(value, 1.0) if s else COSINES

    family = WaveFamily("s", 0.0, make)
    found = speed_gradient(SCENE, [family], order=order, rtol=1e-3)

    def speed(s):
        return crawl_speed(SCENE.but(wave=make(s)), rtol=1e-3, order=order).mean

    want = (speed(0.02) - speed(-0.02)) / 0.04
    assert found.values[0] == pytest.approx(want, abs=found.errors[0] + 0.02 * abs(want))
    assert found.errors[0] < abs(want)


def test_power_and_cost_of_transport():
    found = motion_gradient(SCENE, ["wave.cosine.1"], order=2, rtol=1e-3)
    (one,) = found.cost.parameters

    def numbers(speed):
        return np.array([speed.power.value, speed.cost_of_transport.value])

    wanted = differences(SCENE, one, numbers, (0.02, 0.01), 1e-4)
    for gradient, want in zip((found.power, found.cost), wanted, strict=True):
        assert gradient.values[0] == pytest.approx(want, abs=gradient.errors[0])
        assert gradient.errors[0] < 0.1 * abs(want)
    assert cost_gradient(SCENE, one, order=2, rtol=1e-3).values == found.cost.values


def test_dry_friction_counts_the_distance_over_which_it_is_linearised():
    """V is linear in the mean of the wave, so that any difference is exact."""
    wave, dry = TravellingWave([0.69, 0.27, 0.04], [0.0] * 3, mean=-0.19), Contact(friction=Coulomb())
    scene = Scene(Sheet(width=0.61, poisson=0.45), wave, alpha=0.14, contact=dry)
    found = speed_gradient(scene, ["wave.mean", "wave.cosine.1"], order=2, rtol=1e-2)
    want = differences(scene, found.parameters[0], lambda speed: speed.mean, (0.1, 0.05), 1e-2)
    assert found.values[0] == pytest.approx(want, abs=found.errors[0])
    assert found.errors[0] < 0.05 * abs(want)
    assert "kink" in found.kinks[0]  # of the others


def test_optimise_has_the_gradient_where_it_is_one():
    unknowns = Unknowns(SCENE, {"sheet.width": (0.3, 0.5)})
    assert Adjoint.of(unknowns, Speed(), 1e-3, "second order") is not None
    oblique = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), 1.0)
    turning = Unknowns(SCENE.but(wave=oblique), {"sheet.width": (0.3, 0.5)})
    assert Adjoint.of(turning, Speed(), 1e-3, "second order") is None

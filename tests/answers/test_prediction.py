"""`predict`: the cheapest level that is known to be near enough, and an honest error."""

import math
import warnings

import numpy as np
import pytest

from fem_check.answer.rounding import measured
from fem_check.choice.levels import LEVELS, MESHES, TARGET, cycle, finer
from fem_check.choice.prediction import predict
from fem_check.shell.cycle.speed import cycle_speed
from linear_theory import (
    BeyondReachWarning,
    Contact,
    FieldWave,
    Scene,
    Sheet,
    SineWave,
    Tolerance,
    TravellingWave,
    crawl_speed,
    line_cycle_speed,
)

PULSE = TravellingWave(np.array([0.5, 0.3]), np.array([0.2, 0.1]))


@pytest.fixture(scope="module")
def reference():
    """Speed of the nonlinear sheet by scene, on a mesh finer than any level takes."""
    found = {}

    def speed(scene):
        if scene not in found:
            found[scene] = cycle_speed(finer(scene, 3), rtol=1e-4).mean
        return found[scene]

    return speed


@pytest.mark.parametrize("rtol", [0.3, 0.1, 0.03, 1e-2, 2e-3])
@pytest.mark.parametrize(
    ("width", "alpha", "load", "law"),
    [(0.5, 0.25, "current", "exp"), (0.2, 0.1, "grown", "linear"), (1.0, 0.05, "current", "exp")],
)
def test_error_covers_the_distance_to_the_nonlinear_sheet(reference, width, alpha, load, law, rtol):
    sheet, wave = Sheet(width=width), SineWave()
    scene = Scene(sheet, wave, alpha, growth_law=law, contact=Contact(load))
    found = predict(sheet, wave, alpha, law, load=load, rtol=rtol)
    assert found.scene == scene
    assert found.converged
    assert found.error <= rtol * abs(found.mean)
    # 2e-4: the reference itself, whose tolerance is 1e-4
    true = reference(scene)
    assert abs(found.mean - true) <= found.error + 2e-4 * abs(true)


def test_levels_rise_with_the_tolerance():
    levels = [predict(Sheet(), SineWave(), 0.1, rtol=rtol).level for rtol in (0.5, 0.1, 0.03, 1e-3)]
    places = [list(LEVELS).index(level) for level in levels]
    assert places == sorted(places)
    assert levels[0] == "strip"
    assert levels[-1] == TARGET


@pytest.mark.parametrize(
    ("wave", "friction", "slip_speed"),
    [(PULSE, "coulomb", None), (SineWave(), "viscous", None), (SineWave(5), "coulomb", None)],
)
def test_a_level_of_unknown_model_error_is_not_taken(wave, friction, slip_speed):
    found = predict(Sheet(), wave, 0.1, friction=friction, slip_speed=slip_speed, rtol=0.9)
    assert found.level == TARGET
    for level in list(LEVELS)[:-1]:
        assert f"not {level}: its model error is unknown" in found.reason


def test_asked_for_levels_are_their_functions():
    sheet, wave = Sheet(width=0.2), SineWave()
    strip = predict(sheet, wave, 0.1, level="strip")
    assert strip.mean == pytest.approx(
        line_cycle_speed(0.1, body="strip"), rel=1e-12
    )  # both to rounding
    for order, name in ((1, "first order"), (2, "second order")):
        # predict gives half of its tolerance to the numbers
        expected = crawl_speed(sheet, wave, 0.1, rtol=5e-3, atol=5e-8, order=order)
        assert predict(sheet, wave, 0.1, level=name).mean == pytest.approx(expected.mean, rel=1e-13)
    pulse = predict(sheet, PULSE, 0.1, level="strip")
    assert math.isnan(pulse.error)
    assert not pulse.converged


@pytest.mark.parametrize("level", LEVELS)
def test_units(level):
    small = predict(Sheet(1.0, 0.4), SineWave(), 0.1, level=level)
    large = predict(Sheet(3.0, 1.2), SineWave(period=2.0), 0.1, level=level)
    # the same numbers but for rounding, which the iterations see
    assert large.mean == pytest.approx(1.5 * small.mean, rel=1e-9)
    assert large.error == pytest.approx(1.5 * small.error, rel=1e-3)


def test_cycle_refines_its_mesh_until_the_tolerance_is_met():
    scene = Scene(Sheet(), SineWave(), 0.25)
    coarse = cycle_speed(finer(scene, 1), rtol=1e-3)
    assert not coarse.converged  # else this test shows nothing
    fine = cycle(scene, Tolerance(1e-3, 1e-9))
    assert fine.converged
    assert fine.seconds > coarse.seconds / 10  # sums over the meshes, of which this is the first
    assert MESHES[0] == 1


def test_no_growth_no_motion():
    found = predict(Sheet(), SineWave(), 0.0)
    assert (found.mean, found.error, found.converged) == (0.0, 0.0, True)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"level": "magic"}, "'strip'"),
        ({"growth_law": "log"}, "'metric'"),
        ({"area": "none"}, "'undeformed'"),
        ({"load": "ground"}, "'material'"),
        ({"friction": "none"}, "'viscous'"),
        ({"rtol": 0.0}, "rtol = 0"),
        ({"atol": -1.0}, "atol = -1"),
        ({"alpha": math.inf}, "alpha"),
    ],
)
def test_bad_input(arguments, message):
    with pytest.raises(ValueError, match=message):
        predict(**{"sheet": Sheet(), "wave": SineWave(), "alpha": 0.1, **arguments})


def test_a_strip_refuses_a_wave_that_it_does_not_see():
    """It is the axis x = 0, where this wave is a sine."""
    lopsided = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), 1.0)
    with pytest.raises(ValueError, match="'strip': must be 'cycle' for a wave that depends on x"):
        predict(Sheet(), lopsided, 0.1, level="strip")
    assert predict(Sheet(), lopsided, 0.1, rtol=0.5).level == TARGET


@pytest.mark.parametrize("level", ["auto", "second order", "cycle"])
def test_a_sheet_too_wide_is_refused_by_name_and_not_after_minutes(level):
    with pytest.raises(ValueError, match=r"width = 100: must be <= 20 times the length, 1, for level"):
        predict(Sheet(width=100.0), SineWave(), 0.1, level=level)


def test_a_wide_sheet_has_an_answer_of_first_order():
    with warnings.catch_warnings(action="ignore", category=BeyondReachWarning):
        found = predict(Sheet(width=100.0), SineWave(), 0.1, rtol=0.3, level="first order")
        other = crawl_speed(Sheet(width=100.0), SineWave(), 0.1, rtol=0.03, method="ritz")
    assert "ends of the sheet turn by 9.55 rad" in found.speed.beyond_reach
    assert abs(found.mean - other.mean) <= found.speed.error + other.error


def test_energies_of_an_answer_are_printed_ones_with_their_model_errors():
    found = predict(Sheet(), SineWave(), 0.15, rtol=0.05)
    assert found.level != TARGET  # so that there are model errors
    for name in ("power", "cost_of_transport", "efficiency"):
        told, numerical = getattr(found, name), getattr(found.speed, name)
        assert told.value == numerical.value
        assert told.error > numerical.error
    shown = " ".join(str(found).split())
    assert f"cost of transport {measured(*found.cost_of_transport).with_unit('mu')}" in shown
    power = found.growth_power(friction_strain=1e-4)
    assert power.net.value == pytest.approx(found.power.value, rel=1e-2)

"""Where the theories of small growth end, and that sheets at rest have the speed 0 in all of them."""

import math
import warnings
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from fem_check import Material, Membrane, Scene, cycle_speed, plane_stress_field, predict
from linear_theory import (
    BeyondReachWarning,
    CrawlSpeed,
    FieldWave,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    airy_series,
    crawl_speed,
    field_speed,
    friction_field,
    line_balance,
    ritz_field,
    second_order,
)
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.speed.reach import LARGEST_GROWTH, rotation

PAPER, SINE = Sheet(), SineWave()
K = 2 * np.pi


def field_wave(amplitude: float = 1.0, shift: float = 0.0) -> FieldWave:
    return FieldWave(lambda x, y, t: shift + amplitude * np.sin(K * (y - t)) + 0 * x, 1.0)


# Peaks of |c| by hand: the pulse has 0.5 + 0.3 at phase 0, the field waves |shift| + amplitude.
PEAKS = [
    (SINE, 1.0),
    (TravellingWave([0.5, 0.3], [0.0, 0.0]), 0.8),
    (TravellingWave([0.0], [1.0], mean=-0.5), 1.5),
    (TravellingWave([0.3], [0.4], 3, 2.0), 0.5),
    (field_wave(0.7), 0.7),
    (field_wave(0.7, -0.2), 0.9),
]


@pytest.mark.parametrize(("wave", "peak"), PEAKS)
def test_the_largest_growth_is_found(wave, peak):
    x = y = np.linspace(-0.5, 0.5, 33)
    growths = wave.on(Sheet()).growths(x, y)
    assert abs(growths).max() == pytest.approx(peak, rel=2e-3)  # (pi/64)^2/2: times


@pytest.mark.parametrize(("wave", "peak"), PEAKS[:3])
@pytest.mark.parametrize("order", [1, 2])
def test_growth_beyond_reach_is_warned_of_and_never_converged(wave, peak, order):
    # a load that is conserved is not refused for its sign, as the current one is from 0.437 on
    options = {"order": order, "load": "material", "rtol": 0.3}
    inside = crawl_speed(PAPER, wave, 0.98 * LARGEST_GROWTH / peak, **options)
    assert (inside.beyond_reach, inside.converged) == ("", True)
    with pytest.warns(BeyondReachWarning, match="beyond the reach.*growth") as seen:
        beyond = crawl_speed(PAPER, wave, -1.02 * LARGEST_GROWTH / peak, **options)
    assert [warning.filename for warning in seen] == [__file__]
    assert not beyond.converged
    assert "growth |alpha c| reaches 0.51" in beyond.beyond_reach
    assert beyond.reach.startswith("beyond the reach")


@pytest.mark.parametrize("alpha", [0.6, 12.0, -1e3])
def test_numbers_that_mean_nothing_say_so_however_they_are_asked_for(alpha):
    field = ritz_field(PAPER, field_wave(), degree=5)
    calls: list[Callable[[], CrawlSpeed]] = [
        lambda: crawl_speed(PAPER, SINE, alpha, order=2, rtol=0.3),
        lambda: crawl_speed(PAPER, SINE, alpha, load="material", rtol=0.3),
        lambda: field_speed(field, alpha, load="material", rtol=0.3),
        lambda: predict(PAPER, SINE, alpha, level="second order", rtol=0.3).speed,
    ]
    for call in calls:
        with pytest.warns(BeyondReachWarning, match="alpha = ") as seen:
            assert not call().converged
        assert [warning.filename for warning in seen] == [__file__]
    with pytest.warns(BeyondReachWarning, match="alpha = "):
        friction_field(field, alpha, 0.1, 0.1, 0.0, load="material")


@pytest.mark.parametrize("width", [0.1, 0.5, 1.0])
def test_growth_of_the_paper_is_no_reason_to_warn(width):
    """Warnings are errors here. Wide sheets have no positive load of first order from 0.387 on."""
    sheet = Sheet(width=width)
    for alpha in (0.01, 0.25, 0.38 if width == 1 else 0.4):
        for order in (1, 2):
            assert crawl_speed(sheet, SINE, alpha, order=order, rtol=0.3).converged


def moment(t: np.ndarray) -> np.ndarray:
    """Slope of the sine along y, from its exact moment: int y sin(2 pi (y - t)) = -cos(2 pi t)/2 pi."""
    return 12 * -np.cos(K * t) / K


@pytest.mark.parametrize("width", [0.5, 2.0, 10.0])
def test_the_rotation_of_the_ends_is_that_of_the_linear_part_of_the_wave(width):
    """c = b y turns the places (x, y) by -b x; of the field of the whole wave more by edge layers."""
    exact = abs(moment(np.arange(8) / 8)).max() * width / 2
    assert rotation(SINE.on(Sheet(width=width))) == pytest.approx(exact, rel=1e-9)
    if width == 10:
        field, h = airy_series(Sheet(width=width), SINE, rtol=1e-3), 1e-3
        x, y = 0.4 * width, 0.0
        across, along = (
            np.subtract(field.displacement(x + a, y + b, 0.0), field.displacement(x - a, y - b, 0.0))
            for a, b in ((h, 0.0), (0.0, h))
        )
        turned = abs(across[1] - along[0]) / (4 * h)
        assert turned == pytest.approx(0.8 * exact, rel=0.02)


def test_rotations_of_waves_across_and_of_many_waves():
    """c = 2 x sin turns a sheet by L/2 times 2 at its ends; 500 waves have hardly a linear part."""
    lopsided = FieldWave(lambda x, y, t: 2 * x * np.sin(K * t) + 0 * y, 1.0)
    assert rotation(lopsided.on(Sheet())) == pytest.approx(1.0, rel=1e-9)
    assert rotation(SineWave(500).on(Sheet())) < 0.05
    assert rotation(SineWave(3, period=7.0).on(Sheet(9.0, 4.5))) == pytest.approx(12 / K / 12, rel=1e-9)


@pytest.mark.parametrize("order", [1, 2])
def test_a_sheet_so_wide_that_its_ends_swing_is_beyond_reach(order):
    """In the plane by 0.95 alpha W/L: at rtol = 1e-4 this took half a minute at W = 100 L."""
    sheet = Sheet(width=6.0 if order == 2 else 100.0)
    with pytest.warns(BeyondReachWarning, match="ends of the sheet turn by"):
        found = crawl_speed(sheet, SINE, 0.1, order=order, rtol=0.3 if order == 2 else 1e-4)
    assert not found.converged
    near = crawl_speed(Sheet(width=4.0), SINE, 0.1, rtol=0.1)
    assert near.beyond_reach == ""


def test_what_is_exact_in_the_strain_has_no_such_end():
    assert line_balance(SINE, 0.9).converged
    assert line_balance(SINE, 0.9).beyond_reach == ""


def test_a_second_order_above_all_speeds_of_the_sheet_says_so():
    """A steep wave on a narrow sheet, with growth of a half at the most.

    How fast it crawls is known: a strip's friction is balanced exactly, at finite strain. The number of
    second order is far from it, although growth is not too large; at a fifth of alpha it is near.
    """
    # k = 1, 3, 5 of a square wave, its slope where c = 0 is 3 times that of a sine
    steep = TravellingWave(np.zeros(5), 0.93 * np.array([1, 0, 1 / 3, 0, 1 / 5]))
    narrow, alpha = Sheet(width=0.05), 0.3
    assert alpha * abs(steep.on(Sheet()).growths(np.zeros(1), np.zeros(1))).max() < LARGEST_GROWTH
    with pytest.warns(BeyondReachWarning, match="largest speed of the points"):
        found = crawl_speed(narrow, steep, alpha, order=2, rtol=0.1)
    strip = line_balance(steep, alpha, growth_law="exp", body="strip")
    assert found.mean > 1.5 * strip.mean
    assert not found.converged
    near = crawl_speed(narrow, steep, alpha / 10, order=2, rtol=0.1)
    exact = line_balance(steep, alpha / 10, growth_law="exp", body="strip").mean
    assert near.beyond_reach == ""
    assert near.mean == pytest.approx(exact, rel=0.2)  # rtol and as much for the width


def test_what_is_known_of_the_nonlinear_sheet_is_said_in_words():
    known = crawl_speed(PAPER, SINE, 0.1, order=2, rtol=0.1)
    assert known.reach == f"within {known.model_error:.1g} of the nonlinear sheet"
    pulse = crawl_speed(PAPER, TravellingWave([0.5, 0.3], [0.2, 0.1]), 0.1, rtol=0.3)
    assert math.isnan(pulse.model_error)
    assert pulse.reach == "distance to the nonlinear sheet unknown"
    assert replace(pulse, model_error=0.0).reach == "agrees with the nonlinear sheet"


def test_predict_says_in_its_reason_what_is_not_known():
    pulse = TravellingWave([0.5, 0.3], [0.2, 0.1])
    found = predict(PAPER, pulse, 0.1, level="strip")
    assert found.reason == "requested; distance to the nonlinear sheet unknown"
    with warnings.catch_warnings(category=BeyondReachWarning, action="ignore"):
        found = predict(PAPER, SINE, 0.6, level="second order")
    assert found.reason.startswith("requested; beyond the reach of the theory: growth")
    assert not found.converged


# ---- at rest ----

STILL = {
    "alpha = 0": (SINE, 0.0),
    "alpha = 0, any wave": (field_wave(), 0.0),
    "amplitude 0": (TravellingWave([0.0], [0.0]), 0.1),
    "growth that stays": (TravellingWave([0.0], [0.0], mean=0.3), 0.1),
    "any wave of amplitude 0": (field_wave(0.0), 0.1),
    "any growth that stays": (FieldWave(lambda x, y, t: np.cos(y) + 0 * (x + t), 1.0), 0.1),
}
FRICTION = {"coulomb": None, "tanh": 0.1, "viscous": None}
SCENE_EFFECTS = [Membrane(Material(0.03, 0.5))]


@pytest.mark.parametrize("friction", FRICTION)
@pytest.mark.parametrize("name", STILL)
def test_nothing_crawls_without_growth_that_changes(name, friction):
    wave, alpha = STILL[name]
    law = {"friction": friction, "slip_speed": FRICTION[friction]}
    scene = Scene(PAPER, wave, alpha, effects=SCENE_EFFECTS, cells=(1, 2))
    field = ritz_field(PAPER, wave, degree=5)
    found = [
        crawl_speed(PAPER, wave, alpha, rtol=0.1, **law),
        crawl_speed(PAPER, wave, alpha, rtol=0.1, order=2, **law),
        field_speed(field, alpha, rtol=0.1, **law),
        field_speed(plane_stress_field(PAPER, wave, size=0.4), alpha, rtol=0.1, **law),
        line_balance(wave, alpha, rtol=0.1, length=1, **law),
        cycle_speed(scene, rtol=0.1, **law),
        *(predict(PAPER, wave, alpha, level=m, **law).speed for m in ("strip", "second order")),
    ]
    for speed in found:
        assert abs(speed.mean) <= speed.error <= 1e-14  # roundoff of shapes and of rates
        assert not speed.sticks
    at = friction_field(field, alpha, 0.1, [0.1, 0.2], 0.0, **law)
    np.testing.assert_array_less(abs(at.slip), 1e-14)
    assert np.all(np.isfinite(at.force))


@pytest.mark.parametrize("name", STILL)
def test_without_growth_that_changes_there_is_no_second_order(name):
    wave, alpha = STILL[name]
    found = second_order(PAPER, wave, rtol=0.1)
    if alpha:  # else it is the wave that counts, not the alpha
        assert abs(found.first) <= 1e-14
        assert abs(found.second) <= found.second_error + 1e-14 <= 1e-9


def test_the_distance_to_the_nonlinear_sheet_is_nothing_at_rest():
    for friction, slip_speed in FRICTION.items():
        law = {"friction": friction, "slip_speed": slip_speed}
        assert crawl_speed(PAPER, SINE, 0.0, rtol=0.1, **law).model_error == 0
        still = predict(PAPER, TravellingWave([0.0], [0.0]), 0.1, level="second order", **law)
        assert (still.mean, still.converged) == (0.0, True)


def test_friction_at_rest_is_none_under_the_load_that_is_there():
    """With alpha = 0 the law tanh(v/v0) has no speeds to be scaled with."""
    for name, slip_speed in FRICTION.items():
        at = friction_field(
            airy_series(PAPER, SINE, modes=5),
            0.0,
            0.1,
            [0.1, 0.2],
            0.3,
            friction=name,
            slip_speed=slip_speed,
        )
        np.testing.assert_array_equal(at.force, np.zeros((2, 2)))
        np.testing.assert_array_equal(at.weight, [1.0, 1.0])


def test_speeds_of_rounding_are_no_viscous_regime() -> None:
    """Speeds of 1e-14 L/T are those of a sheet at rest, 1e-4 are not, however wide the law."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_if_viscous(Tanh(0.1), 1e13)
        warn_if_viscous(Tanh(0.1), math.inf)
    for width in (0.1, 1e150):
        with pytest.warns(ViscousRegimeWarning, match="acts as viscous"):
            warn_if_viscous(Tanh(width), width / 1e-4)

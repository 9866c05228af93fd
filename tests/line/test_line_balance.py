"""Any wave on a line: weighted median, its coefficients, sticking, honest errors, general waves."""

import math

import numpy as np
import pytest

from linear_theory import SineWave, TravellingWave
from linear_theory.line import line_speed, line_speed_tanh, line_speed_viscous
from linear_theory.line.balance import line_balance
from linear_theory.line.samples import doubling
from linear_theory.wave.given import FieldWave
from tests.line import reference_line


def sampled(profile, count=1, period=1.0, points=64):
    return TravellingWave.from_samples(profile(2 * np.pi * np.arange(points) / points), count, period)


WAVES = {
    "skewed": TravellingWave([0.0, 0.3], [1.0, 0.1], -2, 3.0),
    "two harmonics": TravellingWave([0.2, 0.0, -0.4], [0.7, 0.5, 0.0], 3, 0.5, mean=0.2),
    "pulse": sampled(lambda p: np.exp(-(((p - 3) / 0.8) ** 2) / 2), points=32),
    "narrow train": sampled(lambda p: np.exp((np.cos(p - 1) - 1) / 0.35**2), 2, points=40),
    "near-square": sampled(lambda p: np.tanh(6 * np.sin(p) + 0.5), points=48),
    "saw-tooth": sampled(lambda p: np.sin(p + 0.8 * np.sin(p)), -1, points=32),
    "ripple": TravellingWave(np.eye(12)[11] * 0.1, np.eye(12)[0] + np.eye(12)[6] * 0.1),
    "turning median": TravellingWave([0.0, 0.5], [1.0, 0.0]),
}
ALPHAS = (1e-9, -1e-4, -0.5, 0.6)


class Anonymous:
    """A travelling wave that does not say so: takes the way of general waves."""

    def __init__(self, wave):
        self.period, self.value, self.rate = wave.period, wave.value, wave.rate


@pytest.mark.parametrize("load", ["current", "material"])
@pytest.mark.parametrize("name", WAVES)
def test_errors_are_honest_for_travelling_waves(name, load):
    wave = WAVES[name]
    # Near a turning value the reference would have to tell crossings alpha apart.
    for alpha in ALPHAS[2 * (name == "turning median") :]:
        result = line_balance(wave, alpha, load=load)
        unit = alpha / wave.count / wave.period
        level = reference_line.travelling_level(wave, alpha, load != "material", result.mean / unit)
        true_error = abs(float(level * unit - result.mean))
        assert true_error <= result.error
        # Rounding only; a flat density (near-square wave) multiplies it.
        assert result.error <= 1e-13 * abs(unit)


@pytest.mark.parametrize("alpha", [1e-12, 1e-8, -1e-4, 0.3, -0.9, 0.999999])
@pytest.mark.parametrize("count", [1, -3])
@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_sine_agrees_with_the_closed_forms(alpha, count):
    wave = SineWave(count, 2.0)
    unit = abs(alpha / count / 2.0)
    dry = line_balance(wave, alpha)
    exact = line_speed(alpha, count, 2.0)
    # Relative to V ~ alpha^2, although the velocities are ~ alpha.
    assert dry.mean == pytest.approx(exact, rel=1e-14)
    assert abs(dry.mean - exact) <= dry.error + 2 * np.spacing(abs(exact))
    assert dry.converged
    assert not dry.sticks
    viscous = line_balance(wave, alpha, friction="viscous")
    assert viscous.mean == pytest.approx(line_speed_viscous(alpha, count, 2.0), rel=1e-14)
    for width in (1e-9, 1e-3, 0.1, 1.0, 1e6):
        blunt = line_balance(wave, alpha, friction="tanh", slip_speed=width * unit)
        exact = line_speed_tanh(alpha, width * unit, count, 2.0)
        assert blunt.mean == pytest.approx(exact, rel=1e-13)
        fastest = unit * (1 + abs(blunt.mean) / unit)
        assert blunt.slip_ratio == pytest.approx(width * unit / fastest, rel=1e-3)


@pytest.mark.parametrize("friction", ["coulomb", "tanh", "viscous"])
def test_weight_conserved_means_no_speed_for_the_sine(friction):
    slip_speed = 0.1 if friction == "tanh" else None
    result = line_balance(SineWave(), 0.3, "material", friction, slip_speed)
    assert abs(result.mean) <= result.error


@pytest.mark.parametrize("name", WAVES)
def test_mirrored_wave_gives_minus_v(name):
    wave = WAVES[name]
    mirrored = TravellingWave(wave.cosine, wave.sine, -wave.count, wave.period, wave.mean)
    opposite = TravellingWave(-wave.cosine, -wave.sine, wave.count, wave.period, -wave.mean)
    result = line_balance(wave, 0.4)
    assert line_balance(mirrored, 0.4).mean == -result.mean
    assert line_balance(opposite, -0.4).mean == result.mean  # the same growth


@pytest.mark.parametrize("name", [name for name in WAVES if name != "turning median"])
def test_coefficients_are_the_limits_of_small_alpha(name):
    wave = WAVES[name]
    result = line_balance(wave, 0.1)
    median = np.median(wave.profile(np.linspace(0, 2 * np.pi, 200001)))
    # The median of 200 001 samples: one spacing times the slope at the median.
    first = (median - wave.mean) / wave.count / wave.period
    assert result.first_order == pytest.approx(first, abs=1e-4)
    h = 1e-4
    up, down = line_balance(wave, h).mean, line_balance(wave, -h).mean
    # Central differences: the next terms are of relative order h^2 times derivatives up to 1e4.
    assert (up - down) / (2 * h) == pytest.approx(result.first_order, abs=1e-5)
    assert (up + down) / (2 * h**2) == pytest.approx(result.second_order, rel=1e-3, abs=1e-6)


@pytest.mark.parametrize("name", WAVES)
def test_tanh_tends_to_dry_friction(name):
    wave = WAVES[name]
    unit = abs(0.3 / wave.count / wave.period)
    dry = line_balance(wave, 0.3).mean
    for width in (1e-5, 1e-14):
        blunt = line_balance(wave, 0.3, friction="tanh", slip_speed=width * unit)
        # First order in v0 in general: the density of the values is not even about the median.
        assert abs(blunt.mean - dry) <= unit * width + blunt.error + line_balance(wave, 0.3).error


@pytest.mark.parametrize("slip_speed", [5e-324, 1e-320, 1e-200])
@pytest.mark.parametrize("name", ["skewed", "turning median"])
def test_subnormal_slip_speeds_are_dry(name, slip_speed):
    for wave in (WAVES[name], Anonymous(WAVES[name])):
        dry = line_balance(wave, 0.3, length=1)
        blunt = line_balance(wave, 0.3, friction="tanh", slip_speed=slip_speed, length=1)
        assert abs(blunt.mean - dry.mean) <= blunt.error + dry.error


def test_loads_current_and_grown_are_one_on_a_line():
    wave = WAVES["skewed"]
    assert line_balance(wave, 0.3, "grown").mean == line_balance(wave, 0.3, "current").mean


def test_coefficients_of_the_sine():
    result = line_balance(SineWave(2, 5.0), 0.1)
    assert result.first_order == 0
    assert result.second_order == pytest.approx(1 / 10, rel=1e-14)
    viscous = line_balance(SineWave(2, 5.0), 0.1, friction="viscous")
    assert viscous.second_order == pytest.approx(1 / 20, rel=1e-14)


def test_a_median_at_a_turning_value_has_no_second_coefficient():
    # c = sin + cos(2 phi)/2 has median 1/2, its local minimum at phi = pi/2.
    result = line_balance(WAVES["turning median"], 0.1)
    assert result.first_order == pytest.approx(0.5, rel=1e-14)
    assert math.isnan(result.second_order)


def compact_pulse(phase):
    return np.where(abs(phase - 3) < 1, np.cos((phase - 3) * np.pi / 2) ** 2, 0.0)


@pytest.mark.parametrize("points", [256, 1024])
def test_a_pulse_with_gaps_sticks_where_the_regularised_law_says(points):
    wave = sampled(compact_pulse, points=points)
    for alpha in (0.5, -0.5):
        result = line_balance(wave, alpha)
        assert result.sticks
        # The gaps are at rest: V = (alpha/nT)(0 - mean c). The series rings there by ~ points^-2.
        assert result.mean == pytest.approx(-alpha * wave.mean, abs=1 / points**2)
        assert result.first_order == pytest.approx(-wave.mean, abs=1 / points**2)
        assert abs(result.second_order) < 1 / points
        regularised = line_balance(wave, alpha, friction="tanh", slip_speed=1e-7)
        assert regularised.mean == pytest.approx(result.mean, abs=1e-6)
        assert not regularised.sticks
    assert not line_balance(SineWave(), 0.5).sticks


def test_no_growth_no_motion():
    for wave in (SineWave(), Anonymous(SineWave()), TravellingWave([0.0], [0.0], mean=0.5)):
        for friction, slip_speed in (("coulomb", None), ("tanh", 0.1), ("viscous", None)):
            result = line_balance(wave, 0.0, friction=friction, slip_speed=slip_speed, length=1)
            assert (result.mean, result.converged) == (0.0, True)
    constant = line_balance(TravellingWave([0.0], [0.0], mean=0.5), 0.3)
    assert constant.mean == 0
    assert not constant.sticks  # all is at rest, and not a part of it


@pytest.mark.parametrize("name", WAVES)
@pytest.mark.parametrize("width", [1e-3, 0.03, 2.0])
@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_tanh_error_is_honest(name, width):
    wave, alpha = WAVES[name], 0.3
    unit = alpha / abs(wave.count) / wave.period
    result = line_balance(wave, alpha, friction="tanh", slip_speed=width * unit)
    phase = np.linspace(0, 2 * np.pi, 2**16, endpoint=False)
    c = wave.profile(phase)
    slip = result.mean - alpha / wave.count / wave.period * (c - wave.mean)
    tanh = np.tanh(slip / (width * unit))
    weight = 1 + alpha * c
    # The trapezoidal rule is exact to rounding, the layers being wider than its step.
    slope = np.mean(weight * (1 - tanh**2)) / (width * unit)
    true_error = abs(np.mean(weight * tanh)) / slope
    assert true_error <= result.error + 1e-15 / slope + 2 * np.spacing(abs(result.mean))
    assert result.error <= 1e-12 * unit


@pytest.mark.parametrize("kind", ["coulomb", "material", "tanh", "viscous"])
@pytest.mark.parametrize("name", ["skewed", "two harmonics", "pulse"])
def test_general_way_agrees_with_the_travelling_one(name, kind):
    wave, alpha = WAVES[name], -0.3
    load = "material" if kind == "material" else "current"
    friction = "coulomb" if kind == "material" else kind
    slip_speed = 0.02 if kind == "tanh" else None
    exact = line_balance(wave, alpha, load, friction, slip_speed)
    general = line_balance(Anonymous(wave), alpha, load, friction, slip_speed, rtol=1e-3, length=1)
    assert general.converged
    assert abs(general.mean - exact.mean) <= general.error
    assert general.first_order == pytest.approx(exact.first_order, abs=3e-3)
    assert general.second_order == pytest.approx(exact.second_order, abs=2e-2)
    assert general.slip_ratio == pytest.approx(exact.slip_ratio, rel=1e-2)
    assert general.sticks == exact.sticks


def standing_pulse(x, y, t):
    """Grows and fades in place while a second wave runs: no symmetry left."""
    bump = np.exp(-(((y - 0.1) / 0.15) ** 2))
    return bump * np.sin(2 * np.pi * t) + 0.5 * np.sin(2 * np.pi * (y - t)) + 0 * x


def test_general_wave_minimises_the_dissipation():
    wave = FieldWave(standing_pulse, 1.0)
    alpha = 0.4
    result = line_balance(wave, alpha, rtol=1e-3, length=1)
    assert result.converged
    cells = 2000
    y = (np.arange(cells) + 0.5) / cells - 0.5
    for t, speed in list(zip(result.times, result.velocity, strict=True))[:: result.times.size // 8]:
        rate = alpha * wave.rate(0.0, y, t)
        v = (np.cumsum(rate) - rate / 2) / cells
        best = reference_line.dissipation_minimum(v - v.mean(), 1 + alpha * wave.value(0.0, y, t))
        # Neighbouring kinks are one cell apart: |dv| <= alpha max|c_t|/cells.
        assert abs(best - speed) < 2 * alpha * 10 / cells


def test_times_found_by_doubling_have_their_own_speeds():
    """Literal medians at neighbouring times, between which the speed changes by far more."""
    turn, alpha = 2 * np.pi, 0.1
    wave = FieldWave(lambda x, y, t: np.sin(turn * (y - t)) + 0.2 * y * np.sin(20 * turn * t), 1.0)
    found = line_balance(wave, alpha, rtol=3e-2, length=1.0)
    assert found.times.size > 128  # twice the first times
    y = (np.arange(4000) + 0.5) / 4000 - 0.5
    for t, speed in zip(found.times[:31], found.velocity[:31], strict=True):
        rate = -np.cos(turn * (y - t)) + 4 * y * np.cos(20 * turn * t)
        v = turn * alpha * (np.cumsum(rate) - rate / 2) / 4000
        order = np.argsort(v)
        weight = np.cumsum(1 + alpha * wave.value(0.0, y, t)[order])
        literal = v.mean() - v[order][np.searchsorted(weight, weight[-1] / 2)]
        assert speed == pytest.approx(literal, abs=1e-2 * abs(found.velocity).max())


@pytest.mark.parametrize("friction", ["coulomb", "tanh"])
def test_error_of_a_general_wave_is_honest(friction):
    wave = FieldWave(standing_pulse, 1.0)
    slip_speed = 0.05 if friction == "tanh" else None
    law = {"friction": friction, "slip_speed": slip_speed, "length": 1}
    fine = line_balance(wave, 0.4, rtol=3e-4, **law)
    for rtol in (1e-1, 1e-2, 3e-3):
        rough = line_balance(wave, 0.4, rtol=rtol, **law)
        assert rough.converged
        assert abs(rough.mean - fine.mean) <= rough.error + fine.error


def test_a_general_pulse_with_gaps_sticks():
    def value(x, y, t):
        return compact_pulse((2 * np.pi * (y - t)) % (2 * np.pi)) + 0 * x

    def rate(x, y, t):
        p = (2 * np.pi * (y - t)) % (2 * np.pi)
        inside = abs(p - 3) < 1
        return np.where(inside, np.pi**2 * np.sin((p - 3) * np.pi), 0.0) + 0 * x

    result = line_balance(FieldWave(value, 1.0, rate), 0.5, rtol=1e-3, length=1)
    mean = 1 / (2 * np.pi)
    assert result.sticks
    assert abs(result.mean + 0.5 * mean) <= result.error
    assert result.first_order == pytest.approx(-mean, rel=1e-3)
    assert abs(result.second_order) < 1e-9


def test_result_says_what_it_is():
    result = line_balance(SineWave(1, 4.0), 0.2, friction="tanh", slip_speed=0.01)
    assert "tanh" in result.model
    assert "0.01" in result.model
    assert math.isnan(result.model_error)
    assert result.seconds > 0
    assert result.times[-1] == 4.0
    assert np.all(result.velocity == result.mean)
    assert line_balance(SineWave(), 0.2).slip_ratio == 0
    assert line_balance(SineWave(), 0.2, friction="viscous").slip_ratio == np.inf


def test_missed_tolerance_is_said(monkeypatch):
    monkeypatch.setattr(doubling, "MOST_SAMPLES", 1 << 14)
    result = line_balance(FieldWave(standing_pulse, 1.0), 0.4, atol=1e-12, rtol=1e-12, length=1)
    assert not result.converged
    assert result.error > 1e-12


BAD = [
    (lambda: line_balance(SineWave(), 1.0), r"alpha = 1: alpha c = -1 at the phase 4\.712.* < 1"),
    (lambda: line_balance(SineWave(), 1.4e154), r"alpha = 1\.4e\+154: alpha\^2 L/T must be finite"),
    (lambda: line_balance(SineWave(), -1.5), r"alpha = -1\.5.*> -1"),
    (lambda: line_balance(Anonymous(SineWave()), 1.5, length=1), r"alpha = 1\.5: .* at S = "),
    (lambda: line_balance(SineWave(), np.nan), "alpha contains nan"),
    (lambda: line_balance(SineWave(), [0.1]), "alpha"),
    (lambda: line_balance(SineWave(), 0.1, load="heavy"), "load = 'heavy'"),
    (lambda: line_balance(SineWave(), 0.1, friction="wet"), "friction = 'wet'"),
    (lambda: line_balance(SineWave(), 0.1, friction="tanh"), "slip_speed = None"),
    (lambda: line_balance(SineWave(), 0.1, friction="tanh", slip_speed=-1), "slip_speed = -1"),
    (lambda: line_balance(SineWave(), 0.1, slip_speed=1.0), r"slip_speed = 1\.0"),
    (lambda: line_balance(SineWave(), 0.1, rtol=0), "rtol = 0"),
    (lambda: line_balance(SineWave(), 0.1, atol=0), "atol = 0"),
    (lambda: line_balance(SineWave(), 0.1, length=0), "length = 0: must be > 0"),
    (lambda: line_balance(FieldWave(standing_pulse, 1.0), 0.1), "length = None: must be given"),
    (lambda: line_balance(Anonymous(SineWave()), 0.1), "length = None: must be given"),
]


@pytest.mark.parametrize(("call", "message"), BAD)
def test_bad_input_names_argument_value_and_range(call, message):
    with pytest.raises(ValueError, match=message):
        call()

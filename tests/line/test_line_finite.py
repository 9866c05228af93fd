"""Growth laws, loads and bodies on a line at finite strain: exact speeds, closed forms, series."""

import math

import mpmath as mp
import numpy as np
import pytest
import sympy

from linear_theory import SineWave, TravellingWave
from linear_theory.line import (
    line_balance,
    line_cycle_series,
    line_cycle_speed,
    line_series,
    line_speed,
)
from linear_theory.wave.given import FieldWave
from tests.line import reference_line
from tests.line.test_line_balance import Anonymous, compact_pulse, sampled, standing_pulse

pytestmark = pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")  # on purpose

LAWS = {"exp": np.exp, "linear": lambda e: 1 + e, "metric": lambda e: np.sqrt(1 + 2 * e)}
RANGE = {"exp": 8.0, "linear": 1.0, "metric": 0.5}  # of |alpha c|; for exp, as far as is tried here
LOADS = {  # load and body, by the power p of the weight s^p
    0: ("material", "line"),
    1: ("current", "line"),
    2: ("current", "strip"),
}
WAVES = {
    "sine": SineWave(),
    "two harmonics": TravellingWave([0.2, -0.4], [0.75, 0.5], -3, 0.5, mean=0.25),
    # ((1 + cos phi)/2)^4, shifted
    "pulse": TravellingWave(
        np.array([56, 28, 8, 1]) / 128 * np.cos(np.arange(1, 5)),
        np.array([56, 28, 8, 1]) / 128 * np.sin(np.arange(1, 5)),
        2,
        mean=35 / 128,
    ),
    "odd, not antisymmetric": TravellingWave([0.0, 0.0], [1.0, 0.375], mean=-0.125),
}


def largest(wave, law, sign):
    """|alpha| beyond which the growth law ends, or RANGE if it never does."""
    c = sign * wave.profile(np.linspace(0, 2 * np.pi, 20001))
    least = -max(abs(c)) if law == "exp" else c.min()
    return RANGE[law] / -least if least < -1e-9 else RANGE[law]


@pytest.fixture(scope="module")
def exact():
    """The reference of a wave for one sign of alpha."""
    made = {}

    def find(name, alpha):
        key = name, alpha < 0
        if key not in made:
            made[key] = reference_line.FiniteStrain(WAVES[name], -1 if alpha < 0 else 1)
        return made[key]

    return find


def alphas(name, law):
    """From tiny to near the largest."""
    yield 1e-6
    if name == "sine":
        yield 1e-3
        yield 0.5 * largest(WAVES[name], law, 1)
    for sign in (1, -1) if name == "two harmonics" else (1,):
        yield sign * (1 - 1e-6) * largest(WAVES[name], law, sign)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", WAVES)
def test_speeds_are_exact(name, law, exact):
    wave = WAVES[name]
    scale = wave.count * wave.period
    for alpha in alphas(name, law):
        fastest = np.ptp(LAWS[law](alpha * wave.profile(np.linspace(0, 2 * np.pi, 1001))))
        for power, (load, body) in LOADS.items():
            for friction, width in (("coulomb", 0.0), ("tanh", 0.25 * fastest), ("viscous", math.inf)):
                if friction == "tanh" and power != 1 and name != "sine":
                    continue  # the reference is slow
                slip = width / abs(scale) if friction == "tanh" else None
                found = line_balance(wave, alpha, load, friction, slip, growth_law=law, body=body)
                truth = exact(name, alpha).speed(alpha, law, power, width, found.mean * scale)
                wrong = float(abs(truth / mp.mpf(scale) - mp.mpf(found.mean)))
                assert wrong <= found.error or wrong < 1e-45  # rounding of a V that is 0
                assert found.error <= 1e-13 * fastest / abs(scale)
                if name == "sine" and abs(truth) > 1e-45:  # of order alpha^2, and all digits count
                    assert wrong <= 1e-12 * abs(found.mean)
                    assert found.error <= 1e-12 * abs(found.mean)


@pytest.mark.parametrize("law", LAWS)
def test_vectorised_sine_is_exact(law, exact):
    alpha = np.array(list(alphas("sine", law)))
    for power, (load, body) in LOADS.items():
        for friction, width in (("coulomb", 0.0), ("viscous", math.inf)):
            speed = line_cycle_speed(alpha, law, load, body=body, friction=friction)
            for a, v in zip(alpha, speed, strict=True):
                truth = exact("sine", a).speed(a, law, power, width, v)
                # Rounding, times up to 10 where V is the difference of large terms (exp, alpha = 8);
                # what is 0 is so to 45 digits.
                assert float(abs(truth - mp.mpf(float(v)))) <= 1e-14 * abs(v) + 1e-45


def test_vectorised_sine_over_blocks_shapes_and_ends_of_the_range():
    alpha = np.linspace(-0.4999, 0.4999, 10001).reshape(73, 137)
    speed = line_cycle_speed(alpha, "metric", count=-2, period=3.0, body="strip")
    assert speed.shape == alpha.shape
    # Which alphas share a quadrature may change the last digit.
    for place in ((0, 0), (36, 68), (72, 136), (50, 3)):
        alone = line_cycle_speed(alpha[place], "metric", "grown", -2, 3.0, "strip")
        assert speed[place] == pytest.approx(float(alone), rel=1e-14)
    assert line_cycle_speed([], "exp").shape == (0,)
    for law, end in (("exp", 99.9), ("linear", np.nextafter(1, 0)), ("metric", np.nextafter(0.5, 0))):
        for power in (0, 1, 2):
            load, body = LOADS[power]
            wave = line_balance(SineWave(), end * (1 - 1e-12), load, growth_law=law, body=body).mean
            # One part in 1e12 of alpha = 100 is one part in 1e10 of exp(alpha).
            assert line_cycle_speed(end, law, load, body=body) == pytest.approx(wave, rel=2e-9)


def mean_metric(alpha, cube=False):
    """Mean of (1 + 2 alpha sin)^(1/2) or of its cube by complete elliptic integrals."""
    m = 4 * alpha / (1 + 2 * alpha)
    if cube:
        sums = 4 * mp.ellipe(m) - (1 - 2 * alpha) * mp.ellipk(m)
        return 2 / (3 * mp.pi) * mp.sqrt(1 + 2 * alpha) * sums
    return 2 / mp.pi * mp.sqrt(1 + 2 * alpha) * mp.ellipe(m)


def kepler(strength):
    return mp.findroot(
        lambda theta: theta - strength * mp.cos(theta), strength / mp.sqrt(1 + strength**2)
    )


def strip_angle(alpha):
    def balance(theta):
        left = theta * (1 + alpha**2 / 2) - alpha**2 / 4 * mp.sin(2 * theta)
        return left - 2 * alpha * mp.cos(theta)

    return mp.findroot(balance, 2 * alpha / mp.sqrt(1 + 4 * alpha**2))


def metric_of(theta, alpha):
    return mp.sqrt(1 + 2 * alpha * mp.sin(theta))


CLOSED_FORMS = {
    ("exp", 0, "coulomb"): lambda a: 1 - mp.besseli(0, a),
    ("linear", 0, "coulomb"): lambda a: mp.mpf(0),
    ("linear", 1, "coulomb"): lambda a: a * mp.sin(kepler(a)),
    ("linear", 2, "coulomb"): lambda a: a * mp.sin(strip_angle(a)),
    ("metric", 0, "coulomb"): lambda a: 1 - mean_metric(a),
    ("metric", 2, "coulomb"): lambda a: metric_of(kepler(2 * a), a) - mean_metric(a),
    ("exp", 1, "viscous"): lambda a: mp.besseli(0, 2 * a) / mp.besseli(0, a) - mp.besseli(0, a),
    ("exp", 2, "viscous"): lambda a: mp.besseli(0, 3 * a) / mp.besseli(0, 2 * a) - mp.besseli(0, a),
    ("linear", 1, "viscous"): lambda a: a**2 / 2,
    ("linear", 2, "viscous"): lambda a: 2 * a**2 / (2 + a**2),
    ("metric", 1, "viscous"): lambda a: 1 / mean_metric(a) - mean_metric(a),
    ("metric", 2, "viscous"): lambda a: mean_metric(a, cube=True) - mean_metric(a),
    ("exp", 0, "viscous"): lambda a: mp.mpf(0),
    ("linear", 0, "viscous"): lambda a: mp.mpf(0),
    ("metric", 0, "viscous"): lambda a: mp.mpf(0),
}


@pytest.mark.parametrize(("law", "power", "friction"), CLOSED_FORMS)
def test_closed_forms(law, power, friction):
    load, body = LOADS[power]
    for alpha in (1e-6, 0.03, 0.49, *((0.99,) if law == "linear" else ()), *((3.0,) * (law == "exp"))):
        with mp.workdps(50):
            truth = float(CLOSED_FORMS[law, power, friction](mp.mpf(alpha)))
        found = line_cycle_speed(alpha, law, load, body=body, friction=friction)
        assert float(found) == pytest.approx(truth, rel=1e-14, abs=0)


def test_linear_line_is_line_speed():
    alpha = np.linspace(-0.999, 0.999, 201)
    np.testing.assert_allclose(line_cycle_speed(alpha, "linear"), line_speed(alpha), rtol=2e-15)


# --- series -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("power", "friction", "leading"),
    [
        (0, "coulomb", {"exp": "-1/4", "linear": "0", "metric": "1/4"}),
        (1, "coulomb", {"exp": "3/4", "linear": "1", "metric": "5/4"}),
        (2, "coulomb", {"exp": "7/4", "linear": "2", "metric": "9/4"}),
        (0, "viscous", {"exp": "0", "linear": "0", "metric": "0"}),
        (1, "viscous", {"exp": "1/2", "linear": "1/2", "metric": "1/2"}),
        (2, "viscous", {"exp": "1", "linear": "1", "metric": "1"}),
    ],
)
def test_series_is_that_of_the_exact_speed(power, friction, leading):
    load, body = LOADS[power]
    for law, second in leading.items():
        series = line_cycle_series(12, law, load, body, friction)
        assert all(isinstance(c, sympy.Rational) for c in series)
        assert series[2] == sympy.Rational(second)
        assert not any(series[1::2])
        assert series[0] == 0
        result = line_balance(SineWave(2), 0.1, load, friction, growth_law=law, body=body)
        assert result.second_order == pytest.approx(float(series[2]) / 2, rel=1e-13, abs=0)
        for alpha in (0.02, 0.04):
            speed = float(line_cycle_speed(alpha, law, load, body=body, friction=friction))
            partial = sum(float(c) * alpha**k for k, c in enumerate(series))
            # The term alpha^14: coefficients grow by up to 11 from one to the next (linear strip).
            rest = 20 * max(abs(float(series[12])), 1.0) * alpha**14
            assert abs(speed - partial) <= rest + 1e-14 * abs(speed)


def test_series_in_closed_form():
    assert line_cycle_series(16, "linear") == line_series(16)
    alpha = sympy.Symbol("alpha")

    def bessel(k):
        return sum((k * alpha / 2) ** (2 * j) / sympy.factorial(j) ** 2 for j in range(6))

    forms = {
        ("linear", "strip"): 2 * alpha**2 / (2 + alpha**2),
        ("exp", "line"): bessel(2) / bessel(1) - bessel(1),
        ("exp", "strip"): bessel(3) / bessel(2) - bessel(1),
    }
    for (law, body), form in forms.items():
        taylor = sympy.Poly(sympy.series(form, alpha, 0, 9).removeO(), alpha).all_coeffs()[::-1]
        assert list(line_cycle_series(8, law, body=body, friction="viscous")) == taylor
    # theta = 2 alpha cos(theta): m = sin(theta) has the coefficients of line_series at 2 alpha.
    kepler_sine = [c * 2**k / 2 for k, c in enumerate(line_series(8))]  # of alpha sin(theta)
    root = sympy.sqrt(1 + 2 * sum(c * alpha**k for k, c in enumerate(kepler_sine)))
    mean = -sum(c * alpha**k for k, c in enumerate(line_cycle_series(8, "metric", "material"))) + 1
    taylor = sympy.Poly(sympy.expand(sympy.series(root, alpha, 0, 9).removeO() - mean), alpha)
    assert list(line_cycle_series(8, "metric", body="strip")) == taylor.all_coeffs()[::-1]


def test_short_series():
    assert line_cycle_series(0) == (0,)
    assert line_cycle_series(1) == (0, 0)
    assert line_cycle_series(3, load="grown", body="strip") == line_cycle_series(12, body="strip")[:4]
    assert line_cycle_series(3, load="material", body="strip") == line_cycle_series(3, load="material")


# --- limits and invariants ----------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", WAVES)
def test_tanh_joins_dry_and_viscous_friction(name, law):
    wave = WAVES[name]
    alpha = 0.6 * largest(wave, law, 1)
    for load, body in LOADS.values():
        kind = {"load": load, "growth_law": law, "body": body}
        dry, viscous = (
            line_balance(wave, alpha, **kind),
            line_balance(wave, alpha, friction="viscous", **kind),
        )
        unit = abs(alpha / wave.count / wave.period)
        sharp = line_balance(wave, alpha, friction="tanh", slip_speed=1e-9 * unit, **kind)
        blunt = line_balance(wave, alpha, friction="tanh", slip_speed=1e9 * unit, **kind)
        # First order in v0, second in 1/v0; the pulse is nearly flat at its median.
        assert abs(sharp.mean - dry.mean) <= 20e-9 * unit
        assert abs(blunt.mean - viscous.mean) <= 1e-12 * unit + blunt.error + viscous.error


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("power", LOADS)
def test_invariants(law, power):
    load, body = LOADS[power]
    kind = {"load": load, "growth_law": law, "body": body}
    for friction, slip in (("coulomb", None), ("tanh", 0.05), ("viscous", None)):
        law_kind = kind | {"friction": friction, "slip_speed": slip}
        for wave in (WAVES["two harmonics"], WAVES["pulse"]):
            alpha = 0.7 * largest(wave, law, 1)
            mirrored = TravellingWave(wave.cosine, wave.sine, -wave.count, wave.period, wave.mean)
            opposite = TravellingWave(-wave.cosine, -wave.sine, wave.count, wave.period, -wave.mean)
            speed = line_balance(wave, alpha, **law_kind).mean
            assert line_balance(mirrored, alpha, **law_kind).mean == -speed
            assert line_balance(opposite, -alpha, **law_kind).mean == speed
        # Half a period turns sin into -sin, and V does not ask when.
        pair = [line_balance(SineWave(), a, **law_kind).mean for a in (0.4, -0.4)]
        assert pair[0] == pytest.approx(pair[1], rel=1e-14)
        grown = line_balance(SineWave(), 0.4, **law_kind | {"load": "grown"}).mean
        assert (grown == pair[0]) is (
            power > 0 or (law, friction) in {("linear", "coulomb")}
        ) or power == 0
    forward = line_cycle_speed(0.4, law, load, 3, 2.0, body)
    assert forward == line_cycle_speed(-0.4, law, load, 3, 2.0, body)
    assert forward == -line_cycle_speed(0.4, law, load, -3, 2.0, body)


@pytest.mark.parametrize("friction", ["coulomb", "tanh", "viscous"])
def test_mean_growth_of_exp_is_a_change_of_length(friction):
    """exp(alpha (c + b)) = exp(alpha b) exp(alpha c): a longer body, alike in all else."""
    wave, alpha, b = WAVES["pulse"], 0.8, 0.7
    longer = TravellingWave(wave.cosine, wave.sine, wave.count, wave.period, wave.mean + b)
    factor = math.exp(alpha * b)
    slip = 0.1 if friction == "tanh" else None
    first = line_balance(wave, alpha, "current", friction, slip, growth_law="exp", body="strip")
    slip = slip and slip * factor
    second = line_balance(longer, alpha, "current", friction, slip, growth_law="exp", body="strip")
    assert abs(second.mean - factor * first.mean) <= second.error + factor * first.error


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("power", LOADS)
def test_coefficients_are_the_limits_of_small_alpha(law, power):
    load, body = LOADS[power]
    for wave in WAVES.values():
        for friction in ("coulomb", "viscous"):
            kind = {"load": load, "friction": friction, "growth_law": law, "body": body}
            result, h = line_balance(wave, 0.1, **kind), 1e-4
            up, down = line_balance(wave, h, **kind).mean, line_balance(wave, -h, **kind).mean
            # Central differences: the next terms are h^2 times derivatives up to 1e3.
            assert (up - down) / (2 * h) == pytest.approx(result.first_order, abs=1e-5)
            assert (up + down) / (2 * h**2) == pytest.approx(result.second_order, abs=2e-5)
        tanh = line_balance(wave, 0.1, load, "tanh", 0.3, growth_law=law, body=body)
        assert (tanh.first_order, tanh.second_order) == (0.0, result.second_order)


def test_second_coefficient_at_a_turning_median():
    wave = TravellingWave([0.0, 0.5], [1.0, 0.0])
    assert math.isnan(line_balance(wave, 0.1, growth_law="exp").second_order)
    # With weight conserved the median stays 1/2: V = s(1/2) - mean s, E c^2 = 5/8.
    still = line_balance(wave, 0.1, "material", growth_law="exp")
    assert still.second_order == pytest.approx((1 / 4 - 5 / 8) / 2, rel=1e-13)


# --- sampled waves ------------------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("power", LOADS)
@pytest.mark.parametrize("friction", ["coulomb", "tanh", "viscous"])
def test_sampled_way_agrees_with_the_travelling_one(law, power, friction):
    load, body = LOADS[power]
    slip = 0.02 if friction == "tanh" else None
    wave, alpha = WAVES["two harmonics"], -0.28
    kind = {"load": load, "friction": friction, "slip_speed": slip, "growth_law": law, "body": body}
    exact = line_balance(wave, alpha, **kind)
    general = line_balance(Anonymous(wave), alpha, rtol=1e-3, **kind, length=1)
    assert general.converged
    assert abs(general.mean - exact.mean) <= general.error + exact.error
    # Linear between some hundred points
    assert general.first_order == pytest.approx(exact.first_order, abs=3e-3)
    assert general.second_order == pytest.approx(exact.second_order, abs=2e-2)
    assert general.model == exact.model


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("power", LOADS)
def test_sampled_wave_minimises_the_dissipation_and_knows_its_error(law, power):
    load, body = LOADS[power]
    wave, alpha = FieldWave(standing_pulse, 1.0), 0.3
    kind = {"load": load, "growth_law": law, "body": body}
    fine = line_balance(wave, alpha, rtol=1e-3, atol=1e-5, **kind, length=1)
    rough = line_balance(wave, alpha, rtol=3e-2, atol=1e-4, **kind, length=1)
    assert fine.converged
    assert rough.converged
    assert abs(rough.mean - fine.mean) <= rough.error + fine.error
    cells = 2000
    for k in range(0, fine.times.size, fine.times.size // 5):
        velocity, weight = reference_line.finite_velocity(
            wave, alpha, LAWS[law], power, fine.times[k], cells
        )
        best = reference_line.dissipation_minimum(velocity, weight * np.ones(cells))
        # Neighbouring kinks are one cell apart: |dv| <= alpha max|s' c_t|/cells.
        assert abs(best - fine.velocity[k]) < 3 * alpha * 10 / cells


@pytest.mark.parametrize("law", LAWS)
def test_coefficients_of_a_sampled_wave_are_limits(law):
    wave, h = FieldWave(standing_pulse, 1.0), 3e-3
    for load, body in LOADS.values():
        kind = {"load": load, "growth_law": law, "body": body, "rtol": 1e-3, "atol": 2e-6}
        result = line_balance(wave, h, **kind, length=1)
        up, down = result.mean, line_balance(wave, -h, **kind, length=1).mean
        errors = 2 * result.error
        assert abs((up - down) / (2 * h) - result.first_order) <= errors / h + 20 * h**2
        # Where the median turns, V(t) has terms |alpha|^(5/2): the limit is approached slowly.
        assert (up + down) / (2 * h**2) == pytest.approx(result.second_order, abs=0.1)


@pytest.mark.parametrize("law", LAWS)
def test_a_pulse_with_gaps_sticks(law):
    wave, alpha, curvature = sampled(compact_pulse, points=256), 0.3, {"exp": 0.5, "metric": -0.5}
    phase = np.linspace(0, 2 * np.pi, 10**5, endpoint=False)
    c = compact_pulse(phase)

    def value(x, y, t):
        return compact_pulse((2 * np.pi * (y - t)) % (2 * np.pi)) + 0 * x

    for candidate in (wave, FieldWave(value, 1.0)):
        for load, body in LOADS.values():
            found = line_balance(candidate, alpha, load, growth_law=law, body=body, rtol=1e-3, length=1)
            assert found.sticks
            # The gaps are at rest; the series of the pulse rings there by points^-2.
            truth = 1 - LAWS[law](alpha * c).mean()
            assert found.mean == pytest.approx(truth, abs=found.error + 1e-4)
            assert found.second_order == pytest.approx(
                -curvature.get(law, 0.0) * np.mean(c**2), abs=5e-3
            )


# --- input --------------------------------------------------------------------------------------


def test_result_says_what_it_is():
    strip = line_balance(SineWave(), 0.2, growth_law="metric", body="strip").model
    assert "strip" in strip
    assert "(1 + 2 alpha c)^(1/2)" in strip
    assert "current load" in strip
    assert "material load" in line_balance(SineWave(), 0.2, "material", growth_law="exp").model
    assert "stretch 1 + alpha c" in line_balance(SineWave(), 0.2).model


BAD = [
    (
        lambda: line_balance(SineWave(), 0.5, growth_law="metric"),
        r"0\.5: .* at the phase 4\.712.* < 0\.5",
    ),
    (lambda: line_balance(SineWave(), -0.7, growth_law="metric"), r"alpha = -0\.7: .*> -0\.5"),
    (lambda: line_balance(SineWave(), 150, growth_law="exp"), r"alpha = 150: .* phase .* < 100"),
    (lambda: line_balance(WAVES["pulse"], -1, growth_law="metric"), r"phase 1 of.* > -0\.5$"),
    (
        lambda: line_balance(Anonymous(SineWave()), 0.6, growth_law="metric", length=1),
        r"0\.6: .*at S = .* < 0\.5",
    ),
    (
        lambda: line_balance(Anonymous(SineWave()), -120, growth_law="exp", length=1),
        r"120: .*at S = .* > -100",
    ),
    (lambda: line_balance(SineWave(), 0.1, growth_law="cubic"), "growth_law = 'cubic': .*'metric'"),
    (lambda: line_balance(SineWave(), 0.1, body="sheet"), "body = 'sheet': .*'line', 'strip'"),
    (lambda: line_cycle_speed(0.5, "metric"), r"alpha = 0\.5: must be in \(-0\.5, 0\.5\)"),
    (lambda: line_cycle_speed([0.1, -100.0]), r"alpha = -100: must be in \(-100, 100\)"),
    (lambda: line_cycle_speed(1.0, "linear"), r"alpha = 1: must be in \(-1, 1\)"),
    (lambda: line_cycle_speed(0.1, "cubic"), "growth_law = 'cubic'"),
    (lambda: line_cycle_speed(0.1, load="heavy"), "load = 'heavy'"),
    (lambda: line_cycle_speed(0.1, body="sheet"), "body = 'sheet'"),
    (lambda: line_cycle_speed(0.1, friction="tanh"), "friction = 'tanh': .*'viscous'"),
    (lambda: line_cycle_speed(0.1, count=0), "count = 0"),
    (lambda: line_cycle_speed(np.nan), "alpha contains nan"),
    (lambda: line_cycle_series(-1), "order = -1"),
    (lambda: line_cycle_series(2.0), r"order = 2\.0"),
    (lambda: line_cycle_series(2, "cubic"), "growth_law = 'cubic'"),
    (lambda: line_cycle_series(2, load="heavy"), "load = 'heavy'"),
    (lambda: line_cycle_series(2, body="sheet"), "body = 'sheet'"),
    (lambda: line_cycle_series(2, friction="tanh"), "friction = 'tanh'"),
]


@pytest.mark.parametrize(("call", "message"), BAD)
def test_bad_input_names_argument_value_and_range(call, message):
    with pytest.raises(ValueError, match=message):
        call()

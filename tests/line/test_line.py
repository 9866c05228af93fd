"""The sine wave on a line: closed form, printed forms, viscous and tanh friction, power series."""

import math
import time

import mpmath as mp
import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from linear_theory import SineWave
from linear_theory.line import line_speed, line_speed_tanh, line_speed_viscous
from linear_theory.line.series import LAPLACE_LIMIT, line_series, line_speed_series
from tests.line import reference_line
from tests.robust.drawn_examples import examples

ALPHAS = (0.01, 0.2, 0.5, 0.8, 0.99)
DOTTIE = 0.7390851332151607  # the fixed point of the cosine


def ulps(value, exact):
    return abs(float((mp.mpf(float(value)) - exact) / np.spacing(float(exact))))


def test_closed_form_is_right_to_two_ulp():
    rng = np.random.default_rng(1)
    alpha = np.concatenate(
        [rng.uniform(-1, 1, 1500), 10 ** rng.uniform(-150, 0, 300), 1 - 10 ** rng.uniform(-16, -1, 200)]
    )
    with mp.workdps(reference_line.DIGITS):
        exact = [mp.mpf(a) * reference_line.kepler_sine(a) for a in alpha]
        worst = max(map(ulps, line_speed(alpha), exact))
    assert worst <= 2  # measured: 1.57 over 50 000 alphas


def test_tiny_alpha_neither_underflows_nor_overflows():
    # alpha^2 = 1e-600 is no double, but alpha/T and V are.
    assert line_speed(1e-300, period=1e-300) == 1e-300
    assert line_speed(1e-300) == 0
    assert line_speed(0.0) == 0
    assert line_speed(0.5, period=1e-306) == pytest.approx(line_speed(0.5) * 1e306, rel=1e-15)
    assert line_speed_tanh(1e-300, 1.0, period=1e-300) == pytest.approx(
        line_speed_tanh(1e-12, 1.0, period=1e-12) * 1e-288, rel=1e-12
    )
    assert line_speed_tanh(1e-10, 1e300) == pytest.approx(5e-21, rel=1e-15)


def test_speed_at_alpha_one_is_the_sine_of_the_fixed_point_of_the_cosine():
    below = np.nextafter(1, 0)
    assert line_speed(below) == pytest.approx(math.sin(DOTTIE), rel=1e-15)
    assert math.sqrt(1 - DOTTIE**2) == pytest.approx(math.sin(DOTTIE), rel=1e-15)


def test_a_million_speeds_in_one_call():
    alpha = np.linspace(-0.999, 0.999, 10**6)
    start = time.process_time()
    speed = line_speed(alpha)
    assert speed.shape == alpha.shape
    # The aim is 0.5 s (measured 0.25 s); 10 times that only shows a loop over elements.
    assert time.process_time() - start < 5


@examples(100)
@given(alpha=st.floats(-0.999, 0.999), count=st.integers(1, 50), period=st.floats(1e-3, 1e3))
def test_symmetries(alpha, count, period):
    for speed in (line_speed, line_speed_viscous, lambda a, n, t: line_speed_tanh(a, 0.1, n, t)):
        forward = speed(alpha, count, period)
        assert forward == speed(-alpha, count, period)
        assert forward == -speed(alpha, -count, period)
        assert forward >= 0


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("count", [1, -2, 5])
def test_closed_form_balances_eq_7_and_the_printed_one_does_not(alpha, count):
    wave = SineWave(count)
    # sgn is integrated on 40 000 points: each crossing is missed by up to one of them.
    tolerance = 2 * (2 * abs(count) + 1) * 2 / 40000
    assert abs(reference_line.force(wave, alpha, line_speed(alpha, count), 0.3)) < tolerance
    printed = line_speed(alpha, count, form="printed")
    assert abs(reference_line.force(wave, alpha, printed, 0.3)) > 0.9 * alpha


def test_printed_eq_8_is_wrong_even_with_the_printed_sign_of_the_velocity():
    wave = SineWave()
    alpha = 0.5
    balanced = reference_line.force(wave, alpha, -line_speed(alpha), velocity_sign=-1)
    printed = reference_line.force(wave, alpha, line_speed(alpha, form="printed"), velocity_sign=-1)
    assert abs(balanced) < 3e-4
    assert abs(printed) > 0.02


def test_printed_eq_8_is_solved_as_it_stands():
    alpha = np.linspace(-0.999999, 0.999999, 2000)
    q = 3 * 2.0 * line_speed(alpha, 3, 2.0, form="printed") / alpha
    # Residual of an equation whose terms are at most 1: rounding.
    assert abs(np.arcsin(q) + alpha * np.sqrt(1 - 2 * q**2)).max() < 1e-15


def test_viscous_is_half_of_dry_to_leading_order_and_the_same_way():
    assert line_speed_viscous(0.3, 2, 5.0) == pytest.approx(0.09 / 20, rel=1e-15)
    assert line_speed(1e-6) / line_speed_viscous(1e-6) == pytest.approx(2, rel=1e-11)  # (2/3) alpha^2


@pytest.mark.parametrize("alpha", [1e-8, 0.3, 0.999999])
@pytest.mark.parametrize("width", [1e-3, 0.013499, 0.013501, 1.0])
def test_tanh_law_against_adaptive_quadrature(alpha, width):
    exact = float(alpha * reference_line.tanh_level(alpha, width))
    # Few roundings of well-conditioned sums: measured 1e-15.
    assert line_speed_tanh(alpha, width * alpha) == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize("alpha", [1e-200, 1e-8, 0.1, 0.9, 0.999999])
def test_tanh_law_joins_dry_and_viscous(alpha):
    period = min(1.0, alpha)  # keeps V in the range of doubles
    unit = alpha / period
    dry, viscous = line_speed(alpha, period=period), line_speed_viscous(alpha, period=period)
    # The corrections are of order (v0/v)^2 and (v/v0)^2.
    assert line_speed_tanh(alpha, 1e-12 * unit, period=period) == pytest.approx(dry, rel=1e-14)
    assert line_speed_tanh(alpha, 1e12 * unit, period=period) == pytest.approx(viscous, rel=1e-14)
    widths = np.geomspace(1e-12, 1e12, 200)
    speeds = line_speed_tanh(alpha, widths * unit, period=period)
    assert np.all(np.diff(speeds) <= 1e-14 * dry)  # the blunter the law, the slower


def test_tanh_law_broadcasts_and_vanishes_without_growth():
    speeds = line_speed_tanh(np.array([0.0, 0.1, -0.4]), np.array([[1e-3], [1.0]]), count=-2)
    assert speeds.shape == (2, 3)
    assert np.all(speeds[:, 0] == 0)
    # Which speeds share a quadrature changes the last digit.
    assert speeds[1, 2] == pytest.approx(line_speed_tanh(-0.4, 1.0, count=-2), rel=1e-14)
    many = line_speed_tanh(np.full(2000, 0.3), 0.01)  # several blocks
    assert np.ptp(many) == 0


def test_series_coefficients_are_those_of_the_implicit_equation():
    x = sympy.Symbol("x")
    theta = sympy.Integer(0)
    for _ in range(4):  # two more orders each time
        theta = sympy.series(x * sympy.cos(theta), x, 0, 8).removeO()
    expected = sympy.Poly(sympy.series(x * sympy.sin(theta), x, 0, 9).removeO(), x)
    assert list(line_series(8)) == expected.all_coeffs()[::-1]
    assert line_series(4) == (0, 0, 1, 0, sympy.Rational(-2, 3))


def test_series_converges_up_to_the_laplace_limit_and_not_beyond():
    assert line_speed_series(0.6, 300) == pytest.approx(line_speed(0.6), rel=1e-12)  # (0.6/0.66)^300
    assert abs(line_speed_series(0.68, 300) - line_speed(0.68)) > abs(
        line_speed_series(0.68, 100) - line_speed(0.68)
    )
    assert abs(line_speed_series(0.75, 400)) > 1e6


def test_laplace_limit_solves_its_equation_and_is_the_ratio_of_the_coefficients():
    with mp.workdps(40):
        root = mp.findroot(lambda x: x * mp.exp(mp.sqrt(1 + x**2)) - 1 - mp.sqrt(1 + x**2), 0.66)
        assert float(root) == LAPLACE_LIMIT
    c = line_series(400)
    # c_k ~ k^(-3/2) r^-k cos(...): a square-root branch point at alpha = +-i r. Ratio of even terms:
    estimates = [math.sqrt(-c[k - 2] / c[k] * (1 - 3 / sympy.Integer(k))) for k in (200, 400)]
    # The next term of the ratio is of order 1/k^2.
    assert abs(estimates[1] - LAPLACE_LIMIT) < 1e-4
    assert abs(estimates[1] - LAPLACE_LIMIT) < 0.3 * abs(estimates[0] - LAPLACE_LIMIT)


@pytest.mark.parametrize("alpha", [0.01, -0.3, 0.6627, 0.8, 0.95])
def test_kapteyn_series_gives_the_closed_form(alpha):
    accuracy = 1e-13  # of the sum of Bessel functions in double precision
    terms = reference_line.kapteyn_terms(alpha, accuracy)
    sine = float(reference_line.kapteyn_sine(alpha, terms))
    assert abs(alpha * sine - line_speed(alpha)) < accuracy


def test_printed_eq_9_has_the_wrong_sign_to_leading_order():
    assert line_speed_series(0.2, 2, 3, 4.0, form="printed") == pytest.approx(-0.04 / 12, rel=1e-15)
    assert line_speed_series(1e-5, 2) == pytest.approx(line_speed(1e-5), rel=1e-9)  # (2/3) alpha^2
    # Eq. 9 does agree with the printed eq. 8: the error is in eq. 8.
    assert line_speed(1e-5, form="printed") == pytest.approx(-1e-10, rel=1e-9)


BAD = [
    (lambda: line_speed(1.0), "alpha = 1: .*no meaning"),
    (lambda: line_speed([0.1, -1.5]), r"alpha = -1\.5"),
    (lambda: line_speed(np.nan), "alpha contains nan"),
    (lambda: line_speed(0.1 + 0j), "alpha"),
    (lambda: line_speed([None]), "alpha"),
    (lambda: line_speed(0.1, 0), "count = 0"),
    (lambda: line_speed(0.1, 1.5), r"count = 1\.5"),
    (lambda: line_speed(0.1, period=0), "period = 0"),
    (lambda: line_speed(0.1, form="exact"), "form = 'exact': .*'printed'"),
    (lambda: line_speed_viscous(2), "alpha = 2"),
    (lambda: line_speed_tanh(0.1, 0), "slip_speed = 0"),
    (lambda: line_speed_tanh(0.1, [1, np.inf]), "slip_speed contains inf"),
    (lambda: line_series(-1), "order = -1"),
    (lambda: line_series(2.0), r"order = 2\.0"),
    (lambda: line_speed_series(0.1, 1001), "order = 1001: .*1000"),
    (lambda: line_speed_series(0.1, 4, form="printed"), "order = 4: must be 2"),
    (lambda: line_speed_series(-1, 4), "alpha = -1"),
]


@pytest.mark.parametrize(("call", "message"), BAD)
def test_bad_input_names_argument_value_and_range(call, message):
    with pytest.raises(ValueError, match=message):
        call()

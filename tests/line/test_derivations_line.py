"""The one-dimensional theory proved again (paper eqs 5-9): signs, closed form, series, leading order.

Every test derives the equation it names and shows that the printed form, where it differs, fails.
Conventions: body 0 <= S <= 1, n waves of period T on it, phase phi = 2 pi (n S - t/T), friction
force of dry contact -sgn(velocity) per unit of load, V > 0 along the wave for n > 0.
"""

import mpmath
import numpy as np
import pytest
import sympy as sp
from scipy import special

ALPHA, PERIOD = sp.symbols("alpha T", positive=True)
COUNT = sp.Symbol("n", integer=True, nonzero=True)
S, TIME, PHI, THETA = sp.symbols("S t phi theta", real=True)
Q = sp.sin(THETA)  # q = nTV/alpha = sin(theta): the body moves with V where sin(phi) = q is at rest
WAVE_PHASE = 2 * sp.pi * (COUNT * S - TIME / PERIOD)
SPEED_UNIT = ALPHA / (COUNT * PERIOD)


def above(integrand):
    """Integral over the arc where sin(phi) > sin(theta), -pi/2 < theta < pi/2."""
    return sp.integrate(integrand, (PHI, THETA, sp.pi - THETA))


def below(integrand):
    """Integral over the arc where sin(phi) < sin(theta)."""
    return sp.integrate(integrand, (PHI, sp.pi - THETA, 2 * sp.pi + THETA))


def signed(integrand):
    """Integral over one period of integrand * sgn(sin(theta) - sin(phi))."""
    return sp.simplify(sp.expand(below(integrand) - above(integrand)))


def root_angle(strength):
    """The root of theta = alpha cos(theta) as a float."""
    return float(mpmath.findroot(lambda z: z - strength * mpmath.cos(z), strength))


def closed_form_angle(order):
    """Power series in alpha of the root of theta = alpha cos(theta), up to alpha**order."""
    angle = sp.Integer(0)
    for _ in range(order):
        angle = sp.series(ALPHA * sp.cos(angle), ALPHA, 0, order + 1).removeO()
    return angle


def speed_series(stretch, weight, profile=lambda sine: sine, order=3):
    """Coefficients of alpha, alpha**2, ... of nTV for a body of local stretch and local weight.

    stretch, weight: functions of growth alpha c; profile: c as an increasing function of sin(phi).
    Material velocity is V - (stretch - mean stretch)/(nT), and dry friction balances where the
    weight of the arc that moves forward equals that of the arc that moves back.
    """
    sine = sp.sin(PHI)

    def expand(expression):
        return sp.expand(sp.series(expression, ALPHA, 0, order + 1).removeO())

    growth = ALPHA * profile(sine)
    unknowns = sp.symbols(f"theta1:{order + 1}")
    angle = sum(c * ALPHA ** (j + 1) for j, c in enumerate(unknowns))
    balance = expand(signed(expand(weight(growth))).subs(THETA, angle))
    for j, unknown in enumerate(unknowns):
        (root,) = sp.solve(balance.coeff(ALPHA, j + 1), unknown)
        balance, angle = sp.expand(balance.subs(unknown, root)), angle.subs(unknown, root)
    assert balance.coeff(ALPHA, 0) == 0
    mean = sp.integrate(expand(stretch(growth)), (PHI, 0, 2 * sp.pi)) / (2 * sp.pi)
    speed = expand(expand(stretch(ALPHA * profile(sp.sin(angle)))) - mean)
    return [speed.coeff(ALPHA, j) for j in range(order + 1)]


def weighted_median(values, weights):
    """The value that halves the weight."""
    order = np.argsort(values, kind="stable")
    total = np.cumsum(weights[order])
    return values[order][np.searchsorted(total, total[-1] / 2)]


def sampled_speed(stretch, weight, profile=np.sin, points=400_000):
    """NTV of the same body without any series: weighted median of the stretch less its mean."""
    c = profile((np.arange(points) + 0.5) * (2 * np.pi / points))
    local = stretch(c) * np.ones(points)
    return weighted_median(local, weight(c) * np.ones(points)) - local.mean()


# --- E1: velocity in the frame of the centre of mass -------------------------------------------


def test_velocity_runs_against_the_growth():
    """E1: eqs 5 and 6 with c = sin(phi) give v_cm = -(alpha/nT) sin(phi); printed with +."""
    x = sp.Symbol("x", real=True)
    displacement = sp.integrate(ALPHA * sp.sin(WAVE_PHASE.subs(S, x)), (x, 0, S))
    rate = sp.diff(displacement, TIME)
    v_cm = rate - sp.integrate(rate, (S, 0, 1))
    derived = -SPEED_UNIT * sp.sin(WAVE_PHASE)
    assert sp.simplify(sp.expand_trig(v_cm - derived)) == 0
    printed = -derived
    assert sp.simplify(sp.expand_trig(v_cm - printed)) != 0
    assert (v_cm - printed).subs({COUNT: 1, PERIOD: 1, ALPHA: 1, TIME: 0, S: sp.Rational(1, 4)}) == -2


def test_any_stretch_moves_the_material_by_its_own_wave():
    """Y = int stretch dS: material velocity is -(stretch - its value at S = 0)/(nT) for any wave."""
    stretch = sp.Function("stretch")
    gradient = sp.diff(stretch(WAVE_PHASE), S).doit()
    rate = sp.diff(stretch(WAVE_PHASE), TIME).doit()
    assert sp.simplify(rate + gradient / (COUNT * PERIOD)) == 0


# --- E2: the balance of dry friction -----------------------------------------------------------


def test_sign_integrals():
    """E2: int sgn(q - sin) = 4 arcsin q, int sin sgn(q - sin) = -4 sqrt(1 - q^2), q = sin(theta)."""
    factors = 2 * sp.cos((THETA + PHI) / 2) * sp.sin((THETA - PHI) / 2)
    assert sp.simplify(sp.expand_trig(factors - (Q - sp.sin(PHI)))) == 0  # hence the two arcs
    assert sp.simplify(signed(sp.Integer(1)) - 4 * THETA) == 0
    assert sp.simplify(signed(sp.sin(PHI)) + 4 * sp.cos(THETA)) == 0


@pytest.mark.parametrize("q", [-0.9, -0.3, 0.0, 0.2, 0.7, 0.99])
def test_sign_integrals_by_literal_summation(q):
    """E2: the same two integrals with sgn taken point by point."""
    step = 2 * np.pi / 200_000
    sine = np.sin((np.arange(200_000) + 0.5) * step)
    sign = np.sign(q - sine)
    assert sign.sum() * step == pytest.approx(4 * np.arcsin(q), abs=2e-4)
    assert (sine * sign).sum() * step == pytest.approx(-4 * np.sqrt(1 - q * q), abs=2e-4)


def test_friction_balance_in_closed_form():
    """E2 (eqs 7, 8): arcsin q - alpha sqrt(1 - q^2) = 0, q = nTV/alpha.

    The printed sign follows from the printed sign of v_cm; the printed 2 q^2 from neither.
    """
    balance = signed(1 + ALPHA * sp.sin(PHI)) / 4
    assert sp.simplify(balance - (THETA - ALPHA * sp.cos(THETA))) == 0

    other_sign = signed(1 - ALPHA * sp.sin(PHI)) / 4  # phi -> -phi turns sgn(q + sin) into sgn(q - sin)
    assert sp.simplify(other_sign - (THETA + ALPHA * sp.cos(THETA))) == 0

    printed = THETA + ALPHA * sp.sqrt(1 - 2 * Q**2)
    for form in (balance, other_sign):
        assert abs((printed - form).subs({THETA: sp.Rational(1, 2), ALPHA: 1}).evalf()) > 0.1


@pytest.mark.parametrize("strength", [0.05, 0.3, 0.8])
def test_closed_form_balances_friction_and_the_print_does_not(strength):
    """E2: eq. 7 summed point by point vanishes at the derived V and not at that of eq. 8."""
    sine = np.sin((np.arange(400_000) + 0.5) * (2 * np.pi / 400_000))

    def force(q):
        return np.mean((1 + strength * sine) * np.sign(q - sine))

    derived = np.sin(root_angle(strength))
    root = mpmath.findroot(
        lambda q: mpmath.asin(q) + strength * mpmath.sqrt(1 - 2 * q * q), -0.6 * strength
    )
    assert force(derived) == pytest.approx(0, abs=1e-5)
    assert abs(force(float(root.real))) > strength / 2


# --- E3: the series, Kepler's equation ---------------------------------------------------------


def test_series_of_the_speed():
    """E3 (eq. 9): nTV = +alpha^2 (1 - (2/3) alpha^2 + (4/5) alpha^4 - ...), even powers only.

    Printed: -alpha^2 + O(alpha^3).
    """
    speed = sp.series(ALPHA * sp.sin(closed_form_angle(7)), ALPHA, 0, 8).removeO()
    coefficients = [speed.coeff(ALPHA, j) for j in range(8)]
    assert coefficients[1::2] == [0, 0, 0, 0]
    assert coefficients[::2] == [0, 1, -sp.Rational(2, 3), sp.Rational(4, 5)]
    assert coefficients[2] != -1
    for strength in (0.05, 0.1):
        exact = strength * np.sin(root_angle(strength))
        series = float(speed.subs(ALPHA, strength))
        assert series == pytest.approx(exact, abs=2 * strength**8)
        assert exact == pytest.approx(strength**2, abs=strength**4)


def test_speed_is_even_in_alpha():
    """E3: if theta solves theta = alpha cos(theta), -theta solves it for -alpha: V is even."""
    equation = THETA - ALPHA * sp.cos(THETA)
    mirrored = equation.subs({THETA: -THETA, ALPHA: -ALPHA}, simultaneous=True)
    assert sp.expand(mirrored + equation) == 0
    speed = ALPHA * sp.sin(THETA)
    assert speed.subs({THETA: -THETA, ALPHA: -ALPHA}, simultaneous=True) == speed


def test_closed_form_is_keplers_equation():
    """E2 with E = pi/2 - theta: E + alpha sin(E) = pi/2, eccentricity -alpha, mean anomaly pi/2."""
    anomaly = sp.pi / 2 - THETA
    kepler = anomaly + ALPHA * sp.sin(anomaly) - sp.pi / 2
    assert sp.simplify(kepler + (THETA - ALPHA * sp.cos(THETA))) == 0


def test_power_series_converges_up_to_the_laplace_limit():
    """Branch point of theta = alpha cos(theta), where also 1 = -alpha sin(theta): |alpha| = 0.66274.

    The ratio of the exact coefficients tends to the same limit.
    """
    height = mpmath.findroot(lambda z: z * mpmath.tanh(z) - 1, 1.2)  # theta = i z
    limit = height / mpmath.cosh(height)
    assert limit == pytest.approx(0.6627434193491816, abs=1e-14)

    def coefficient(n):  # Lagrange: (d/dw)^(n-1) cos(w)^n at 0, over n!, n odd
        terms = (sp.binomial(n, k) * (n - 2 * k) ** (n - 1) for k in range(n + 1))
        return (-1) ** ((n - 1) // 2) * sp.Rational(sum(terms), 2**n * sp.factorial(n))

    series = closed_form_angle(5)
    assert [coefficient(n) for n in (1, 3, 5)] == [series.coeff(ALPHA, n) for n in (1, 3, 5)]
    n = 301
    ratio = float(abs(coefficient(n) / coefficient(n + 2))) ** 0.5
    assert ratio * (n / (n + 2)) ** 0.75 == pytest.approx(float(limit), rel=1e-4)  # n^(-3/2): a root


@pytest.mark.parametrize("strength", [0.3, 0.8, 0.95])
def test_kapteyn_series_converges_beyond_the_power_series(strength):
    """theta = sum over odd n of (2/n) J_n(n alpha) (-1)^((n-1)/2), also above 0.6627."""
    n = np.arange(1, 4001, 2)
    angle = np.sum(2 / n * special.jv(n, n * strength) * (-1.0) ** ((n - 1) // 2))
    assert angle == pytest.approx(strength * np.cos(angle), abs=1e-10)


def test_full_strength_is_the_fixed_point_of_the_cosine():
    """E2 at alpha = 1: theta = cos(theta) = 0.739085..."""
    angle = root_angle(1.0)
    assert angle == pytest.approx(0.7390851332151607, abs=1e-14)
    ones = sampled_speed(lambda c: 1 + c, lambda c: 1 + c)
    assert ones == pytest.approx(np.sin(angle), abs=1e-4)


# --- E4: viscous friction ----------------------------------------------------------------------


def test_viscous_friction_crawls_the_same_way_half_as_fast():
    """E4: int (1 + alpha sin)(V - (alpha/nT) sin) = 0 gives V = +alpha^2/(2nT)."""
    speed = sp.Symbol("V")
    force = (1 + ALPHA * sp.sin(PHI)) * (speed - SPEED_UNIT * sp.sin(PHI))
    (viscous,) = sp.solve(sp.integrate(force, (PHI, 0, 2 * sp.pi)), speed)
    assert sp.simplify(viscous - ALPHA * SPEED_UNIT / 2) == 0
    dry = SPEED_UNIT * sp.sin(closed_form_angle(3))
    ratio = sp.limit(viscous / dry, ALPHA, 0)
    assert ratio == sp.Rational(1, 2)  # same direction: positive


# --- the balance as a minimum ------------------------------------------------------------------


def test_balance_of_dry_friction_is_the_minimum_of_a_convex_function():
    """Eq. 11 is the gradient of int |v + V| J dA, whose Hessian is positive semidefinite."""
    p, q = sp.symbols("p q", real=True, nonzero=True)
    slip = sp.sqrt(p**2 + q**2)
    gradient = [sp.diff(slip, z) for z in (p, q)]
    assert sp.simplify(gradient[0] - p / slip) == 0
    assert sp.simplify(gradient[1] - q / slip) == 0
    hessian = sp.hessian(slip, (p, q))
    assert sp.simplify(hessian.det()) == 0
    assert sp.simplify(hessian.trace() - 1 / slip) == 0


def test_minus_v_is_the_weighted_median_of_v_cm():
    """Eq. 7 says that the arcs v_cm < -V and v_cm > -V carry the same load."""
    load = 1 + ALPHA * sp.sin(PHI)  # sin(phi) > q is where v_cm = -(alpha/nT) sin(phi) < -V
    difference = sp.simplify(below(load) - above(load))
    assert sp.simplify(difference - 4 * (THETA - ALPHA * sp.cos(THETA))) == 0
    for strength in (0.1, 0.6):
        sampled = sampled_speed(lambda c, a=strength: 1 + a * c, lambda c, a=strength: 1 + a * c)
        assert sampled == pytest.approx(strength * np.sin(root_angle(strength)), abs=2e-5)


# --- F1, F2, F3: load and growth law set the leading coefficient --------------------------------


def one(_):
    return sp.Integer(1)


def linear(growth):
    return 1 + growth


def metric(growth):
    return sp.sqrt(1 + 2 * growth)


CASES = {
    "linear theory, current load": (linear, linear, 1),
    "F1 narrow strip, J = 1 + 2 alpha c": (linear, lambda growth: 1 + 2 * growth, 2),
    "F2 linear theory, material load": (linear, one, 0),
    "F2 exponential growth, material load": (sp.exp, one, -sp.Rational(1, 4)),
    "F3 exponential growth, current load": (sp.exp, sp.exp, sp.Rational(3, 4)),
    "F3 linear metric 1 + 2 alpha c, current load": (metric, metric, sp.Rational(5, 4)),
    "F2 linear metric 1 + 2 alpha c, material load": (metric, one, sp.Rational(1, 4)),
    "F1 narrow strip, exponential growth": (
        sp.exp,
        lambda growth: sp.exp(2 * growth),
        sp.Rational(7, 4),
    ),
    "F1 narrow strip, linear lengths": (linear, lambda growth: linear(growth) ** 2, 2),
    "F1 narrow strip, linear metric": (metric, lambda growth: 1 + 2 * growth, sp.Rational(9, 4)),
}


@pytest.mark.parametrize(("stretch", "weight", "expected"), CASES.values(), ids=CASES.keys())
def test_leading_coefficient_depends_on_growth_law_and_load(stretch, weight, expected):
    """F1-F3: lim nTV/alpha^2 is 1, 2, 0, -1/4, 3/4, 5/4; there is no term of first order."""
    assert speed_series(stretch, weight) == [0, 0, expected, 0]
    strength = 0.02
    c = sp.Symbol("c")
    numeric = [sp.lambdify(c, f(strength * c), "numpy") for f in (stretch, weight)]
    assert sampled_speed(*numeric) / strength**2 == pytest.approx(float(expected), abs=0.01)


def test_leading_coefficient_in_general():
    """F3: stretch 1 + s1 g + s2 g^2, weight 1 + w1 g (g = alpha c): nTV = (s1 w1 - s2/2) alpha^2."""
    s1, s2, w1, w2 = sp.symbols("s1 s2 w1 w2")
    series = speed_series(lambda g: 1 + s1 * g + s2 * g**2, lambda g: 1 + w1 * g + w2 * g**2, order=2)
    assert series[:2] == [0, 0]
    assert sp.simplify(series[2] - (s1 * w1 - s2 / 2)) == 0


def test_leading_coefficient_in_general_for_viscous_friction():
    """mean(s w)/mean(w) - mean(s) = (s1 w1/2) alpha^2: the bend of the stretch does nothing."""
    s1, s2, w1, w2 = sp.symbols("s1 s2 w1 w2")
    growth = ALPHA * sp.sin(PHI)
    stretch, weight = 1 + s1 * growth + s2 * growth**2, 1 + w1 * growth + w2 * growth**2

    def mean(expression):
        return sp.integrate(sp.expand(expression), (PHI, 0, 2 * sp.pi)) / (2 * sp.pi)

    speed = mean(stretch * weight) / mean(weight) - mean(stretch)
    assert sp.series(speed, ALPHA, 0, 3).removeO().equals(ALPHA**2 * s1 * w1 / 2)


def test_strip_of_linear_lengths_in_closed_form():
    """F1: stretch 1 + a c, weight its square: theta (1 + a^2/2) - (a^2/4) sin(2 theta) = 2 a cos."""
    balance = signed((1 + ALPHA * sp.sin(PHI)) ** 2) / 4
    closed = THETA * (1 + ALPHA**2 / 2) - ALPHA**2 / 4 * sp.sin(2 * THETA) - 2 * ALPHA * sp.cos(THETA)
    assert sp.simplify(balance - closed) == 0
    strip = signed(1 + 2 * ALPHA * sp.sin(PHI)) / 4  # linear metric: Kepler's equation with 2 alpha
    assert sp.simplify(strip - (THETA - 2 * ALPHA * sp.cos(THETA))) == 0


def test_second_order_of_any_wave():
    """V_2 = p E|c - m|/(2 f) + s2 (m^2 - E c^2), m the median of c and f its density there (dry).

    c = sin(phi) - b cos(2 phi) has median -b, density 1/pi there and E|c - m| = 2/pi.
    """
    b, s2, p = sp.Rational(1, 5), sp.Symbol("s2"), sp.Symbol("p")

    def profile(sine):
        return sine - b * (1 - 2 * sine**2)

    series = speed_series(lambda g: 1 + g + s2 * g**2, lambda g: 1 + p * g, profile, order=2)
    square = sp.integrate(sp.expand(profile(sp.sin(PHI)) ** 2), (PHI, 0, 2 * sp.pi)) / (2 * sp.pi)
    assert square == sp.Rational(1, 2) + b**2 / 2
    expected = p * (2 / sp.pi) / (2 / sp.pi) + s2 * (b**2 - square)
    assert sp.simplify(series[2] - expected) == 0


def test_series_and_closed_form_agree():
    """E3 by a second way: the weighted median to order alpha^4 gives 1 and -2/3."""
    assert speed_series(linear, linear, order=4) == [0, 0, 1, 0, -sp.Rational(2, 3)]


def test_linear_material_load_gives_no_speed_at_any_strength():
    """F2: stretch 1 + alpha c with weight 1: the median and the mean of a sine are both 0."""
    assert signed(sp.Integer(1)).subs(THETA, 0) == 0
    assert sp.integrate(sp.sin(PHI), (PHI, 0, 2 * sp.pi)) == 0
    for strength in (0.2, 0.9):
        speed = sampled_speed(lambda c, a=strength: 1 + a * c, np.ones_like)
        assert speed == pytest.approx(0, abs=1e-4)


def test_waves_without_half_period_antisymmetry_have_a_first_order():
    """F2b: V = (alpha/nT)(median c - mean c), whatever the load; c = sin(phi) - b cos(2 phi): -b."""
    b = sp.Rational(1, 5)  # increasing in sin(phi) for b < 1/4, mean 0, median -b

    def profile(sine):
        return sine - b * (1 - 2 * sine**2)

    first = {speed_series(linear, weight, profile, order=1)[1] for weight in (one, linear)}
    assert first == {-b}

    def sampled(phase):
        return np.sin(phase) - float(b) * np.cos(2 * phase)

    for strength in (1e-3, -1e-3):
        speed = sampled_speed(lambda c, a=strength: 1 + a * c, np.ones_like, sampled)
        assert speed / strength == pytest.approx(-float(b), abs=1e-3)


def test_half_period_antisymmetry_is_sufficient_but_not_necessary():
    """F2b: c = sin(phi) + sin(2 phi) is not antisymmetric by half a period, yet V has no first order.

    c(-phi) = -c(phi) is enough for median = mean = 0; a phase shift between the two is not.
    """
    wave = sp.sin(PHI) + sp.sin(2 * PHI)
    assert sp.simplify(sp.expand_trig(wave.subs(PHI, PHI + sp.pi) + wave)) != 0
    assert sp.simplify(wave.subs(PHI, -PHI) + wave) == 0

    def median(shift):
        return sampled_speed(lambda c: c, np.ones_like, lambda z: np.sin(z) + np.sin(2 * z + shift))

    assert median(0.0) == pytest.approx(0, abs=1e-4)
    assert abs(median(np.pi / 2)) > 0.1


def test_power_of_the_sine_wave():
    """Mean of (1 + alpha sin) |sin(theta) - sin(phi)| at balance, and its share of V."""
    power = signed((1 + ALPHA * sp.sin(PHI)) * (Q - sp.sin(PHI))) / (2 * sp.pi)
    balanced = sp.cos(THETA) * (2 + ALPHA * sp.sin(THETA) - ALPHA**2) / sp.pi
    for angle in (0.1, 0.4, 0.7):
        values = {THETA: angle, ALPHA: angle / sp.cos(angle)}  # theta = alpha cos(theta)
        assert abs(sp.N((power - balanced).subs(values))) < 1e-14
    # rigid velocities do no work: the power is that of the deformation, -sin(phi), alone
    force = signed((1 + ALPHA * sp.sin(PHI)) * Q)
    assert abs(sp.N(force.subs({THETA: 0.4, ALPHA: 0.4 / sp.cos(0.4)}))) < 1e-14
    small = sp.limit(balanced.subs(THETA, ALPHA), ALPHA, 0)
    assert small == 2 / sp.pi

"""Limits of the plate theory proved: the strip on soft and on stiff ground, the heavy elastica.

Lengths over L, times over T. A strip of bending stiffness B under c = sin k(y - t), k = 2 pi, deflects
by w = cos(kt) w_s - sin(kt) w_c. It slips with v = -sin k(y - t) by growth, and with du/dt, u' =
-w'^2/2 - (h^2/12) (M w')', M = w'' + c, by bending; see `tests/plate/reference_strip.py`.
"""

import pytest
import sympy as sp

Y, T, Z, AT = sp.symbols("y t z Y", real=True)
STIFFNESS, SPRING, WEIGHT, H, LAYER = sp.symbols("B s q h ell", positive=True)
K = 2 * sp.pi
END = sp.Rational(1, 2)
SINE, COSINE = sp.sin(K * Y), sp.cos(K * Y)


def along(integrand):
    """Integral over the strip."""
    return sp.integrate(sp.expand(integrand), (Y, -END, END))


def decaying(integrand):
    """Integral over z > 0 of polynomials times decaying waves, term by term."""
    total = sp.Integer(0)
    for term in sp.Add.make_args(sp.expand(sp.expand(integrand.rewrite(sp.exp)), power_exp=False)):
        term = sp.powsimp(term)
        waves = [e.exp for e in term.atoms(sp.exp)]
        rate = -sum(waves) / Z
        factor = sp.simplify(term / sp.exp(-rate * Z))
        power = sp.degree(factor, Z) if factor.has(Z) else 0
        total += factor.subs(Z, 1) * sp.factorial(power) / rate ** (power + 1)
    return sp.simplify(sp.expand(total))


def dry_over_viscous():
    """First harmonic of f = sgn(sin), which V_ab counts, over the mean of df/dv: two jumps of 2."""
    angle = sp.Symbol("theta", real=True)
    first = 2 * 2 * sp.integrate(sp.sin(angle), (angle, 0, sp.pi)) / (2 * sp.pi)
    return first / (2 * 2 / (2 * sp.pi))


def test_dry_friction_counts_pressure_twice():
    assert dry_over_viscous() == 2


# ---- soft ground


def free_shapes():
    """w_s and w_c of the free strip, without rigid part."""
    return SINE / K**2 - 12 * Y / K**3, COSINE / K**2


def soft_mixed():
    """V_ab under viscous friction, (s/q) <w v>."""
    sine, cosine = free_shapes()
    return -SPRING / (2 * WEIGHT) * along(sine * SINE + cosine * COSINE)


def shortening(sine, cosine):
    """What V_bb under dry friction counts of -w'^2/2, by parts: a density along the strip."""
    slopes = sp.diff(sine, Y), sp.diff(cosine, Y)
    return ((slopes[0] ** 2 - slopes[1] ** 2) * SINE**2 + 2 * slopes[0] * slopes[1] * SINE * COSINE) / 2


def soft_bent():
    """V_bb under dry friction: M = 0."""
    return along(shortening(*free_shapes()))


def stated_soft():
    """V_ab, V_bb."""
    mixed = -SPRING / WEIGHT * (1 - 12 / K**2) / (2 * K**2)
    return mixed, -(1 - 144 / K**4) / (4 * K**2)


def test_free_shapes():
    for shape, growth in zip(free_shapes(), (SINE, COSINE), strict=True):
        assert sp.simplify(sp.diff(shape, Y, 2) + growth) == 0
        assert (along(shape), sp.simplify(along(shape * Y))) == (0, 0)


def test_soft_ground():
    for found, stated in zip((soft_mixed(), soft_bent()), stated_soft(), strict=True):
        assert sp.simplify(found - stated) == 0


def test_v_bb_is_minus_the_slip_at_the_points_without_slip():
    """- int du/dt dy at t = y for the free shapes, without integration by parts."""
    slope = sp.cos(K * T) * sp.diff(free_shapes()[0], Y) - sp.sin(K * T) * sp.diff(free_shapes()[1], Y)
    rate = sp.expand(sp.diff(-(slope**2) / 2, T))
    slip = sp.integrate(sp.expand(rate.subs(T, AT)), (Y, 0, AT))
    speed = -sp.integrate(sp.expand(slip), (AT, -END, END))
    assert sp.simplify(speed - stated_soft()[1]) == 0


# ---- stiff ground: at the end y = 1/2, a distance d = sqrt(2) ell z from it

LENGTH = sp.sqrt(2) * LAYER


def end_layer(moment, shear):
    """exp(-z) (P cos z + Q sin z) that brings w'' = -moment and w''' = -shear to the end, along y."""
    first, second = sp.symbols("P Q")
    wave = sp.exp(-Z) * (first * sp.cos(Z) + second * sp.sin(Z))
    conditions = [
        sp.diff(wave, Z, 2).subs(Z, 0) / LENGTH**2 + moment,
        -sp.diff(wave, Z, 3).subs(Z, 0) / LENGTH**3 + shear,
    ]
    return wave.subs(sp.solve(conditions, [first, second]))


def end_layers():
    """w_s and w_c: c = sin ky and cos ky are 0 and -1 there, with slopes -k and 0."""
    return end_layer(0, -K), end_layer(-1, 0)


def by_y(expression):
    """Derivative along the strip."""
    return -sp.diff(expression, Z) / LENGTH


def near_the_end():
    """sin ky and cos ky to second order in z."""
    distance = K * LENGTH * Z
    return distance, -1 + distance**2 / 2


def inside_mixed():
    """V_ab of w = l^4 k^2 c, the same at every point: l^4 s = B."""
    return -(K**2) * STIFFNESS / (2 * WEIGHT)


def stiff_mixed():
    """V_ab under viscous friction: inside, and both ends to the order of the layer."""
    (sine, cosine), (w_s, w_c) = near_the_end(), end_layers()
    ends = 2 * LENGTH * decaying(w_s * sine + w_c * cosine)
    lowest = sp.series(sp.expand(ends), LAYER, 0, 6).removeO()
    return inside_mixed() - lowest * STIFFNESS / LAYER**4 / (2 * WEIGHT)


def stiff_bent():
    """V_bb under dry friction: shortening, and moments that turn, to the lowest order of each."""
    distance, (w_s, w_c) = K * LENGTH * Z, end_layers()
    slopes = by_y(w_s), by_y(w_c)
    shortened = -(slopes[1] ** 2) * distance**2 - 2 * slopes[0] * slopes[1] * distance
    moments = by_y(slopes[0]) + distance, by_y(slopes[1]) - 1
    turned = 2 * distance * moments[1] * slopes[1] + moments[0] * slopes[1] + moments[1] * slopes[0]
    return 2 * LENGTH * (decaying(shortened) / 2 - H**2 / 12 * K * decaying(turned))


def stated_stiff():
    """V_ab, V_bb."""
    mixed = inside_mixed() * (1 - 2 * sp.sqrt(2) * LAYER)
    return mixed, sp.sqrt(2) / 8 * K**2 * LAYER**3 * (3 * LAYER**2 - H**2)


def test_the_layer_solves_its_equation_and_lifts_the_end_by_its_square():
    for layer in end_layers():
        assert sp.simplify(LAYER**4 * by_y(by_y(by_y(by_y(layer)))) + layer) == 0
    # pressure rho g (1 - beta s l^2/(rho g)) at the end, s l^2 = sqrt(B s)
    assert sp.simplify(end_layers()[1].subs(Z, 0) - LAYER**2) == 0
    assert sp.simplify(decaying(end_layers()[1])) == 0  # no net force


@pytest.mark.parametrize("part", [0, 1], ids=["V_ab", "V_bb"])
def test_stiff_ground(part):
    found = (stiff_mixed, stiff_bent)[part]()
    assert sp.simplify(found - stated_stiff()[part]) == 0


# ---- the heavy elastica


def elastica_balance():
    """Derivative of B theta'^2/2 - Q sin(theta) + R(z) - q z along the strip, R' = r."""
    angle, force, height = (sp.Function(n)(Y) for n in ("theta", "Q", "z"))
    reaction = sp.Function("r")(height)
    primitive = sp.Function("R")(height)  # of r
    kept = STIFFNESS * sp.diff(angle, Y) ** 2 / 2 - force * sp.sin(angle) + primitive - WEIGHT * height
    rate = sp.diff(kept, Y)
    rate = rate.subs(sp.diff(primitive, Y), reaction * sp.sin(angle))
    rate = rate.subs(sp.diff(angle, Y, 2), force * sp.cos(angle) / STIFFNESS)
    return rate.subs({sp.diff(force, Y): reaction - WEIGHT, sp.diff(height, Y): sp.sin(angle)})


DEPTH, RISE, CURVATURE = sp.symbols("d D kappa", positive=True)


def elastica_work(end):
    """B kappa^2/2 of an end at the height `end` <= 0 over a flat middle at -d, r = k z^2, q = k d^2."""
    height = sp.Symbol("zeta")
    return sp.integrate(WEIGHT - WEIGHT / DEPTH**2 * height**2, (height, -DEPTH, end))


def test_the_elastica_has_an_integral_at_any_slope():
    assert sp.simplify(elastica_balance()) == 0
    spring = 2 * WEIGHT / DEPTH
    stated = spring * RISE**2 / 2 * (1 - RISE / (3 * DEPTH))
    assert sp.simplify(elastica_work(RISE - DEPTH) - stated) == 0
    assert sp.simplify(elastica_work(0) - sp.Rational(2, 3) * WEIGHT * DEPTH) == 0
    # B kappa^2 at lift-off over that of the plate, q^2/s: 8/3
    assert sp.simplify(2 * elastica_work(0) / (WEIGHT**2 / spring)) == sp.Rational(8, 3)

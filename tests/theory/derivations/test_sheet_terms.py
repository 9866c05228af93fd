"""Derivations: the terms of eq. 15, mean and linear growth, Fourier coefficients of the wave."""

import pytest
import sympy as sp

from tests.theory.derivations.sheet import (
    ALPHA,
    D_TRACE,
    FAMILIES,
    PRINTED_D,
    SIGN_S,
    D,
    G,
    J,
    L,
    R,
    S,
    W,
    X,
    Y,
    biharmonic,
    differs,
    hooke,
    strain_of,
    stresses,
    vanishes,
)

# --- E8: the terms of eq. 15 -----------------------------------------------------------------------


def test_particular_solution():
    """First line of eq. 15: chi = alpha c_j/q^2 for c_j = cos(q y) or sin(q y) solves eq. 14."""
    q = sp.Symbol("q", positive=True)
    for growth in (sp.cos(q * Y), sp.sin(q * Y)):
        chi = ALPHA * growth / q**2
        assert sp.expand(biharmonic(chi) + ALPHA * sp.diff(growth, Y, 2)) == 0
        xx, yy, xy = stresses(chi)
        assert (sp.expand(xx + ALPHA * growth), yy, xy) == (0, 0, 0)


@pytest.mark.parametrize("family", FAMILIES)
def test_each_term_is_biharmonic(family):
    """E8: the A, B, C and D terms of eq. 15 (D with cosh(d_s x)) satisfy nabla^4 chi = 0."""
    assert vanishes(biharmonic(FAMILIES[family]))


@pytest.mark.parametrize("family", FAMILIES)
def test_each_term_is_free_of_shear_on_all_edges(family):
    """E8: d_xy chi = 0 on x = +-W/2 and y = +-L/2 for every integer m, r and odd s = 2 j - 1."""
    mixed = sp.diff(FAMILIES[family], X, Y)
    for edge in ({X: W / 2}, {X: -W / 2}, {Y: L / 2}, {Y: -L / 2}):
        value = sp.expand_trig(sp.expand(mixed.subs(edge)))
        assert vanishes(value)
    assert differs(mixed)


def test_printed_d_term_is_not_biharmonic():
    """E8: the last line with cosh(d_s y) has nabla^4 chi = 4 d^2 (...) sin(dy) cosh(dy)/cosh(dW/2)."""
    excess = biharmonic(PRINTED_D)
    expected = 4 * D**2 * D_TRACE * sp.sin(D * Y) * sp.cosh(D * Y) / sp.cosh(D * W / 2)
    assert vanishes(excess - expected)
    assert differs(excess)
    assert differs(sp.diff(PRINTED_D, X, Y).subs(X, W / 2))  # nor free of shear on the sides


# --- E9: mean and linear growth --------------------------------------------------------------------


def test_constant_growth_is_a_uniform_dilation():
    """E9: c = c0 has stress 0 and u = alpha c0 (x, y); the r = 0 term of eq. 15 divides by 0."""
    c0 = sp.Symbol("c0", real=True)
    assert strain_of((ALPHA * c0 * X, ALPHA * c0 * Y)) == hooke((0, 0, 0), c0)
    assert G.subs(R, 0) == 0
    assert (ALPHA * sp.cos(G * Y) / G**2).subs(R, 0) == sp.zoo * ALPHA
    printed_a0 = 2 / L * sp.integrate(c0, (Y, -L / 2, L / 2))
    assert sp.simplify(printed_a0 - 2 * c0) == 0  # and the printed coefficient is twice the mean


def test_linear_growth_is_free_of_stress():
    """E9: c = c1 y has stress 0 and u = alpha c1 (x y, (y^2 - x^2)/2)."""
    c1 = sp.Symbol("c1", real=True)
    u = (ALPHA * c1 * X * Y, ALPHA * c1 * (Y**2 - X**2) / 2)
    assert strain_of(u) == hooke((0, 0, 0), c1 * Y)


# --- E10: Fourier coefficients of the wave -----------------------------------------------------------


def half_wave_coefficient(growth):
    """The printed integral for b_s, in y/L."""
    half = sp.Rational(1, 2)
    b = sp.pi * S
    return 2 * sp.integrate(sp.expand(growth * sp.sin(b * Y)), (Y, -half, half))


def test_a_full_sine_meets_every_half_wave():
    """E10: b_s of sin(2 pi r y) is 4 a (-1)^r sigma_s/(b^2 - a^2), a = 2 pi r, b = s pi: never 0."""
    a, b = 2 * sp.pi * R, sp.pi * S
    closed = 4 * a * (-1) ** R * SIGN_S / (b**2 - a**2)
    for r in (1, 2, 5):
        for j in (1, 2, 3, 8):
            numbers = {R: r, J: j}
            integral = half_wave_coefficient(sp.sin(a * Y).subs(numbers)).subs(numbers)
            assert sp.simplify(integral - closed.subs(numbers)) == 0
    # any r and j: product to sum, integrated term by term
    p, q = sp.symbols("p q", positive=True)
    product = sp.sin(p * Y) * sp.sin(q * Y)
    primitive = sp.sin((p - q) * Y) / (2 * (p - q)) - sp.sin((p + q) * Y) / (2 * (p + q))
    assert sp.simplify(sp.expand_trig(sp.diff(primitive, Y) - product)) == 0
    general = (4 * primitive.subs(Y, sp.Rational(1, 2))).subs({p: a, q: b})
    assert sp.simplify(sp.expand_trig(sp.expand(general)) - closed) == 0
    assert sp.factor(b**2 - a**2) == sp.factor(sp.pi**2 * (S - 2 * R) * (S + 2 * R))  # odd: never 0


def test_printed_coefficients_are_not_those_of_the_wave():
    """E10: a_r = delta_1r cos(wt) fits cos(2 pi y - wt); sin(2 pi n y - wt) has a_n = -sin(wt).

    b_s = delta_1s sin(wt) would be the half wave sin(pi y), which no full wave contains alone.
    """
    wt = sp.Symbol("wt", real=True)
    half = sp.Rational(1, 2)

    def even(growth, r):
        return sp.simplify(2 * sp.integrate(growth * sp.cos(2 * sp.pi * r * Y), (Y, -half, half)))

    cosine, sine = sp.cos(2 * sp.pi * Y - wt), sp.sin(2 * sp.pi * Y - wt)
    assert [even(cosine, r) for r in (1, 2)] == [sp.cos(wt), 0]
    assert [even(sine, r) for r in (1, 2)] == [-sp.sin(wt), 0]
    for growth, factor in ((cosine, sp.sin(wt)), (sine, sp.cos(wt))):
        for s in (1, 3, 5):
            b_s = 2 * sp.integrate(growth * sp.sin(s * sp.pi * Y), (Y, -half, half))
            closed = factor * sp.Rational(8, 4 - s**2) * (-1) ** ((s - 1) // 2) / sp.pi
            assert sp.simplify(b_s - closed) == 0
            assert b_s != 0


def test_subtracting_the_end_slope_speeds_up_the_coefficients():
    """E10: c - (-1)^r a y has slope 0 at the ends and b_s = 4 a^3 (-1)^r sigma_s/(b^2 (b^2 - a^2))."""
    a, b = 2 * sp.pi * R, sp.pi * S
    reduced = sp.sin(a * Y) - (-1) ** R * a * Y
    assert sp.simplify(sp.diff(reduced, Y).subs(Y, sp.Rational(1, 2))) == 0
    primitive = sp.sin(b * Y) / b**2 - Y * sp.cos(b * Y) / b
    assert sp.simplify(sp.diff(primitive, Y) - Y * sp.sin(b * Y)) == 0
    of_y = sp.simplify(sp.expand_trig(sp.expand(4 * primitive.subs(Y, sp.Rational(1, 2)))))
    assert sp.simplify(of_y - 4 * SIGN_S / b**2) == 0
    full = 4 * a * (-1) ** R * SIGN_S / (b**2 - a**2)
    closed = 4 * a**3 * (-1) ** R * SIGN_S / (b**2 * (b**2 - a**2))
    assert sp.simplify(full - (-1) ** R * a * of_y - closed) == 0

"""The two-dimensional linear theory proved again (paper eqs 1a, 4, 10, 14, 15 and the amplitudes).

Every test derives the equation it names and shows that the printed form, where it differs, fails.
Conventions: rectangle |x| <= W/2, |y| <= L/2, Young modulus 1, wave numbers k_m = 2 pi m/W (printed
alpha_m), g_r = 2 pi r/L (gamma_r), d_s = s pi/L with s odd (delta_s). The print has W = L/2.
"""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
import sympy as sp

X, Y = sp.symbols("x y", real=True)
ALPHA, NU = sp.symbols("alpha nu", real=True)
L, W, WAVENUMBER, HALF = sp.symbols("L W k H", positive=True)
M, R, J = sp.symbols("m r j", integer=True, positive=True)
S = 2 * J - 1
K, G, D = 2 * sp.pi * M / W, 2 * sp.pi * R / L, sp.pi * S / L
SIGN_S = (-1) ** (J - 1)  # (-1)^((s-1)/2)


def vanishes(expression):
    """Whether an expression in exponentials and trigonometric functions of free symbols is zero."""
    numerator, _ = sp.fraction(sp.together(sp.sympify(expression).rewrite(sp.exp)))
    return sp.simplify(sp.expand(sp.powsimp(sp.expand(numerator)))) == 0


def differs(expression):
    """Whether an expression is not zero, shown at one point with rational values."""
    numbers = {L: 1, W: sp.Rational(1, 2), M: 2, R: 1, J: 2, X: sp.Rational(1, 7), Y: sp.Rational(2, 7)}
    expression = sp.sympify(expression).subs(numbers)
    free = sorted(expression.free_symbols, key=str)
    values = {symbol: sp.Rational(j + 2, 5) for j, symbol in enumerate(free)}
    return abs(complex(expression.subs(values).evalf(30))) > 1e-6


def biharmonic(chi):
    """The left side of eq. 14."""
    return sp.diff(chi, X, 4) + 2 * sp.diff(chi, X, 2, Y, 2) + sp.diff(chi, Y, 4)


def stresses(chi):
    """(xx, yy, xy) of an Airy function, by equilibrium."""
    return sp.diff(chi, Y, 2), sp.diff(chi, X, 2), -sp.diff(chi, X, Y)


def hooke(stress, growth, factor=1):
    """(xx, yy, xy) strain of plane stress with Y = 1 and thermal term factor * alpha * c."""
    xx, yy, xy = stress
    extra = factor * ALPHA * growth
    return xx - NU * yy + extra, yy - NU * xx + extra, (1 + NU) * xy


def strain_of(u):
    """(xx, yy, xy) of a displacement."""
    return (
        sp.diff(u[0], X),
        sp.diff(u[1], Y),
        (sp.diff(u[0], Y) + sp.diff(u[1], X)) / 2,
    )


def even_profile(k, half, z):
    """The braces of the A and C terms of eq. 15 over cosh: even in z, flat at z = +-half."""
    braces = k * z * sp.sinh(k * z) - (1 + k * half * sp.coth(k * half)) * sp.cosh(k * z)
    return braces / (k**2 * sp.cosh(k * half))


def odd_profile(k, half, z):
    """The braces of the B terms of eq. 15 over sinh: odd in z, flat at z = +-half."""
    braces = k * z * sp.cosh(k * z) - (1 + k * half * sp.tanh(k * half)) * sp.sinh(k * z)
    return braces / (k**2 * sp.sinh(k * half))


FAMILIES = {
    "A": sp.cos(K * X) * even_profile(K, L / 2, Y),
    "B": sp.cos(K * X) * odd_profile(K, L / 2, Y),
    "C": sp.cos(G * Y) * even_profile(G, W / 2, X),
    "D": sp.sin(D * Y) * even_profile(D, W / 2, X),
}
D_TRACE = 1 + D * W / 2 * sp.coth(D * W / 2)
PRINTED_D = (
    sp.sin(D * Y) / (D**2 * sp.cosh(D * W / 2)) * (D * X * sp.sinh(D * X) - D_TRACE * sp.cosh(D * Y))
)


# --- E5: constitutive law ------------------------------------------------------------------------


@pytest.mark.parametrize("raised", [True, False], ids=["indices raised by abar", "as printed"])
def test_plane_stress_law_follows_from_the_koiter_energy(raised):
    """E5: eq. 1a with abar = exp(2 alpha c), linearised, is eq. 10b with + alpha c (no factor 1+nu)."""
    small, c = sp.symbols("e c", real=True)
    xx, yy, xy = strain = sp.symbols("exx eyy exy", real=True)
    metric = sp.eye(2) + 2 * small * sp.Matrix([[xx, xy], [xy, yy]])
    rest = sp.exp(2 * small * ALPHA * c)
    change = metric - rest * sp.eye(2)
    change = change / rest if raised else change
    area = rest if raised else 1
    density = area / (8 * (1 - NU**2)) * ((1 - NU) * (change**2).trace() + NU * change.trace() ** 2)
    energy = sp.expand(sp.diff(density, small, 2).subs(small, 0)) / 2
    stress = [sp.diff(energy, xx), sp.diff(energy, yy), sp.diff(energy, xy) / 2]

    def residuals(factor):
        return [sp.simplify(a - b) for a, b in zip(hooke(stress, c, factor), strain, strict=True)]

    assert residuals(1) == [0, 0, 0]
    assert residuals(1 + NU) == [ALPHA * NU * c, ALPHA * NU * c, 0]


def test_printed_thermal_term_is_that_of_plane_strain():
    """E5: three-dimensional Hooke gives alpha c if sigma_zz = 0 and (1+nu) alpha c if eps_zz = 0."""
    c, xx, yy, zz = sp.symbols("c sxx syy szz", real=True)
    strain_x = xx - NU * (yy + zz) + ALPHA * c
    strain_z = zz - NU * (xx + yy) + ALPHA * c
    (constrained,) = sp.solve(strain_z, zz)
    thermal = {"plane stress": strain_x.subs(zz, 0), "plane strain": strain_x.subs(zz, constrained)}
    at_rest = {name: sp.factor(value.subs({xx: 0, yy: 0})) for name, value in thermal.items()}
    assert at_rest == {"plane stress": ALPHA * c, "plane strain": sp.factor((1 + NU) * ALPHA * c)}
    # and the rest of eq. 10b is plane stress, so that the print mixes the two:
    assert sp.expand(thermal["plane stress"] - ((1 + NU) * xx - NU * (xx + yy) + ALPHA * c)) == 0
    assert sp.expand(thermal["plane strain"] - ((1 + NU) * xx - NU * (xx + yy))).coeff(xx) != 0


def test_compatibility_gives_equation_14():
    """E5: with + alpha c, compatibility is eq. 14 (Y = 1); with (1+nu) alpha c it is not."""
    chi, c = sp.Function("chi")(X, Y), sp.Function("c")(X, Y)
    laplacian = sp.diff(c, X, 2) + sp.diff(c, Y, 2)

    def residual(factor):
        xx, yy, xy = hooke(stresses(chi), c, factor)
        incompatibility = sp.diff(xx, Y, 2) + sp.diff(yy, X, 2) - 2 * sp.diff(xy, X, Y)
        return sp.simplify(incompatibility - (biharmonic(chi) + ALPHA * laplacian))

    assert residual(1) == 0
    assert sp.simplify(residual(1 + NU) - NU * ALPHA * laplacian) == 0


# --- E6, E7: shear and free edges ------------------------------------------------------------------


def test_equilibrium_fixes_the_shear():
    """E6: d_i sigma_ij = 0 holds for sigma_xy = -d_xy chi, and not for the printed -2 d_xy chi."""
    chi = sp.Function("chi")(X, Y)
    xx, yy, xy = stresses(chi)

    def force(shear):
        return sp.diff(xx, X) + sp.diff(shear, Y), sp.diff(shear, X) + sp.diff(yy, Y)

    assert force(xy) == (0, 0)
    assert force(2 * xy) == (-sp.diff(chi, X, Y, 2), -sp.diff(chi, X, 2, Y))


def test_free_edges_also_need_the_mixed_derivative():
    """E7: sigma n = 0 is d_yy chi = d_xy chi = 0 on x = +-W/2 and d_xx chi = d_xy chi = 0 on y = +-L/2.

    chi = x y meets both printed conditions everywhere and still pulls at every edge.
    """
    chi = sp.Function("chi")(X, Y)
    xx, yy, xy = stresses(chi)
    tensor = sp.Matrix([[xx, xy], [xy, yy]])
    side, end = tensor * sp.Matrix([1, 0]), tensor * sp.Matrix([0, 1])
    assert list(side) == [sp.diff(chi, Y, 2), -sp.diff(chi, X, Y)]
    assert list(end) == [-sp.diff(chi, X, Y), sp.diff(chi, X, 2)]
    assert stresses(X * Y) == (0, 0, -1)


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


# --- E11, E12: the amplitude equations --------------------------------------------------------------


def even_projection(g, half, k):
    """Integral of [(1 - h coth h) cosh(gz) + gz sinh(gz)] cos(kz) over |z| < half, / half; h = g half.

    sin(k half) = 0 is used: k half is a multiple of pi (symbols: `half_turn` = cos(k half)).
    """
    z = sp.Symbol("z", real=True)
    turn = sp.Symbol("half_turn")
    slope = sp.Symbol("slope", positive=True)
    primitive = slope * sp.sinh(slope * z) * sp.cos(k * z) + k * sp.cosh(slope * z) * sp.sin(k * z)
    primitive = primitive / (slope**2 + k**2)
    assert sp.simplify(sp.diff(primitive, z) - sp.cosh(slope * z) * sp.cos(k * z)) == 0
    ends = 2 * primitive.subs(z, half).subs({sp.sin(k * half): 0, sp.cos(k * half): turn})
    with_cosh, with_z_sinh = ends.subs(slope, g), sp.diff(ends, slope).subs(slope, g)
    h = g * half
    return ((1 - h * sp.coth(h)) * with_cosh + g * with_z_sinh) / half, turn


def odd_projection(k, half, d):
    """Integral of [(1 - h tanh h) sinh(kz) + kz cosh(kz)] sin(dz) over |z| < half, / half; h = k half.

    cos(d half) = 0 is used; `quarter_turn` = sin(d half).
    """
    z = sp.Symbol("z", real=True)
    turn = sp.Symbol("quarter_turn")
    slope = sp.Symbol("slope", positive=True)
    primitive = slope * sp.cosh(slope * z) * sp.sin(d * z) - d * sp.sinh(slope * z) * sp.cos(d * z)
    primitive = primitive / (slope**2 + d**2)
    assert sp.simplify(sp.diff(primitive, z) - sp.sinh(slope * z) * sp.sin(d * z)) == 0
    ends = 2 * primitive.subs(z, half).subs({sp.cos(d * half): 0, sp.sin(d * half): turn})
    with_sinh, with_z_cosh = ends.subs(slope, k), sp.diff(ends, slope).subs(slope, k)
    h = k * half
    return ((1 - h * sp.tanh(h)) * with_sinh + k * with_z_cosh) / half, turn


def test_own_terms_of_the_amplitude_equations():
    """Brackets of all four equations: 1 + 2kH/sinh(2kH) (A, C, D) and 1 - 2kH/sinh(2kH) (B).

    They are the normal stress of a term on its own pair of edges: k = k_m and H = L/2 (A, B), or
    k = g_r, d_s and H = W/2 (C, D). For W = L/2 these are the printed ones.
    """
    k, half, wave = WAVENUMBER, HALF, sp.cos(WAVENUMBER * X)
    for profile, sign in ((even_profile, 1), (odd_profile, -1)):
        own = stresses(wave * profile(k, half, Y))[1].subs(Y, half)
        assert vanishes(own - wave * (1 + sign * 2 * k * half / sp.sinh(2 * k * half)))
    own = stresses(sp.sin(k * Y) * even_profile(k, half, X))[0].subs(X, half)
    assert vanishes(own - sp.sin(k * Y) * (1 + 2 * k * half / sp.sinh(2 * k * half)))


@pytest.mark.parametrize(("family", "wavenumber"), [("C", G), ("D", D)])
def test_stress_of_c_and_d_terms_on_the_ends(family, wavenumber):
    """E11, E12: sigma_yy on y = L/2 is sign * [(1 - h coth h) cosh + gx sinh]/cosh h, h = g W/2.

    sign = (-1)^r for C and (-1)^((s-1)/2) for D.
    """
    sign = {"C": (-1) ** R, "D": SIGN_S}[family]
    g, h = wavenumber, wavenumber * W / 2
    stress = stresses(FAMILIES[family])[1].subs(Y, L / 2)
    bracket = (1 - h * sp.coth(h)) * sp.cosh(g * X) + g * X * sp.sinh(g * X)
    difference = sp.expand_trig(sp.expand(stress - sign * bracket / sp.cosh(h)))
    assert vanishes(difference)


def test_coupling_of_c_and_d_into_the_a_and_b_equations():
    """E11, E12: (-1)^m (8/W) k^2 g tanh(g W/2)/(k^2 + g^2)^2, g = g_r or d_s, times the sign above."""
    g, k = sp.symbols("g k", positive=True)
    integral, turn = even_projection(g, W / 2, k)
    derived = integral / sp.cosh(g * W / 2)
    corrected = turn * 8 / W * k**2 * g * sp.tanh(g * W / 2) / (k**2 + g**2) ** 2
    assert vanishes(derived - corrected)
    assert sp.cos(K * W / 2) == (-1) ** M
    assert sp.sin(K * W / 2) == 0
    assert corrected.subs(k, 0) == 0  # no resultant: m = 0 needs no equation

    printed = turn * 8 / L * k**2 * g * sp.tanh(k * L / 4) / (k**2 + g**2) ** 2
    assert differs((derived - printed).subs(W, L / 2))
    ratio = sp.simplify((corrected / printed).subs(W, L / 2))
    assert vanishes(ratio - 2 * sp.tanh(g * L / 4) / sp.tanh(k * L / 4))


def test_no_mode_saves_the_printed_a_and_b_equations():
    """E11, E12: corrected/printed = 2 tanh(g L/4)/tanh(k L/4) lies in (1.3, 2.01) for all modes.

    g L/4 >= pi/4 (s = 1), where tanh = 0.6558; k L/4 = pi m >= pi, where 0.99627 <= tanh < 1.
    """
    lowest = 2 * mpmath.tanh(mpmath.pi / 4)
    highest = 2 / mpmath.tanh(mpmath.pi)
    assert lowest > 1.3
    assert highest < 2.01
    assert 2 * mpmath.tanh(mpmath.pi / 2) / mpmath.tanh(mpmath.pi) > 1.8  # A-equation, r = m = 1


def test_coupling_of_a_into_the_c_equation():
    """C-equation, as printed: (-1)^(m+r) (8/L) k g^2 tanh(k L/2)/(k^2 + g^2)^2."""
    h = K * L / 2
    stress = stresses(FAMILIES["A"])[0].subs(X, W / 2)
    bracket = (1 - h * sp.coth(h)) * sp.cosh(K * Y) + K * Y * sp.sinh(K * Y)
    assert vanishes(sp.expand_trig(sp.expand(stress - (-1) ** M * bracket / sp.cosh(h))))
    g, k = sp.symbols("g k", positive=True)
    integral, turn = even_projection(k, L / 2, g)
    printed = turn * 8 / L * k * g**2 * sp.tanh(k * L / 2) / (k**2 + g**2) ** 2
    assert vanishes(integral / sp.cosh(k * L / 2) - printed)
    assert sp.cos(G * L / 2) == (-1) ** R


def test_coupling_of_b_into_the_d_equation():
    """D-equation, as printed: (-1)^(m+(s-1)/2) (8/L) k d^2 coth(k L/2)/(k^2 + d^2)^2."""
    h = K * L / 2
    stress = stresses(FAMILIES["B"])[0].subs(X, W / 2)
    bracket = (1 - h * sp.tanh(h)) * sp.sinh(K * Y) + K * Y * sp.cosh(K * Y)
    assert vanishes(sp.expand_trig(sp.expand(stress - (-1) ** M * bracket / sp.sinh(h))))
    d, k = sp.symbols("d k", positive=True)
    integral, turn = odd_projection(k, L / 2, d)
    printed = turn * 8 / L * k * d**2 * sp.coth(k * L / 2) / (k**2 + d**2) ** 2
    assert vanishes(integral / sp.sinh(k * L / 2) - printed)
    assert sp.simplify(sp.expand_trig(sp.sin(D * L / 2)) - SIGN_S) == 0


def test_narrow_sheet_stretches_freely_both_ways():
    """W -> 0 with the C-equation's C = alpha a/2: sigma = 0, so eps_xx = eps_yy = alpha c (see F1)."""
    g, xi, half = sp.symbols("g xi h", positive=True)  # half = g W/2, x = xi W/2
    profile = even_profile(g, half / g, X)
    own = 1 + 2 * half / sp.sinh(2 * half)

    def narrow(expression):  # sympy 1.14 loses h coth(h) in this limit: write it with sinh and cosh
        expression = expression.replace(sp.coth, lambda z: sp.cosh(z) / sp.sinh(z))
        return sp.series(expression.subs(X, xi * half / g), half, 0, 1).removeO()

    assert narrow(own) == 2
    xx, yy, xy = stresses(sp.cos(g * Y) * profile)
    particular, _, _ = stresses(sp.cos(g * Y) / g**2)
    terms = [sp.expand(narrow(sp.simplify(z / w))) for z, w in ((xx, particular), (yy, particular))]
    assert terms == [-2, 0]  # particular + (1/2) C-term: no sigma_xx, no sigma_yy
    assert narrow(sp.simplify(xy / sp.sin(g * Y))) == 0


# --- the whole series ------------------------------------------------------------------------------


def amplitudes(modes, width=0.5, odd=False, printed=False, tail=0):
    """Wave numbers, A_m and C_r (or B_m and D_s) and K on a sheet of L = 1; m <= modes, r <= 2 modes.

    Load: cos(2 pi y), or odd: sin(2 pi y) less its stress-free linear part, as in E10.
    tail > modes: (-1)^m K/m and the balancing tail of the other family are carried up to that mode,
    with K = (-1)^M M A_M at the last; otherwise K means nothing.
    """

    def family(r):  # wave numbers, signs, partner of the tail 1/m
        if odd:
            return (2 * r - 1) * np.pi, (-1.0) ** (r - 1), -2 / (2 * r - 1)
        return 2 * r * np.pi, (-1.0) ** r, -1 / r

    def own(z, sign=1):
        return np.diag(1 + sign * 2 * z / np.sinh(np.minimum(2 * z, 600)))

    def ends(k, g):
        strength, side = (8, k / 4) if printed else (8 / width, g * width / 2)
        return strength * k**2 * g * np.tanh(side) / (k**2 + g**2) ** 2

    def sides(k, g):
        return 8 * k * g**2 * np.tanh(k / 2) ** (-1 if odd else 1) / (k**2 + g**2) ** 2

    m, r = np.arange(1, modes + 1), np.arange(1, 2 * modes + 1)
    k, sign_m = 2 * np.pi * m[:, None] / width, (-1.0) ** m
    g, sign_r, _ = family(r)
    size = 3 * modes
    matrix = np.zeros((size + 1, size + 1))
    matrix[:modes, :modes] = own(k[:, 0] / 2, -1 if odd else 1)
    matrix[:modes, modes:size] = sign_m[:, None] * sign_r * ends(k, g)
    matrix[modes:size, :modes] = (sign_m[:, None] * sign_r * sides(k, g)).T
    matrix[modes:size, modes:size] = own(g * width / 2)
    matrix[size, [modes - 1, size]] = sign_m[-1] * modes, -1
    if tail:
        far_m = np.arange(modes + 1, tail + 1)
        far_g, _, partner = family(np.arange(2 * modes + 1, tail + 1))
        matrix[:modes, size] = sign_m * (ends(k, far_g) @ partner)
        matrix[modes:size, size] = sign_r * (1 / far_m @ sides(2 * np.pi * far_m[:, None] / width, g))
    load = np.zeros(size + 1)
    a = 2 * np.pi
    load[modes:size] = -4 * a**3 * sign_r / (g**2 * (g**2 - a**2)) if odd else r == 1
    solution = np.linalg.solve(matrix, load)
    return k[:, 0], g, solution[:modes], solution[modes:size], solution[size]


def end_traction(x, k, g, a, c, width, odd):
    """sigma_yy on y = L/2 = 1/2, differentiated from eq. 15 without any projection."""
    r = np.arange(1, g.size + 1)
    signs = (-1.0) ** (r - 1) if odd else (-1.0) ** r
    own = 1 + (-1 if odd else 1) * k / np.sinh(np.minimum(k, 600))
    h, z = g * width / 2, np.outer(x, g)
    cosh = (np.exp(z - h) + np.exp(-z - h)) / (1 + np.exp(-2 * h))
    sinh = (np.exp(z - h) - np.exp(-z - h)) / (1 + np.exp(-2 * h))
    return np.cos(np.outer(x, k)) @ (a * own) + ((1 - h / np.tanh(h)) * cosh + z * sinh) @ (c * signs)


def central_stress(k, g, a, c, _tail, width=0.5):
    """sigma_xx at the centre for the even load (the tails of A and C are negligible there)."""

    def cosh(z):
        return np.cosh(np.minimum(z, 600))

    h, w = k / 2, g * width / 2
    return -1 + a @ ((1 - h / np.tanh(h)) / cosh(h)) + c @ ((1 + w / np.tanh(w)) / cosh(w))


@pytest.mark.parametrize("odd", [False, True], ids=["A and C", "B and D"])
@pytest.mark.parametrize("width", [0.5, 0.8])
def test_corrected_amplitudes_free_the_ends(width, odd):
    """E11, E12 as a whole: sigma_yy on y = L/2 tends to 0 with more modes; with the print it does not.

    Measured on the middle 80 % of the edge, away from the slow convergence at the corners (E13).
    """
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x = 0.8 * nodes * width / 2

    def traction(modes, printed=False):
        k, g, a, c, _ = amplitudes(modes, width, odd, printed)
        return np.sqrt(weights @ end_traction(x, k, g, a, c, width, odd) ** 2 / 2)

    coarse, fine = traction(10), traction(40)
    assert fine < 0.3 * coarse
    if width == 0.5:  # the print is for W = L/2 only
        coarse_print, fine_print = traction(10, printed=True), traction(40, printed=True)
        assert fine_print > 0.99 * coarse_print
        assert fine_print > 10 * fine


# --- E13: the slow tails ---------------------------------------------------------------------------


def test_integral_of_the_tail_balance():
    """E13: int_0^inf t^-s/(1 + t^2)^2 dt = (pi/4)(1 + s)/cos(pi s/2), -3 < s < 1."""
    s, t = sp.symbols("s t", positive=True)
    integral = sp.integrate(t ** (-s) / (1 + t**2) ** 2, (t, 0, sp.oo), conds="none")
    assert sp.simplify(integral - sp.pi / 4 * (1 + s) / sp.cos(sp.pi * s / 2)) == 0
    for value in (-1.5, 0.0, 0.4):
        numeric = mpmath.quad(lambda z, v=value: z**-v / (1 + z * z) ** 2, [0, 1, mpmath.inf])
        assert numeric == pytest.approx(np.pi / 4 * (1 + value) / np.cos(np.pi * value / 2), rel=1e-6)


def tail_factor(wanted, other, step, lam):
    """Minus the factor that a tail z^-lam of the other family gives in an amplitude equation.

    (8/W) sum_r k^2 g (k^2 + g^2)^-2 g^-lam -> (8/W)(1/dg) k^-lam int t^(1-lam)/(1+t^2)^2 dt.
    wanted: the side that divides (W or L); step: dg of the other family.
    """
    p = lam - 1
    return 8 / wanted / step * sp.pi / 4 * (1 + p) / sp.cos(sp.pi * p / 2) * other


def test_exponents_of_the_tails():
    """E13: A ~ (-1)^m a k^-lam, C ~ (-1)^r c g^-lam balance for sin(pi lam/2) = +-lam, any L and W."""
    lam, a, c = sp.symbols("lambda a c", nonzero=True)
    step_k, step_g = 2 * sp.pi / W, 2 * sp.pi / L
    first = a + tail_factor(W, c, step_g, lam)
    second = c + tail_factor(L, a, step_k, lam)
    determinant = sp.Matrix([[1, first.coeff(c)], [second.coeff(a), 1]]).det()
    f = lam / sp.sin(sp.pi * lam / 2)
    assert sp.simplify((determinant - (1 - f**2)).rewrite(sp.sin)) == 0

    k_at_one = {lam: 1}  # lam = 1: A = (-1)^m K/m and C = -(-1)^r K/r with one K
    tail = sp.Symbol("K")
    common = {a: tail * step_k, c: -tail * step_g}
    assert sp.simplify(first.subs(k_at_one).subs(common)) == 0
    assert sp.simplify(second.subs(k_at_one).subs(common)) == 0
    opposite = {a: tail * step_k, c: tail * step_g}
    assert sp.simplify(first.subs(k_at_one).subs(opposite)) != 0


def test_odd_tail_is_twice_as_strong():
    """E13, odd pair: B = (-1)^m K/m goes with D = -2 (-1)^((s-1)/2) K/s (d_s is spaced by 2 pi/L)."""
    tail, s = sp.symbols("K s", positive=True)
    b, d = sp.symbols("b d")
    step_k, step_d = 2 * sp.pi / W, 2 * sp.pi / L
    balances = [b + tail_factor(W, d, step_d, 1), d + tail_factor(L, b, step_k, 1)]
    (ratio,) = {sp.simplify(sp.solve(balance, d)[0]) for balance in balances}
    mode_d = (ratio / (s * sp.pi / L)).subs(b, tail * step_k)
    assert sp.simplify(mode_d + 2 * tail / s) == 0


def wedge_matrix(lam, symmetric):
    """sigma_theta,theta and sigma_r,theta on theta = pi/4 for chi = r^(lam+1) F(theta)."""
    theta = sp.Symbol("theta", real=True)
    wave = sp.cos if symmetric else sp.sin
    parts = [wave((lam + 1) * theta), wave((lam - 1) * theta)]
    rows = [parts, [sp.diff(part, theta) for part in parts]]
    return sp.Matrix(rows).subs(theta, sp.pi / 4)


def test_exponents_are_those_of_a_free_right_angled_corner():
    """E13: free wedge of 90 degrees: sin(pi lam/2) = -lam (symmetric) or +lam (antisymmetric)."""
    lam = sp.Symbol("lambda")
    r, theta = sp.symbols("r theta", positive=True)
    for part in (lam + 1, lam - 1):  # Williams' functions are biharmonic
        chi = r ** (lam + 1) * sp.cos(part * theta)
        for _ in range(2):
            chi = sp.diff(chi, r, 2) + sp.diff(chi, r) / r + sp.diff(chi, theta, 2) / r**2
        assert sp.simplify(chi) == 0
    for symmetric, sign in ((True, 1), (False, -1)):
        determinant = wedge_matrix(lam, symmetric).det()
        expected = sp.sin(sp.pi * lam / 2) + sign * lam
        factor = sp.simplify((determinant / expected).subs(lam, sp.Rational(1, 3)))
        assert factor**2 == 1
        assert vanishes(determinant - factor * expected)


def test_next_exponents():
    """E13: the roots after lam = 1 are 2.7396 + 1.1190 i (symmetric) and 4.8083 + 1.4639 i."""
    for sign, start, expected in (
        (-1, 2.7 + 1.1j, 2.739593 + 1.119025j),
        (1, 4.8 + 1.5j, 4.808251 + 1.463928j),
    ):
        root = mpmath.findroot(lambda z, a=sign: mpmath.sin(mpmath.pi * z / 2) - a * z, start)
        assert complex(root) == pytest.approx(expected, abs=1e-6)
        inside = winding(lambda z, a=sign: mpmath.sin(mpmath.pi * z / 2) - a * z, 1.5, root.real + 0.5)
        assert inside == 2  # the pair of conjugates: no other root with 1.5 < Re lam
    assert mpmath.sin(mpmath.pi / 2) == 1


def winding(function, left, right, height=6.0, points=4000):
    """Number of zeros in left < Re z < right, |Im z| < height, by the argument principle."""
    corners = [complex(left, -height), complex(right, -height), complex(right, height)]
    corners += [complex(left, height), corners[0]]
    side = np.linspace(0, 1, points // 4)
    path = np.concatenate([p + (q - p) * side for p, q in pairwise(corners)])
    values = np.array([complex(function(z)) for z in path])
    return round(float(np.sum(np.angle(values[1:] / values[:-1]))) / (2 * np.pi))


@pytest.mark.parametrize(("odd", "partner"), [(False, -1), (True, -2)])
def test_computed_amplitudes_have_the_tails(odd, partner):
    """E13: (-1)^m m A_m tends to K and (-1)^r r C_r to -K, (-1)^m m B_m to K and sigma_s s D_s to -2K.

    So the amplitudes of fig. 7 decay like 1/m, not rapidly. The tails are not put in here.
    """
    _, _, a, c, _ = amplitudes(250, odd=odd)
    m, r = np.arange(1, a.size + 1), np.arange(1, c.size + 1)
    first = (-1.0) ** m * m * a
    second = (-1.0) ** (r - 1) * (2 * r - 1) * c if odd else (-1.0) ** r * r * c
    tail = amplitudes(40, odd=odd, tail=6000)[-1]
    assert first[29:40] == pytest.approx(tail, rel=0.01)
    assert second[29:40] == pytest.approx(partner * tail, rel=0.01)
    assert abs(tail) > 0.2


def test_carrying_the_tail_beats_plain_truncation():
    """E13: error of sigma_xx at the centre 1.4e-5 at M = 20, of order M^-2; < 1e-7 with the tail."""
    exact = central_stress(*amplitudes(40, tail=6000))
    plain = {n: abs(central_stress(*amplitudes(n)) - exact) for n in (10, 20, 40)}
    assert plain[20] == pytest.approx(1.36e-5, rel=0.03)
    assert plain[10] / plain[20] == pytest.approx(4, rel=0.1)
    assert plain[20] / plain[40] == pytest.approx(4, rel=0.1)
    carried = abs(central_stress(*amplitudes(20, tail=6000)) - exact)
    assert carried < plain[20] / 100


# --- displacements ---------------------------------------------------------------------------------


def even_functions(k, half):
    z = k * Y
    scale, trace = sp.cosh(k * half), k * half * sp.coth(k * half)
    return (
        sp.cosh(z) / scale,
        (z * sp.sinh(z) - trace * sp.cosh(z)) / scale,
        sp.sinh(z) / scale,
        (z * sp.cosh(z) - trace * sp.sinh(z)) / scale,
    )


def odd_functions(k, half):
    z = k * Y
    scale, trace = sp.sinh(k * half), k * half * sp.tanh(k * half)
    return (
        sp.sinh(z) / scale,
        (z * sp.cosh(z) - trace * sp.sinh(z)) / scale,
        sp.cosh(z) / scale,
        (z * sp.sinh(z) - trace * sp.cosh(z)) / scale,
    )


@pytest.mark.parametrize(
    ("functions", "profile"), [(even_functions, even_profile), (odd_functions, odd_profile)]
)
def test_displacement_of_a_term(functions, profile):
    """For chi = cos(kx)/k^2 (p1 - p0) the displacement is, up to a rigid motion,

    u_x = sin(kx)/k [2 p0 + (1 + nu)(p1 - p0)], u_y = cos(kx)/k [2 s0 - (1 + nu) q1]:
    Hooke's law of plane stress, Young modulus 1, even and odd kind; 1 - nu in place of 1 + nu fails.
    """
    k, half = WAVENUMBER, HALF
    p0, p1, s0, q1 = functions(k, half)
    chi = sp.cos(k * X) / k**2 * (p1 - p0)
    assert vanishes(chi - sp.cos(k * X) * profile(k, half, Y))

    def residuals(factor):
        u_x = sp.sin(k * X) / k * (2 * p0 + factor * (p1 - p0))
        u_y = sp.cos(k * X) / k * (2 * s0 - factor * q1)
        return [a - b for a, b in zip(strain_of((u_x, u_y)), hooke(stresses(chi), 0), strict=True)]

    assert all(vanishes(residual) for residual in residuals(1 + NU))
    assert differs(residuals(1 - NU)[0])


def test_displacement_of_the_particular_solution():
    """Chi = alpha c/q^2, c = cos(q y): u = alpha (0, (1+nu) sin(q y)/q): eps_xx = 0 there."""
    q = sp.Symbol("q", positive=True)
    growth = sp.cos(q * Y)
    u = (sp.Integer(0), ALPHA * (1 + NU) * sp.sin(q * Y) / q)
    strain = hooke(stresses(ALPHA * growth / q**2), growth)
    assert [sp.expand(a - b) for a, b in zip(strain_of(u), strain, strict=True)] == [0, 0, 0]

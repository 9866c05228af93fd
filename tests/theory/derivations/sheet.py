"""Symbols and algebra of the two-dimensional linear theory, which the tests beside it prove again.

Every test derives the equation it names and shows that the printed form, where it differs, fails.
Conventions: rectangle |x| <= W/2, |y| <= L/2, Young modulus 1, wave numbers k_m = 2 pi m/W (printed
alpha_m), g_r = 2 pi r/L (gamma_r), d_s = s pi/L with s odd (delta_s). The print has W = L/2.
"""

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


# --- E13: the slow tails ---------------------------------------------------------------------------


def tail_factor(wanted, other, step, lam):
    """Minus the factor that a tail z^-lam of the other family gives in an amplitude equation.

    (8/W) sum_r k^2 g (k^2 + g^2)^-2 g^-lam -> (8/W)(1/dg) k^-lam int t^(1-lam)/(1+t^2)^2 dt.
    wanted: the side that divides (W or L); step: dg of the other family.
    """
    p = lam - 1
    return 8 / wanted / step * sp.pi / 4 * (1 + p) / sp.cos(sp.pi * p / 2) * other


def wedge_matrix(lam, symmetric):
    """sigma_theta,theta and sigma_r,theta on theta = pi/4 for chi = r^(lam+1) F(theta)."""
    theta = sp.Symbol("theta", real=True)
    wave = sp.cos if symmetric else sp.sin
    parts = [wave((lam + 1) * theta), wave((lam - 1) * theta)]
    rows = [parts, [sp.diff(part, theta) for part in parts]]
    return sp.Matrix(rows).subs(theta, sp.pi / 4)

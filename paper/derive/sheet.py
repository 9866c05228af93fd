"""The plane: law, edges, terms and couplings of the series, second order (E5 to E13, F1, F3)."""

import sympy as sp

from paper.derive.proof import ProofError, Step, prove, proved
from paper.derive.typst_math import typst
from tests.theory.derivations import sheet as on_sheet
from tests.theory.derivations.sheet import NU, L, W, X, Y


def plane_stress() -> Step:
    """E5: eq. 1a linearised, and what eq. 14 becomes with the printed factor."""
    small, c = sp.symbols("e c", real=True)
    xx, yy, xy = strain = sp.symbols("exx eyy exy", real=True)
    rest = sp.exp(2 * small * on_sheet.ALPHA * c)
    change = (sp.eye(2) + 2 * small * sp.Matrix([[xx, xy], [xy, yy]])) / rest - sp.eye(2)
    density = (1 - NU) * (change**2).trace() + NU * change.trace() ** 2
    energy = sp.expand(sp.diff(rest * density / (8 * (1 - NU**2)), small, 2).subs(small, 0)) / 2
    stress = [sp.diff(energy, xx), sp.diff(energy, yy), sp.diff(energy, xy) / 2]
    for law, component in zip(on_sheet.hooke(stress, c), strain, strict=True):
        prove("strain", law, component)
    chi, growth = sp.Function("chi")(X, Y), sp.Function("c")(X, Y)
    xx, yy, xy = on_sheet.hooke(on_sheet.stresses(chi), growth)
    incompatible = sp.diff(xx, Y, 2) + sp.diff(yy, X, 2) - 2 * sp.diff(xy, X, Y)
    laplacian = sp.diff(growth, X, 2) + sp.diff(growth, Y, 2)
    prove("eq. 14", incompatible, on_sheet.biharmonic(chi) + on_sheet.ALPHA * laplacian)
    return Step(
        "E5",
        "Eq. 1a with $a = I + 2 epsilon$, $overline(a) = e^(2 alpha c) I$ to second order, "
        "$sigma = partial W \\/ partial epsilon$ solved for $epsilon$; and compatibility of that "
        "$epsilon$:",
        (
            "epsilon_(i j) = (1 + nu) sigma_(i j) - nu delta_(i j) sigma_(k k) + alpha c delta_(i j)",
            "nabla^4 chi = -alpha nabla^2 c",
        ),
    )


def edges() -> Step:
    """E6, E7: shear and tractions."""
    chi = sp.Function("chi")(X, Y)
    xx, yy, xy = on_sheet.stresses(chi)
    prove("f_x", sp.diff(xx, X) + sp.diff(xy, Y), 0)
    prove("f_y", sp.diff(xy, X) + sp.diff(yy, Y), 0)
    doubled = sp.diff(xx, X) + 2 * sp.diff(xy, Y)
    prove("print", doubled, -sp.diff(chi, X, Y, 2))
    if on_sheet.stresses(X * Y) != (0, 0, -1):
        raise ProofError("chi = x y")
    return Step(
        "E6, E7",
        "$partial_i sigma_(i j) = 0$ holds identically for $sigma_(x y) = -partial_(x y) chi$; "
        "with the "
        "printed factor a force is left. $chi = x y$ meets the printed edge conditions and "
        "pulls at "
        "every edge:",
        (
            "partial_x sigma_(x x) + partial_y (2 sigma_(x y)) = -partial_(x y y) chi",
            "chi = x y: quad sigma_(x x) = sigma_(y y) = 0, quad sigma_(x y) = -1",
        ),
    )


def terms() -> Step:
    """E8, E9: the four families, and the printed D-term."""
    for term in on_sheet.FAMILIES.values():
        prove("biharmonic", on_sheet.biharmonic(term), 0)
        mixed = sp.diff(term, X, Y)
        for edge in ({X: W / 2}, {Y: L / 2}):  # even or odd: the opposite edges follow
            prove("shear", mixed.subs(edge), 0)
    d = sp.Symbol("delta", positive=True)
    constant = sp.Symbol("q", positive=True)
    bracket = d * X * sp.sinh(d * X) - constant * sp.cosh(d * Y)
    excess = on_sheet.biharmonic(sp.sin(d * Y) * bracket)
    stated = 4 * constant * d**4 * sp.sin(d * Y) * sp.cosh(d * Y)
    c0 = sp.Symbol("c_0", real=True)
    printed = 2 / L * sp.integrate(c0, (Y, -L / 2, L / 2))
    return Step(
        "E7, E8, E9",
        "All terms of the four families $A$, $B$, $C$, $D$ (with $cosh delta_s x$ in $D$) are "
        "biharmonic and free "
        "of shear on all four edges, for every $m$, $r$, odd $s$, $W$ and $L$. Of the printed "
        "$D$-bracket, "
        "$delta x sinh delta x - q cosh delta y$, is left the first line; the second is $a_0$ of a "
        "constant $c = c_0$ by the printed integral, twice the mean",
        (
            proved("nabla^4 chi", excess, stated),
            proved("a_0", printed, 2 * c0),
        ),
    )


def wave_coefficients() -> Step:
    """E10."""
    a, b = sp.symbols("a b", positive=True)
    half = sp.Rational(1, 2)
    integral = 4 * sp.integrate(sp.sin(a * Y) * sp.sin(b * Y), (Y, 0, half), conds="none")
    integral = sp.piecewise_fold(integral)
    if isinstance(integral, sp.Piecewise):
        integral = integral.args[-1].expr
    free = sp.expand(sp.expand_trig(integral)).subs(sp.sin(a / 2), 0).subs(sp.cos(b / 2), 0)
    stated = 4 * a * sp.cos(a / 2) * sp.sin(b / 2) / (b**2 - a**2)
    return Step(
        "E10",
        "The printed integral for $sin a y$, $a = 2 pi n$, $b = delta_s = s pi$ ($L = 1$; $sin "
        "a\\/2 = 0$, "
        "$cos b\\/2 = 0$, so that $cos a\\/2 sin b\\/2 = plus.minus 1$): never zero",
        (proved("b_s", free, stated),),
    )


def couplings() -> Step:
    """E11, E12 and the equations that hold as printed."""
    g, k = sp.symbols("gamma k", positive=True)
    into_a, turn = on_sheet.even_projection(g, W / 2, k)
    into_c, _ = on_sheet.even_projection(k, L / 2, g)
    into_d, _ = on_sheet.odd_projection(k, L / 2, g)
    ends = 8 * k**2 * g * sp.tanh(g * W / 2) / (W * (k**2 + g**2) ** 2)
    sides = 8 * k * g**2 / (L * (k**2 + g**2) ** 2)
    scaled = [
        (into_a / sp.cosh(g * W / 2), turn * ends),
        (into_c / sp.cosh(k * L / 2), turn * sides * sp.tanh(k * L / 2)),
        (into_d / sp.sinh(k * L / 2), sp.Symbol("quarter_turn") * sides * sp.coth(k * L / 2)),
    ]
    for derived, stated in scaled:
        prove("coupling", derived, stated)
    return Step(
        "E11, E12",
        "Normal stress of a $C$- or $D$-term on the ends, projected on $cos k x$ over the "
        "width, and of an "
        "$A$- or $B$-term on the sides, projected over the length (signs $(-1)^(m + r)$ taken "
        "out); the last "
        "two are as printed:",
        (
            f"C, D -> A, B: quad {typst(ends)}",
            f"A -> C: quad {typst(sides)} tanh frac(k L, 2)",
            'B -> D: quad "the same with" coth',
        ),
    )


def tails() -> Step:
    """E13: exponents of the tails and of the corner."""
    s, t = sp.symbols("s t", positive=True)
    lam, tail = sp.Symbol("lambda", positive=True), sp.Symbol("K", positive=True)
    integral = sp.integrate(t ** (-s) / (1 + t**2) ** 2, (t, 0, sp.oo), conds="none")
    stated = sp.pi * (1 + s) / (4 * sp.cos(sp.pi * s / 2))
    a, c = sp.symbols("a c", nonzero=True)
    step_k, step_g = 2 * sp.pi / W, 2 * sp.pi / L
    first = a + on_sheet.tail_factor(W, c, step_g, lam)
    second = c + on_sheet.tail_factor(L, a, step_k, lam)
    determinant = sp.Matrix([[1, first.coeff(c)], [second.coeff(a), 1]]).det()
    ratio = lam / sp.sin(sp.pi * lam / 2)
    prove("determinant", (determinant - (1 - ratio**2)).rewrite(sp.sin), 0)
    for balanced in (first, second):
        prove("K", balanced.subs(lam, 1).subs({a: tail * step_k, c: -tail * step_g}), 0)
    for symmetric, sign in ((True, 1), (False, -1)):
        wedge = on_sheet.wedge_matrix(lam, symmetric).det()
        corner = sp.sin(sp.pi * lam / 2) + sign * lam
        factor = sp.simplify((wedge / corner).subs(lam, sp.Rational(1, 3)))
        prove("corner", wedge, factor * corner)
    return Step(
        "E13",
        "$A_m = (-1)^m a k_m^(-lambda)$ and $C_r = (-1)^r c gamma_r^(-lambda)$ in the A- and "
        "C-equations, "
        "sums replaced by the integral of the first line; determinant; at $lambda = 1$ both "
        "equations hold "
        "for $a = 2 pi K\\/W$, $c = -2 pi K\\/L$. A free right-angled corner, $chi = r^(lambda "
        "+ 1) "
        "F(theta)$, has the same exponents:",
        (
            proved("integral_0^infinity frac(t^(-s), (1 + t^2)^2) dif t", integral, stated),
            "1 - (frac(lambda, sin pi lambda \\/2))^2 = 0 quad arrow.l.r.double quad "
            "sin frac(pi lambda, 2) = plus.minus lambda",
        ),
    )


def strip_limit() -> Step:
    """F1: W -> 0."""
    g, xi, half = sp.symbols("g xi h", positive=True)  # h = g W/2, x = xi W/2
    profile = on_sheet.even_profile(g, half / g, X)

    def narrow(expression: sp.Expr) -> sp.Expr:
        # written with sinh and cosh: some releases of sympy lose h coth(h) in this limit
        expression = expression.replace(sp.coth, lambda z: sp.cosh(z) / sp.sinh(z))
        return sp.series(expression.subs(X, xi * half / g), half, 0, 1).removeO()

    prove("own", narrow(1 + 2 * half / sp.sinh(2 * half)), 2)
    xx, yy, _ = on_sheet.stresses(sp.cos(g * Y) * profile)
    particular, _, _ = on_sheet.stresses(sp.cos(g * Y) / g**2)
    for stress, limit in ((xx, -2), (yy, 0)):
        prove("limit", sp.expand(narrow(sp.simplify(stress / particular))), limit)
    return Step(
        "F1",
        "$W -> 0$: the bracket of the C-equation tends to 2, so $C = alpha a_r\\/2$, and half "
        "a $C$-term takes "
        "away the stress of the particular solution:",
        ("sigma -> 0, quad epsilon_(x x) = epsilon_(y y) = alpha c, quad J = 1 + 2 alpha c",),
    )


def second_source() -> Step:
    """F3: the source of the displacement of second order, from the energy itself."""
    small, other = sp.symbols("alpha e", real=True)
    c, k, m = sp.symbols("c k m", real=True)
    one, two, test = (sp.Matrix(2, 2, sp.symbols(f"{n}:4", real=True)) for n in "uvw")
    gradient = small * one + small**2 * two + other * test
    growth = small * c + small**2 * k * c**2
    elastic = (gradient + gradient.T) / 2 + gradient.T * gradient / 2 - growth * sp.eye(2)
    weight = 1 + small * m * c

    def hooke(strain: sp.Matrix) -> sp.Matrix:
        return ((1 - NU) * strain + NU * strain.trace() * sp.eye(2)) / (1 - NU**2)

    def symmetric(matrix: sp.Matrix) -> sp.Matrix:
        return (matrix + matrix.T) / 2

    energy = weight * (elastic * hooke(elastic)).trace() / 2
    work = sp.expand(sp.diff(energy, other).subs(other, 0))
    stress = hooke(symmetric(one) - c * sp.eye(2))
    source = hooke(k * c**2 * sp.eye(2) - one.T * one / 2) - m * c * stress - one * stress
    first = (stress.T * test).trace()
    second = ((hooke(symmetric(two)) - source).T * test).trace()
    prove("order 1", work.coeff(small, 1), first)
    prove("order 2", work.coeff(small, 2), second)
    return Step(
        "F3",
        "The work of eq. 1a on $nabla v$ at order $alpha^2$, for $u = alpha u_1 + alpha^2 u_2$, "
        "$overline(a) = g I$, $(g - 1)\\/2 = alpha c + alpha^2 k c^2$, weight $1 + alpha m c$, "
        "$sigma_1 = C : (e(u_1) - c I)$, $C$ the law of E5 solved for the stress:",
        (
            "integral (C : e(u_2)) : nabla v = integral P : nabla v",
            "P = C : (k c^2 I - 1/2 nabla u_1^top nabla u_1) - m c sigma_1 - nabla u_1 sigma_1",
        ),
    )

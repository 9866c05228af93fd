"""The one-dimensional theory, and the friction balance (E1 to E4, F1 to F3)."""

from collections.abc import Callable

import sympy as sp

from paper.derive.proof import ProofError, Step, prove, proved
from paper.derive.typst_math import typst
from tests.line import test_derivations_line as on_line
from tests.line.test_derivations_line import ALPHA, COUNT, PERIOD, PHI, THETA


def velocity() -> Step:
    """E1."""
    s, x = on_line.S, sp.Symbol("x", real=True)
    phase = on_line.WAVE_PHASE
    displacement = sp.integrate(ALPHA * sp.sin(phase.subs(s, x)), (x, 0, s))
    rate = sp.diff(displacement, on_line.TIME)
    derived = rate - sp.integrate(rate, (s, 0, 1))
    stated = -ALPHA / (COUNT * PERIOD) * sp.sin(PHI)
    prove("v", derived, stated.subs(PHI, phase))
    return Step(
        "E1",
        "Eqs 5 and 6 integrated for $c = sin phi$, $phi = 2 pi (n S - t\\/T)$:",
        (f'v_"cm" = {typst(stated)}',),
    )


def balance() -> Step:
    """E2."""
    signs = on_line.signed
    return Step(
        "E2",
        "Over one period of $phi$, with $q = sin theta$ and both arcs integrated apart:",
        (
            proved('integral "sgn"(q - sin phi) dif phi', signs(sp.Integer(1)), 4 * THETA),
            proved(
                'integral sin phi med "sgn"(q - sin phi) dif phi',
                signs(sp.sin(PHI)),
                -4 * sp.cos(THETA),
            ),
            proved(
                '1/4 integral (1 + alpha sin phi) "sgn"(q - sin phi) dif phi',
                signs(1 + ALPHA * sp.sin(PHI)) / 4,
                THETA - ALPHA * sp.cos(THETA),
            ),
        ),
    )


def series() -> Step:
    """E3, with the branch point that ends it."""
    speed = sp.series(ALPHA * sp.sin(on_line.closed_form_angle(7)), ALPHA, 0, 8).removeO()
    stated = ALPHA**2 - sp.Rational(2, 3) * ALPHA**4 + sp.Rational(4, 5) * ALPHA**6
    z = sp.Symbol("z", positive=True)
    at_branch = (THETA - ALPHA * sp.cos(THETA)).subs({THETA: sp.I * z, ALPHA: sp.I * z / sp.cosh(z)})
    slope = sp.diff(THETA - ALPHA * sp.cos(THETA), THETA)
    slope = slope.subs({THETA: sp.I * z, ALPHA: sp.I * z / sp.cosh(z)})
    prove("0", at_branch, 0)
    return Step(
        "E3",
        "$n T V = alpha sin theta$ with $theta = alpha cos theta$. The series ends where "
        "$theta - alpha cos theta$ has a double root, first at $theta = upright(i) z$, "
        "$alpha = upright(i) z\\/cosh z$ with $z tanh z = 1$, the slope there being",
        (
            proved("n T V", speed, stated) + " - dots.c",
            proved("dif / (dif theta) (theta - alpha cos theta)", slope, 1 - z * sp.tanh(z)),
        ),
    )


def viscous() -> Step:
    """E4."""
    speed = sp.Symbol("V")
    unit = ALPHA / (COUNT * PERIOD)
    force = (1 + ALPHA * sp.sin(PHI)) * (speed - unit * sp.sin(PHI))
    (root,) = sp.solve(sp.integrate(force, (PHI, 0, 2 * sp.pi)), speed)
    return Step(
        "E4",
        "$integral (1 + alpha sin phi)(V - alpha\\/(n T) sin phi) dif phi = 0$ gives",
        (proved("V", root, ALPHA**2 / (2 * COUNT * PERIOD)),),
    )


STRETCHES: dict[str, Callable[[sp.Expr], sp.Expr]] = {
    "exp": sp.exp,
    "linear": on_line.linear,
    "metric": on_line.metric,
}
"""Stretch as a function of alpha c by growth law."""


def laws() -> Step:
    """F1 to F3: the coefficient of alpha^2 for all growth laws and loads of a bar and a strip."""
    s1, s2, n1, n2 = sp.symbols("s_1 s_2 n_1 n_2")
    general = on_line.speed_series(
        lambda g: 1 + s1 * g + s2 * g**2, lambda g: 1 + n1 * g + n2 * g**2, order=2
    )
    formulas = [proved("lim n T V\\/alpha^2", general[2], s1 * n1 - s2 / 2)]
    for power, name in ((0, "weight conserved"), (1, "current load, bar"), (2, "current load, strip")):
        values = [_coefficient(stretch, power) for stretch in STRETCHES.values()]
        formulas.append(f'"{name}:" quad ' + ", quad ".join(typst(v) for v in values))
    return Step(
        "F1, F2, F3",
        "Weighted median less mean for stretch $1 + s_1 xi + s_2 xi^2$ and load $1 + n_1 xi + "
        "n_2 xi^2$, $xi = alpha sin phi$; then for the stretches $s = e^xi$, $1 + xi$ and "
        "$sqrt(1 + 2 xi)$ with loads $s^0$, $s^1$ (a bar) and $s^2$ (a narrow strip, which "
        "widens as it lengthens):",
        tuple(formulas),
    )


def _coefficient(stretch: Callable[[sp.Expr], sp.Expr], power: int) -> sp.Expr:
    """lim nTV/alpha^2 of weight stretch^power."""
    zeroth, first, second = on_line.speed_series(stretch, lambda g: stretch(g) ** power, order=2)
    if (zeroth, first) != (0, 0):
        raise ProofError(f"a speed of lower order, {zeroth} + {first} alpha")
    return second


def first_order() -> Step:
    """F2b: the shift of a median by a small weight, checked on c = sin(phi) - b cos(2 phi)."""
    b = sp.Rational(1, 5)  # c rises with sin(phi) for b < 1/4; its median is -b, its mean 0
    found = on_line.speed_series(
        on_line.linear, on_line.linear, lambda sine: sine - b * (1 - 2 * sine**2), order=2
    )
    spread = sp.integrate(sp.sin(PHI) * (1 + 2 * b * sp.sin(PHI)), (PHI, 0, sp.pi)) - sp.integrate(
        sp.sin(PHI) * (1 + 2 * b * sp.sin(PHI)), (PHI, sp.pi, 2 * sp.pi)
    )
    density = 2 / (2 * sp.pi)  # of c at its median: two points, |dc/dphi| = 1
    prove("first", found[1], -b)
    prove("second", found[2], spread / (2 * sp.pi) / (2 * density))
    return Step(
        "F2b",
        '$-V$ is the weighted median of $v_"cm" = -(c - overline(c)) alpha\\/(n T)$. The weight '
        "$1 + alpha c$ shifts the plain median $m_0$ of $c - overline(c)$, where its density "
        "is $p$, by "
        "$delta$ with $2 p delta = alpha E$, $E$ the mean of $abs(c - overline(c) - m_0)$. For "
        "$c = sin phi - 1/5 cos 2 phi$ this gives",
        (
            "n T V = alpha m_0 + alpha^2 frac(E, 2 p) + dots.c = "
            f"{typst(found[1] * ALPHA + found[2] * ALPHA**2)} + dots.c",
        ),
    )


def convexity() -> Step:
    """The balance as a minimum, and its first two orders."""
    p, q = sp.symbols("w_x w_y", real=True, nonzero=True)
    size, w = sp.sqrt(p**2 + q**2), sp.Matrix([p, q])
    hessian = sp.hessian(size, (p, q))
    prove("det", hessian.det(), 0)
    projector = sp.eye(2) / size - w * w.T / size**3
    for entry in hessian - projector:
        prove("entry", entry, 0)
    return Step(
        "Balance",
        "$abs(w)$ is convex: its gradient is $w\\/abs(w)$ (the stationarity is eq. 11) and its "
        "Hessian "
        "$D(w) = (I - w w^top\\/abs(w)^2)\\/abs(w)$ has",
        (
            f"det D = {typst(0)}",
            proved('"tr" D', sp.simplify(hessian.trace()), 1 / size),
        ),
    )

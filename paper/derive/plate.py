"""The plate on its ground, friction with a direction, and power."""

import sympy as sp

from paper.derive.proof import Step, prove, proved
from tests.line.test_derivations_line import ALPHA, THETA
from tests.plate import test_derivations_plate as on_plate
from tests.plate.test_derivations_plate import BACKWARD, BETA, FORWARD, C, H, R, V, W, X, Y


def ground_and_plate() -> Step:
    """The deflection on a ground that is linearised about its depth, with free edges."""
    rate = 2 * sp.sqrt(on_plate.STIFFNESS * on_plate.WEIGHT)
    prove("p", on_plate.pressure(W), on_plate.WEIGHT - BETA * rate * W)
    at_x, at_y = on_plate.boundary_flux(W, V, C)
    inside = on_plate.field_equation(W, C) * V + sp.diff(at_x, X) + sp.diff(at_y, Y)
    _prove_expanded("plate", on_plate.virtual_work(W, V, C) - inside)
    _prove_expanded("edge", on_plate.edge_remainder(W, V, C))
    return Step(
        "Plate",
        "Eq. 2 at the depth $sqrt(q\\/k)$ that carries the weight $q = rho g$, lifted by the "
        "deflection $beta zeta$: pressure $q (1 + beta p)$. The virtual work of eq. 1b, with $D = "
        "h^3\\/(12 (1 - nu^2))$ and $K = nabla nabla zeta + c I$, and of the ground, integrated by "
        "parts: inside, at an edge $x = plus.minus W\\/2$ (moment, Kirchhoff's shear), at a corner",
        (
            "p = -frac(s zeta, q), quad s = 2 sqrt(k q)",
            "D nabla^4 zeta + s zeta = -D (1 + nu) nabla^2 c",
            "zeta_(x x) + nu zeta_(y y) + (1 + nu) c = 0",
            "zeta_(x x x) + (2 - nu) zeta_(x y y) + (1 + nu) c_x = 0, quad zeta_(x y) = 0",
        ),
    )


def mixed_order() -> Step:
    """Sources of the second order of the balance: pressure for V_ab, stretching by slopes for V_bb."""
    force, _ = on_plate.friction_at(on_plate.slip_at_couplings())
    derived = on_plate.second(on_plate.load_at_couplings() * force)
    for one, other in zip(derived, on_plate.force_of_second_order(), strict=True):
        prove("force", one, other)
    return Step(
        "Pressure and slip",
        "The energy is even in $(beta, zeta)$: no point slips with $beta$ or $alpha beta$. Slip and "
        "load are $alpha v_1 + alpha^2 v_2 + beta^2 v_b$ and $1 + alpha e + beta p$. With $w_1 = v_1 "
        "+ V_1$, $u = w_1\\/abs(w_1)$ and $D = D(w_1)$ as above, the balance $integral N w\\/abs(w) "
        "dif A = 0$ at the orders $alpha^2$, $alpha beta$, $beta^2$:",
        (
            "integral [D (v_2 + V_(alpha alpha)) + e u] dif A = 0",
            "integral [D V_(alpha beta) + p u] dif A = 0, quad "
            "integral D (v_b + V_(beta beta)) dif A = 0",
        ),
    )


def lower_face() -> Step:
    """Slip of the points h/2 below the mid-surface."""
    w, offset = on_plate.lower_face()
    time = on_plate.TIME
    for place, moved in zip((X, Y), offset, strict=True):
        prove("slip", sp.diff(moved, time), BETA * H / 2 * sp.diff(w, place, time))
    return Step(
        "Lower face",
        "$x - (h\\/2) n$, $n prop (-beta nabla zeta, 1)$ from the tangents of "
        "$(x, y, beta zeta)$: along the ground its points are displaced, and slip in addition, by",
        ("+frac(h, 2) beta nabla zeta + O(beta^3), quad +frac(h, 2) beta nabla zeta_t + O(beta^3)",),
    )


def quantile() -> Step:
    """Dry friction with a direction on a line."""
    stated = BACKWARD / (FORWARD + BACKWARD)
    return Step(
        "Quantile",
        "On a line forward slip meets $mu_f$, backward slip $mu_b$; a share $F$ of the weight slips "
        'forward in balance, so that $-V$ is the weighted quantile at $1 - F$ of $v_"cm"$, that at $F$ '
        'of $-v_"cm"$:',
        (f"mu_f F = mu_b (1 - F) quad => quad {proved('F', on_plate.share_forward(), stated)}",),
    )


def directional_sine() -> Step:
    """A sine under friction with a direction, with its series."""
    stated = THETA - ALPHA * sp.cos(THETA) - sp.pi / 2 * R
    prove("balance", on_plate.directional_sine(), stated)
    r = sp.Symbol("r", real=True)
    series = ALPHA * sp.sin(sp.pi * r / 2) + ALPHA**2 * sp.cos(sp.pi * r / 2) ** 2
    prove("series", on_plate.directional_series(r), series)
    return Step(
        "Sine wave, directional",
        "The arcs of E2 with $mu_f$ where $sin phi < sin theta$ and $mu_b$ elsewhere, over "
        "$2 (mu_f + mu_b)$; $r = (mu_b - mu_f)\\/(mu_b + mu_f)$:",
        (
            "theta - alpha cos theta = frac(pi, 2) r",
            "n T V = alpha sin theta = alpha sin frac(pi r, 2) + alpha^2 cos^2 frac(pi r, 2) + dots.c",
        ),
    )


def power() -> Step:
    """What growth does, and friction takes, to second order."""
    force, size = on_plate.friction_at(on_plate.slip_at_couplings())
    load, slip = on_plate.load_at_couplings(), on_plate.slip_at_couplings()
    for name, one in (("size", load * size), ("work", load * force.dot(slip))):
        prove(name, on_plate.second(one), on_plate.power_of_second_order())
    return Step(
        "Power",
        "With the energy $U(x, r)$ of shape $x$ and rest state $r$, and friction $F = partial "
        "U\\/partial x$ in equilibrium, growth does the work of the first line, exactly. Friction "
        "takes $P = integral N abs(w) dif A$, by the balance $integral N u dot v dif A$: rigid motions "
        "do no work. So the speeds of second order are not needed for $P\\/alpha$ to second order:",
        (
            "partial_r U med r_t = dif U\\/dif t - F dot x_t",
            "frac(P, alpha) = integral [abs(w_1) + alpha (e abs(w_1) + u dot v_2)",
            "quad quad quad + beta p abs(w_1) + frac(beta^2, alpha) u dot v_b] dif A + dots.c",
        ),
    )


def _prove_expanded(name: str, difference: sp.Expr) -> None:
    """Derivatives of functions of x and y: evaluated and expanded, which is quick."""
    prove(name, sp.expand(difference.doit()), 0)

"""Proofs of the plate on its ground, of friction with a direction and of power, for the appendix.

Conventions: deflection beta w upwards, rest curvature -beta c, load of a unit of the undeformed area
1 + alpha e + beta p. Each test proves a statement and shows that the tempting wrong form fails.
"""

import pytest
import sympy as sp

from tests.line import test_derivations_line as on_line
from tests.line.test_derivations_line import ALPHA, PHI, THETA
from tests.theory.derivations.sheet import NU, X, Y

BETA, SMALL, TIME = sp.symbols("beta epsilon t", real=True)
RIGIDITY, SPRING, WEIGHT, STIFFNESS = sp.symbols("D s q k", positive=True)
H = sp.Symbol("h", positive=True)
FORWARD, BACKWARD = sp.symbols("mu_f mu_b", positive=True)
R = (BACKWARD - FORWARD) / (BACKWARD + FORWARD)

W, V, C = (sp.Function(name)(X, Y) for name in "wvc")


# --- the plate on its linearised ground ----------------------------------------------------------


def pressure(deflection):
    """k z^2 of eq. 2 at z = -sqrt(q/k) + beta w, to first order in beta."""
    depth = sp.sqrt(WEIGHT / STIFFNESS)
    return sp.series(STIFFNESS * (BETA * deflection - depth) ** 2, BETA, 0, 2).removeO()


def moments(w, c):
    """(xx, yy, xy) of D [(1 - nu) K + nu tr(K) I], K = grad grad w + c I."""
    xx, yy, xy = sp.diff(w, X, 2) + c, sp.diff(w, Y, 2) + c, sp.diff(w, X, Y)
    trace = NU * (xx + yy)
    return tuple(RIGIDITY * m for m in ((1 - NU) * xx + trace, (1 - NU) * yy + trace, (1 - NU) * xy))


def virtual_work(w, v, c):
    """Derivative of the energy D/2 [(1 - nu) K : K + nu (tr K)^2] + s w^2/2 along v."""
    bent = w + SMALL * v
    xx, yy, xy = sp.diff(bent, X, 2) + c, sp.diff(bent, Y, 2) + c, sp.diff(bent, X, Y)
    density = (1 - NU) * (xx**2 + yy**2 + 2 * xy**2) + NU * (xx + yy) ** 2
    return sp.diff((RIGIDITY * density + SPRING * bent**2) / 2, SMALL).subs(SMALL, 0)


def field_equation(w, c):
    """D lap lap w + s w + D (1 + nu) lap c."""
    lap = sp.diff(w, X, 2) + sp.diff(w, Y, 2)
    double = sp.diff(lap, X, 2) + sp.diff(lap, Y, 2)
    laplacian = sp.diff(c, X, 2) + sp.diff(c, Y, 2)
    return RIGIDITY * double + SPRING * w + RIGIDITY * (1 + NU) * laplacian


def moment_at_x(w, c):
    """Bending moment at an edge x = const."""
    return RIGIDITY * (sp.diff(w, X, 2) + NU * sp.diff(w, Y, 2) + (1 + NU) * c)


def shear_at_x(w, c):
    """Kirchhoff's shear at an edge x = const."""
    return RIGIDITY * (sp.diff(w, X, 3) + (2 - NU) * sp.diff(w, X, Y, 2) + (1 + NU) * sp.diff(c, X))


def boundary_flux(w, v, c):
    """(x, y) of what is left of the virtual work at the edges before Kirchhoff's step."""
    xx, yy, xy = moments(w, c)
    at_x = xx * sp.diff(v, X) + xy * sp.diff(v, Y) - (sp.diff(xx, X) + sp.diff(xy, Y)) * v
    at_y = xy * sp.diff(v, X) + yy * sp.diff(v, Y) - (sp.diff(xy, X) + sp.diff(yy, Y)) * v
    return at_x, at_y


def edge_remainder(w, v, c):
    """Flux at x = const, less moment, shear and the corner's force: a derivative along the edge."""
    corner = sp.diff(moments(w, c)[2] * v, Y)
    return boundary_flux(w, v, c)[0] - (
        moment_at_x(w, c) * sp.diff(v, X) - shear_at_x(w, c) * v + corner
    )


def test_pressure_of_a_ground_linearised_about_its_depth():
    slope = 2 * sp.sqrt(STIFFNESS * WEIGHT)
    assert sp.simplify(pressure(W) - WEIGHT * (1 - BETA * slope / WEIGHT * W)) == 0


def test_plate_equation_and_free_edges():
    at_x, at_y = boundary_flux(W, V, C)
    inside = field_equation(W, C) * V + sp.diff(at_x, X) + sp.diff(at_y, Y)
    assert sp.expand((virtual_work(W, V, C) - inside).doit()) == 0
    assert sp.expand(edge_remainder(W, V, C).doit()) == 0
    # without c the edge would carry a moment
    left = moments(W, C)[0] - moment_at_x(W, 0)
    assert sp.expand((left - RIGIDITY * (1 + NU) * C).doit()) == 0


# --- second order of the balance, and the power -----------------------------------------------------


def slips():
    """w_1 and further slips of a point, rows of two: alpha^2, alpha beta and beta^2."""
    return [sp.Matrix(sp.symbols(f"{n}_x {n}_y", real=True)) for n in ("w", "a", "m", "b")]


def friction_at(point):
    """Dry friction w/|w| and the norm |w| of a slip."""
    size = sp.sqrt(point.dot(point))
    return point / size, size


def slip_at_couplings():
    """w_1 + alpha a + beta m + beta^2/alpha b: the slip over alpha, with (alpha, beta) of order
    epsilon."""
    first, grown, both, bent = slips()
    return first + SMALL * (ALPHA * grown + BETA * both + BETA**2 / ALPHA * bent)


def load_at_couplings():
    """1 + alpha e + beta p."""
    e, p = sp.symbols("e p", real=True)
    return 1 + SMALL * (ALPHA * e + BETA * p)


def second(expression):
    """Of order epsilon beyond the leading one."""
    return sp.diff(expression, SMALL).subs(SMALL, 0)


def tangent(point):
    """D(w) = (I - w w^T/|w|^2)/|w|."""
    size = sp.sqrt(point.dot(point))
    return (sp.eye(2) - point * point.T / size**2) / size


def force_of_second_order():
    """D(w_1) (alpha a + beta m + beta^2/alpha b) + (alpha e + beta p) w_1/|w_1|."""
    first, grown, both, bent = slips()
    e, p = sp.symbols("e p", real=True)
    unit, _ = friction_at(first)
    change = ALPHA * grown + BETA * both + BETA**2 / ALPHA * bent
    return tangent(first) * change + (ALPHA * e + BETA * p) * unit


def power_of_second_order():
    """(alpha e + beta p) |w_1| + w_1/|w_1| . (alpha a + beta m + beta^2/alpha b)."""
    first, grown, both, bent = slips()
    e, p = sp.symbols("e p", real=True)
    unit, size = friction_at(first)
    change = ALPHA * grown + BETA * both + BETA**2 / ALPHA * bent
    return (ALPHA * e + BETA * p) * size + unit.dot(change)


def test_balance_of_second_order_is_linear_in_its_sources():
    force, _ = friction_at(slip_at_couplings())
    derived = second(load_at_couplings() * force)
    assert (derived - force_of_second_order()).applyfunc(sp.simplify) == sp.zeros(2, 1)
    # of alpha beta: pressure, and the rigid motion m that balances it
    first, _, both, _ = slips()
    mixed = tangent(first) * both + sp.Symbol("p", real=True) * friction_at(first)[0]
    assert (derived.diff(BETA).subs(BETA, 0) - mixed).applyfunc(sp.simplify) == sp.zeros(2, 1)


def test_power_of_second_order_needs_no_speed_of_second_order():
    force, size = friction_at(slip_at_couplings())
    load = load_at_couplings()
    for power in (load * size, load * force.dot(slip_at_couplings())):
        assert sp.simplify(second(power) - power_of_second_order()) == 0
    # a rigid part of m, the same everywhere, has the factor of the balance of first order
    first, _, both, _ = slips()
    unit, _ = friction_at(first)
    assert (sp.Matrix([sp.diff(power_of_second_order(), z) for z in both]) - BETA * unit) == sp.zeros(
        2, 1
    )


def test_work_of_growth_is_what_is_stored_and_what_friction_takes():
    """dU/dt of U(x, r) with -dU/dx + F = 0: dU/dr dr/dt = dU/dt - F dx/dt, exactly."""
    place, rest = sp.Function("x")(TIME), sp.Function("r")(TIME)
    x, r = sp.symbols("x r")
    stored = sp.Function("U")
    growth = sp.diff(stored(x, r), r).subs({x: place, r: rest}) * sp.diff(rest, TIME)
    force = sp.diff(stored(x, r), x).subs({x: place, r: rest})  # of friction: equilibrium
    rate = sp.diff(stored(place, rest), TIME)
    assert sp.simplify((rate - force * sp.diff(place, TIME) - growth).doit()) == 0


# --- the lower face ---------------------------------------------------------------------------------


def lower_face():
    """Displacement along the ground of the point h/2 below the mid-surface, to second order in beta."""
    w = sp.Function("w")(X, Y, TIME)
    surface = sp.Matrix([X, Y, BETA * w])
    normal = surface.diff(X).cross(surface.diff(Y))
    normal = normal / sp.sqrt(normal.dot(normal))
    offset = -H / 2 * normal
    return w, [sp.series(offset[i], BETA, 0, 3).removeO() for i in range(2)]


def test_lower_face_slips_with_the_gradient_of_the_rate():
    w, offset = lower_face()
    for place, moved in zip((X, Y), offset, strict=True):
        slip = sp.diff(moved, TIME)
        assert sp.simplify(slip - BETA * H / 2 * sp.diff(w, place, TIME)) == 0
        assert sp.simplify(slip + BETA * H / 2 * sp.diff(w, place, TIME)) != 0


# --- friction with a direction ----------------------------------------------------------------------


def share_forward():
    """Share of the weight that slips forward in balance: mu_f share = mu_b (1 - share)."""
    share = sp.Symbol("F")
    (found,) = sp.solve(FORWARD * share - BACKWARD * (1 - share), share)
    return found


def directional_sine():
    """Balance of (1 + alpha sin phi) under slip sin theta - sin phi, over 2 (mu_f + mu_b)."""
    load = 1 + ALPHA * sp.sin(PHI)
    force = FORWARD * on_line.below(load) - BACKWARD * on_line.above(load)
    return force / (2 * (FORWARD + BACKWARD))


def directional_series(r):
    """nTV = alpha sin(theta) to second order in alpha, theta - alpha cos(theta) = pi r/2."""
    start = sp.pi * r / 2
    angle = start + ALPHA * sp.cos(start)
    balance = sp.series(angle - ALPHA * sp.cos(angle) - start, ALPHA, 0, 2).removeO()
    assert sp.simplify(balance) == 0
    return sp.series(ALPHA * sp.sin(angle), ALPHA, 0, 3).removeO()


def test_dry_friction_with_a_direction_balances_at_a_quantile():
    assert sp.simplify(share_forward() - BACKWARD / (FORWARD + BACKWARD)) == 0
    # it is where the convex dissipation, mu_f or mu_b times the speed, is least
    v, level = sp.symbols("v V", real=True)
    gauge = FORWARD * sp.Max(v + level, 0) + BACKWARD * sp.Max(-v - level, 0)
    slopes = [sp.diff(gauge, level).subs(v, s).subs(level, 0).doit() for s in (1, -1)]
    assert slopes == [FORWARD, -BACKWARD]


def test_sine_wave_under_friction_with_a_direction():
    stated = THETA - ALPHA * sp.cos(THETA) - sp.pi / 2 * R
    assert sp.simplify(directional_sine() - stated) == 0
    assert sp.simplify(directional_sine() - (stated + sp.pi * R)) != 0


@pytest.mark.parametrize("r", [sp.Rational(1, 2), sp.Rational(-1, 3)])
def test_series_under_friction_with_a_direction(r):
    first, again = sp.sin(sp.pi * r / 2), sp.cos(sp.pi * r / 2) ** 2
    assert sp.simplify(directional_series(r) - (ALPHA * first + ALPHA**2 * again)) == 0
    for strength in (1e-3, 2e-3):
        root = sp.nsolve(THETA - strength * sp.cos(THETA) - sp.pi * r / 2, THETA, float(sp.pi * r / 2))
        series = strength * float(first) + strength**2 * float(again)
        assert abs(strength * float(sp.sin(root)) - series) < 2 * strength**3

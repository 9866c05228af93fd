"""Second order in alpha: the displacement, V_2 against the nonlinear sheet, limits, honest errors."""

from dataclasses import replace

import numpy as np
import pytest
import skfem
import sympy
from skfem.helpers import ddot, grad

from fem_check.plane_stress.solver import PlaneStressSolver
from fem_check.shell.cycle.frame import BodyFrame
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.material import Material
from figures.measure import second_order as table
from linear_theory import Sheet, SineWave, TravellingWave, crawl_speed, second_order
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.deformation.second.field import SecondOrderField, second_order_field
from linear_theory.friction.contact import Contact
from linear_theory.growth.growth import Growth, Reference
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.scene.scene import Scene
from linear_theory.speed.second_order import coefficients, leading_period
from tests.plane_stress import reference_forms

PAPER, SINE = Sheet(), SineWave()
PULSE = table.WAVES["pulse"]


@pytest.mark.parametrize("law", GROWTH_LAWS)
def test_series_of_growth_and_weight(law):
    c, alpha = sympy.symbols("c alpha")
    strain = alpha * c
    factor = {"exp": sympy.exp(2 * strain), "linear": (1 + strain) ** 2, "metric": 1 + 2 * strain}[law]
    assert float(factor.subs({alpha: 0.1, c: 0.7})) == pytest.approx(
        float(Growth(0.1, law).metric(0.7))
    )
    growth = sympy.series((factor - 1) / 2, alpha, 0, 3).removeO()
    assert growth.coeff(alpha, 1) == c
    assert growth.coeff(alpha, 2) == sympy.nsimplify(GROWTH_LAWS[law].square) * c**2
    for area, power in (("grown", -1), ("undeformed", -2)):
        weight = sympy.series(factor**power, alpha, 0, 2).removeO()
        assert (
            weight.coeff(alpha, 1) == sympy.nsimplify(Growth(0.1, energy_area=area).energy_weight) * c
        )


@pytest.mark.parametrize("area", Reference)
@pytest.mark.parametrize("law", GROWTH_LAWS)
def test_displacement_is_the_second_difference_of_nonlinear_shapes(law, area):
    """[u(alpha) + u(-alpha)]/(2 alpha^2) of static shapes, both seen in the frame of the body."""
    wave, sheet = PULSE, Sheet(width=0.6, poisson=0.3)
    alpha, times = 0.01, np.array([0.13, 0.6])
    places = []
    for sign in (1, -1):
        scene = Scene(
            sheet,
            wave,
            sign * alpha,
            effects=(Membrane(Material(sheet.thickness, sheet.poisson)),),
            growth_law=law,
            area=area,
            cells=(8, 12),
            element=skfem.ElementQuadBFS(),
        )
        shapes = cycle_of_shapes(scene, 16)
        region = shapes.discretisation.interior
        reference = region.reference[0, :2]
        place = np.stack([reference + region.displacement(u, (0,))[0, :2] for u in shapes.at(times)], 1)
        places.append(BodyFrame.of(shapes).seen(times, place, np.zeros_like(place))[0])
    second = (places[0] + places[1] - 2 * reference[:, None]) / (2 * alpha**2)
    field = second_order_field(sheet, wave, Growth(1.0, law, energy_area=area), rtol=1e-5)
    found = np.stack([field.second_displacement(*reference, t) for t in times], 1)
    print(np.linalg.norm(second - found) / np.linalg.norm(found))
    assert np.linalg.norm(second - found) < 3e-3 * np.linalg.norm(found)


@skfem.LinearForm
def source_work(v, w):
    """Work of the stress w.source in the gradient of v."""
    return ddot(w.source, grad(v))


@pytest.mark.parametrize("area", Reference)
def test_finite_elements_have_the_same_second_displacement(area):
    """u_1 and u_2 of linear elements alone, the source written out in tensors of their gradients."""
    sheet, wave, t, k = Sheet(width=0.7, poisson=0.2), PULSE, 0.21, 1.0
    lines = [np.linspace(-s / 2, s / 2, n) for s, n in ((sheet.width, 15), (sheet.length, 21))]
    mesh = skfem.MeshTri.init_tensor(*lines)
    solver = PlaneStressSolver(mesh, 4, sheet.poisson)
    growth = wave.value(solver.x, solver.y, t)
    first = solver.solve(growth[None])[0]
    basis = reference_forms.basis(mesh, 4)
    slope = np.asarray(basis.interpolate(first).grad)  # du_k/dx_j
    one = np.eye(2)[:, :, None, None]

    def hooke(strain):
        nu = sheet.poisson
        return strain / (1 + nu) + nu / (1 - nu**2) * one * np.trace(strain)

    stress = hooke((slope + slope.swapaxes(0, 1)) / 2 - growth * one)
    quadratic = np.einsum("ki...,kj...->ij...", slope, slope) / 2
    weight = {"grown": -2.0, "undeformed": -4.0}[area]
    source = hooke(k * growth**2 * one - quadratic) - weight * growth * stress
    source -= np.einsum("ki...,ij...->kj...", slope, stress)
    free, factor = solver._factor
    second = np.zeros(basis.N)
    second[free] = factor.solve(source_work.assemble(basis, source=source)[free])
    modes, means = solver._rigid_motions
    second -= np.linalg.solve(means @ modes.T, means @ second) @ modes
    ritz = second_order_field(sheet, wave, Growth(1.0, energy_area=area), rtol=1e-7)
    expected = ritz.second_displacement(solver.x, solver.y, t)
    found = np.asarray(basis.interpolate(second))
    error = np.sqrt(((found - expected) ** 2 * solver.weights).sum())
    # 3.6e-5 and 2.0e-5 with this mesh, 3.2e-6 and 1.7e-6 with one of 24 x 34 squares
    assert error < 5e-5 * np.sqrt((expected**2 * solver.weights).sum())


def test_second_displacement_has_no_rigid_part_and_a_rate():
    field = second_order_field(PAPER, PULSE)
    (x, wx), (y, wy) = (np.polynomial.legendre.leggauss(n) for n in (30, 40))
    u = field.second_displacement(x[:, None] * 0.25, y * 0.5, 0.3)
    assert abs(np.einsum("cij,i,j->c", u, wx, wy)).max() < 1e-12  # roundoff
    step = 1e-4
    ahead, behind = (field.second_displacement(0.1, 0.2, 0.3 + s) for s in (step, -step))
    # a central difference: step^2/6 of the third derivative, (8 pi)^3 at most
    np.testing.assert_allclose(
        field.second_velocity(0.1, 0.2, 0.3), (ahead - behind) / (2 * step), rtol=1e-4, atol=1e-5
    )


@pytest.mark.parametrize(
    ("law", "shift"), [("exp", -1 / 4), ("linear", 0.0), ("metric", 1 / 4)], ids=["exp", "lin", "met"]
)
@pytest.mark.parametrize(("load", "limit"), [("current", 2.0), ("grown", 2.0), ("material", 0.0)])
def test_narrow_strip(law, shift, load, limit):
    """Its weight grows like the square of the stretch: 2, and -1/4, 0, 1/4 by the law of growth."""
    found = second_order(Sheet(width=0.002), SINE, law, load=load)
    # (2 pi W/L)^2 = 2e-4 are the corrections of width
    assert found.second == pytest.approx(limit + shift, abs=3e-4 + found.second_error)
    assert found.second_error <= 1e-3 * max(abs(found.second), 0.01)
    assert found.first == found.first_error == 0


def test_known_limit_of_the_papers_sheet():
    # 1.5330, the nonlinear sheet with 12 x 24 elements at rtol 1e-5; 1.9146 is eq. 11
    found = second_order(PAPER, SINE, rtol=1e-4)
    assert found.second == pytest.approx(1.5330, abs=1e-4)
    undeformed = second_order(PAPER, SINE, area="undeformed", rtol=1e-4)
    assert 1 - undeformed.second / found.second == pytest.approx(0.02, abs=0.002)


FAST = [
    ("exp", "grown", "current"),
    ("linear", "grown", "grown"),
    ("metric", "undeformed", "material"),
    ("exp", "undeformed", "material"),
    ("metric", "grown", "current"),
]
SHEETS = [table.SINES[0], table.SINES[1], table.SINES[2]]


@pytest.mark.parametrize("model", FAST)
@pytest.mark.parametrize("sheet", SHEETS)
def test_nonlinear_sheet_has_the_same_coefficient(sheet, model):
    case = table.Case(*sheet, *model)
    row = table.row(case, rtol=5e-4)
    # 0.2 % is what is promised; where V_2 is next to 0, of the scale 1
    assert row.second == pytest.approx(row.nonlinear_second, rel=2e-3, abs=2e-4)
    assert abs(row.second - row.nonlinear_second) <= row.second_error + row.nonlinear_second_error


def test_a_pulse_has_both_coefficients():
    case = table.Case(0.5, 0.5, "pulse", (4, 8), "exp", "grown", "current")
    row = table.row(case, rtol=1e-3)
    # errors of V, 2e-4 of V_1 alpha, are divided by alpha^2 = 0.0036
    assert row.first == pytest.approx(row.nonlinear_first, rel=1e-3)
    assert row.second == pytest.approx(row.nonlinear_second, rel=5e-3)


HONEST = [
    (PAPER, SINE, {}),
    (PAPER, SINE, {"growth_law": "metric", "load": "material"}),
    (Sheet(width=0.1, poisson=0.0), SINE, {"load": "grown"}),
    (Sheet(width=0.25, poisson=-0.5), SineWave(2), {"area": "undeformed"}),
    (PAPER, SINE, {"friction": "tanh", "slip_speed": 0.1}),
    (PAPER, SINE, {"friction": "viscous"}),
    (PAPER, PULSE, {}),
]


@pytest.mark.parametrize(("sheet", "wave", "options"), HONEST)
def test_error_estimate_is_honest(sheet, wave, options):
    levels = (2e-2, 3e-3)
    exact = second_order(sheet, wave, rtol=levels[-1] / 5, **options)
    for rtol in levels:
        found = second_order(sheet, wave, rtol=rtol, **options)
        assert abs(found.second - exact.second) <= found.second_error + exact.second_error
        assert abs(found.first - exact.first) <= found.first_error + exact.first_error
        assert found.second_error <= rtol * max(abs(found.second), 0.01)


def test_error_of_coarse_polynomials_is_honest():
    exact = leading_period(second_order_field(PAPER, SINE, rtol=1e-6), Contact(), 1e-3)
    for degree in ((5, 9), (7, 11), (9, 15)):
        field = SecondOrderField(RitzField(SINE.on(PAPER), RitzSolver(PAPER, degree)))
        found = leading_period(field, Contact(), 1e-3)
        assert abs(found.mean - exact.mean) <= found.error + exact.error


@pytest.mark.parametrize("wave", [SINE, PULSE])
def test_mirrored_wave_crawls_the_other_way(wave):
    back = TravellingWave(wave.cosine, wave.sine, -wave.count)
    forward, backward = (second_order(PAPER, w, rtol=3e-3) for w in (wave, back))
    tolerance = forward.second_error + backward.second_error
    assert backward.second == pytest.approx(-forward.second, abs=tolerance)
    tolerance = forward.first_error + backward.first_error
    assert backward.first == pytest.approx(-forward.first, abs=tolerance + 1e-15)


def test_opposite_growth_turns_the_first_order_round():
    opposite = replace(PULSE, cosine=-PULSE.cosine, sine=-PULSE.sine)
    one, other = (second_order(PAPER, w, rtol=3e-3) for w in (PULSE, opposite))
    assert other.first == pytest.approx(-one.first, abs=one.first_error + other.first_error)
    assert other.second == pytest.approx(one.second, abs=one.second_error + other.second_error)


def test_units_are_length_over_period():
    one = second_order(Sheet(1.0, 0.5), SINE, rtol=1e-2)
    other = second_order(Sheet(3.0, 1.5), SineWave(1, 0.25), rtol=1e-2)
    assert other.second == pytest.approx(12 * one.second, rel=1e-6)  # roundoff moves points at rest


def test_order_two_is_the_polynomial():
    both = second_order(PAPER, PULSE, rtol=1e-2)
    alpha = -0.2
    speed = crawl_speed(PAPER, PULSE, alpha, rtol=1e-2, order=2)
    assert speed.mean == pytest.approx(both.first * alpha + both.second * alpha**2, rel=1e-12)
    assert (speed.first_order, speed.second_order) == (both.first, both.second)
    assert speed.converged
    assert speed.velocity.shape == speed.times.shape
    closed = np.append(speed.velocity, speed.velocity[0]), np.append(speed.times, speed.times[0] + 1)
    # trapezoids between 40 times or more
    assert np.trapezoid(*closed) == pytest.approx(speed.mean, rel=0.02)
    for word in ("exp", "per grown area", "current load", "second order"):
        assert word in speed.model


def test_orders_one_and_two_agree_at_first_order():
    """Pulses, whose V_1 the linear theory has right: what differs is of order alpha."""
    one, two = (crawl_speed(PAPER, PULSE, 1e-4, rtol=3e-3, order=n) for n in (1, 2))
    assert two.mean == pytest.approx(one.mean, rel=1e-2)


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_order_two_of_tanh_keeps_its_slip_speed():
    """At a slip speed far below and far above the speeds it is dry and viscous."""
    options = {"alpha": 0.1, "rtol": 3e-3, "order": 2}
    tanh = [
        crawl_speed(PAPER, SINE, friction="tanh", slip_speed=s, **options).mean for s in (1e-6, 1e3)
    ]
    ends = [crawl_speed(PAPER, SINE, friction=f, **options).mean for f in ("coulomb", "viscous")]
    np.testing.assert_allclose(tanh, ends, rtol=6e-3)


def test_no_growth_no_motion():
    still = crawl_speed(PAPER, SINE, 0.0, order=2, rtol=1e-2)
    assert (still.mean, still.error, still.converged) == (0.0, 0.0, True)


def test_a_sheet_that_rests_has_no_second_coefficient():
    field = second_order_field(PAPER, SINE)
    period = leading_period(field, Contact(), 1e-2)
    assert coefficients(field, period, Contact(), 0.0, 1e-2).second == pytest.approx(1.533, rel=1e-2)
    found = coefficients(field, period._replace(sticks=True), Contact(), 0.0, 1e-2)
    assert np.isnan(found.second)
    assert found.second_error == np.inf


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"growth_law": "cubic"}, ["growth_law", "cubic", "exp", "linear", "metric"]),
        ({"area": "current"}, ["area", "current", "grown", "undeformed"]),
        ({"order": 3}, ["order = 3", "1, 2"]),
        ({"order": 1.0}, ["order = 1.0"]),
        ({"order": 2, "load": "heavy"}, ["load", "heavy", "material"]),
        ({"order": 2, "friction": "sticky"}, ["friction", "sticky"]),
        ({"order": 2, "friction": "tanh"}, ["slip_speed", "None"]),
        ({"order": 2, "method": "airy"}, ["method", "airy", "ritz"]),
        ({"order": 2, "rtol": 0.0}, ["rtol", "0"]),
        ({"order": 2, "alpha": np.inf}, ["alpha", "inf"]),
        (
            {"order": 2, "alpha": 1.2, "growth_law": "linear"},
            ["alpha = 1.2", "1 + alpha c", "within -1", "must be < 1"],
        ),
        (
            {"order": 2, "alpha": -0.6, "growth_law": "metric"},
            ["alpha = -0.6", "(1 + 2 alpha c)", "within -0.5", "must be > -0.5"],
        ),
        ({"order": 2, "wave": 3}, ["wave = 3"]),
    ],
)
def test_bad_input(options, words):
    with pytest.raises(ValueError, match=r".") as error:
        crawl_speed(**{"sheet": PAPER, "wave": SINE, "alpha": 0.1, **options})
    assert all(word in str(error.value) for word in words)


def test_the_table_is_what_its_command_makes():
    rows = table.TABLE.read()
    assert len(rows) == len(list(table.cases()))
    case = next(iter(table.cases()))
    again, kept = table.row(case), rows[0]
    assert (kept.growth_law, kept.area, kept.load) == (case.growth_law, case.area, case.load)
    # DIGITS of them are written
    assert again.second == pytest.approx(kept.second, rel=1e-6)
    assert again.nonlinear_second == pytest.approx(kept.nonlinear_second, rel=1e-6)


def test_both_columns_of_the_table_agree():
    for row in table.TABLE.read():
        tolerance = row.second_error + row.nonlinear_second_error
        assert abs(row.second - row.nonlinear_second) <= tolerance
        tolerance = row.first_error + row.nonlinear_first_error
        assert abs(row.first - row.nonlinear_first) <= tolerance
        # 0.2 % is what is promised, of the scale 0.1 L/T where loads and laws nearly cancel in V_2
        assert row.second == pytest.approx(row.nonlinear_second, rel=2e-3, abs=2e-4)


def test_a_table_that_is_not_there(tmp_path):
    path = tmp_path / "second_order.csv"
    with pytest.raises(FileNotFoundError, match=r"python -m figures\.measure\.second_order"):
        table.TABLE.read(path)
    rows = table.TABLE.read()[:2]
    assert table.TABLE.read(table.TABLE.write(rows, path)) == rows

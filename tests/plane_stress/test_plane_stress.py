"""Linear finite elements: exact solutions, rates, agreement with Ritz, honest errors, any outline."""

import functools

import numpy as np
import pytest
import sympy as sp
from skfem import MeshTri

from fem_check.mesh.location import quadrilateral_points
from fem_check.mesh.outline import Outline
from fem_check.plane_stress.field import plane_stress_field
from linear_theory import Sheet, SineWave
from linear_theory.deformation.ritz import ritz_field
from linear_theory.motion.motion import CellGrid
from linear_theory.wave.given import FieldWave

ELL = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0], [0, 0], [0, 0.5], [-0.5, 0.5]])
RECTANGLE = np.array([[-0.25, -0.5], [0.25, -0.5], [0.25, 0.5], [-0.25, 0.5]])
ANGLES = 2 * np.pi * np.arange(16) / 16
HOLE = 0.1 * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)


def distance(field, reference):
    """Relative L2 distance at the worst sampled phase, by the quadrature of `field`'s mesh."""
    solver = field._solver
    x, y, weights = solver.x.ravel(), solver.y.ravel(), solver.weights.ravel()
    v = reference._displacements(x, y)
    difference, size = (field._norms(w, weights) for w in (field._displacements(x, y) - v, v))
    return float((difference / size).max())


def bubble_wave(outline, poisson):
    """Growth -laplacian(chi) whose stress is the Airy stress of chi, u = -(1 + nu) grad chi.

    chi is the squared product of the distances from the sides, so that it and its slope vanish there.
    """
    x, y = sp.symbols("x y")
    corners = np.asarray(outline.corners)
    chi = sp.Integer(100)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        chi *= ((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) ** 2
    c = -(sp.diff(chi, x, 2) + sp.diff(chi, y, 2))
    u = [-(1 + poisson) * sp.diff(chi, v) for v in (x, y)]
    s = [sp.diff(chi, y, 2), sp.diff(chi, x, 2), -sp.diff(chi, x, y)]
    c, u, s = (sp.lambdify((x, y), e, cse=True) for e in (c, u, s))
    wave = FieldWave(lambda x, y, t: c(x, y) * np.cos(2 * np.pi * t), 1.0)
    return wave, u, s


@pytest.mark.parametrize("degree", [2, 4])
@pytest.mark.parametrize("outline", [Outline.rectangle(Sheet()), Outline.trapezoid(0.6, 0.4, 1)])
def test_convergence_to_a_smooth_solution(outline, degree):
    """The rates of scikit-fem's elements: p + 1 in displacement, p in stress; and absolute bounds."""
    wave, u, s = bubble_wave(outline, 0.3)
    errors, triangles = [], []
    for size in {2: (0.06, 0.03), 4: (0.12, 0.06)}[degree]:
        field = plane_stress_field(outline, wave, poisson=0.3, degree=degree, size=size)
        x, y = field._solver.x, field._solver.y
        pairs = (
            (field.displacement(x, y, 0), np.array(u(x, y))),
            (field.stress(x, y, 0), np.array(s(x, y))),
        )
        norms = [np.sqrt(((a - b) ** 2).sum() / (b**2).sum()) for a, b in pairs]
        errors.append(norms)
        triangles.append(field.mesh.t.shape[1])
    assert norms[0] <= field.error
    rates = np.log(np.divide(*errors)) / np.log(triangles[1] / triangles[0]) * 2
    np.testing.assert_allclose(rates, [degree + 1, degree], atol=0.25)  # not yet asymptotic
    bound = {2: [3e-4, 5e-3], 4: [5e-7, 2e-5]}[degree]  # measured: a third to two thirds of that
    assert np.all(np.array(errors[1]) < bound)


@pytest.mark.parametrize("degree", [2, 4])
@pytest.mark.parametrize("outline", [Sheet(1, 0.3), Outline(ELL), Outline(RECTANGLE, [HOLE])])
def test_growth_linear_in_space_makes_no_stress(outline, degree):
    wave = FieldWave(lambda x, y, t: 0.3 + 0.7 * x * np.sin(2 * np.pi * t) - 1.1 * y, period=1.0)
    field = plane_stress_field(outline, wave, degree=degree, size=0.15)
    x, y = field._solver.x[:, 0], field._solver.y[:, 0]
    c = wave.value(x, y, 0.2)
    np.testing.assert_allclose(field.stress(x, y, 0.2), 0, atol=1e-11)  # roundoff
    np.testing.assert_allclose(field.strain(x, y, 0.2), [c, c, 0 * c], atol=1e-11)
    assert field.error < 1e-11


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5, -0.5])
@pytest.mark.parametrize("width", [0.1, 0.5, 1.0, 2.0])
def test_agreement_with_ritz_to_the_error_that_each_claims(width, poisson, count):
    sheet, wave = Sheet(1, width, poisson), SineWave(count)
    ritz = ritz_field(sheet, wave, rtol=1e-8)
    for degree in (2, 4):
        size = min(width, 1 / count) / (5 if degree == 2 else 3)
        fem = plane_stress_field(sheet, wave, degree=degree, size=size)
        true = distance(fem, ritz)
        assert true <= fem.error + ritz.error
        assert fem.error < 8 * true  # an estimate, not just a bound; measured at most 4
        x, y = np.linspace(-0.4, 0.4, 5)[:, None] * width, np.linspace(-0.45, 0.45, 7)
        scale = abs(ritz.velocity(x, y, 0.1)).max()
        # pointwise errors are a few times those in the mean
        np.testing.assert_allclose(
            fem.velocity(x, y, 0.1), ritz.velocity(x, y, 0.1), atol=10 * fem.error * scale
        )


def test_agreement_with_ritz_for_a_wave_that_depends_on_x():
    wave = FieldWave(lambda x, y, t: np.exp(x) * np.sin(2 * np.pi * (y - t) + 3 * x * y), period=1.0)
    fem = plane_stress_field(Sheet(), wave, degree=4, size=0.1)
    ritz = ritz_field(Sheet(), wave, rtol=1e-7)
    assert distance(fem, ritz) <= fem.error + ritz.error
    x, y = np.linspace(-0.2, 0.2, 4)[:, None], np.linspace(-0.45, 0.45, 5)
    t = np.array([0.1, 0.77])[:, None, None]
    for name, factor in (("displacement", 10), ("velocity", 10), ("strain", 500)):
        a, b = getattr(fem, name)(x, y, t), getattr(ritz, name)(x, y, t)
        assert (
            abs(a - b).max() < factor * fem.error * abs(b).max()
        )  # strains lose one power of the size


OUTLINES = {
    "trapezoid": Outline.trapezoid(0.6, 0.3, 1),
    "fan": Outline.trapezoid(0.1, 0.9, 0.5),
    "hole": Outline(RECTANGLE, [HOLE]),
    "ell": Outline(ELL),
}


@functools.cache
def fine(name):
    return plane_stress_field(OUTLINES[name], SineWave(), degree=4, size=0.03)


@pytest.mark.parametrize("degree", [2, 4])
@pytest.mark.parametrize("name", OUTLINES)
def test_error_estimate_is_honest_on_other_outlines(name, degree):
    field = plane_stress_field(OUTLINES[name], SineWave(), degree=degree, size=0.1)
    true = distance(field, fine(name))
    assert true <= field.error
    assert field.error < 15 * true  # measured at most 9 (smooth corners of the hole)


def test_field_of_a_trapezoid_is_mirror_symmetric():
    field = plane_stress_field(OUTLINES["trapezoid"], SineWave(), size=0.1)
    x, y = np.linspace(0.01, 0.14, 5)[:, None], np.linspace(-0.49, 0.49, 6)
    u, v = field.displacement(x, y, 0.2), field.displacement(-x, y, 0.2)
    np.testing.assert_allclose(v, u * np.array([-1, 1])[:, None, None], atol=1e-12)  # roundoff


@pytest.mark.parametrize("degree", [2, 4])
@pytest.mark.parametrize("name", OUTLINES)
def test_no_rigid_motion(name, degree):
    wave = FieldWave(lambda x, y, t: x**2 * y + y**3 - x**3 + np.cos(x - y) * t, period=1.0)
    field = plane_stress_field(OUTLINES[name], wave, degree=degree, size=0.15)
    solver = field._solver
    u = field._displacements(solver.x, solver.y)
    np.testing.assert_allclose((u * solver.weights).sum(axis=(2, 3)), 0, atol=1e-14)  # roundoff
    assert abs(mean_rotation(field)).max() < 1e-12  # roundoff, with points found to 1e-16


def mean_rotation(field):
    """Integral of (du_y/dx - du_x/dy)/2: half the circulation of u along all edges (Stokes)."""
    mesh = field.mesh
    edges = mesh.facets[:, mesh.boundary_facets()]
    nodes, weights = np.polynomial.legendre.leggauss(4)
    a, b = mesh.p[:, edges].transpose(1, 0, 2)
    inner = mesh.p[:, mesh.t[:, mesh.f2t[0, mesh.boundary_facets()]]].mean(axis=1)
    along = b - a
    left = along[0] * (inner - a)[1] - along[1] * (inner - a)[0] > 0
    along = np.where(left, along, -along)
    points = (a + b)[..., None] / 2 + (b - a)[..., None] / 2 * nodes
    u = field._displacements(*points)
    return np.einsum("jcen,ce,n->j", u, along, weights) / 2


def test_cross_sections_carry_no_force():
    sheet = Sheet()
    field = plane_stress_field(sheet, SineWave(), degree=4, size=0.06)
    x, weights = np.polynomial.legendre.leggauss(40)
    y = np.array([-0.31, 0.017, 0.26])[:, None]
    stress = field.stress(x * sheet.width / 2, y, 0.1)
    # stresses of order 0.3, discontinuous from element to element; measured 2e-5
    np.testing.assert_allclose((stress[1:] * weights).sum(axis=-1), 0, atol=1e-4)


@pytest.mark.parametrize("outline", [Sheet(), OUTLINES["trapezoid"], OUTLINES["hole"]])
def test_motion_fills_the_sheet_and_holds_the_values(outline):
    wave = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) * (1 + x), period=1.0)
    for some in (SineWave(), wave):
        field = plane_stress_field(outline, some, size=0.15, degree=4)
        times = np.array([0.0, 0.3])
        motion = field.motion(times, CellGrid.uniform(field.sheet, 1, 1, half=True), 3)
        weights = np.multiply.outer(*[np.polynomial.legendre.leggauss(3)[1]] * 2)
        assert not motion.mirrored
        assert (motion.area > 0).all()
        assert (motion.area * weights).sum() == pytest.approx(outline.area, rel=1e-13)
        # a cell's Jacobian is linear and u of degree 4, so that three points leave some error
        mean = (motion.velocity * motion.area * weights).sum(axis=(2, 3, 4))
        assert abs(mean).max() < 1e-3 * abs(motion.velocity).max() * outline.area
        x, y = motion.position
        for i, t in enumerate(times):
            np.testing.assert_allclose(motion.velocity[:, i], field.velocity(x, y, t), atol=1e-10)
            dilation = field.strain(x, y, t)[:2].sum(axis=0)
            np.testing.assert_allclose(motion.dilation[i], dilation, atol=1e-10)
            np.testing.assert_allclose(motion.growth[i], some.value(x, y, t), atol=1e-14)


def test_cells_of_a_triangle():
    points, jacobian = quadrilateral_points(4)
    weights = np.multiply.outer(*[np.polynomial.legendre.leggauss(4)[1]] * 2)
    assert (jacobian * weights).sum() == pytest.approx(0.5, rel=1e-14)
    x, y = points
    # integral of x^a y^b over the triangle: a! b!/(a + b + 2)!
    assert (x**3 * y**2 * jacobian * weights).sum() == pytest.approx(12 / 5040, rel=1e-13)


def test_a_mesh_is_taken_as_it_is():
    mesh = MeshTri.init_tensor(np.linspace(-0.25, 0.25, 4), np.linspace(-0.5, 0.5, 7))
    field = plane_stress_field(mesh, SineWave(), poisson=0.5)
    ritz = ritz_field(Sheet(), SineWave())
    assert distance(field, ritz) <= field.error + ritz.error
    assert field.mesh.t.shape[1] == 4 * mesh.t.shape[1]
    assert plane_stress_field(mesh, SineWave(), size=0.06).mesh.t.shape[1] == 16 * mesh.t.shape[1]


def test_poisson_ratio_comes_from_the_sheet_unless_given():
    assert plane_stress_field(Sheet(poisson=0.2), SineWave(), size=0.3).sheet.poisson == 0.2
    assert plane_stress_field(Sheet(poisson=0.2), SineWave(), 0.1, size=0.3).sheet.poisson == 0.1
    assert plane_stress_field(Outline(ELL), SineWave(), size=0.3).sheet.poisson == 0.5


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"outline": 3}, "outline = 3: must be a Sheet, an Outline or a MeshTri"),
        ({"degree": 3}, "degree = 3: must be 2 or 4"),
        ({"size": 0.0}, "size = 0: must be > 0"),
        ({"size": np.nan}, "size contains nan: must be finite"),
        ({"poisson": 0.7}, r"poisson = 0.7: must be in \(-1, 0.5\]"),
        (
            {"outline": MeshTri([[0, 1, 2.0], [0, 0, 0.0]], [[0], [1], [2]])},
            "outline: 1 of 1 elements are inverted or have no area",
        ),
        (
            {
                "outline": MeshTri(
                    [[0, 1, 0, 5, 6, 5.0], [0, 0, 1, 5, 5, 6.0]], [[0, 3], [1, 4], [2, 5]]
                )
            },
            "outline: has 2 separate pieces, must be one",
        ),
    ],
)
def test_bad_input(arguments, message):
    arguments = {"outline": Sheet(), "wave": SineWave(), "size": 0.25} | arguments
    with pytest.raises(ValueError, match=message):
        plane_stress_field(**arguments)


def test_points_outside():
    field = plane_stress_field(OUTLINES["hole"], SineWave(), degree=2, size=0.1)
    edge = field.displacement([0.25, -0.25, 0.1], [0.5, 0.1, 0.0], 0.0)  # on the boundary is inside
    assert np.isfinite(edge).all()
    for x, y in ((0.3, 0), (0, 0.51), (0.02, 0.03)):
        with pytest.raises(ValueError, match=f"x, y = {x:g}, {y:g}: must be inside the outline"):
            field.displacement(x, y, 0.0)
    with pytest.raises(ValueError, match="x contains nan"):
        field.strain(np.nan, 0, 0)

"""Shape functions, reference surfaces, matrices and linear solution, each against something else."""

import numpy as np
import pytest
import scipy.sparse as sp
import skfem

from fem_check.mesh.outline import Outline
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rest_state import grown_state
from fem_check.shell.kinematics.shape_functions import shape_functions
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import (
    AnnulusSector,
    Cylinder,
    Flat,
    SpherePart,
    Surface,
)
from fem_check.shell.material import Material, elastic_tensor
from fem_check.shell.statics import linear_solver
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.sparsity import Sparsity
from tests.shell.shell_cases import koiter, trapezoid

RNG = np.random.default_rng(0)

SURFACES = [Flat(0.2), trapezoid, AnnulusSector(), Cylinder(0.7), SpherePart(0.7)]
SHELLS = [skfem.ElementQuadBFS(), skfem.ElementTriArgyris()]
LAGRANGE = [skfem.ElementQuad1(), skfem.ElementQuad2(), skfem.ElementTriP2(), skfem.ElementTriP4()]


def mesh_for(element: object, n: int = 2, uneven: bool = True) -> object:
    y = np.linspace(-0.5, 0.5, 2 * n + 1)
    grid = np.linspace(-0.25, 0.25, n + 1), y + 0.3 * y**3 if uneven else y
    return (skfem.MeshQuad if "Quad" in type(element).__name__ else skfem.MeshTri).init_tensor(*grid)


@pytest.mark.parametrize("element", SHELLS + LAGRANGE, ids=lambda e: type(e).__name__)
def test_shape_functions_are_those_of_scikit_fem(element: object) -> None:
    mesh = mesh_for(element)
    basis = skfem.Basis(mesh, element, intorder=6)
    points = np.asarray(basis.global_coordinates())
    order = 2 if element in SHELLS else 1
    ours = shape_functions(mesh, element, np.arange(mesh.nelements), points, order)
    for shape in range(ours.shape[3]):
        field = basis.basis[shape][0]
        theirs = [np.broadcast_to(np.asarray(field), points.shape[1:]), *field.grad]
        if order == 2:
            theirs += [field.hess[0, 0], field.hess[1, 1], field.hess[0, 1]]
        expected = np.stack(theirs, -1)
        np.testing.assert_allclose(ours[..., shape], expected, atol=1e-8 * np.abs(expected).max())


@pytest.mark.parametrize("element", SHELLS, ids=lambda e: type(e).__name__)
def test_polynomials_of_the_element_are_exact_far_from_the_origin(element: object) -> None:
    """x^3 y is in both spaces. (scikit-fem's own functions are no functions any more on this mesh.)"""
    d = Discretisation(mesh_for(element).translated((30.0, -20.0)), element)

    def jets(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        x, y = x - 30, y + 20
        rows = [x**3 * y, 3 * x**2 * y, x**3, 6 * x * y, 0 * x, 3 * x**2]
        return np.stack([np.stack([r, 0 * r, -r]) for r in rows])

    found = d.interior.displacement(d.interpolate(jets), (0, 1, 2, 3, 4, 5))
    expected = jets(*d.interior.parameters.reshape(2, -1))
    for values, exact in zip(found, expected, strict=True):
        np.testing.assert_allclose(values, exact, atol=1e-10 * max(1.0, np.abs(exact).max()), rtol=0)


def test_a_uniform_mesh_shares_its_shape_functions() -> None:
    element = skfem.ElementQuadBFS()
    uniform = Discretisation(mesh_for(element, uneven=False), element).interior
    uneven = Discretisation(mesh_for(element), element).interior
    assert uniform.shapes((1, 2)).shape[0] == 1
    assert uneven.shapes((1, 2)).shape[0] == len(uneven.elements)
    every = shape_functions(uniform.mesh, element, uniform.elements, uniform.parameters, 1)
    np.testing.assert_allclose(
        np.broadcast_to(uniform.shapes((1, 2)), every[:, :, 1:].shape), every[:, :, 1:], atol=1e-11
    )


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: type(s).__name__)
def test_derivatives_of_surfaces(surface: Surface) -> None:
    """Central differences of the map and of its first derivatives, error O(step^2)."""
    x, y, h = np.linspace(0.3, 0.5, 5), np.linspace(-0.4, 0.4, 5), 1e-5
    jet = surface(x, y)
    across = (surface(x + h, y) - surface(x - h, y)) / (2 * h)
    along = (surface(x, y + h) - surface(x, y - h)) / (2 * h)
    for entry, expected in (
        (1, across[0]),
        (2, along[0]),
        (3, across[1]),
        (4, along[2]),
        (5, along[1]),
    ):
        np.testing.assert_allclose(jet[entry], expected, atol=1e-9)


def test_curvature_of_reference_surfaces() -> None:
    """Gauss and mean curvature: cylinder 0, -1/(2R); sphere 1/R^2, -1/R; ring and trapezoid flat."""
    mesh = skfem.MeshQuad.init_tensor(np.linspace(0.6, 1.0, 3), np.linspace(-0.4, 0.4, 3))
    for surface, gauss, mean in (
        (Cylinder(0.7), 0.0, -0.5 / 0.7),
        (SpherePart(0.7), 1 / 0.49, -1 / 0.7),
        (AnnulusSector(), 0.0, 0.0),
        (trapezoid, 0.0, 0.0),
    ):
        region = Discretisation(mesh, skfem.ElementQuadBFS(), surface).interior
        (a11, a22, a12), (b11, b22, b12) = region.metric, region.curvature
        det = a11 * a22 - a12**2
        np.testing.assert_allclose((b11 * b22 - b12**2) / det, gauss, atol=1e-13)
        np.testing.assert_allclose(
            (b11 * a22 - 2 * b12 * a12 + b22 * a11) / (2 * det), mean, atol=1e-13
        )


def test_measures_are_areas_and_lengths() -> None:
    mesh = skfem.MeshTri.init_tensor(np.linspace(0, np.pi / 3, 5), np.linspace(0, 2, 3))
    d = Discretisation(mesh, skfem.ElementTriArgyris(), Cylinder(1.5))
    assert d.interior.measure.sum() == pytest.approx(1.5 * np.pi / 3 * 2, rel=1e-12)
    assert d.edge(lambda xi: np.isclose(xi[1], 2)).measure.sum() == pytest.approx(
        1.5 * np.pi / 3, rel=1e-12
    )
    assert d.edge(lambda xi: np.isclose(xi[0], 0)).measure.sum() == pytest.approx(2, rel=1e-12)
    assert d.point((0.1, 0.1)).measure.sum() == 1


def test_an_exact_curved_reference_carries_no_prestress() -> None:
    """The undeformed cylinder has energy 0 on any mesh: x = X + u_h with the exact X."""
    element = skfem.ElementQuadBFS()
    d = Discretisation(mesh_for(element, 1), element, Cylinder(0.3))
    material = Material(0.01, 0.3)
    p = Potential(d, (Membrane(material), Bending(material)), grown_state(d.interior))
    assert p.energy(d.zeros()) < 1e-30
    assert np.abs(p.gradient(d.zeros())).max() < 1e-16


def test_elastic_tensor_is_that_of_the_appendix() -> None:
    """Index by index: nu a^ab a^cd + (1 - nu)/2 (a^ac a^bd + a^ad a^bc)."""
    nu, metric = 0.37, np.array([[1.3, 0.2], [0.2, 0.8]])
    a = np.linalg.inv(metric)
    full = nu * np.einsum("ab,cd->abcd", a, a) + (1 - nu) / 2 * (
        np.einsum("ac,bd->abcd", a, a) + np.einsum("ad,bc->abcd", a, a)
    )
    found = elastic_tensor(np.array([[1.3], [0.8], [0.2]]), nu)[..., 0]
    index = ((0, 0), (1, 1), (0, 1))
    expected = [[full[i + j] for j in index] for i in index]
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_kinematics_of_a_known_deformation() -> None:
    """A sheet rolled up to radius R: metric of the plane, curvature 1/R, area unchanged."""
    element, radius = skfem.ElementTriArgyris(), 0.4
    d = Discretisation(mesh_for(element, 4), element)

    def jets(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        rolled = Cylinder(radius)(x / radius, y)
        scale = np.array([1, 1 / radius, 1, 1 / radius**2, 1, 1 / radius])[:, None, None]
        return rolled * scale - Flat()(x, y)

    state = PointState(d.interior, d.interpolate(jets), (0, 1, 2, 3, 4, 5))
    np.testing.assert_allclose(
        state.metric, np.array([1, 1, 0.0])[:, None] + 0 * state.metric, atol=1e-5
    )
    np.testing.assert_allclose(state.curvature[0], -1 / radius, atol=2e-3)
    np.testing.assert_allclose(state.curvature[1:], 0, atol=2e-3)
    assert state.area.sum() == pytest.approx(d.interior.measure.sum(), abs=1e-7)


@pytest.mark.parametrize(("element", "n", "degree"), [(0, 1, None), (1, 1, None), (0, 2, 5)])
def test_only_rigid_motions_are_free_of_energy(element: int, n: int, degree: int | None) -> None:
    """Six zero eigenvalues of the flat, unsupported sheet: no point of quadrature too few."""
    grid = np.linspace(-0.5, 0.5, n + 1)
    mesh = (skfem.MeshQuad, skfem.MeshTri)[element].init_tensor(grid, grid)
    d = Discretisation(mesh, SHELLS[element], degree=degree)
    p = Potential(d, koiter(Material(0.1, 0.3)), grown_state(d.interior))
    sparsity = Sparsity(d, np.ones(d.size, bool))
    values = np.linalg.eigvalsh(
        sparsity.matrix(sparsity.assemble(p.hessian_blocks(d.zeros()))).toarray()
    )
    assert np.sum(np.abs(values) < 1e-12 * values.max()) == 6


def matrix_case(element: object) -> tuple[Discretisation, Sparsity, np.ndarray]:
    d = Discretisation(mesh_for(element, 3), element)
    supports = Supports(d).clamp(lambda xi: np.isclose(xi[1], d.mesh.p[1].min()))
    sparsity, material = Sparsity(d, supports.free), Material(0.05, 0.3)
    p = Potential(d, koiter(material), grown_state(d.interior))
    return d, sparsity, sparsity.assemble(p.hessian_blocks(d.zeros()))


@pytest.mark.parametrize("element", SHELLS, ids=lambda e: type(e).__name__)
def test_banded_and_sparse_solutions_agree(element: object) -> None:
    _, sparsity, values = matrix_case(element)
    right = RNG.normal(size=sparsity.size)
    banded = linear_solver._banded(sparsity, values)
    sparse = linear_solver._sparse(sparsity, values)
    assert banded is not None
    assert sparse is not None
    x = banded.solve(right)
    np.testing.assert_allclose(sparsity.matrix(values) @ x, right, atol=1e-7)
    np.testing.assert_allclose(sparse.solve(right), x, atol=1e-6 * np.abs(x).max())


def test_matrices_that_are_not_positive_definite_are_recognised() -> None:
    _, sparsity, values = matrix_case(skfem.ElementQuadBFS())
    lowest = sp.linalg.eigsh(sparsity.matrix(values), k=1, sigma=0, return_eigenvectors=False)[0]
    for factor in (linear_solver._banded, linear_solver._sparse):
        shifted = values.copy()
        shifted[sparsity.diagonal] -= 1.1 * lowest
        assert factor(sparsity, shifted) is None
        shifted[sparsity.diagonal] += 0.2 * lowest
        assert factor(sparsity, shifted) is not None


def test_the_band_of_a_rectangle_is_one_row_of_elements_wide() -> None:
    element = skfem.ElementQuadBFS()
    d = Discretisation(mesh_for(element, 4), element)
    sparsity = Sparsity(d, np.ones(d.size, bool))
    assert sparsity.half_width < 12 * (5 + 2)


def test_clamped_edges_stay_where_they_are_and_keep_their_tangent_plane() -> None:
    """Random values of the free unknowns neither move nor tilt the edge, but may stretch the sheet."""
    for element in SHELLS:
        d = Discretisation(mesh_for(element), element)
        bottom = d.mesh.p[1].min()
        supports = Supports(d).clamp(lambda xi, y=bottom: np.isclose(xi[1], y))
        u = np.where(supports.free, RNG.normal(size=d.size), 0)
        edge = d.edge(lambda xi, y=bottom: np.isclose(xi[1], y))
        np.testing.assert_allclose(edge.displacement(u, (0, 1)), 0, atol=1e-10)
        across = edge.displacement(u, (2,))[0]
        np.testing.assert_allclose(across[2], 0, atol=1e-10)
        assert np.abs(across[:2]).max() > 0.1
        assert np.abs(edge.displacement(u, (4,))).max() > 1


def test_points_on_the_boundary_of_triangles_are_found() -> None:
    """Corners, and points along all sides, of a sheet with a hole, to roundoff outside of it."""
    turn = np.linspace(0, 2 * np.pi, 17)[:-1]
    hole = 0.1 * np.stack([np.cos(turn), np.sin(turn)], 1)
    square = np.array([[-0.25, -0.5], [0.25, -0.5], [0.25, 0.5], [-0.25, 0.5]])
    mesh = Outline(square, [hole]).mesh(0.15)
    share = np.linspace(0, 1, 23)[:, None]
    ends = [(loop, np.roll(loop, -1, axis=0)) for loop in (square, hole)]
    sides = [(a, b) for start, end in ends for a, b in zip(start, end, strict=True)]
    points = np.concatenate([(1 - share) * a + share * b for a, b in sides]).T
    flat = Discretisation(mesh, skfem.ElementTriP2(), components=2)
    np.testing.assert_allclose(flat.points(points).position(flat.zeros(), (0,))[0], points, atol=1e-12)
    with pytest.raises(ValueError, match=r"xi = \[0\. 0\.\]: must be in the parameter domain"):
        flat.points(np.array([[0.0], [0.0]]))


@pytest.mark.parametrize("kind", ["MeshQuad", "MeshTri"])
@pytest.mark.parametrize(("width", "length"), [(30.0, 60.0), (2.1, 7.3), (1 / 3, 1.0), (0.03, 0.06)])
def test_points_on_edges_and_corners_are_in_the_mesh(kind: str, width: float, length: float) -> None:
    """Also where rounding puts them outside; they are where bilinear or linear functions say."""
    x, y = np.linspace(-width / 2, width / 2, 7), np.linspace(-length / 2, length / 2, 13)
    mesh = getattr(skfem, kind).init_tensor(x, y)
    element = skfem.ElementQuadBFS() if kind == "MeshQuad" else skfem.ElementTriArgyris()
    sheet = Discretisation(mesh, element)
    random = np.random.default_rng(3)
    share = np.concatenate([random.uniform(size=(20, 4)), np.eye(4)[:3], [[0.5, 0.5, 0, 0]]])
    share = share[:, : mesh.t.shape[0]] / share[:, : mesh.t.shape[0]].sum(1, keepdims=True)
    places = np.einsum("ik,ckt->cit", share, mesh.p[:, mesh.t]).reshape(2, -1)
    found = sheet._elements_at(places)
    low, high = (getattr(mesh.p[:, mesh.t], m)(axis=1)[:, found] for m in ("min", "max"))
    assert np.all(places >= low - 1e-9 * length)
    assert np.all(places <= high + 1e-9 * length)
    with pytest.raises(ValueError, match="must be in the parameter domain"):
        sheet._elements_at(np.array([[0.0], [0.51 * length]]))

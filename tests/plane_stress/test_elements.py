"""Integrals over all triangles at once against scikit-fem's loop over shape functions."""

import numpy as np
import pytest
from skfem import MeshTri

from fem_check.plane_stress.elements import Elements
from fem_check.plane_stress.solver import PlaneStressSolver
from tests.plane_stress import reference_forms as reference

ROUNDOFF = 1e-12


@pytest.fixture(params=[2, 4])
def degree(request):
    return request.param


@pytest.fixture
def mesh():
    """Triangles of all shapes, half of them clockwise."""
    rng = np.random.default_rng(0)
    x, y = np.sort(rng.random((2, 6)))
    tensor = MeshTri.init_tensor(x, y)
    return MeshTri(tensor.p + 0.02 * rng.standard_normal(tensor.p.shape) * np.diff(x).min(), tensor.t)


def near(found, expected):
    found, expected = (getattr(a, "toarray", lambda a=a: a)() for a in (found, expected))
    np.testing.assert_allclose(found, expected, rtol=0, atol=ROUNDOFF * np.abs(expected).max())


@pytest.mark.parametrize("poisson", [-0.9, 0.0, 0.5])
def test_stiffness(mesh, degree, poisson):
    basis = reference.basis(mesh, degree)
    near(
        Elements(mesh, degree).stiffness(poisson),
        reference.elastic_work.assemble(basis, poisson=poisson),
    )


def test_works_of_dilation(mesh, degree):
    basis, elements = reference.basis(mesh, degree), Elements(mesh, degree)
    growths = np.random.default_rng(1).standard_normal((3, *elements.x.shape))
    works = [reference.dilation_work.assemble(basis, growth=growth) for growth in growths]
    near(elements.dilation_works(growths), np.stack(works))


def test_means(mesh, degree):
    basis = reference.basis(mesh, degree)
    shifts = [reference.shift.assemble(basis, along=along) for along in (0, 1)]
    near(Elements(mesh, degree).means, np.stack([*shifts, reference.rotation.assemble(basis)]))


def test_points_and_nodes(mesh, degree):
    basis, elements = reference.basis(mesh, degree), Elements(mesh, degree)
    near(np.stack([elements.x, elements.y]), np.asarray(basis.global_coordinates()))
    near(elements.weights, basis.dx)
    near(np.repeat(elements.nodes, 2, axis=1), basis.doflocs)


def test_displacements_and_strains(mesh, degree):
    """At the points of the quadrature, by scikit-fem's interpolation."""
    basis, solver = reference.basis(mesh, degree), PlaneStressSolver(mesh, degree, 0.3)
    solution = np.random.default_rng(2).standard_normal(basis.N)
    displacement, strain = solver.everywhere(solution[None], Elements(mesh, degree).local)
    expected = basis.interpolate(solution)
    near(displacement[0], np.asarray(expected))
    slope = np.asarray(expected.grad)
    near(strain[0], np.stack([slope[0, 0], slope[1, 1], (slope[0, 1] + slope[1, 0]) / 2]))


def test_residual_vanishes_for_the_solution_of_the_same_growth(mesh, degree):
    solver = PlaneStressSolver(mesh, degree, 0.3)
    growths = np.random.default_rng(3).standard_normal((2, *solver.x.shape))
    solution = solver.solve(growths)
    size = abs(solver.residual(np.zeros_like(solution), growths)).max()
    assert abs(solver.residual(solution, growths)).max() < 1e-10 * size  # roundoff of thin triangles
    assert abs(solver.residual(solution, 2 * growths)).max() > 0.9 * size

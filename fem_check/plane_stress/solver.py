"""Finite elements for thermoelastic plane stress: weak forms, factorisation, values at any point.

Find u with   int sigma(eps(u) - c I) : eps(v) dx dy = 0   for all v,

sigma(e) = e/(1 + nu) + nu tr(e) I/(1 - nu^2), Young's modulus 1, all edges free (eq. 10 of the seed
paper with the strain c I of growth). Elements are triangles of degree 2 or 4 (scikit-fem).
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import Basis, BilinearForm, ElementTriP2, ElementTriP4, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, div, eye, sym_grad, trace

from fem_check.plane_stress.factor import SparseFactor
from linear_theory.common.units import power_of_two
from linear_theory.motion.rigid import centre_and_gyration

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

ELEMENTS = {2: ElementTriP2, 4: ElementTriP4}


@BilinearForm  # type: ignore[untyped-decorator]
def elastic_work(u: Any, v: Any, w: Any) -> Any:
    """Work of the stress of u in the strain of v; w.poisson."""
    e, nu = sym_grad(u), w.poisson
    return ddot(e / (1 + nu) + nu / (1 - nu**2) * eye(trace(e), 2), sym_grad(v))


@LinearForm  # type: ignore[untyped-decorator]
def growth_work(v: Any, w: Any) -> Any:
    """Work of sigma(c I) in the strain of v; w.growth is c, w.poisson."""
    return w.growth / (1 - w.poisson) * div(v)


@LinearForm  # type: ignore[untyped-decorator]
def pull(v: Any, w: Any) -> Any:
    """Work of a stress w.stress in the strain of v."""
    return ddot(w.stress, sym_grad(v))


@LinearForm  # type: ignore[untyped-decorator]
def shift(v: Any, w: Any) -> Any:
    """Displacement along the direction w.along."""
    return v[w.along]


@LinearForm  # type: ignore[untyped-decorator]
def rotation(v: Any, w: Any) -> Any:
    """Local rotation, anticlockwise."""
    return (v.grad[1, 0] - v.grad[0, 1]) / 2


class PlaneStressSolver:
    """Displacements of degree 2 or 4 on a mesh; factors its matrix once.

    x, y: (triangles, points), where growths are needed; weights: of these points, including area.
    """

    def __init__(self, mesh: MeshTri, degree: int, poisson: float) -> None:
        self.mesh, self.degree, self.poisson = mesh, degree, poisson
        self._element = ELEMENTS[degree]()
        self._basis = Basis(mesh, ElementVector(self._element), intorder=2 * degree)
        self.x, self.y = np.asarray(self._basis.global_coordinates())
        self.weights: Array = self._basis.dx

    def solve(self, growths: Array) -> Array:
        """Nodal displacements for growths (cases, triangles, points), (cases, unknowns).

        Their mean and mean rotation over the area are zero.
        """
        works = [growth_work.assemble(self._basis, growth=g, poisson=self.poisson) for g in growths]
        return self.response(np.stack(works))

    def residual(self, solution: Array, growths: Array) -> Array:
        """Works of growths in every displacement less those of the stress of a solution, (cases,
        unknowns): 0 for the solution of these growths."""
        nu, found = self.poisson, []
        for u, growth in zip(solution, growths, strict=True):
            strain = sym_grad(self._basis.interpolate(u))
            spread = growth / (1 - nu) - nu / (1 - nu**2) * trace(strain)
            stress = eye(spread, 2) - strain / (1 + nu)
            found.append(pull.assemble(self._basis, stress=stress))
        return np.stack(found)

    def response(self, works: Array) -> Array:
        """Displacements of balanced works (cases, unknowns), without mean and mean rotation."""
        free, factor = self._factor
        solution = np.zeros_like(works)
        solution[:, free] = factor.solve(works[:, free].T).T
        return self.centred(solution)

    def centred(self, solution: Array) -> Array:
        """Nodal displacements (cases, unknowns) without their mean and mean rotation."""
        modes, means = self._rigid_motions
        return np.asarray(solution - np.linalg.solve(means @ modes.T, means @ solution.T).T @ modes)

    def missed(self, growths: Array) -> Array:
        """Residual of growths fitted by polynomials of one degree less than the elements, same shape.

        Times the root of the weights: its squares sum to the square of the L2 norm.
        """
        x, y = np.asarray(self._basis.X)
        powers = [(i, j) for i in range(self.degree) for j in range(self.degree - i)]
        scale = np.sqrt(self.weights)
        polynomials = np.stack([x**i * y**j for i, j in powers], axis=1) * scale[:1].T
        base, _ = np.linalg.qr(polynomials)
        return np.asarray(growths * scale - (growths * scale) @ base @ base.T)

    def displacements(self, solution: Array, triangle: Indices, local: Array) -> Array:
        """Displacements (cases, 2, n) in the given triangles (n,) at local coordinates (2, n)."""
        values, _ = self._shape_functions(local)
        return np.asarray(np.einsum("jbcn,bn->jcn", self._nodal(solution, triangle), values))

    def strains(self, solution: Array, triangle: Indices, local: Array) -> Array:
        """Strains (cases, 3, n), components xx, yy, xy, at the same kind of points."""
        _, slopes = self._shape_functions(local)
        inverse = self._basis.mapping.invA[:, :, triangle]
        slopes = np.einsum("bdn,den->ben", slopes, inverse)
        return _symmetric(np.einsum("jbcn,ben->jcen", self._nodal(solution, triangle), slopes))

    def everywhere(self, solution: Array, local: Array) -> tuple[Array, Array]:
        """Displacements (cases, 2, triangles, n) and strains (cases, 3, ...) at local points (2, n)."""
        values, slopes = self._shape_functions(local)
        nodal = self._nodal(solution, np.arange(self.mesh.t.shape[1]))
        displacement = np.tensordot(nodal, values, (1, 0))
        gradient = np.tensordot(nodal, slopes, (1, 0))  # cases, components, triangles, local, n
        gradient = np.einsum("jctdn,det->jcetn", gradient, self._basis.mapping.invA)
        return displacement, _symmetric(gradient)

    @cached_property
    def centre_and_gyration(self) -> tuple[Array, float]:
        """Centre of mass (2,) of the mesh and its radius of gyration."""
        return centre_and_gyration(np.stack([self.x.ravel(), self.y.ravel()]), self.weights.ravel())

    @cached_property
    def _factor(self) -> tuple[Indices, SparseFactor]:
        """Free unknowns and the factors of their matrix.

        Three unknowns are fixed to suppress rigid motions; growth exerts no net force or torque, so
        that the reactions vanish, and `solve` then removes the mean displacement and rotation.
        """
        matrix = elastic_work.assemble(self._basis, poisson=self.poisson)
        free = np.setdiff1d(np.arange(self._basis.N), self._held())
        return free, SparseFactor(matrix[free][:, free])

    def _held(self) -> Indices:
        """Both components at one vertex, and one at the farthest, across the line between them."""
        ray = self.mesh.p - self.mesh.p[:, :1]
        far = int(np.argmax(ray[0] ** 2 + ray[1] ** 2))
        across = int(abs(ray[0, far]) > abs(ray[1, far]))
        nodes = self._basis.nodal_dofs
        return np.array([nodes[0, 0], nodes[1, 0], nodes[across, far]])

    @cached_property
    def _rigid_motions(self) -> tuple[Array, Array]:
        """Nodal values of the three rigid motions, and integrals that measure them, (3, unknowns)."""
        basis = self._basis
        component = np.zeros(basis.N, np.int64)
        for dofs in (basis.nodal_dofs, basis.facet_dofs, basis.interior_dofs):
            component[dofs[1::2]] = 1
        arms = basis.doflocs - self.centre_and_gyration[0][:, None]
        size = power_of_two(float(abs(arms).max()))  # makes rotations comparable with shifts
        x, y = arms / size
        modes = np.stack([component == 0, component == 1, np.where(component == 0, -y, x)])
        means = [
            shift.assemble(basis, along=0),
            shift.assemble(basis, along=1),
            size * rotation.assemble(basis),
        ]
        return modes.astype(float), np.stack(means)

    def _nodal(self, solution: Array, triangle: Indices) -> Array:
        """Nodal values of the given triangles, (cases, shape functions, 2, n)."""
        dofs = self._basis.element_dofs[:, triangle]
        return np.asarray(solution[:, dofs].reshape(len(solution), -1, 2, dofs.shape[1]))

    def _shape_functions(self, local: Array) -> tuple[Array, Array]:
        """Values (functions, n) and slopes in local coordinates (functions, 2, n)."""
        pairs = [self._element.lbasis(local, i) for i in range(len(self._element.doflocs))]
        values = np.stack([np.broadcast_to(value, local.shape[1:]) for value, _ in pairs])
        return values, np.stack([np.broadcast_to(slope, local.shape) for _, slope in pairs])


def _symmetric(gradient: Array) -> Array:
    """Strains (cases, 3, ...) from displacement gradients (cases, 2, 2, ...)."""
    mixed = (gradient[:, 0, 1] + gradient[:, 1, 0]) / 2
    return np.stack([gradient[:, 0, 0], gradient[:, 1, 1], mixed], axis=1)

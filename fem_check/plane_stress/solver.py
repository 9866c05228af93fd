"""Finite elements for thermoelastic plane stress: weak forms, factorisation, values at any point.

Find u with   int sigma(eps(u) - c I) : eps(v) dx dy = 0   for all v,

sigma(e) = e/(1 + nu) + nu tr(e) I/(1 - nu^2), Young's modulus 1, all edges free (eq. 10 of the seed
paper with the strain c I of growth). Elements are triangles of degree 2 or 4 (scikit-fem).
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import MeshTri

from fem_check.mesh.orientation import oriented
from fem_check.plane_stress.elements import Elements
from fem_check.plane_stress.factor import SparseFactor
from linear_theory.common.units import power_of_two
from linear_theory.motion.rigid import centre_and_gyration

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


class PlaneStressSolver:
    """Displacements of degree 2 or 4 on a mesh; factors its matrix once.

    x, y: (triangles, points), where growths are needed; weights: of these points, including area.
    """

    def __init__(self, mesh: MeshTri, degree: int, poisson: float) -> None:
        self.mesh, self.degree, self.poisson = oriented(mesh), degree, poisson
        self._elements = Elements(self.mesh, degree)
        self.x, self.y, self.weights = self._elements.x, self._elements.y, self._elements.weights

    def solve(self, growths: Array) -> Array:
        """Nodal displacements for growths (cases, triangles, points), (cases, unknowns).

        Their mean and mean rotation over the area are zero.
        """
        return self.response(self._works(growths))

    def residual(self, solution: Array, growths: Array) -> Array:
        """Works of growths in every displacement less those of the stress of a solution, (cases,
        unknowns): 0 for the solution of these growths."""
        return np.asarray(self._works(growths) - (self._matrix @ solution.T).T)

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
        x, y = self._elements.local
        powers = [(i, j) for i in range(self.degree) for j in range(self.degree - i)]
        scale = np.sqrt(self.weights)
        polynomials = np.stack([x**i * y**j for i, j in powers], axis=1) * scale[:1].T
        base, _ = np.linalg.qr(polynomials)
        return np.asarray(growths * scale - (growths * scale) @ base @ base.T)

    def displacements(self, solution: Array, triangle: Indices, local: Array) -> Array:
        """Displacements (cases, 2, n) in the given triangles (n,) at local coordinates (2, n)."""
        values, _ = self._elements.shape_functions(local)
        return np.asarray(np.einsum("jbcn,bn->jcn", self._elements.nodal(solution, triangle), values))

    def strains(self, solution: Array, triangle: Indices, local: Array) -> Array:
        """Strains (cases, 3, n), components xx, yy, xy, at the same kind of points."""
        _, slopes = self._elements.shape_functions(local)
        inverse = self._elements.inverse[:, :, triangle]
        slopes = np.einsum("bdn,den->ben", slopes, inverse)
        return _symmetric(np.einsum("jbcn,ben->jcen", self._elements.nodal(solution, triangle), slopes))

    def everywhere(self, solution: Array, local: Array) -> tuple[Array, Array]:
        """Displacements (cases, 2, triangles, n) and strains (cases, 3, ...) at local points (2, n)."""
        values, slopes = self._elements.shape_functions(local)
        nodal = self._elements.nodal(solution, slice(None))
        displacement = np.tensordot(nodal, values, (1, 0))
        gradient = np.tensordot(nodal, slopes, (1, 0))  # cases, components, triangles, local, n
        gradient = np.einsum("jctdn,det->jcetn", gradient, self._elements.inverse)
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
        free = np.setdiff1d(np.arange(self._elements.unknowns), self._held())
        return free, SparseFactor(self._matrix[free][:, free])

    @cached_property
    def _matrix(self) -> Any:
        """Stiffness of all unknowns."""
        return self._elements.stiffness(self.poisson)

    def _works(self, growths: Array) -> Array:
        """Works of the stress of growths in every displacement, (cases, unknowns)."""
        return self._elements.dilation_works(growths / (1 - self.poisson))

    def _held(self) -> Indices:
        """Both components at one vertex, and one at the farthest, across the line between them."""
        ray = self.mesh.p - self.mesh.p[:, :1]
        far = int(np.argmax(ray[0] ** 2 + ray[1] ** 2))
        across = int(abs(ray[0, far]) > abs(ray[1, far]))
        return np.array([0, 1, 2 * far + across])

    @cached_property
    def _rigid_motions(self) -> tuple[Array, Array]:
        """Nodal values of the three rigid motions, and integrals that measure them, (3, unknowns)."""
        arms = self._elements.nodes - self.centre_and_gyration[0][:, None]
        size = power_of_two(float(abs(arms).max()))  # makes rotations comparable with shifts
        x, y = arms / size
        none, all_of_them = np.zeros_like(x), np.ones_like(x)
        motions = [(all_of_them, none), (none, all_of_them), (-y, x)]
        modes = np.stack([np.stack(motion, axis=1).ravel() for motion in motions])
        return modes, self._elements.means * np.array([[1.0], [1.0], [size]])


def _symmetric(gradient: Array) -> Array:
    """Strains (cases, 3, ...) from displacement gradients (cases, 2, 2, ...)."""
    mixed = (gradient[:, 0, 1] + gradient[:, 1, 0]) / 2
    return np.stack([gradient[:, 0, 0], gradient[:, 1, 1], mixed], axis=1)

"""Integrals over straight triangles, all at once, from those over one reference triangle.

The map from the reference triangle is affine: an integral of a product of slopes is one over the
reference triangle times constants of the triangle (R. C. Kirby, A. Logg, ACM Trans. Math. Softw.
32:417, 2006), and a matrix is one product instead of a loop over pairs of shape functions.
"""

from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from skfem import Basis, ElementTriP2, ElementTriP4, MeshTri
from skfem.quadrature import get_quadrature_tri

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

ELEMENTS = {2: ElementTriP2, 4: ElementTriP4}


class Elements:
    """Displacements of degree 2 or 4 on a mesh; of node k, 2k is the unknown along x, 2k + 1 along y.

    mesh: oriented (`mesh.orientation`). x, y: (triangles, points) of the quadrature, exact to twice the
    degree; weights: of these points, including area. local: the same points in the reference triangle,
    (2, points). nodes: (2, n).
    """

    def __init__(self, mesh: MeshTri, degree: int) -> None:
        self._element = ELEMENTS[degree]()
        basis = Basis(mesh, self._element, intorder=0)  # of which only nodes and maps are used
        self.nodes: Array = basis.doflocs
        self.inverse: Array = basis.mapping.invA
        """Slopes of local coordinates, (local, 2, triangles)."""
        self.local, reference = get_quadrature_tri(2 * degree)
        self.weights: Array = np.multiply.outer(abs(basis.mapping.detA), reference)
        self.x, self.y = basis.mapping.F(self.local)
        self._values, self._slopes = self.shape_functions(self.local)
        self._nodes_of: Indices = basis.element_dofs

    @property
    def unknowns(self) -> int:
        """How many there are."""
        return int(self.nodes.size)

    def shape_functions(self, local: Array) -> tuple[Array, Array]:
        """Values (functions, n) and slopes in local coordinates (functions, 2, n)."""
        pairs = [self._element.lbasis(local, i) for i in range(len(self._element.doflocs))]
        values = np.stack([np.broadcast_to(value, local.shape[1:]) for value, _ in pairs])
        return values, np.stack([np.broadcast_to(slope, local.shape) for _, slope in pairs])

    def nodal(self, solution: Array, triangle: Indices | slice) -> Array:
        """Of a solution (cases, unknowns), in triangles, (cases, functions, 2, triangles)."""
        found = solution.reshape(len(solution), -1, 2)[:, self._nodes_of[:, triangle]]
        return np.asarray(found.swapaxes(2, 3))

    def stiffness(self, poisson: float) -> sp.csc_matrix:
        """Work of the stress of one displacement in the strain of another, Young's modulus 1."""
        inverse, one = self.inverse, np.eye(2)
        shear, dilation = 0.5 / (1 + poisson), poisson / (1 - poisson**2)
        # Of the slope d of a displacement along i with the slope f of one along j.
        metric = np.einsum("ij,det,fet->tijdf", one, inverse, inverse)
        moduli = shear * (metric + np.einsum("djt,fit->tijdf", inverse, inverse))
        moduli += dilation * np.einsum("dit,fjt->tijdf", inverse, inverse)
        moduli *= self.weights.sum(axis=1)[:, None, None, None, None]
        share = self.weights[0] / self.weights[0].sum()
        products = np.einsum("q,bdq,cfq->dfbc", share, self._slopes, self._slopes)
        blocks = np.tensordot(moduli, products, 2)  # triangle, i, j, function, function
        row, column = self._dofs[:, :, None, :, None], self._dofs[:, None, :, None, :]
        row, column = (np.broadcast_to(index, blocks.shape).ravel() for index in (row, column))
        shape = self.unknowns, self.unknowns
        return sp.coo_matrix((blocks.ravel(), (row, column)), shape).tocsc()

    def dilation_works(self, growths: Array) -> Array:
        """Integrals of growths (cases, triangles, points) times the divergence of each displacement."""
        pulled = np.tensordot(growths * self.weights, self._slopes, (2, 2))
        return self._summed(np.einsum("jtbd,dit->jtib", pulled, self.inverse))

    @cached_property
    def means(self) -> Array:
        """Integrals over the sheet of both displacements and of the rotation, (3, unknowns)."""
        triangles = len(self.weights)
        shift = self.weights @ self._values.T
        pulled = np.tensordot(self.weights, self._slopes, (1, 2))
        slope = np.einsum("tbd,det->teb", pulled, self.inverse)
        parts = np.zeros((3, triangles, 2, shift.shape[1]))
        parts[0, :, 0] = parts[1, :, 1] = shift
        parts[2, :, 0], parts[2, :, 1] = -slope[:, 1] / 2, slope[:, 0] / 2
        return self._summed(parts)

    @cached_property
    def _dofs(self) -> NDArray[np.int32]:
        """Unknowns of the triangles, (triangles, 2, functions)."""
        along = np.arange(2)[None, :, None]
        return np.asarray(2 * self._nodes_of.T[:, None, :] + along, np.int32)

    def _summed(self, parts: Array) -> Array:
        """Vectors (cases, unknowns) of their parts (cases, triangles, 2, functions)."""
        where, size = self._dofs.ravel(), self.unknowns
        return np.stack([np.bincount(where, part.ravel(), size) for part in parts])

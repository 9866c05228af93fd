"""Elements of second order whose nodes are the points of their quadrature: the mass is a diagonal.

Lines and rectangles have the elements P2 and Q2 with Simpson's rule; triangles have P2 with a bubble
and the rule of seven points (Cohen, Joly, Roberts and Tordjman, SIAM J. Numer. Anal. 38:2047, 2001).
With the values at the nodes as unknowns the diffusion term is the sparse product M⁻¹ K c, of third
order (fourth at the nodes of lines and rectangles), and reaction is evaluated node by node.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp
import skfem
from numpy.typing import NDArray
from skfem.helpers import dot, grad

from fem_check.mesh.location import TriangleFinder
from fem_check.mesh.outline import Outline
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

ELEMENTS = {
    skfem.MeshLine1: skfem.ElementLineP2,
    skfem.MeshQuad1: skfem.ElementQuad2,
    skfem.MeshTri1: skfem.ElementTriP2B,
}

DEGREE = 6
"""Of the quadrature of the stiffness, exact for all three elements on straight meshes."""

Body = Sheet | Outline


@dataclass(frozen=True, eq=False)
class Space:
    """A mesh with its nodes; a mesh of lines lies along y.

    nodes: x and y (2, n). mass (n,). stiffness (n, n), sparse.
    """

    mesh: Any

    @classmethod
    def on(cls, body: Body, size: float, depends_on_x: bool) -> "Space":
        """Of elements up to that size: on the axis of a sheet where nothing depends on x."""
        if isinstance(body, Outline):
            return cls(body.mesh(size))
        along = np.linspace(-body.length / 2, body.length / 2, _count(body.length, size) + 1)
        if not depends_on_x:
            return cls(skfem.MeshLine(along))
        across = np.linspace(-body.width / 2, body.width / 2, _count(body.width, size) + 1)
        return cls(skfem.MeshQuad.init_tensor(across, along))

    @cached_property
    def basis(self) -> Any:
        """Of scikit-fem."""
        kind = next(e for m, e in ELEMENTS.items() if isinstance(self.mesh, m))
        return skfem.Basis(self.mesh, kind(), intorder=DEGREE)

    @property
    def size(self) -> int:
        """n, number of nodes."""
        return int(self.basis.N)

    @cached_property
    def nodes(self) -> Array:
        """x and y, (2, n)."""
        places = self.basis.doflocs
        if len(places) == 1:
            return np.asarray(np.stack([0 * places[0], places[0]]))
        inner = self.basis.element_dofs[-1]
        if np.isnan(places[:, inner]).any():  # scikit-fem gives a bubble no place
            places = places.copy()
            places[:, inner] = self.mesh.p[:, self.mesh.t].mean(1)
        return np.asarray(places)

    @cached_property
    def mass(self) -> Array:
        """Length or area that belongs to each node, (n,)."""
        integrals = skfem.LinearForm(lambda v, _: v).assemble(self.basis)
        return np.asarray(self._from_nodes.T @ integrals)

    @cached_property
    def laplacian(self) -> Any:
        """M⁻¹ K, so that minus it times c is the Laplacian with Neumann edges; (n, n), sparse."""
        form = skfem.BilinearForm(lambda u, v, _: dot(grad(u), grad(v)))
        stiffness = self._from_nodes.T @ form.assemble(self.basis) @ self._from_nodes
        return (sp.diags(1 / self.mass) @ stiffness).tocsr()

    @cached_property
    def fastest(self) -> float:
        """Bound of the largest eigenvalue of `laplacian` (Gershgorin), 1/length²."""
        return float(abs(self.laplacian).sum(axis=1).max())

    def weights(self, x: Array, y: Array) -> tuple[Indices, Array]:
        """Nodes and their weights, (nodes per element, *shape) each, that give values at points.

        Points outside take the values of the nearest element's edge.
        """
        shape = np.broadcast_shapes(x.shape, y.shape)
        x, y = (np.broadcast_to(v, shape).ravel() for v in (x, y))
        element, local = self._located(x, y)
        kind = self.basis.elem
        dofs = self.basis.element_dofs[:, element]
        functions = np.stack([kind.lbasis(local, i)[0] for i in range(dofs.shape[0])])
        values = self._local.T @ functions
        return dofs.reshape(-1, *shape), values.reshape(-1, *shape)

    @cached_property
    def _local(self) -> Array:
        """Coefficients of scikit-fem's functions from values at the nodes of one element."""
        kind = self.basis.elem
        places = np.nan_to_num(np.asarray(kind.doflocs, float), nan=1 / 3).T
        count = places.shape[1]
        return np.asarray(np.linalg.inv(np.stack([kind.lbasis(places, i)[0] for i in range(count)], 1)))

    @cached_property
    def _from_nodes(self) -> Any:
        """Those of all functions from the values at all nodes, (n, n)."""
        dofs = self.basis.element_dofs
        rows, columns = (np.broadcast_to(d, (len(dofs), *dofs.shape)) for d in (dofs[:, None], dofs))
        shape = (self.size, self.size)
        values = np.broadcast_to(self._local[:, :, None], rows.shape)
        total = sp.coo_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape).tocsr()
        shared = np.bincount(dofs.ravel(), minlength=self.size)  # rows of shared nodes are all alike
        return (sp.diags(1 / shared) @ total).tocsr()

    def _located(self, x: Array, y: Array) -> tuple[Indices, Array]:
        if len(self.mesh.p) == 1:
            return self._on_line(y)
        if isinstance(self.mesh, skfem.MeshQuad1):
            return self._on_grid(x, y)
        triangle, local = self._finder(x, y)
        lost = np.flatnonzero(triangle < 0)
        if lost.size:
            triangle[lost] = self._finder._tree.query(np.stack([x[lost], y[lost]], 1))[1]
            local[:, lost] = _inside(self._affine(triangle[lost], np.stack([x[lost], y[lost]])))
        return triangle, local

    @cached_property
    def _finder(self) -> TriangleFinder:
        return TriangleFinder(self.mesh)

    def _on_line(self, y: Array) -> tuple[Indices, Array]:
        ends = self.mesh.p[0]
        element = _cells(np.sort(ends), y)
        starts = self.mesh.p[0, self.mesh.t]
        left, right = starts[:, element]
        return element, np.clip((y - left) / (right - left), 0, 1)[None]

    def _on_grid(self, x: Array, y: Array) -> tuple[Indices, Array]:
        lines = [np.unique(np.round(v, 12)) for v in self.mesh.p]
        centres = self.mesh.p[:, self.mesh.t].mean(1)
        table = np.zeros([line.size - 1 for line in lines], np.int64)
        table[tuple(_cells(*pair) for pair in zip(lines, centres, strict=True))] = np.arange(
            self.mesh.nelements
        )
        element = table[_cells(lines[0], x), _cells(lines[1], y)]
        return element, np.clip(self._affine(element, np.stack([x, y])), 0, 1)

    def _affine(self, element: Indices, points: Array) -> Array:
        """Local coordinates (2, n) of points in elements that are affine images of the reference."""
        corners = self.mesh.p[:, self.mesh.t[:, element]]
        first, second = corners[:, 1] - corners[:, 0], corners[:, -1] - corners[:, 0]
        apart = points - corners[:, 0]
        area = first[0] * second[1] - first[1] * second[0]
        along = apart[0] * second[1] - apart[1] * second[0]
        up = first[0] * apart[1] - first[1] * apart[0]
        return np.stack([along, up]) / area


def _count(length: float, size: float) -> int:
    return max(1, int(np.ceil(length / size - 1e-9)))


def _cells(lines: Array, values: Array) -> Indices:
    return np.clip(np.searchsorted(lines, values, side="right") - 1, 0, lines.size - 2)


def _inside(local: Array) -> Array:
    """Local coordinates of a triangle moved into it."""
    local = np.clip(local, 0, 1)
    return np.asarray(local / np.maximum(local.sum(axis=0), 1))

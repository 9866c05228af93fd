"""Location of points in the triangles of a mesh, and quadrilateral cells that fill each triangle.

A point of a triangle has the local coordinates (X, Y), X, Y >= 0, X + Y <= 1, of scikit-fem.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from skfem import MeshTri

from linear_theory.common.quadrature import gauss_legendre

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

TOLERANCE = (
    1e-9  # tolerance for points outside the mesh by roundoff, relative to the size of a triangle
)
DRAWN = 500
"""Number of elements sufficient to draw the shape of a sheet."""

_CANDIDATES = 12
_BLOCK = 2**22  # numbers in one temporary array


class TriangleFinder:
    """Finds the triangles that contain given points, and the local coordinates there.

    A tree of centroids gives candidates; points in none of them are tested in all triangles.
    """

    def __init__(self, mesh: MeshTri) -> None:
        corners = mesh.p[:, mesh.t]
        self._origin = corners[:, 0].T
        self._inverse = np.linalg.inv(
            np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], 1).transpose(
                2, 0, 1
            )
        )
        self._tree = cKDTree(corners.mean(axis=1).T)
        roundoff = np.finfo(float).eps * np.abs(mesh.p).max() * np.abs(self._inverse).sum(2).max()
        self._tolerance = TOLERANCE + 4 * float(roundoff)

    def __call__(self, x: Array, y: Array) -> tuple[Indices, Array]:
        """Triangles (n,) and local coordinates (2, n) of points x, y (n,); -1 where outside."""
        points = np.stack([x, y], axis=1)
        count = min(_CANDIDATES, self._tree.n)
        candidates = self._tree.query(points, count)[1].reshape(len(points), count)
        triangle, local, depth = self._best(points, candidates)
        lost = np.flatnonzero(depth < -self._tolerance)
        every = np.arange(self._tree.n)[None]
        for some in np.array_split(lost, 1 + lost.size * self._tree.n // _BLOCK):
            triangle[some], local[some], depth[some] = self._best(points[some], every)
        return np.where(depth < -self._tolerance, -1, triangle), local.T

    def _best(self, points: Array, candidates: Indices) -> tuple[Indices, Array, Array]:
        """The candidate (n or 1, k) in which each point lies deepest."""
        shift = points[:, None] - self._origin[candidates]
        local = np.einsum(
            "nkij,nkj->nki", np.broadcast_to(self._inverse[candidates], (*shift.shape, 2)), shift
        )
        depth = np.minimum(local.min(axis=2), 1 - local.sum(axis=2))
        best = depth.argmax(axis=1)
        row = np.arange(len(points))
        triangle = np.broadcast_to(candidates, depth.shape)[row, best]
        return triangle, local[row, best], depth[row, best]


def quadrilateral_points(order: int) -> tuple[Array, Array]:
    """Gauss points of the three quadrilateral cells of a triangle: local coordinates and Jacobian.

    Each cell extends from a corner to the centroid, with the midpoints of two sides as its other
    corners. Returns (2, 3, order, order) and (3, order, order), the Jacobian of the bilinear map from
    [-1, 1]^2 to local coordinates, linear along each axis.
    """
    nodes, _ = gauss_legendre(order)
    s, t = nodes[:, None], nodes
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    points, jacobians = [], []
    for k in range(3):
        a, b, d = corners[k], (corners[k] + corners[k - 2]) / 2, (corners[k] + corners[k - 1]) / 2
        c = corners.mean(axis=0)
        a, b, c, d = (v[:, None, None] for v in (a, b, c, d))
        points.append(
            (
                (1 - s) * (1 - t) * a
                + (1 + s) * (1 - t) * b
                + (1 + s) * (1 + t) * c
                + (1 - s) * (1 + t) * d
            )
            / 4
        )
        along_s = ((1 - t) * (b - a) + (1 + t) * (c - d)) / 4
        along_t = ((1 - s) * (d - a) + (1 + s) * (c - b)) / 4
        jacobians.append(along_s[0] * along_t[1] - along_s[1] * along_t[0])
    return np.stack(points, axis=1), np.stack(jacobians)


def covering(mesh: Any) -> tuple[Array, Indices]:
    """Points (2, n) and triangles (m, 3) of a mesh, refined until its shape can be drawn.

    The corners of a few elements of high degree do not show their shape. Quadrilaterals become two
    triangles each. All are anticlockwise: normals at points are means of those of the triangles around.
    """
    while mesh.nelements < DRAWN:
        mesh = mesh.refined()
    corners = np.asarray(mesh.t, np.int64)
    if len(corners) == 4:
        corners = np.concatenate([corners[:3], corners[[0, 2, 3]]], axis=1)
    points, (a, b, c) = np.asarray(mesh.p), corners[:3]
    first, second = points[:, b] - points[:, a], points[:, c] - points[:, a]
    clockwise = first[0] * second[1] - first[1] * second[0] < 0
    return points, np.stack([a, np.where(clockwise, c, b), np.where(clockwise, b, c)], axis=1)

"""Triangle meshes of quadrilaterals and of polygons with holes.

Quadrilaterals get a grid of cells that their diagonals cut in four: symmetric wherever the outline
is. Other polygons get a Delaunay triangulation of points at equal distances along the sides and a
hexagonal grid inside, smoothed.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay
from skfem import MeshTri

from fem_check import polygons

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

SMOOTHINGS = 10
CLEARANCE = 0.6  # of the spacing: how near to a side points of the inner grid may come
MOST_SPLITS = 30


def quadrilateral_mesh(corners: Array, size: float) -> MeshTri:
    """Mesh of a convex quadrilateral (4, 2), anticlockwise, with sides of triangles up to `size`."""
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    n = max(1, int(np.ceil(max(sides[0], sides[2]) / size - 1e-9)))
    m = max(1, int(np.ceil(max(sides[1], sides[3]) / size - 1e-9)))
    nodes = _bilinear(corners, np.linspace(0, 1, n + 1), np.linspace(0, 1, m + 1))
    centres = _bilinear(corners, (np.arange(n) + 0.5) / n, (np.arange(m) + 0.5) / m)
    number = np.arange((n + 1) * (m + 1)).reshape(n + 1, m + 1)
    a, b, c, d = (part.ravel() for part in _corners_of_cells(number))
    e = number.size + np.arange(n * m)
    triangles = np.concatenate([[a, b, e], [b, c, e], [c, d, e], [d, a, e]], axis=1)
    return MeshTri(np.concatenate([nodes, centres], axis=1), triangles)


def polygon_mesh(loops: Sequence[Array], size: float) -> MeshTri:
    """Mesh of a polygon with holes; loops: outline and holes, (n, 2) each.

    Raises ValueError where the outline cannot be followed with triangles of that size.
    """
    boundary, fixed = _boundary_points(loops, size)
    inner = _inner_points(loops, size)
    for _ in range(MOST_SPLITS):
        points, triangles = _smoothed(loops, boundary, inner, size)
        missing = _missing_sides(fixed, triangles)
        if not missing.any():
            return MeshTri(points.T.copy(), triangles.T.copy())
        boundary, fixed = _split(boundary, fixed, missing)
    raise ValueError(f"size = {size:g}: must be smaller, the mesh does not follow the outline")


def _bilinear(corners: Array, s: Array, t: Array) -> Array:
    """(2, len(s) * len(t)) points of the map of the unit square, t fastest."""
    s, t = (v.ravel() for v in np.meshgrid(s, t, indexing="ij"))
    weights = np.stack([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t])
    return np.asarray(corners.T @ weights)


def _corners_of_cells(number: Indices) -> tuple[Indices, Indices, Indices, Indices]:
    return number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]


def _boundary_points(loops: Sequence[Array], size: float) -> tuple[Array, Indices]:
    """Points along all sides, (n, 2), and the pairs of them that must become edges, (m, 2)."""
    points: list[Array] = []
    edges: list[Indices] = []
    offset = 0
    for loop in loops:
        ends = np.roll(loop, -1, axis=0)
        counts = np.maximum(1, np.ceil(np.linalg.norm(ends - loop, axis=1) / size - 1e-9).astype(int))
        for start, end, count in zip(loop, ends, counts, strict=True):
            share = np.arange(count)[:, None] / count
            points.append(start + share * (end - start))
        number = offset + np.arange(counts.sum())
        edges.append(np.stack([number, np.roll(number, -1)], axis=1))
        offset += int(counts.sum())
    return np.concatenate(points), np.concatenate(edges)


def _inner_points(loops: Sequence[Array], size: float) -> Array:
    """Hexagonal grid inside the polygon, symmetric about the middle of its bounding box."""
    low, high = loops[0].min(axis=0), loops[0].max(axis=0)
    rows = int((high[1] - low[1]) / (size * np.sqrt(0.75))) + 1
    columns = int((high[0] - low[0]) / size) + 2
    row = np.arange(rows) - (rows - 1) / 2
    column = np.arange(-columns, columns + 1) / 1.0
    x = (low[0] + high[0]) / 2 + size * (column + 0.5 * (np.arange(rows) % 2)[:, None])
    y = (low[1] + high[1]) / 2 + size * np.sqrt(0.75) * row[:, None]
    points = np.stack([v.ravel() for v in np.broadcast_arrays(x, y)], axis=1)
    points = points[polygons.inside(loops, points)]
    return np.asarray(points[polygons.distance(loops, points) > CLEARANCE * size])


def _smoothed(
    loops: Sequence[Array], boundary: Array, inner: Array, size: float
) -> tuple[Array, Indices]:
    """Delaunay triangulation inside the loops, inner points moved to the mean of their neighbours."""
    points = np.concatenate([boundary, inner])
    triangles = _triangles(loops, points, size)
    for _ in range(SMOOTHINGS if len(inner) else 0):
        a, b = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).T
        total, count = np.zeros_like(points), np.zeros(len(points))
        for i, j in ((a, b), (b, a)):
            np.add.at(total, i, points[j])
            np.add.at(count, i, 1)
        points[len(boundary) :] = (total / np.maximum(count, 1)[:, None])[len(boundary) :]
        triangles = _triangles(loops, points, size)
    return points, triangles


def _triangles(loops: Sequence[Array], points: Array, size: float) -> Indices:
    """Delaunay triangles within the loops, without the flat ones along straight sides."""
    triangles = np.asarray(Delaunay(points).simplices, np.int64)
    p, q, r = points[triangles].transpose(1, 0, 2)
    area = abs((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0]) / 2
    keep = polygons.inside(loops, (p + q + r) / 3) & (area > 1e-9 * size**2)
    return np.asarray(triangles[keep])


def _missing_sides(fixed: Indices, triangles: Indices) -> NDArray[np.bool_]:
    """Which of the pairs are not an edge of exactly one triangle."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    count = int(triangles.max()) + len(fixed) + 1
    keys, times = np.unique(np.sort(edges, axis=1) @ [count, 1], return_counts=True)
    wanted = np.sort(fixed, axis=1) @ [count, 1]
    return np.asarray(~np.isin(wanted, keys[times == 1]))


def _split(boundary: Array, fixed: Indices, missing: NDArray[np.bool_]) -> tuple[Array, Indices]:
    """Halve the missing edges by new boundary points."""
    start, end = fixed[missing].T
    new = len(boundary) + np.arange(len(start))
    halves = [np.stack([start, new], axis=1), np.stack([new, end], axis=1)]
    middle = (boundary[start] + boundary[end]) / 2
    return np.concatenate([boundary, middle]), np.concatenate([fixed[~missing], *halves])

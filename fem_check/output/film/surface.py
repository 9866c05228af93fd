"""A surface in space as it is painted on the page."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, TriMesh
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from fem_check.output.film.camera import Camera
from fem_check.output.geometry import edges

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

SHADE = 0.6
"""How much the light changes colours, from 0 to 1."""

BEHIND = 2e-3
"""Depth, as a share of the size of the surface, by which an edge must lie behind it to be hidden."""


class Surface(NamedTuple):
    """points (3, n) and cells (m, corners), triangles or quadrilaterals."""

    points: Array
    cells: Integers


def quads(across: int, count: int) -> Integers:
    """Cells (m, 4) of a grid of so many points, whose last axis has the size `across`."""
    index = np.arange(count).reshape(-1, across)
    corners = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return np.stack([corner.ravel() for corner in corners], axis=1)


def normals(surface: Surface) -> Array:
    """Unit normals of the cells, (3, m)."""
    corners = surface.points[:, surface.cells]
    first, second = corners[..., 1] - corners[..., 0], corners[..., -1] - corners[..., 0]
    return _unit(np.cross(first, second, axis=0))


def paint(ax: Axes, surface: Surface, colors: Array, camera: Camera, factor: float) -> Iterator[Any]:
    """Triangles from back to front, and the edges that are not hidden behind them.

    colors (n, 3): of the points, shaded by the light. factor: from length to that of the axes.
    """
    seen, depth = camera.page(surface.points), camera.depth(surface.points)
    order = np.argsort(depth[surface.cells].mean(1), kind="stable")
    level = camera.light(np.array([0.0, 0.0, 1.0]))
    bright = 1 + SHADE * (camera.light(_normals_at_points(surface)) - level)
    mesh = TriMesh(Triangulation(seen[0] * factor, seen[1] * factor, surface.cells[order]))
    shaded: Any = np.clip(colors * bright[:, None], 0, 1)
    mesh.set_facecolor(shaded)
    yield ax.add_collection(mesh, autolim=False)
    rim = edges(surface.cells)
    lines = seen.T[rim[_visible(seen, depth, surface.cells, rim)]] * factor
    yield ax.add_collection(LineCollection(list(lines), color="0.15", lw=1.0), autolim=False)


def _normals_at_points(surface: Surface) -> Array:
    """Unit normals (3, n): means of those of the triangles around."""
    total = np.zeros((surface.points.shape[1], 3))
    for corner in surface.cells.T:
        np.add.at(total, corner, normals(surface).T)
    return _unit(total.T)


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=0), 1e-300))


def _visible(seen: Array, depth: Array, cells: Integers, rim: Integers) -> NDArray[np.bool_]:
    """Whether the middle of an edge (k, 2) is before every triangle that covers it on the page."""
    middle = seen[:, rim].mean(-1)
    near = depth[rim].mean(1) + BEHIND * float(np.ptp(seen))
    origin, first, second = (seen[:, cells[:, k]] for k in range(3))
    u, v = first - origin, second - origin
    way = middle[:, :, None] - origin[:, None]
    area = u[0] * v[1] - u[1] * v[0]
    with np.errstate(divide="ignore", invalid="ignore"):  # triangles seen from their edge
        a = (way[0] * v[1] - way[1] * v[0]) / area
        b = (u[0] * way[1] - u[1] * way[0]) / area
    corner = depth[cells]
    height = corner[:, 0] + a * (corner[:, 1] - corner[:, 0]) + b * (corner[:, 2] - corner[:, 0])
    covered = (a >= 0) & (b >= 0) & (a + b <= 1) & (height > near[:, None])
    return np.asarray(~covered.any(1))

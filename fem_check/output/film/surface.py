"""A surface in space as polygons on the page."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.output.film.camera import Camera
from fem_check.output.geometry import edges

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

SHADE = 0.75
"""How much the light changes colours, from 0 to 1."""


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
    normal = np.cross(first, second, axis=0)
    return np.asarray(normal / np.linalg.norm(normal, axis=0))


def faces(surface: Surface, colors: Array, camera: Camera) -> tuple[Array, dict[str, Any]]:
    """Triangles and edges of a surface in the order in which to paint them.

    colors (m, 3): of the triangles. Returns polygons (k, 3, 2) on the page, those of edges without an
    area, and their looks as arguments of a PolyCollection. What is nearer hides what is behind it.
    """
    rim = edges(surface.cells)
    cells = np.concatenate([surface.cells, rim[:, [0, 1, 1]]])
    seen = camera.page(surface.points).T
    depth = camera.depth(surface.points)
    # An edge is as near as the nearest triangle that it could bound, and is painted after it.
    near = np.concatenate([depth[surface.cells].mean(1), depth[rim].max(1)])
    order = np.argsort(near, kind="stable")
    level = camera.light(np.array([0.0, 0.0, 1.0]))
    bright = 1 + SHADE * (camera.light(normals(surface)) - level)
    painted = np.clip(colors * bright[:, None], 0, 1)
    dark = np.full((len(rim), 3), 0.15)
    looks = {
        "facecolors": np.concatenate([painted, dark])[order],
        "edgecolors": np.concatenate([painted, dark])[order],
        "linewidths": np.repeat([0.5, 1.0], [len(painted), len(rim)])[order],
    }
    return seen[cells[order]], looks

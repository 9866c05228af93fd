"""Outline of a sheet given by triangles, and positions of arrows on it."""

from typing import Any

import numpy as np
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


def edges(triangles: Integers) -> Integers:
    """Edges that belong to a single triangle, (k, 2) points: the outline, including holes."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(sides[first[count == 1]])


def inside(points: Array, triangles: Integers, across: int, along: int, margin: float = 0.0) -> Array:
    """Centres, if inside the sheet, of across x along cells of its bounding box, (2, k).

    margin: distance, relative to that of the centres, at which the sheet must still be.
    """
    low, high = points.min(1), points.max(1)
    shares = [(np.arange(n) + 0.5) / n for n in (across, along)]
    grid = np.stack(np.meshgrid(*shares, indexing="ij")).reshape(2, -1)
    centres = low[:, None] + (high - low)[:, None] * grid
    step = (high - low) / (across, along)
    finder: Any = Triangulation(points[0], points[1], triangles).get_trifinder()
    found = np.ones(grid.shape[1], bool)
    for way in [(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1)] if margin else [(0, 0)]:
        found &= finder(*(centres + (margin * step * way)[:, None])) >= 0
    return np.asarray(centres[:, found])


def refined(points: Array, triangles: Integers) -> tuple[Array, Integers]:
    """Points and triangles with each triangle cut into four."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=-1)
    pairs, index = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
    first, second, third = triangles.T
    a, b, c = index.reshape(-1, 3).T + points.shape[1]
    cut = [(first, a, c), (a, second, b), (c, b, third), (a, b, c)]
    middles = points[:, pairs].mean(-1)
    cells = np.concatenate([np.stack(corners, axis=1) for corners in cut])
    return np.concatenate([points, middles], axis=1), cells


def middle_line(points: Array, triangles: Integers, count: int) -> tuple[Array, Integers]:
    """Points (2, count) of a line along the sheet, and the indices of those inside the sheet.

    The line x = const nearest to the middle of the bounding box that lies at least half inside the
    sheet; if there is none, the line with the largest part inside.
    """
    low, high = points.min(1), points.max(1)
    y = low[1] + (high[1] - low[1]) * (np.arange(count) + 0.5) / count
    finder: Any = Triangulation(points[0], points[1], triangles).get_trifinder()
    shares = 0.5 + np.array([0, 1, -1, 2, -2, 3, -3, 4, -4]) / 10
    lines = [np.stack([np.full(count, low[0] + s * (high[0] - low[0])), y]) for s in shares]
    found = [np.flatnonzero(finder(*line) >= 0) for line in lines]
    best = next(
        (k for k, indices in enumerate(found) if 2 * indices.size >= count),
        int(np.argmax([indices.size for indices in found])),
    )
    return lines[best], found[best]

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


def inside(points: Array, triangles: Integers, across: int, along: int) -> Array:
    """Centres, if inside the sheet, of across x along cells of its bounding box, (2, k)."""
    low, high = points.min(1), points.max(1)
    shares = [(np.arange(n) + 0.5) / n for n in (across, along)]
    grid = np.stack(np.meshgrid(*shares, indexing="ij")).reshape(2, -1)
    x, y = low[:, None] + (high - low)[:, None] * grid
    finder: Any = Triangulation(points[0], points[1], triangles).get_trifinder()
    found = finder(x, y) >= 0
    return np.stack([x[found], y[found]])

"""Outline and arrows' tails of a sheet that is given by triangles."""

from typing import Any

import numpy as np
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


def edges(triangles: Integers) -> Integers:
    """The edges that belong to one triangle alone, (k, 2) points: the outline, holes included."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    return np.asarray(sides[first[count == 1]])


def inside(points: Array, triangles: Integers, across: int, along: int) -> Array:
    """Centres of across x along cells of the box of the points that lie in the sheet, (2, k)."""
    low, high = points.min(1), points.max(1)
    shares = [(np.arange(n) + 0.5) / n for n in (across, along)]
    grid = np.stack(np.meshgrid(*shares, indexing="ij")).reshape(2, -1)
    x, y = low[:, None] + (high - low)[:, None] * grid
    finder: Any = Triangulation(points[0], points[1], triangles).get_trifinder()
    found = finder(x, y) >= 0
    return np.stack([x[found], y[found]])

"""Plane polygons: area, crossings, points inside. A loop is (n, 2), closed by its first point."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def signed_area(loop: Array) -> float:
    """Positive where the loop runs anticlockwise."""
    x, y = loop.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)


def turns(loop: Array) -> Array:
    """Change of direction from each side to the next, radians, positive to the left."""
    side = np.roll(loop, -1, axis=0) - loop
    after = np.roll(side, -1, axis=0)
    cross = side[:, 0] * after[:, 1] - side[:, 1] * after[:, 0]
    return np.asarray(np.arctan2(cross, np.sum(side * after, axis=1)))


def segments(loops: Sequence[Array]) -> tuple[Array, Array]:
    """Starts and ends of all sides, (sides, 2) each."""
    return np.concatenate(loops), np.concatenate([np.roll(loop, -1, axis=0) for loop in loops])


def first_crossing(loops: Sequence[Array]) -> tuple[int, int] | None:
    """Two sides (numbered through all loops) that meet elsewhere than at a common corner."""
    start, end = segments(loops)
    count = len(start)
    side_of_start = _orientation(start[:, None], end[:, None], start)
    side_of_end = _orientation(start[:, None], end[:, None], end)
    apart = side_of_start * side_of_end > 0  # both ends of j on one side of i
    meet = ~apart & ~apart.T & _boxes_meet(start, end)
    following = np.concatenate([_next_side(loop, offset) for loop, offset in _offsets(loops)])
    i, j = np.nonzero(np.triu(meet, 1))
    neighbours = (following[i] == j) | (following[j] == i)
    bad = np.flatnonzero(~neighbours)
    return (int(i[bad[0]]), int(j[bad[0]])) if bad.size and count > 2 else None


def inside(loops: Sequence[Array], points: Array) -> Flags:
    """Which of the points (n, 2) an odd number of loops surrounds (first outline, then holes)."""
    odd = np.zeros(len(points), bool)
    x, y = points.T
    for (x0, y0), (x1, y1) in zip(*segments(loops), strict=True):
        if y0 != y1:
            odd ^= ((y0 <= y) != (y1 <= y)) & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return odd


def distance(loops: Sequence[Array], points: Array) -> Array:
    """Distance of the points (n, 2) from the nearest side."""
    nearest = np.full(len(points), np.inf)
    for start, end in zip(*segments(loops), strict=True):
        along = end - start
        share = np.clip((points - start) @ along / (along @ along), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(points - start - share[:, None] * along, axis=1))
    return nearest


def _orientation(a: Array, b: Array, c: Array) -> Array:
    """Sign of the area of the triangles a b c."""
    ab, ac = b - a, c - a
    return np.asarray(np.sign(ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]))


def _boxes_meet(start: Array, end: Array) -> Flags:
    low, high = np.minimum(start, end), np.maximum(start, end)
    return np.asarray(np.all((low[:, None] <= high) & (low <= high[:, None]), axis=-1))


def _offsets(loops: Sequence[Array]) -> list[tuple[Array, int]]:
    starts = np.cumsum([0, *(len(loop) for loop in loops)])
    return list(zip(loops, starts.tolist(), strict=False))


def _next_side(loop: Array, offset: int) -> NDArray[np.int64]:
    return offset + np.roll(np.arange(len(loop)), -1)

"""The transpose of the refinement of cells: weights at points of leaves, moved to whole cells.

`cells.graded` and `creases.cut` interpolate the values of a cell, polynomials, to the Gauss points of
its parts. What an integral over the parts changes by is a sum over these points of a weight times the
change there; the weights times the interpolation are weights at the points of the whole cell. Two
channels, the local coordinates of the whole cell, tell where the points of a leaf are in it.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory.motion.cells import Graded, gauss

Array = NDArray[np.float64]

LARGEST = 4_000_000
"""Numbers of an interpolation matrix that are held at once."""


def local_coordinates(order: int) -> Array:
    """Of the Gauss points of a cell, (2, n, n)."""
    points = gauss(order).points
    return np.stack(np.meshgrid(points, points, indexing="ij"))


def gathered(leaves: Graded, place: Array, weights: Array, count: int) -> Array:
    """Weights (k, leaves, n, n) at the points of leaves as ones at those of whole cells.

    place: (2, leaves, n, n), local coordinates in the whole cell; the owners are whole cells, of which
    there are `count`. Returns (k, count, n, n).
    """
    n = weights.shape[-1]
    found = np.zeros((count, len(weights), n, n))
    whole = _are_whole(leaves, place)
    found[leaves.owners[whole]] = weights[:, whole].swapaxes(0, 1)
    parts = np.flatnonzero(~whole)
    parts = parts[np.argsort(leaves.owners[parts], kind="stable")]
    size = max(LARGEST // n**3, 1)
    for some in (parts[i : i + size] for i in range(0, parts.size, size)):
        moved = _moved(place[:, some], weights[:, some])
        owners = leaves.owners[some]
        starts = np.flatnonzero(np.diff(owners, prepend=-1))
        found[owners[starts]] += np.add.reduceat(moved, starts, axis=0)
    return found.swapaxes(0, 1)


def _are_whole(leaves: Graded, place: Array) -> NDArray[np.bool_]:
    """Which leaves are whole cells, neither halved nor cut."""
    corner = local_coordinates(place.shape[-1])[:, [0, -1], [0, -1]]
    same = (place[:, :, [0, -1], [0, -1]] == corner[:, None]).all((0, 2))
    return np.asarray(same & (leaves.shares == 1.0))


def _moved(place: Array, weights: Array) -> Array:
    """Weights (k, leaves, n, n) times the interpolation, (leaves, k, n, n)."""
    across, along = (_interpolation(one) for one in place)
    flat = np.moveaxis(weights, 0, 1)
    if _is_grid(place):  # (n, n) matrices along each axis
        first, second = across[:, :, 0], along[:, 0]
        return np.asarray(first.swapaxes(-1, -2)[:, None] @ flat @ second[:, None])
    return np.einsum("ckpq,cpqa,cpqb->ckab", flat, across, along, optimize=True)


def _is_grid(place: Array) -> bool:
    """Whether the first coordinate depends on the first axis alone, and the second on the second."""
    x, y = place
    return bool((x == x[:, :, :1]).all() and (y == y[:, :1]).all())


def _interpolation(place: Array) -> Array:
    """Interpolation from the Gauss points to places, (*place.shape, n)."""
    n = place.shape[-1]
    return np.asarray(np.polynomial.legendre.legvander(place, n - 1) @ gauss(n).inverse)


def point_weights(leaves: Graded, order: int) -> Array:
    """Weights of the points of leaves in an integral, but for the area, (leaves, n, n)."""
    weights = gauss(order).weights
    return leaves.shares[:, None, None] * np.multiply.outer(weights, weights)

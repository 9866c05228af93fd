"""Random points of a body and random shares of a period, without gaps, at which a wave is looked at."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Places = tuple[Array, Array]
"""x and y of points, (n,) each, units of length."""

POINTS, SEED = 192, 20240607


def spread(count: int, seed: int) -> Array:
    """Random numbers in [0, 1), one in each of `count` equal parts of it, in random order, (count,).

    No gap between them is longer than two parts: what is as wide as that is met, wherever it lies.
    """
    random = np.random.default_rng(seed)
    return np.asarray((random.permutation(count) + random.uniform(size=count)) / count)


def on_sheet(sheet: Sheet) -> Places:
    """Random points of a rectangle."""
    x, y = spread(POINTS, SEED) - 0.5, spread(POINTS, SEED + 3) - 0.5
    return sheet.width * x, sheet.length * y


def on_axis(length: float) -> Places:
    """Random points of the line x = 0, as long as a body."""
    y = spread(POINTS, SEED) - 0.5
    return 0 * y, length * y


def among(x: Array, y: Array) -> Places:
    """A random choice of given points of a body of any outline, by their places along y."""
    along = np.argsort(y, axis=None)
    some = along[(x.size * spread(POINTS, SEED)).astype(int)]
    return x.ravel()[some], y.ravel()[some]

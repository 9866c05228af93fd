"""Stratified random points of a body and phases of a period, at which a wave is sampled."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Places = tuple[Array, Array]
"""x and y of sampling points, (n,) each, units of length."""

POINTS, SEED = 192, 20240607


def spread(count: int, seed: int) -> Array:
    """Random numbers in [0, 1), one in each of `count` equal parts, in random order, (count,).

    No gap is longer than two parts: a feature of that width is hit, wherever it lies.
    """
    random = np.random.default_rng(seed)
    return np.asarray((random.permutation(count) + random.uniform(size=count)) / count)


def on_sheet(sheet: Sheet) -> Places:
    """Stratified random points of a rectangle."""
    x, y = spread(POINTS, SEED) - 0.5, spread(POINTS, SEED + 3) - 0.5
    return sheet.width * x, sheet.length * y


def on_axis(length: float) -> Places:
    """Stratified random points on the axis x = 0 of a body of that length."""
    y = spread(POINTS, SEED) - 0.5
    return 0 * y, length * y


def among(x: Array, y: Array) -> Places:
    """A random choice of the given points of a body of any outline, stratified along y."""
    along = np.argsort(y, axis=None)
    some = along[(x.size * spread(POINTS, SEED)).astype(int)]
    return x.ravel()[some], y.ravel()[some]

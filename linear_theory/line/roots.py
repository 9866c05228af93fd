"""Bracketed roots of increasing functions, many at a time."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

EPS = float(np.finfo(float).eps)
MOST_STEPS = 2200
"""Iteration limit: bisection alone gets from the largest double to the smallest in fewer."""


def bracketed_newton(
    function: Callable[[Array], tuple[Array, Array]],
    low: ArrayLike,
    high: ArrayLike,
    guess: ArrayLike,
    rtol: float = 32 * EPS,
    atol: float = 0.0,
) -> Array:
    """Elementwise root of an increasing function between `low` and `high`.

    function(x) returns value and slope, each of the shape of x; low, high and guess broadcast to it.
    Newton steps are taken while they stay inside the bracket and shrink; otherwise the bracket is
    halved, so that jumps and vertical tangents are found too. Stops when the bracket is narrower
    than rtol |x| + atol and returns the point with the smallest |value|, which for a smooth function
    is accurate to rounding. The caller must ensure that the bracket contains the root: if not, the
    nearer end is returned.
    """
    lo, hi, x = (np.array(a, float) for a in np.broadcast_arrays(low, high, guess))
    x = np.clip(x, lo, hi)
    best, least = x, np.full(x.shape, np.inf)
    last, stretch = hi - lo, np.ones(x.shape)
    for _ in range(MOST_STEPS):
        value, slope = function(x)
        better = abs(value) < least
        best, least = np.where(better, x, best), np.where(better, abs(value), least)
        lo, hi = np.where(value <= 0, x, lo), np.where(value >= 0, x, hi)
        small = rtol * abs(x) + atol
        done = hi - lo <= small
        if done.all():
            return best
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            step = -value / slope
        # A short step is no proof where the slope is huge: step beyond the root, further each time.
        short = abs(step) < stretch * small / 4
        step = np.where(short, np.copysign(stretch * small / 4, -value), step)
        stretch = np.where(short, 2 * stretch, stretch)
        good = (x + step > lo) & (x + step < hi) & (short | (2 * abs(step) <= last))
        new = np.where(done, x, np.where(good, x + step, lo + (hi - lo) / 2))
        last, x = abs(new - x), new
    raise RuntimeError("a bracketed root was not found: the function is not finite")

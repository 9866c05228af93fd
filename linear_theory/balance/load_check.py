"""Where the normal load on a sheet would not be positive, so that small-strain theory is invalid."""

from decimal import ROUND_DOWN, Context

import numpy as np
from numpy.typing import NDArray

from linear_theory.motion.cells import gauss
from linear_theory.motion.motion import Motion

Array = NDArray[np.float64]


def check_load(motion: Motion, rate: Array, alpha: float) -> None:
    """Raise ValueError, naming the point, if the load 1 + alpha e is not positive, edges included."""
    to_edges = gauss(rate.shape[-1]).with_ends
    everywhere = to_edges @ rate @ to_edges.T
    lowest = 1 + alpha * everywhere
    if lowest.min() > 0:
        return
    _, cell, i, j = np.unravel_index(lowest.argmin(), lowest.shape)
    x, y = (to_edges @ motion.position[:, cell] @ to_edges.T)[:, i, j]
    limit = -1 / everywhere.min() if alpha > 0 else -1 / everywhere.max()
    raise ValueError(
        f"alpha = {alpha:g}: the area element 1 + alpha tr(strain) would be {lowest.min():.3g} at "
        f"x = {x:.3g}, y = {y:.3g}; must be {'<' if alpha > 0 else '>'} {_towards_zero(limit)}"
    )


def _towards_zero(limit: float, digits: int = 4) -> str:
    """A limit rounded to `digits` digits towards zero, so that the rounded value is within it."""
    return f"{float(Context(prec=digits, rounding=ROUND_DOWN).create_decimal(limit)):g}"

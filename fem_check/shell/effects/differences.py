"""Derivatives of a function of two variables by eighth-order central differences, with errors."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Function = Callable[[Array, Array], Array]

_PLACES = np.arange(-4, 5)
_FIRST = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
_SECOND = np.array(
    [-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560],
)
"""Weights of f(x + j h) for h f' and h^2 f'', j = -4 ... 4."""

_ORDERS = np.array([0, 1, 1, 2, 2, 2])[:, None]
_ROUNDOFF = 4 * np.finfo(float).eps

_SHORTER = (0.7, 0.45)
"""Steps for comparison: across a kink two differences may agree by chance, three hardly."""

_DIRECTIONS = ((1, 0), (0, 1), (1, 1), (1, -1))


class Checked(NamedTuple):
    """Derivatives (6, points) and their estimated errors, from differences with several steps."""

    jets: Array
    error: Array


def slopes(function: Function, x: Array, y: Array, step: float) -> Array:
    """f_x, f_y at points (points,), (2, points)."""
    values = np.stack([_along(function, x, y, step, d) for d in _DIRECTIONS[:2]])
    return np.tensordot(values, _FIRST, (1, 0)) / step


def jets(function: Function, x: Array, y: Array, step: float) -> Array:
    """f, f_x, f_y, f_xx, f_yy, f_xy at points (points,), (6, points).

    The mixed derivative is a quarter of the difference of the second ones along the two diagonals.
    """
    values = np.stack([_along(function, x, y, step, d) for d in _DIRECTIONS])
    first = np.tensordot(values[:2], _FIRST, (1, 0)) / step
    centre = values[:, 4:5]  # subtracted, so that a height far from 0 costs no digits
    second = np.tensordot(values - centre, _SECOND, (1, 0)) / step**2
    mixed = (second[2] - second[3]) / 4
    return np.stack([values[0, 4], *first, *second[:2], mixed])


def checked_jets(function: Function, x: Array, y: Array, step: float) -> Checked:
    """`jets` with errors: the change with two shorter steps, and the roundoff of the function."""
    found = jets(function, x, y, step)
    error = _ROUNDOFF * np.abs(found[0]) / (_SHORTER[-1] * step) ** _ORDERS
    for share in _SHORTER:
        error = np.maximum(error, np.abs(jets(function, x, y, share * step) - found))
    return Checked(found, error)


def _along(function: Function, x: Array, y: Array, step: float, direction: tuple[int, int]) -> Array:
    """Values at nine points along a line through each, (9, points)."""
    shift = step * _PLACES[:, None]
    places = x + shift * direction[0], y + shift * direction[1]
    values = function(*(p.ravel() for p in places))
    return values.reshape(len(_PLACES), -1)

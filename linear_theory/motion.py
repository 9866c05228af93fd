"""The motion of a sheet as the friction balance reads it: values on polynomial cells.

Every cell is the image of the square [-1, 1]^2 and carries values at order x order Gauss-Legendre
points, that is one polynomial per quantity. This is all that passes from a deformation (series,
Ritz, finite elements, shell) to the friction balance, which can refine a cell by interpolation
without asking the deformation again.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.sheet import Sheet

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """Values per unit alpha at the Gauss points of all cells; c cells, n = order, T times.

    position: (2, c, n, n), reference coordinates x, y.
    area: (c, n, n), Jacobian of the map from [-1, 1]^2 (quadrature weights not included).
    velocity: (2, T, c, n, n), length per time, in the frame of the mean motion.
    dilation: (T, c, n, n), trace of the strain.
    growth: (T, c, n, n), the wave c.
    mirrored: the cells cover x >= 0 of a motion that is mirror symmetric in x.
    """

    position: Array
    area: Array
    velocity: Array
    dilation: Array
    growth: Array
    mirrored: bool = False


def rectangle_cells(
    sheet: Sheet, cells: tuple[int, int], order: int, half: bool
) -> tuple[Array, Array, Array]:
    """Gauss points of a grid of equal cells: x, y (broadcast to (cells, n, n)) and their `area`.

    x has shape (cells, n, 1) and y (cells, 1, n): the first local axis runs across the sheet.
    """
    across, along = cells
    nodes, _ = np.polynomial.legendre.leggauss(order)
    left = 0.0 if half else -sheet.width / 2
    dx, dy = (sheet.width / 2 - left) / across, sheet.length / along
    column, row = np.divmod(np.arange(across * along), along)
    x = left + dx * (column[:, None] + (nodes + 1) / 2)
    y = -sheet.length / 2 + dy * (row[:, None] + (nodes + 1) / 2)
    area = np.full((across * along, order, order), dx * dy / 4)
    return x[:, :, None], y[:, None, :], area

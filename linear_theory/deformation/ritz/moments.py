"""Integrals of growth fields times products of Legendre polynomials."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.ritz import legendre
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


def gauss_moments(
    sheet: Sheet, counts: tuple[int, int], growths: Callable[[Array, Array], Array]
) -> Array:
    """Integrals of any growth fields times p_i(2x/W) p_j(2y/L) over [-1, 1]^2.

    growths: of x and y, (growths, *broadcast(x, y).shape). counts: of Gauss points and degrees. Returns
    (growths, *counts).
    """
    (x, weights_x), (y, weights_y) = (gauss_legendre(count) for count in counts)
    across = legendre.orthonormal(counts[0], x) * weights_x[:, None]
    along = legendre.orthonormal(counts[1], y) * weights_y[:, None]
    growth = growths(x[:, None] * sheet.width / 2, y * sheet.length / 2)
    return np.asarray(across.T @ growth @ along)

"""Gauss-Legendre quadrature: the one place that its points and weights come from."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@lru_cache(maxsize=64)
def gauss_legendre(count: int) -> tuple[Array, Array]:
    """Points in (-1, 1), ascending, and weights, (count,) each, read-only.

    Exact for polynomials up to degree 2 count - 1. Raises ValueError for a count < 1.

    >>> from linear_theory.common.quadrature import gauss_legendre
    >>> points, weights = gauss_legendre(3)
    >>> print(f"integral of x^4 over (-1, 1): {weights @ points**4:.3f}")
    integral of x^4 over (-1, 1): 0.400
    """
    points, weights = np.polynomial.legendre.leggauss(count)
    for array in (points, weights):
        array.setflags(write=False)
    return points, weights

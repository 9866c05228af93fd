"""Polynomials on [-1, 1] for plates: Legendre polynomials integrated twice.

    psi_0 = p_0,  psi_1 = p_1,  psi_d = double integral of p_{d-2} = s_{d-1} phi_d - s_{d-2} phi_{d-2},

with p_d, phi_d and s_d as in `ritz.legendre`. Their second derivatives p_{d-2} are orthonormal, so that
the matrix of the bending energy is well conditioned, where that of the p_d has a condition number of
order degree^8.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.ritz import legendre

Array = NDArray[np.float64]


class Basis(NamedTuple):
    """Legendre coefficients of psi_0 ... psi_{count-1} and of their derivatives, (count, count) each.

    Column d belongs to psi_d, row k to p_k.
    """

    values: Array
    slopes: Array
    curvatures: Array


@lru_cache(maxsize=64)
def twice_integrated(count: int) -> Basis:
    """The basis of the degrees below `count` (>= 3)."""
    degree = np.arange(count)
    s = np.concatenate([[1.0], 1 / np.sqrt((2 * degree[1:] - 1.0) * (2 * degree[1:] + 1.0))])
    once = np.zeros((count, count))  # column d: psi_d in the once integrated phi
    once[0, 0], once[1, 1] = 1.0, 1 / s[1]
    for d in range(2, count):
        once[d, d] = s[d - 1]
        if d > 2:
            once[d - 2, d] = -s[d - 2]
    values, slopes = legendre.values(once, 0), legendre.slopes(once, 0)
    curvatures = np.eye(count, k=2)
    for table in (values, slopes, curvatures):
        table.setflags(write=False)
    return Basis(values, slopes, curvatures)


@lru_cache(maxsize=64)
def derivative(count: int) -> Array:
    """Column n: Legendre coefficients of p_n', (count, count)."""
    k, n = np.indices((count, count))
    below = (n > k) & ((n - k) % 2 == 1)
    table = np.where(below, np.sqrt((2.0 * n + 1) * (2 * k + 1)), 0.0)
    table.setflags(write=False)
    return table

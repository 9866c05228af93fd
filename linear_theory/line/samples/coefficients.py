"""V_1 and V_2 in V = V_1 alpha + V_2 alpha^2 of a wave that is sampled, under dry and viscous friction.

With g_1 = int c_t, g_2 = int 2 c c_t, both less their means, m_0 the median of g_1, f its density there
and E_0 the mean over the places where g_1 = m_0,

    V = -alpha m_0 + alpha^2 (p E[c (1(g_1 < m_0) - share)]/f - s_2 E_0[g_2]) + ...

all of them weighted with the map of friction, if there is one.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory.line.piece import Piece
from linear_theory.line.samples.piecewise import (
    cell_means,
    density_at,
    less_mean,
    mean_at,
    weighted_quantile,
)

Array = NDArray[np.float64]


def dry_coefficients(
    c: Array, rate: Array, growth: Piece, share: float, mu: Array
) -> tuple[Array, Array]:
    """Of V = V1 alpha + V2 alpha^2, as in the module's head, each (times,); mu: (times, cells)."""
    g, mean_growth = less_mean(rate), cell_means(c)
    level, below = weighted_quantile(g, mu / mu.shape[1], share)
    density = mu * density_at(g, level)
    weighed = np.mean(mu * mean_growth * (below - share), axis=1) / density.sum(axis=1)
    second = growth.power * weighed
    if growth.curvature:
        second = second - growth.curvature * mean_at(less_mean(2 * c * rate), g, level, density)
    return -level, second


def viscous_coefficients(c: Array, rate: Array, growth: Piece, mu: Array) -> tuple[Array, Array]:
    """Of alpha and alpha^2: minus the mean of v weighted with mu (1 + p alpha c), each (times,)."""
    share = mu / mu.sum(axis=1, keepdims=True)

    def mean(values: Array) -> Array:
        return np.asarray(np.sum(share * values, axis=1))

    g, middle = cell_means(less_mean(rate)), cell_means(c)
    level = mean(g)
    second = -growth.power * mean(middle * (g - level[:, None]))
    if growth.curvature and np.ptp(mu) > 0:  # else v_2 has no mean
        second = second - growth.curvature * mean(cell_means(less_mean(2 * c * rate)))
    return -level, second

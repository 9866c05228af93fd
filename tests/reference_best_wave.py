"""The best wave on dry ground as a linear program: literal, and independent of the gradient."""

import numpy as np
from scipy.optimize import linprog


def best_of_one_arc(harmonics, points=32):
    """Largest median c - mean c of waves with |c| <= 1, c at or above its median on one half period.

    That half is centred at phase 0, and the wave even (the mean of a wave and its mirror image is as
    good): c = sum_k a_k cos k phi and m are the unknowns of a linear program on a grid. Returns its
    optimum, too high by the grid, and that of the wave it finds scaled to |c| <= 1, too low.
    """
    phase = np.linspace(0, np.pi, points * harmonics // 2 + 1)
    basis = np.cos(np.outer(phase, np.arange(harmonics + 1)))
    upper = basis[phase <= np.pi / 2 + 1e-12]
    none, ones = np.zeros((len(phase), 1)), np.ones((len(upper), 1))
    rows = np.block([[basis, none], [-basis, none], [-upper, ones]])
    limits = np.concatenate([np.ones(2 * len(phase)), np.zeros(len(upper))])
    cost = np.zeros(harmonics + 2)
    cost[0], cost[-1] = 1, -1
    found = linprog(cost, rows, limits, bounds=[(None, None)] * (harmonics + 2), method="highs")
    return -found.fun, _value(found.x[:-1])


def _value(cosine):
    phase = (np.arange(40000) + 0.5) / 40000 * np.pi
    c = np.cos(np.outer(phase, np.arange(len(cosine)))) @ cosine
    return (np.median(c) - cosine[0]) / abs(c).max()


def first_order(cosine, sine, points=20001):
    """(median c - mean c)/max |c| of a wave, from many samples."""
    k = np.arange(1, len(cosine) + 1)
    angle = np.outer(2 * np.pi / points * np.arange(points), k)
    g = np.cos(angle) @ cosine + np.sin(angle) @ sine
    return np.median(g), g

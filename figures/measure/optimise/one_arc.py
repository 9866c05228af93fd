"""The best wave on dry ground as a linear program, independent of speeds and gradients."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from linear_theory import TravellingWave

Array = NDArray[np.float64]

POINTS = 32
"""Phases of the program to a wavelength of the highest harmonic."""

FINE = 40000
"""Phases at which the wave that it finds is valued, over half a period."""


class Range(NamedTuple):
    """Of a maximum: found on the grid, and had by a wave."""

    most: float
    reached: float


def best_of_one_arc(harmonics: int) -> Range:
    """Largest median c - mean c of waves with |c| <= 1 that are at or above their median on one half of
    the period, in one piece.

    The optimum of the linear program is too high, as between the phases of its grid nothing is asked;
    the wave that it finds, scaled to |c| <= 1, is a wave. That waves of several pieces are no better is
    found, not proved.
    """
    found = _program(harmonics)
    return Range(-float(found.fun), _value(found.x[:-1]))


def wave_of_one_arc(harmonics: int) -> TravellingWave:
    """The wave that has it, with a largest |c| of 1; above its median for |phi| < pi/2.

    >>> from figures.measure.optimise.one_arc import wave_of_one_arc
    >>> wave = wave_of_one_arc(2)
    >>> print(round(abs(wave.profile(0.0)), 2), wave.cosine.round(2))  # a dent in the middle
    0.78 [ 0.89 -0.44]
    """
    cosine = _program(harmonics).x[:-1]
    cosine = cosine / abs(_profile(cosine)).max()
    return TravellingWave(cosine[1:], np.zeros(harmonics), mean=float(cosine[0]))


def _program(harmonics: int) -> Any:
    """The half above the median is centred at phase 0, and the wave even (the mean of a wave and its
    mirror image is as good): c = sum_k a_k cos k phi and m are the unknowns, on a grid."""
    phase = np.linspace(0, np.pi, POINTS * harmonics // 2 + 1)
    basis = np.cos(np.outer(phase, np.arange(harmonics + 1)))
    upper = basis[phase <= np.pi / 2 + 1e-12]
    none, ones = np.zeros((len(phase), 1)), np.ones((len(upper), 1))
    rows = np.block([[basis, none], [-basis, none], [-upper, ones]])
    limits = np.concatenate([np.ones(2 * len(phase)), np.zeros(len(upper))])
    cost = np.zeros(harmonics + 2)
    cost[0], cost[-1] = 1, -1
    return linprog(cost, rows, limits, bounds=[(None, None)] * (harmonics + 2), method="highs")


def _value(cosine: Array) -> float:
    """(median c - mean c)/max |c|, from many samples."""
    c = _profile(cosine)
    return float((np.median(c) - cosine[0]) / abs(c).max())


def _profile(cosine: Array) -> Array:
    """Many samples over half a period."""
    phase = (np.arange(FINE) + 0.5) / FINE * np.pi
    return np.asarray(sum(a * np.cos(k * phase) for k, a in enumerate(cosine)))

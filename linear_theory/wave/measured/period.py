"""The period of samples, where it is not given: the one of the best fit by a few harmonics.

Fits by three harmonics and low degrees are tried at all periods that the samples could show, the best
ones refined. Of periods that fit alike (2 T and 3 T fit what T does) the shortest is taken, and refined
again with the functions that the wave is then fitted by. Its error is that of least squares: var(T) =
2 noise^2/S'' with the sum S of the squares of what is left.
"""

import math

import numpy as np
from numpy.typing import NDArray

from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]

HARMONICS, DEGREE = 3, 6
MOST_SAMPLES, MOST_REFINING = 1500, 3000
PER_CYCLE, MOST_CYCLES = 8, 150
"""Periods tried, to a cycle more or less in the time of the samples, and cycles at the most."""

WITHIN = 4
"""Part of a cycle of the highest harmonic by which a period is refined, at the end of the samples."""

BEST, ALIKE = 8, 1.5
"""Fits that are refined, and the ratio of sums of squares up to which they count as alike."""

EXACT = 1e-8
"""Relative error of the best fit of samples without noise: S is flat at its minimum."""


def estimated(samples: Samples) -> float:
    """The period by few functions. Raises ValueError where the samples show none."""
    some = samples.some(MOST_SAMPLES)
    times = np.unique(some.t)
    span = float(times[-1] - times[0])
    most = min((times.size - 1) / (2 * HARMONICS + 1), MOST_CYCLES)
    if most < 1:
        raise ValueError(
            f"t has {times.size} different times: must be >= {2 * HARMONICS + 2} to find the period; "
            "give period=..."
        )
    cycles = np.arange(1.0, most, 1 / PER_CYCLE)
    degree = min(DEGREE, np.unique(some.y).size // 2)
    basis = Basis.over(some, span, HARMONICS, (0 if some.x is None else 2, degree))
    left = _Left(some, basis)
    sums = np.array([left(n) for n in cycles])
    padded = np.concatenate([[math.inf], sums, [math.inf]])
    low = np.flatnonzero((sums <= padded[:-2]) & (sums <= padded[2:]))
    low = low[np.argsort(sums[low])][:BEST]
    found = [_refined(left, cycles[i], 1 / PER_CYCLE) for i in low]
    least = min(square for _, square in found)
    total = float(np.sum((some.c - some.c.mean()) ** 2))
    if not least < total / 2:
        raise ValueError("t, c: no period is seen in the samples; give period=...")
    best = max(n for n, square in found if square <= ALIKE * least + 1e-18 * total)
    return span / best


def refined(samples: Samples, basis: Basis) -> tuple[float, float]:
    """The period near that of a basis with which it fits best, and its standard error."""
    left = _Left(samples.some(MOST_REFINING), basis)
    step = basis.period / (WITHIN * basis.harmonics * float(np.ptp(samples.t)))
    cycles, _ = _refined(left, 1.0, step)
    return basis.period / cycles, _error(left, cycles, 1e-2 * step, samples.size)


class _Left:
    """Sum of the squares that a fit leaves with a basis whose period is shorter by a factor."""

    def __init__(self, samples: Samples, basis: Basis) -> None:
        self.samples, self.basis = samples, basis

    def __call__(self, factor: float) -> float:
        basis, c = self.basis.lasting(self.basis.period / factor), self.samples.c
        q, _ = np.linalg.qr(basis.columns(self.samples))
        return float(np.sum((c - q @ (q.T @ c)) ** 2))


def _refined(left: _Left, factor: float, step: float) -> tuple[float, float]:
    from scipy.optimize import minimize_scalar  # here: scipy takes long to import

    bounds = factor - step, factor + step
    found = minimize_scalar(left, bounds=bounds, method="bounded", options={"xatol": 1e-6 * step})
    return float(found.x), float(found.fun)


def _error(left: _Left, factor: float, step: float, count: int) -> float:
    """Standard error of the period; count: samples in all."""
    square, (ahead, behind) = left(factor), (left(factor + step), left(factor - step))
    bend = max(ahead + behind - 2 * square, 1e-300) / step**2
    noise = square / max(left.samples.size - left.basis.size, 1)
    error = math.sqrt(2 * noise / bend * left.samples.size / count) / factor
    return max(error, EXACT) * left.basis.period / factor

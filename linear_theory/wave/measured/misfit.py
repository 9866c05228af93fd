"""Whether what a fit leaves is noise, or a part of the wave that it missed.

Errors of independent samples are independent. Where what is left at a sample is more like what is left
at its nearest neighbour (in place and phase) than chance allows, it is not noise alone: half the
mean square of the difference is the variance of the noise, the rest belongs to the wave. The more
of what varies a fit leaves, the more it is suspected: where it leaves most, all counts as missed that
chance allows.

A fit with a function for each phase, or place, leaves nothing and may yet miss what would come next:
that is taken to go on as the last harmonics, or degrees, of the fit do.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.fit import Fit, fitted
from linear_theory.wave.measured.samples import Samples
from linear_theory.wave.measured.scores import SAME_PHASE

Array = NDArray[np.float64]

MOST_SAMPLES = 6000
"""Between which neighbours are looked for."""

CHANCE = 2.0
"""Standard errors of the share that neighbours have in common, below which it counts as 0."""

MOST_OF = 0.5
"""Share of the variance in time."""

PLACES = 9
"""Decimals of phases and places between which neighbours are looked for."""

EXACT = 1e-12
"""Noise over the size of c that is roundoff."""


@dataclass(frozen=True, eq=False)
class Misfit(Shown):
    """Root mean squares: varying, of what of c varies in time; left, of what the fit leaves of that;
    missed, of the part of it that neighbouring samples have in common, and of what would come next."""

    varying: float
    left: float
    missed: float

    @classmethod
    def of(cls, samples: Samples, fit: Fit) -> "Misfit":
        """Of a fit to samples."""
        varying = fitted(samples, fit.basis.but(0, fit.basis.degree)).noise
        found = cls(varying, fit.noise, 0.0)
        common = _common(samples.some(MOST_SAMPLES), fit, min(found.dropped / MOST_OF, 1.0))
        return cls(varying, fit.noise, math.hypot(common, _next(samples, fit)))

    @property
    def dropped(self) -> float:
        """Share of the variance in time that the fit leaves."""
        return (self.left / self.varying) ** 2 if self.varying else 0.0


def _common(samples: Samples, fit: Fit, suspicion: float) -> float:
    """Root mean square of what nearest neighbours have in common, of what is left.

    suspicion: 0 where only what is surely no chance counts, to 1 where all counts that chance allows.
    """
    if fit.noise <= EXACT * math.sqrt(float(np.mean(samples.c**2))):
        return 0.0
    share, chance = 1 - _pure(samples, fit) / fit.noise**2, CHANCE * math.sqrt(3 / samples.size)
    sure, possible = share if share > chance else 0.0, suspicion * (share + chance)
    return fit.noise * math.sqrt(min(max(sure, possible), 1.0))


def _pure(samples: Samples, fit: Fit) -> float:
    """Variance of the noise by differences of what is left at nearest neighbours.

    The fit takes a part h of the noise of a sample along, its leverage, and of that of its neighbour:
    what is left has covariance noise^2 (1 - H), with H = Q Q^T of the orthogonal columns Q.
    """
    from scipy.linalg import solve_triangular  # here: scipy takes long to import

    near, left = _nearest(samples, fit.basis), samples.c - fit.values(samples)
    q = solve_triangular(fit.factor, fit.basis.columns(samples).T, trans="T")
    taken = np.sum((q - q[:, near]) ** 2, axis=0)
    return float(np.sum((left - left[near]) ** 2) / np.sum(np.maximum(2 - taken, 0)))


def _next(samples: Samples, fit: Fit) -> float:
    """Root mean square of the next harmonic and next degrees, where no residual could show them."""
    squares = fit.coefficients**2
    squares[1:] /= 2  # the mean of a cosine
    sums = [np.sum(squares, axis=axes) for axes in ((1, 2), (0, 2), (0, 1))]
    sums[0] = sums[0][1:].reshape(-1, 2).sum(axis=1)
    phases = np.mod(np.round(samples.t / fit.basis.period / SAME_PHASE), round(1 / SAME_PHASE))
    known = [0 if v is None else np.unique(v).size for v in (phases, samples.x, samples.y)]
    known[0] -= 1 - known[0] % 2  # of an even number, the last is half a harmonic
    full = (1 < functions >= count for functions, count in zip(fit.basis.shape, known, strict=True))
    return math.sqrt(sum(_continued(of) for of, is_full in zip(sums, full, strict=True) if is_full))


def _continued(squares: Array) -> float:
    """What follows: less than the last by as much as that is less than the two before, or the same."""
    last, before = float(squares[-1]), float(squares[-3:-1].max(initial=0.0))
    return last * min(last / before, 1.0) if before else last


def _nearest(samples: Samples, basis: Basis) -> NDArray[np.intp]:
    """The nearest other sample of each, a period and the ranges of x and y being of length 1."""
    from scipy.spatial import cKDTree  # here: scipy takes long to import

    angle = 2 * np.pi / basis.period * samples.t
    places = [np.cos(angle) / (2 * np.pi), np.sin(angle) / (2 * np.pi), samples.y / np.ptp(basis.along)]
    if samples.x is not None:
        places.append(samples.x / np.ptp(basis.across))
    # Rounding in other units must not tell which of two equally near samples is taken.
    points = np.round(np.stack(places, axis=1), PLACES)
    near = cKDTree(points).query(points, k=2)[1]
    itself = near[:, 0] == np.arange(samples.size)  # of equal places any one comes first
    return np.where(itself, near[:, 1], near[:, 0])

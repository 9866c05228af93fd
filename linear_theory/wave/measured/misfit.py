"""Whether what a fit leaves is noise, or a part of the wave that it missed.

Errors of independent samples are independent. Where what is left at a sample is more like what is left
at its nearest neighbour (in place and phase) than chance allows, it is not noise alone: half the
mean square of the difference is the variance of the noise, the rest belongs to the wave. The more
of what varies a fit leaves, the more it is suspected: where it leaves most, all counts as missed that
chance allows.

A fit with as many functions as samples can tell may leave nothing and yet miss what would come next:
that is taken to be as large as the last harmonic, or degree, of the fit.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.bounds import Numbers
from linear_theory.wave.measured.fit import Fit, fitted
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]

MOST_SAMPLES = 20_000
"""Between which neighbours are looked for."""

CHANCE = 2.0
"""Standard errors of the share that neighbours have in common, below which it counts as 0."""

MOST_OF = 0.5
"""Share of the variance in time."""

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
    def of(cls, samples: Samples, fit: Fit, largest: Numbers) -> "Misfit":
        """Of a fit to samples, which can tell functions up to the `largest` numbers."""
        varying = fitted(samples, fit.basis.but(0, fit.basis.degree)).noise
        found = cls(varying, fit.noise, 0.0)
        common = _common(samples.some(MOST_SAMPLES), fit, min(found.dropped / MOST_OF, 1.0))
        return cls(varying, fit.noise, math.hypot(common, _next(fit, largest)))

    @property
    def dropped(self) -> float:
        """Share of the variance in time that the fit leaves."""
        return (self.left / self.varying) ** 2 if self.varying else 0.0


def _common(samples: Samples, fit: Fit, suspicion: float) -> float:
    """Root mean square of what nearest neighbours have in common, of what is left.

    suspicion: 0 where only what is surely no chance counts, to 1 where all counts that chance allows.
    """
    left = samples.c - fit.values(samples)
    if fit.noise <= EXACT * math.sqrt(float(np.mean(samples.c**2))):
        return 0.0
    pure = np.mean((left - left[_nearest(samples, fit.basis)]) ** 2) / 2
    share, chance = 1 - float(pure) / fit.noise**2, CHANCE * math.sqrt(3 / samples.size)
    sure, possible = share if share > chance else 0.0, suspicion * (share + chance)
    return fit.noise * math.sqrt(min(max(sure, possible), 1.0))


def _next(fit: Fit, largest: Numbers) -> float:
    """Root mean square of the last harmonic and of the last degrees, where samples can tell no more."""
    squares, square = fit.coefficients**2, 0.0
    squares[1:] /= 2  # the mean of a cosine
    numbers = (fit.basis.harmonics, *fit.basis.degree)
    for axis, (number, top) in enumerate(zip(numbers, largest, strict=True)):
        if number and number == top:
            last = squares[-2:] if axis == 0 else squares.take(-1, axis)
            square += float(last.sum())
    return math.sqrt(square)


def _nearest(samples: Samples, basis: Basis) -> NDArray[np.intp]:
    """The nearest other sample of each, a period and the ranges of x and y being of length 1."""
    from scipy.spatial import cKDTree  # here: scipy takes long to import

    angle = 2 * np.pi / basis.period * samples.t
    places = [np.cos(angle) / (2 * np.pi), np.sin(angle) / (2 * np.pi), samples.y / np.ptp(basis.along)]
    if samples.x is not None:
        places.append(samples.x / np.ptp(basis.across))
    points = np.stack(places, axis=1)
    near = cKDTree(points).query(points, k=2)[1]
    itself = near[:, 0] == np.arange(samples.size)  # of equal places any one comes first
    return np.where(itself, near[:, 1], near[:, 0])

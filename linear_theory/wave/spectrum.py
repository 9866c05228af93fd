"""Series expansions of functions of one variable, from samples, checked at random points.

A series of N terms interpolates samples of any function at N points. Whether it represents the function
is checked at other, random points, where aliases and features finer than the samples show.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown

Array = NDArray[np.float64]
Function = Callable[[Array], Array]
"""Several functions at once: values (n, lines) at points (n,)."""

RESOLVED, ROUNDOFF = 1e-9, 1e-13
"""Largest negligible root-mean-square error of a series, relative to that of the function without its
mean, and to its largest value."""


@dataclass(frozen=True, eq=False)
class Spectrum(Shown):
    """sizes (K,): root mean squares of the terms 1 ... K of a series; missed: of the remainder."""

    sizes: Array
    missed: float

    @property
    def total(self) -> float:
        """Root mean square of all but the constant term."""
        return float(self._beyond[0])

    def beyond(self, term: float) -> float:
        """Root mean square of the terms above `term`, with the remainder."""
        return float(self._beyond[min(max(int(term), 0), self.sizes.size)])

    def needed(self, size: float) -> float:
        """The term beyond which the root mean square is at most `size`; inf if unknown."""
        enough = np.flatnonzero(self._beyond <= size)
        return float(max(enough[0], 1)) if enough.size else math.inf

    def highest(self, share: float) -> float:
        """The term beyond which at most that fraction of the total is left; inf if unknown."""
        return self.needed(share * self.total)

    def of_rates(self, period: float) -> "Spectrum":
        """The spectrum of the time derivative, for terms that are harmonics of that period."""
        frequency, harmonics = 2 * np.pi / period, np.arange(1, self.sizes.size + 1)
        missed = frequency * (self.sizes.size + 1) * self.missed
        return Spectrum(frequency * harmonics * self.sizes, missed)

    @cached_property
    def _beyond(self) -> Array:
        """Root mean squares above term 0, 1, ..., K, (K + 1,)."""
        squares = np.cumsum(np.append(self.missed, self.sizes[::-1]) ** 2)
        return np.sqrt(squares[::-1])


def fourier(function: Function, checks: Array, fewest: int, most: int) -> Spectrum:
    """Harmonics of functions of period 1; checks: random points (n,); fewest, most: sample counts."""
    known, tolerance = _checked(function, checks)
    count = fewest
    values = function(np.arange(count) / count)
    while True:
        terms = np.fft.rfft(values, axis=0)[: count // 2] / count
        turns = np.exp(2j * np.pi * np.multiply.outer(checks, np.arange(1, count // 2)))
        missed = _rms(terms[0].real + 2 * (turns @ terms[1:]).real - known)
        if missed <= tolerance or count >= most:
            break
        between = function((np.arange(count) + 0.5) / count)
        values = np.stack([values, between], 1).reshape(2 * count, -1)
        count *= 2
    sizes = np.sqrt(2 * np.mean(abs(terms[1:]) ** 2, axis=1))
    return Spectrum(sizes, 0.0 if missed <= tolerance else missed)


def chebyshev(function: Function, checks: Array, fewest: int, most: int) -> Spectrum:
    """Chebyshev expansion of functions on [-1, 1]; arguments as for `fourier`."""
    from scipy.fft import dct  # here: scipy takes long to import

    known, tolerance = _checked(function, checks)
    count = fewest
    while True:
        nodes = np.cos(np.pi * (np.arange(count) + 0.5) / count)
        terms = dct(function(nodes), axis=0) / count
        terms[0] /= 2
        found = np.polynomial.chebyshev.chebval(checks, terms).T
        missed = _rms(found - known)
        if missed <= tolerance or count >= most:
            break
        count *= 2
    sizes = np.sqrt(np.mean(terms[1:] ** 2, axis=1) / 2)
    return Spectrum(sizes, 0.0 if missed <= tolerance else missed)


def _checked(function: Function, checks: Array) -> tuple[Array, float]:
    """Values at the check points, and the largest negligible deviation from them."""
    known = function(checks)
    varying = float(np.sqrt(np.mean(np.var(known, axis=0))))
    return known, max(RESOLVED * varying, ROUNDOFF * float(abs(known).max()))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))

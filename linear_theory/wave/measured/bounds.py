"""How many functions samples can tell at all: a fit must not swing wider between them than at them."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]
Numbers = tuple[int, int, int]
"""Harmonics, degree across, degree along."""

MOST = 48
"""Harmonics, and degrees, at the most."""

BETWEEN = 25.0
"""Variance of a fit between samples over that of one sample, at the most; at samples it is below 1."""

STATIONS, FINER = 400, 8
"""Different coordinates that are looked at, and places in each gap between them."""


def most(samples: Samples, period: float) -> Numbers:
    """The largest numbers that the samples can tell."""
    phases = np.unique(np.mod(samples.t / period, 1.0))
    across = 0 if samples.x is None else _largest_degree(np.unique(samples.x))
    return _largest_harmonic(phases), across, _largest_degree(np.unique(samples.y))


def _largest_harmonic(phases: Array) -> int:
    around = _thinned(np.append(phases, phases[0] + 1))
    known, fine = around[:-1], _between(around)
    basis = Basis(1.0, min(MOST, (known.size - 1) // 2), (0, 0), (-1, 1), (-1, 1))
    return (_tame(basis.times(known), basis.times(fine)) - 1) // 2


def _largest_degree(places: Array) -> int:
    known = _thinned(places)
    degree = min(MOST, known.size - 1)
    basis = Basis(1.0, 0, (0, degree), (-1, 1), (float(known[0]), float(known[-1])))
    return max(_tame(*(basis.polynomials(0.0, at)[1] for at in (known, _between(known)))) - 1, 0)


def _thinned(places: Array) -> Array:
    if places.size <= STATIONS:
        return places
    return places[np.linspace(0, places.size - 1, STATIONS).astype(int)]


def _between(places: Array) -> Array:
    """Places in all gaps."""
    gaps = np.arange(FINER * (places.size - 1) + 1) / FINER
    return np.interp(gaps, np.arange(places.size), places)


def _tame(at: Array, between: Array) -> int:
    """How many of the first functions make a fit that does not swing between samples."""
    r = np.linalg.qr(at).R
    safe = abs(np.diag(r)) > 1e-8 * np.sqrt(len(at))
    count = int(np.argmin(safe)) if not safe.all() else safe.size
    fine = np.linalg.solve(r[:count, :count].T, between[:, :count].T)
    tame = np.cumsum(fine**2, axis=0).max(axis=1) <= BETWEEN
    return int(np.argmin(tame)) if not tame.all() else count

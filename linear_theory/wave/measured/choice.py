"""How many harmonics and which degrees samples and their noise allow.

Two bounds hold for each. What the samples can tell at all: a fit must not swing wider between them than
at them (`most`). What the noise leaves: the least squares of what a fit to all samples but one is off
at that one, over all of them (leave-one-out cross-validation; n fits in one by the leverages h of the
samples, (r/(1 - h))^2 of the residuals r). Harmonics and degrees are swept in turn until none changes.
"""

import math

import numpy as np
from numpy.typing import NDArray

from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]
Numbers = tuple[int, int, int]
"""Harmonics, degree across, degree along."""

MOST = 48
"""Harmonics, and degrees, at the most."""

MOST_SAMPLES, MOST_FUNCTIONS = 6000, 600
"""With which numbers are chosen: a random choice of many samples will do."""

BETWEEN = 25.0
"""Variance of a fit between samples over that of one sample, at the most; at samples it is below 1."""

STATIONS, FINER = 400, 8
"""Different coordinates that are looked at, and places in each gap between them."""

ROUNDS = 6

LEAST_GAIN = 1e-3
"""By which more functions must lower the score to be taken: less is chance."""

ROUNDOFF = 1e-14
"""Of the largest c."""


def chosen(samples: Samples, period: float, asked: tuple[int | None, ...]) -> Numbers:
    """Numbers of functions; asked: those that are given already, else None."""
    largest = most(samples, period)
    numbers = _first(asked, largest)
    free = [axis for axis in (0, 2, 1) if asked[axis] is None and largest[axis]]
    some = samples.some(MOST_SAMPLES)
    for _ in range(ROUNDS):
        before = list(numbers)
        for axis in free:
            numbers[axis] = _best(some, period, numbers, axis, largest[axis])
        if numbers == before:
            break
    return numbers[0], numbers[1], numbers[2]


def _first(asked: tuple[int | None, ...], largest: Numbers) -> list[int]:
    """Degrees with which harmonics are chosen first: high, with room for some harmonics beside them."""
    harmonics, across, along = (
        n if n is not None else top for n, top in zip(asked, largest, strict=True)
    )
    if asked[1] is None:
        across = min(across, 3)
    if asked[2] is None:
        along = min(along, max(MOST_FUNCTIONS // (7 * (across + 1)) - 1, 1))
    return [harmonics, across, along]


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


def _best(samples: Samples, period: float, numbers: list[int], axis: int, largest: int) -> int:
    """The number along one axis, the others being as they are, of least score."""
    sizes = [2 * numbers[0] + 1, numbers[1] + 1, numbers[2] + 1]
    inner = math.prod(size for i, size in enumerate(sizes) if i != axis)
    room = max(min(MOST_FUNCTIONS, samples.size // 2) // inner, 1)
    top = min(largest, (room - 1) // 2 if axis == 0 else room - 1)
    numbers = [top if i == axis else n for i, n in enumerate(numbers)]
    basis = Basis.over(samples, period, numbers[0], (numbers[1], numbers[2]))
    factors = list(basis.factors(samples))
    outer = factors.pop(axis)
    columns = np.einsum("no,ni,nj->noij", outer, *factors).reshape(samples.size, -1)
    step = 2 if axis == 0 else 1
    scores = _scores(columns, samples.c, [inner * (1 + step * n) for n in range(top + 1)])
    floor = (ROUNDOFF * abs(samples.c).max()) ** 2
    return int(np.argmax(scores <= scores.min() * (1 + LEAST_GAIN) + floor))


def _scores(columns: Array, c: Array, counts: list[int]) -> Array:
    """Mean squares of what fits by the first `counts` of columns are off at a sample left out."""
    q, _ = np.linalg.qr(columns)
    residual, leverage, start, found = c.copy(), np.zeros(c.size), 0, []
    for count in counts:
        part = q[:, start:count]
        residual = residual - part @ (part.T @ residual)
        leverage, start = leverage + np.sum(part**2, axis=1), count
        found.append(np.mean((residual / np.maximum(1 - leverage, 1e-9)) ** 2))
    return np.array(found)

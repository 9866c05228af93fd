"""How many harmonics and which degrees samples and their noise allow.

Two bounds hold for each. What the samples can tell at all (`bounds`). What the noise leaves: the least
leave-one-out score (`scores`). That has local minima: a wave that grows along the sheet is nothing that
a harmonic of degree 0 could fit, nor a degree without a harmonic. So the score is first found on a
coarse grid of all numbers together, with few of the samples; from the best places on it, numbers are
swept in turn until none changes; from the least of these minima, again with many samples.
"""

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.progress import track
from linear_theory.wave.measured.bounds import MOST, Numbers, most
from linear_theory.wave.measured.samples import Samples
from linear_theory.wave.measured.scores import Merged

Array = NDArray[np.float64]

MOST_SAMPLES, MOST_FUNCTIONS = 6000, 600
"""With which numbers are chosen: a random choice of many samples will do."""

COARSE_SAMPLES, COARSE_FUNCTIONS = 1000, 240
"""With which the coarse grid is looked at, and swept."""

LADDER = (0, 1, 2, 3, 4, 5, 6, 8, 10, 13, 17, 22, 28, 36, MOST)
"""Numbers on it."""

STARTS, ROUNDS = 3, 6
"""Places on the grid from which numbers are swept, and sweeps of each."""

LEAST_GAIN = 1e-3
"""By which more functions must lower the score to be taken: less is chance."""

ROUNDOFF = 1e-14
"""Of the largest c."""

Data = tuple[Merged, int]
"""Samples, and functions at the most."""


class Scored(NamedTuple):
    """Numbers of functions and their score."""

    score: float
    numbers: Numbers

    @property
    def functions(self) -> int:
        """In all."""
        harmonics, across, along = self.numbers
        return (2 * harmonics + 1) * (across + 1) * (along + 1)


def chosen(samples: Samples, period: float, asked: tuple[int | None, ...]) -> Numbers:
    """Numbers of functions; asked: those that are given already, else None."""
    largest = most(samples, period)
    free = [axis for axis in (2, 0, 1) if asked[axis] is None and largest[axis]]
    fixed = [0 if n is None else n for n in asked]
    if not free:
        return fixed[0], fixed[1], fixed[2]
    search = _Search(Merged.of(samples, period), period, largest, free)
    starts = track("measured wave: sweeping them", search.starts(fixed))
    found = search.least([search.swept(start, search.few) for start in starts])
    return search.swept(found, search.many).numbers


class _Search:
    """Of the numbers of least score; free: axes that are to be found."""

    def __init__(self, data: Merged, period: float, largest: Numbers, free: list[int]) -> None:
        self.few = data.some(COARSE_SAMPLES), COARSE_FUNCTIONS
        self.many = data.some(MOST_SAMPLES), MOST_FUNCTIONS
        self.period, self.largest, self.free = period, largest, free
        self.floor = (ROUNDOFF * abs(data.samples.c).max()) ** 2
        self._lines: dict[tuple[bool, int, tuple[int, ...]], tuple[float, int]] = {}

    def least(self, found: list[Scored]) -> Scored:
        """The one of least score; of those that score alike the one of fewest functions."""
        bound = min(one.score for one in found) * (1 + LEAST_GAIN) + self.floor
        return min((one for one in found if one.score <= bound), key=lambda one: one.functions)

    def starts(self, fixed: list[int]) -> list[Scored]:
        """The best on the coarse grid, each with another number on its first ladder."""
        line, *others = self.free
        ladders = [[n for n in LADDER if n <= self.largest[axis]] for axis in others]
        best: dict[int, list[Scored]] = {}
        for rungs in track("measured wave: looking for its numbers", [*itertools.product(*ladders)]):
            numbers = list(fixed)
            for axis, rung in zip(others, rungs, strict=True):
                numbers[axis] = rung
            scored = self._line(self.few, numbers, line)
            best.setdefault(rungs[0] if rungs else 0, []).append(scored)
        return sorted(self.least(found) for found in best.values())[:STARTS]

    def swept(self, start: Scored, data: Data) -> Scored:
        """The minimum that is reached by one number after the other."""
        found = start
        for _ in range(ROUNDS):
            before = found.numbers
            for axis in self.free[1:] + self.free[:1]:
                found = self._line(data, list(found.numbers), axis)
            if found.numbers == before:
                break
        return found

    def _line(self, data: Data, numbers: list[int], axis: int) -> Scored:
        """The least along one axis, the other numbers being as they are.

        Kept, since sweeps from several starts meet, and each ends with lines that it has seen.
        """
        key = data is self.many, axis, tuple(n for i, n in enumerate(numbers) if i != axis)
        if key not in self._lines:
            samples, functions = data
            scores = samples.along(self.period, numbers, axis, self.largest[axis], functions)
            at = int(np.argmax(scores <= scores.min() * (1 + LEAST_GAIN) + self.floor))
            self._lines[key] = float(scores[at]), at
        score, numbers[axis] = self._lines[key]
        return Scored(score, (numbers[0], numbers[1], numbers[2]))

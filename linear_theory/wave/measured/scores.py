"""Leave-one-out scores of fits: the mean square of what they are off at a sample that they did not see.

n fits in one by the leverages h of the samples: (r/(1 - h))^2 of the residuals r. Samples at one place
and one phase of the period count as one, of their mean and their number: a fit that saw one of two
copies has seen the other.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]

SAME_PHASE = 1e-9
"""Of a period."""

SMALLEST_REST = 1e-9
"""Of 1 - leverage."""


@dataclass(frozen=True, eq=False)
class Merged(Shown):
    """Samples without copies; weights: roots of the numbers of those that were merged, of mean 1."""

    samples: Samples
    weights: Array

    @classmethod
    def of(cls, samples: Samples, period: float) -> "Merged":
        """One sample for each place and phase."""
        phase = np.mod(np.round(samples.t / period / SAME_PHASE), round(1 / SAME_PHASE))
        keys = [phase, samples.y] if samples.x is None else [phase, samples.y, samples.x]
        order = np.lexsort(keys)
        new = np.any([np.diff(key[order]) != 0 for key in keys], axis=0)
        starts = np.flatnonzero(np.concatenate([[True], new]))
        firsts = order[starts]
        if firsts.size == samples.size:
            return cls(samples, np.ones(samples.size))
        counts = np.diff(np.append(starts, samples.size))
        kept = samples.take(np.sort(firsts))
        at = np.argsort(firsts)
        means = (np.add.reduceat(samples.c[order], starts) / counts)[at]
        weights = np.sqrt(counts[at] / counts.mean())
        return cls(Samples(kept.x, kept.y, kept.t, means), weights)

    def some(self, most: int) -> "Merged":
        """At most so many of them, see `Samples.some`."""
        if self.samples.size <= most:
            return self
        places = self.samples.choice(most)
        return Merged(self.samples.take(places), self.weights[places])

    def along(
        self, period: float, numbers: Sequence[int], axis: int, largest: int, functions: int
    ) -> Array:
        """Scores for 0, 1, ... of one of the numbers (harmonics, degrees), the others as they are.

        Up to `largest`, and as far as a fit has no more than so many functions and half the samples.
        """
        sizes = [2 * numbers[0] + 1, numbers[1] + 1, numbers[2] + 1]
        inner = math.prod(size for i, size in enumerate(sizes) if i != axis)
        room = max(min(functions, self.samples.size // 2) // inner, 1)
        top = min(largest, (room - 1) // 2 if axis == 0 else room - 1)
        tops = [top if i == axis else n for i, n in enumerate(numbers)]
        factors = list(
            Basis.over(self.samples, period, tops[0], (tops[1], tops[2])).factors(self.samples)
        )
        outer = factors.pop(axis)
        columns = np.einsum("no,ni,nj->noij", outer, *factors).reshape(self.samples.size, -1)
        step = 2 if axis == 0 else 1
        return self._scores(columns, [inner * (1 + step * n) for n in range(top + 1)])

    def _scores(self, columns: Array, counts: list[int]) -> Array:
        """Of fits by the first `counts` of columns."""
        q, _ = np.linalg.qr(columns * self.weights[:, None])
        residual = self.samples.c * self.weights
        leverage, start, found = np.zeros(residual.size), 0, []
        for count in counts:
            part = q[:, start:count]
            residual = residual - part @ (part.T @ residual)
            leverage, start = leverage + np.sum(part**2, axis=1), count
            found.append(np.mean((residual / np.maximum(1 - leverage, SMALLEST_REST)) ** 2))
        return np.array(found)

"""A solution at kept times, and between them: quintic in time, elements of order two in
space."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.space import Space
from fem_check.excitable.system import System
from linear_theory.common import validation

Array = NDArray[np.float64]

SPACING = 0.5
"""Largest distance of kept times. Reaction has rates up to 1/2: the interpolation is good to 1e-8."""

HALVINGS = 14
"""Of the first interval: where a start has a slope at an edge, c changes with the root of time
there."""


def kept_times(until: float) -> Array:
    """Times from 0 to `until`, equidistant but for the first interval, which is graded."""
    even = np.linspace(0.0, until, max(2, int(np.ceil(until / SPACING)) + 1))
    first = even[1] * 0.5 ** np.arange(HALVINGS, 0, -1)
    return np.concatenate([even[:1], first, even[1:]])


@dataclass(frozen=True, eq=False)
class Record:
    """States (T, 2 n) of a system at `kept_times` (T,)."""

    system: System
    times: Array
    states: Array

    @property
    def space(self) -> Space:
        """The mesh."""
        return self.system.space

    @property
    def c(self) -> Array:
        """At times and nodes, (T, n)."""
        return self.states[:, : self.space.size]

    @cached_property
    def derivatives(self) -> tuple[Array, Array]:
        """dc/dt and d²c/dt² likewise."""
        return self.system.derivatives(self.times, self.states)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """c; x, y, t broadcast. Raises ValueError for times outside of the record."""
        return self._at(x, y, t, _values)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """dc/dt likewise."""
        return self._at(x, y, t, _rates)

    def _at(
        self, x: ArrayLike, y: ArrayLike, t: ArrayLike, weigh: "Callable[[Array, Array], Parts]"
    ) -> Array:
        x, y, t = (validation.real_array(n, v) for n, v in (("x", x), ("y", y), ("t", t)))
        nodes, shares = self.space.weights(x, y)
        before, s, step = self._steps(t)
        total: Array = np.zeros(np.broadcast_shapes(nodes.shape[1:], t.shape))
        for weight, order, after in weigh(s, step):
            field = (self.c, *self.derivatives)[order]
            values = sum(
                share * field[before + after, node] for node, share in zip(nodes, shares, strict=True)
            )
            total = total + weight * values
        return np.asarray(total)

    def _steps(self, t: Array) -> tuple[NDArray[np.int64], Array, Array]:
        """The kept time before, the fraction of the step that is over, and the step."""
        end = float(self.times[-1])
        slack = 1e-9 * end
        if t.size and (t.min() < -slack or t.max() > end + slack):
            worst = t.min() if t.min() < -slack else t.max()
            raise ValueError(
                f"t = {worst:g}: must be in 0 to {end:g}, for which the wave was solved; "
                "give a larger `until`"
            )
        before = np.searchsorted(self.times, t, side="right") - 1
        before = np.clip(before, 0, self.times.size - 2)
        step = self.times[before + 1] - self.times[before]
        return before, np.clip((t - self.times[before]) / step, 0, 1), step


Parts = tuple[tuple[Array, int, int], ...]
"""Weights, with the derivative (0, 1, 2) and the end of the step (0, 1) that they belong to."""


def _values(s: Array, h: Array) -> Parts:
    """Quintic Hermite interpolation at fractions s of a step h."""
    r, s3 = 1 - s, s**3
    r3 = r**3
    return (
        (r3 * (1 + 3 * s + 6 * s**2), 0, 0),
        (s3 * (1 + 3 * r + 6 * r**2), 0, 1),
        (h * r3 * s * (1 + 3 * s), 1, 0),
        (-h * s3 * r * (1 + 3 * r), 1, 1),
        (h**2 * r3 * s**2 / 2, 2, 0),
        (h**2 * s3 * r**2 / 2, 2, 1),
    )


def _rates(s: Array, h: Array) -> Parts:
    """Its derivative."""
    r = 1 - s
    jump = 30 * s**2 * r**2 / h
    return (
        (-jump, 0, 0),
        (jump, 0, 1),
        (r**2 * (1 + 2 * s - 15 * s**2), 1, 0),
        (s**2 * (1 + 2 * r - 15 * r**2), 1, 1),
        (h * r**2 * s * (2 - 5 * s) / 2, 2, 0),
        (-h * s**2 * r * (2 - 5 * r) / 2, 2, 1),
    )

"""A wave and the strains that act back on it, step by step with the sheet.

The two are solved in turn within a step from t to t + dt. First c is integrated to t + dt, with the
strain that the line through its last two values gives at every time between; then the sheet is, with
that c. As for the scheme of Adams and Bashforth, whose error is 5/12 dt³ per step, the order is two,
that of the steps of the sheet; the wave in itself is integrated far more accurately than that.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.methods import Method
from fem_check.excitable.space import Space
from fem_check.excitable.system import System
from linear_theory.common import validation
from linear_theory.common.shown import Shown

if TYPE_CHECKING:
    from fem_check.excitable.solution import Solution

Array = NDArray[np.float64]

SLACK = 1e-9
"""Relative difference of times that count as the same."""


@dataclass(frozen=True)
class Course:
    """States (2 n,) of the wave at times of the run, and the strains at the nodes (n,) there.

    kept: whether a time is kept for good; others go when they are no longer needed. jumped: whether the
    sheet jumped to the last one, so that no line goes through its strains.
    """

    times: tuple[float, ...]
    states: tuple[Array, ...]
    strains: tuple[Array, ...]
    kept: tuple[bool, ...]
    jumped: bool = False

    def strain(self, t: float) -> Array:
        """On the line through the last two times, or as it was at the last."""
        if self.jumped or len(self.times) < 2:
            return self.strains[-1]
        before, last = self.times[-2:]
        share = (t - last) / (last - before)
        return np.asarray(self.strains[-1] + share * (self.strains[-1] - self.strains[-2]))

    def advanced(self, t: float, state: Array, strain: Array, kept: bool, jumped: bool) -> "Course":
        """One step later."""
        needed = [*(i for i in range(len(self.times) - 1) if self.kept[i]), len(self.times) - 1]
        return Course(
            (*(self.times[i] for i in needed), t),
            (*(self.states[i] for i in needed), state),
            (*(self.strains[i] for i in needed), strain),
            (*(self.kept[i] for i in needed), kept),
            jumped,
        )


class FollowedWave(Shown):
    """The wave of a run: the past, and c one step ahead of it.

    course: the past; it is replaced, never changed, so that a run can return to an earlier one.
    """

    def __init__(self, system: System, method: Method, rtol: float) -> None:
        self.system, self.method, self.rtol = system, method, rtol
        nothing = np.zeros(system.space.size)
        self.course = Course((0.0,), (system.first,), (nothing,), (True,))
        self._ahead: tuple[Course, float, Array] | None = None
        self._weights: tuple[Array, Array, tuple[NDArray[np.int64], Array]] | None = None

    def _contents(self) -> Mapping[str, Any]:
        return {"equation": self.system.equation, "nodes": self.system.space.size, "time": self.time}

    @classmethod
    def of(cls, wave: "Solution", coarse: bool) -> "FollowedWave":
        """On elements as small as the wave needs without feedback, or twice as large."""
        pair = wave.alone._pair
        size = 2 * pair.size if coarse else pair.size
        assert wave.method is not None
        method = wave.method.coarser() if coarse else wave.method
        return cls(System(wave.equation, wave.body, Space.on(wave.body, size, True)), method, wave.rtol)

    @cached_property
    def places(self) -> Array:
        """Points of the undeformed sheet whose strains act on the wave, (2, n)."""
        return self.system.space.nodes

    @property
    def time(self) -> float:
        """Up to which the run has come."""
        return self.course.times[-1]

    def begin(self, strain: Array) -> None:
        """Set the strain at time 0."""
        self.course = replace(self.course, strains=(strain,))

    def accept(self, t: float, strain: Array, kept: bool, jumped: bool) -> None:
        """Take the step to a time, at which the sheet has that strain."""
        self.course = self.course.advanced(t, self.state(t), strain, kept, jumped)

    def state(self, t: float) -> Array:
        """c and w at the nodes after a step to a time, (2 n,), from the strains of the past."""
        course = self.course
        if self._ahead is None or self._ahead[0] is not course or self._ahead[1] != t:
            system, times = replace(self.system, strain=course.strain), np.array([course.times[-1], t])
            found = self.method.states(system, times, course.states[-1], self.rtol)[-1]
            self._ahead = course, t, found
        return self._ahead[2]

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """c; x, y, t broadcast. Raises ValueError for t < 0."""
        x, y, t = (validation.real_array(n, v) for n, v in (("x", x), ("y", y), ("t", t)))
        if t.ndim == 0:
            return self._at(x, y, float(t))
        x, y, t = np.broadcast_arrays(x, y, t)
        found = np.empty(t.shape)
        for time in np.unique(t):
            now = t == time
            found[now] = self._at(x[now], y[now], float(time))
        return found

    def _at(self, x: Array, y: Array, t: float) -> Array:
        nodes, shares = self._weights_at(x, y)
        return np.asarray(np.einsum("k...,k...->...", shares, self._nodal(t)[nodes]))

    def _weights_at(self, x: Array, y: Array) -> tuple[NDArray[np.int64], Array]:
        """Of the last points, which are mostly the same again."""
        last = self._weights
        if last is None or not (np.array_equal(last[0], x) and np.array_equal(last[1], y)):
            last = self._weights = x, y, self.system.space.weights(x, y)
        return last[2]

    def _nodal(self, t: float) -> Array:
        """c at the nodes, (n,): kept, on a cubic between kept times, or a step ahead of the past."""
        course, size = self.course, self.system.space.size
        if t > self.time * (1 + SLACK):
            return self.state(t)[:size]
        if t < -SLACK * self.time:
            raise ValueError(f"t = {t:g}: must be >= 0")
        times = np.array(course.times)
        nearest = int(abs(times - t).argmin())
        if abs(times[nearest] - t) <= SLACK * self.time:
            return course.states[nearest][:size]
        after = int(np.searchsorted(times, t))
        return self._between(after - 1, after, t)

    def _between(self, before: int, after: int, t: float) -> Array:
        """By Hermite's cubic."""
        start, end = self.course.times[before], self.course.times[after]
        h = end - start
        s = (t - start) / h
        (c, rate), (d, slope) = (self._with_rate(i) for i in (before, after))
        rise = h * ((1 - s) * rate - s * slope)
        return np.asarray((1 - s) * c + s * d + s * (1 - s) * ((1 - 2 * s) * (c - d) + rise))

    def _with_rate(self, i: int) -> tuple[Array, Array]:
        """c and dc/dt at the nodes at a time of the past."""
        state, strain = self.course.states[i], self.course.strains[i]
        rates = replace(self.system, strain=lambda t: strain).rates(self.course.times[i], state)
        size = self.system.space.size
        return state[:size], rates[:size]

    def arrays(self) -> dict[str, Array]:
        """All of the past."""
        course = self.course
        return {
            "wave_times": np.array(course.times),
            "wave_states": np.stack(course.states),
            "wave_strains": np.stack(course.strains),
            "wave_kept": np.array(course.kept),
            "wave_jumped": np.array(course.jumped),
        }

    def restore(self, found: dict[str, Array]) -> None:
        """The past from those arrays."""
        self.course = Course(
            tuple(float(t) for t in found["wave_times"]),
            tuple(found["wave_states"]),
            tuple(found["wave_strains"]),
            tuple(bool(k) for k in found["wave_kept"]),
            bool(found["wave_jumped"]),
        )

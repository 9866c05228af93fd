"""Means over time of functions that are smooth except for a few kinks."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LONG = 0.15  # fraction of the whole interval above which a panel is long
_BOOLE = np.array([7, 32, 12, 32, 7]) / 90
_SIMPSON = np.array([1, 0, 4, 0, 1]) / 6


class TimeGrid(NamedTuple):
    """Panels of five equidistant times; neighbours share their end points; times (4 panels + 1,)."""

    times: Array

    @property
    def lengths(self) -> Array:
        """Length of each panel."""
        return self.times[4::4] - self.times[:-4:4]

    @property
    def longest_step(self) -> float:
        """Longest interval between neighbouring times."""
        return float(self.lengths.max()) / 4

    def mean(self, values: Array) -> tuple[float, float]:
        """Mean of values (times,) by Boole's rule, and its estimated error.

        The error is estimated from the difference of Simpson's rule with one and with two steps, a
        fourth difference: far too large where the function is smooth, and about right at a kink. The
        fourth difference of a panel may vanish although it contains a kink, but then not that of five
        times shifted by half a panel: the largest of the three is taken. The error of long panels,
        which may hide more, is doubled.
        """
        share = self.lengths / self.lengths.sum()
        return float(share @ (_panels(values) @ _BOOLE)), float(self._errors(values).sum())

    def coarse_mean(self, values: Array) -> float:
        """Mean of values (times,) by Simpson's rule from every second time."""
        share = self.lengths / self.lengths.sum()
        return float(share @ (_panels(values) @ _SIMPSON))

    def means(self, values: Array) -> tuple[Array, Array]:
        """Means of values (n, times) and their estimated errors, (n,) each."""
        means, errors = zip(*map(self.mean, values), strict=True)
        return np.array(means), np.array(errors)

    def error(self, values: Array) -> float:
        """Estimated error of the mean of values (n, times), as the norm over the n components."""
        return float(self._joint_errors(values).sum())

    def refined(self, values: Array, tolerance: float) -> tuple["TimeGrid", NDArray[np.bool_]]:
        """The grid with the worst panels bisected, and which of its times are new.

        values: (times,), or (n, times) for the norm of the error of n components.
        """
        errors = self._joint_errors(np.atleast_2d(values))
        return self._cut(errors > min(tolerance / errors.size, errors.max() / 2))

    def with_steps(self, longest: float) -> "TimeGrid":
        """The grid with panels bisected until no step is longer than `longest`."""
        grid = self
        while grid.longest_step > longest * (1 + 1e-9):
            grid, _ = grid._cut(grid.lengths / 4 > longest * (1 + 1e-9))
        return grid

    def interpolated(self, values: Array, times: Array) -> Array:
        """Values (..., grid times) at other times (n,), by the polynomials that `mean` integrates."""
        panel = np.clip(np.searchsorted(self.times[::4], times, "right") - 1, 0, self.lengths.size - 1)
        local = (times - self.times[4 * panel]) / (self.lengths[panel] / 4)
        nodes = np.arange(5)
        weights = [np.prod([(local - j) / (i - j) for j in nodes if j != i], axis=0) for i in nodes]
        return np.asarray((values[..., 4 * panel + nodes[:, None]] * weights).sum(-2))

    def _cut(self, cut: NDArray[np.bool_]) -> tuple["TimeGrid", NDArray[np.bool_]]:
        panels = _panels(self.times)
        middles = (panels[:, 1:] + panels[:, :-1]) / 2
        times = np.concatenate([self.times, middles[cut].ravel()])
        new = np.arange(times.size) >= self.times.size
        order = np.argsort(times)
        return TimeGrid(times[order]), new[order]

    def _joint_errors(self, values: Array) -> Array:
        """Errors for values (n, times) that are the components of a vector, (panels,)."""
        return np.asarray(np.hypot.reduce([self._errors(component) for component in values]))

    def _errors(self, values: Array) -> Array:
        share = self.lengths / self.lengths.sum()
        fourth = _fourth_differences(self.times, values)
        padded = np.concatenate([[0.0], fourth, [0.0]])
        worst = np.maximum(padded[1::2], np.maximum(padded[:-1:2], padded[2::2]))
        return np.asarray(share * np.where(share > _LONG, 2.0, 0.7) * worst / 12)


def _fourth_differences(times: Array, values: Array) -> Array:
    """Absolute fourth differences of five consecutive times, at every second time.

    These are divided differences, as neighbouring panels may differ in length, times 24 h^4.
    """
    t = np.lib.stride_tricks.sliding_window_view(times, 5)[::2]
    difference = np.lib.stride_tricks.sliding_window_view(values, 5)[::2]
    for order in range(1, 5):
        difference = np.diff(difference, axis=1) / (t[:, order:] - t[:, :-order])
    return np.asarray(24 * abs(difference[:, 0]) * ((t[:, 4] - t[:, 0]) / 4) ** 4)


def first_grid(start: float, end: float, panels: int) -> TimeGrid:
    """Equal panels."""
    return TimeGrid(np.linspace(start, end, 4 * panels + 1))


def _panels(values: Array) -> Array:
    """(panels, 5)."""
    return np.lib.stride_tricks.sliding_window_view(values, 5)[::4]

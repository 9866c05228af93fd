"""Means over time of functions that are smooth between a few kinks."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LONG = 0.15  # share of the whole above which a panel is long
_BOOLE = np.array([7, 32, 12, 32, 7]) / 90
_SIMPSON = np.array([1, 0, 4, 0, 1]) / 6
_TWO_SIMPSONS = np.array([1, 4, 2, 4, 1]) / 12


class TimeGrid(NamedTuple):
    """Panels of five equidistant times, neighbours sharing their ends; times (4 panels + 1,)."""

    times: Array

    @property
    def lengths(self) -> Array:
        """Length of each panel."""
        return self.times[4::4] - self.times[:-4:4]

    def mean(self, values: Array) -> tuple[float, float]:
        """Mean of values (times,) by Boole's rule, and its estimated error.

        From the difference of Simpson's rule with two and with one step per panel, panel by panel: far
        too large where the function is smooth, and about right at a kink. Long panels may hide more
        than they show, and count twice.
        """
        share = self.lengths / self.lengths.sum()
        return float(share @ (_panels(values) @ _BOOLE)), float(self._errors(values).sum())

    def refined(self, values: Array, tolerance: float) -> tuple["TimeGrid", NDArray[np.bool_]]:
        """The grid with the worst panels cut in two, and which of its times are new."""
        errors = self._errors(values)
        cut = errors > min(tolerance / errors.size, errors.max() / 2)
        panels = _panels(self.times)
        middles = (panels[:, 1:] + panels[:, :-1]) / 2
        times = np.concatenate([self.times, middles[cut].ravel()])
        new = np.arange(times.size) >= self.times.size
        order = np.argsort(times)
        return TimeGrid(times[order]), new[order]

    def _errors(self, values: Array) -> Array:
        share = self.lengths / self.lengths.sum()
        caution = np.where(share > _LONG, 2.0, 0.7)
        return np.asarray(share * caution * abs(_panels(values) @ (_TWO_SIMPSONS - _SIMPSON)))


def first_grid(start: float, end: float, panels: int) -> TimeGrid:
    """Equal panels."""
    return TimeGrid(np.linspace(start, end, 4 * panels + 1))


def _panels(values: Array) -> Array:
    """(panels, 5)."""
    return np.lib.stride_tricks.sliding_window_view(values, 5)[::4]

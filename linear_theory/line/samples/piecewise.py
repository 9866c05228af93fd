"""Functions that are linear between equidistant points: means, quantiles, densities; many at once."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Ends(NamedTuple):
    """A function that is linear on each cell: its smaller value there, and by how much it rises,
    (times, cells). flat: cells on which it does not; None if there are none."""

    low: Array
    rise: Array
    flat: NDArray[np.bool_] | None

    @classmethod
    def of(cls, g: Array) -> "Ends":
        """Of values g (times, cells + 1) at the ends of the cells."""
        low = np.minimum(g[:, 1:], g[:, :-1])
        rise = np.maximum(g[:, 1:], g[:, :-1]) - low
        flat = rise == 0
        return cls(low, rise, flat if flat.any() else None)

    def part_below(self, level: Array) -> Array:
        """Part of each cell where the function is <= level, (times, cells); level (times, 1)."""
        part = level - self.low
        with np.errstate(divide="ignore", invalid="ignore"):
            part /= self.rise
        np.maximum(part, 0, out=part)
        np.minimum(part, 1, out=part)
        return part if self.flat is None else np.where(self.flat, level >= self.low, part)

    def weight_below(self, level: Array, weight: Array) -> Array:
        """Sum of the weights (times, cells) of what is below a level (times,)."""
        return np.einsum("tc,tc->t", weight, self.part_below(level[:, None]))


def weighted_quantile(g: Array, weight: Array, share: float = 0.5) -> tuple[Array, Array]:
    """Level with that share of the weight below, and part of each cell below it, for every time.

    The weight below a level is linear between neighbours of the sorted samples: bisect for the
    neighbours, then interpolate. It jumps where a cell is flat.
    """
    rows, ends = np.arange(g.shape[0]), Ends.of(g)
    ordered, wanted = np.sort(g, axis=1), share * weight.sum(axis=1)
    below, above = np.zeros(rows.size, int), np.full(rows.size, g.shape[1] - 1)
    while np.any(above - below > 1):
        middle = (below + above) // 2
        enough = ends.weight_below(ordered[rows, middle], weight) >= wanted
        below, above = np.where(enough, below, middle), np.where(enough, middle, above)
    low, high = ordered[rows, below], ordered[rows, above]
    at_low = ends.weight_below(low, weight)
    sloping = (
        weight if ends.flat is None else np.where(ends.flat & (ends.low == high[:, None]), 0, weight)
    )
    at_high = ends.weight_below(high, sloping)
    gain = np.where(at_high > at_low, at_high - at_low, np.inf)
    level = low + (high - low) * np.clip((wanted - at_low) / gain, 0, 1)
    level = np.where((at_low < wanted) & (wanted < at_high), level, high)
    return level, ends.part_below(level[:, None])


def density_at(g: Array, level: Array) -> Array:
    """Part of the body per unit of g at a level, by cell, (times, cells); infinite on a flat cell."""
    low, high = np.minimum(g[:, 1:], g[:, :-1]), np.maximum(g[:, 1:], g[:, :-1])
    at = level[:, None]
    with np.errstate(divide="ignore"):
        there = (low < at) & (at <= high) | (low == high) & (low == at)
        return np.where(there, 1 / (high - low), 0) / low.shape[1]


def mean_at(values: Array, g: Array, level: Array, density: Array) -> Array:
    """Mean of linear values over the places where g meets a level, (times,): where flat, over flats."""
    flat = np.isinf(density)
    share = np.where(flat.any(axis=1, keepdims=True), flat, density)
    with np.errstate(divide="ignore", invalid="ignore"):
        place = np.where(flat, 0.5, (level[:, None] - g[:, :-1]) / np.diff(g, axis=1))
    here = values[:, :-1] + np.where(share > 0, place, 0.0) * np.diff(values, axis=1)
    return np.asarray(np.sum(share * here, axis=1) / share.sum(axis=1))


def less_mean(rate: Array) -> Array:
    """int rate dS from one end of the body to every point, less its mean."""
    g = np.zeros_like(rate)
    np.cumsum(cell_means(rate) / (rate.shape[1] - 1), axis=1, out=g[:, 1:])
    return np.asarray(g - cell_means(g).mean(axis=1, keepdims=True))


def cell_means(values: Array) -> Array:
    """Mean on each cell, (times, cells), of values at the ends of the cells."""
    return np.asarray((values[:, 1:] + values[:, :-1]) / 2)

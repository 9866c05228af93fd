"""Which scenes a sweep has: a grid, pairs of a list, random points, or a Latin hypercube."""

import itertools
import math
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.sweeps.points.axes import Axis
from linear_theory.common import validation
from linear_theory.common.shown import Value

MOST = 10**8
"""Scenes of a sweep."""


class Design(Value):
    """Points with a value for each axis."""

    @abstractmethod
    def size(self, axes: Sequence[Axis]) -> int:
        """How many. Raises ValueError for axes that do not fit."""

    @abstractmethod
    def points(self, axes: Sequence[Axis]) -> Iterator[tuple[Any, ...]]:
        """One after the other, always the same ones in the same order."""


@dataclass(frozen=True)
class Grid(Design):
    """Every value of each field with every value of the others; the last field changes fastest.

    >>> from fem_check.sweeps import Grid
    >>> from fem_check.sweeps.points.axes import axes_of
    >>> axes = axes_of({"growth.alpha": [0.1, 0.2], "sheet.width": [0.3, 0.5]})
    >>> print(*Grid().points(axes))
    (0.1, 0.3) (0.1, 0.5) (0.2, 0.3) (0.2, 0.5)
    """

    def size(self, axes: Sequence[Axis]) -> int:
        """The product of all."""
        for axis in axes:
            if axis.size is None:
                raise ValueError(f"over: {axis.path}: must have a count, or be a list, on a grid")
        return _bounded(math.prod(axis.size or 0 for axis in axes))

    def points(self, axes: Sequence[Axis]) -> Iterator[tuple[Any, ...]]:
        """The last changes fastest."""
        return itertools.product(*(axis.values() for axis in axes))


@dataclass(frozen=True)
class Paired(Design):
    """The first values of all fields, then the second ones, and so on: lists of the same length."""

    def size(self, axes: Sequence[Axis]) -> int:
        """That of each."""
        sizes = {axis.path: axis.size for axis in axes}
        if None in sizes.values() or len(set(sizes.values())) > 1:
            said = ", ".join(f"{path} has {size or 'no count'}" for path, size in sizes.items())
            raise ValueError(f"over: {said}: must all have as many values, in a list")
        return _bounded(axes[0].size or 0)

    def points(self, axes: Sequence[Axis]) -> Iterator[tuple[Any, ...]]:
        """Side by side."""
        return zip(*(axis.values() for axis in axes), strict=True)


@dataclass(frozen=True)
class Drawn(Design):
    """So many points from the unit cube, each field at its share of its range or list.

    count: of points; seed: of the numbers, the same points for the same seed.
    """

    count: int
    seed: int = 0

    def __post_init__(self) -> None:
        validation.integer("count", self.count, 1)
        _bounded(self.count)
        validation.integer("seed", self.seed, 0)

    @abstractmethod
    def shares(self, axes: int) -> NDArray[np.float64]:
        """Points of the unit cube, shape (count, axes)."""

    def size(self, axes: Sequence[Axis]) -> int:
        """As it is given."""
        return self.count

    def points(self, axes: Sequence[Axis]) -> Iterator[tuple[Any, ...]]:
        """From the seed."""
        shares = self.shares(len(axes))
        return zip(*(axis.at(shares[:, i]) for i, axis in enumerate(axes)), strict=True)


@dataclass(frozen=True)
class Random(Drawn):
    """Independent points, uniform in each range (in its logarithm for "log") or list."""

    def shares(self, axes: int) -> NDArray[np.float64]:
        """Independent of each other."""
        return np.random.default_rng(self.seed).random((self.count, axes))


@dataclass(frozen=True)
class LatinHypercube(Drawn):
    """Points of which each field, cut into `count` equal parts, has one in every part.

    >>> from fem_check.sweeps import Between, LatinHypercube
    >>> from fem_check.sweeps.points.axes import axes_of
    >>> axes = axes_of({"growth.alpha": Between(0.0, 1.0), "sheet.width": Between(1.0, 2.0)})
    >>> points = list(LatinHypercube(10, seed=1).points(axes))
    >>> print(sorted(int(10 * alpha) for alpha, width in points))
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]
    """

    def shares(self, axes: int) -> NDArray[np.float64]:
        """One in every part of each field."""
        from scipy.stats import qmc  # half a second, for those who need it

        drawn: NDArray[np.float64] = qmc.LatinHypercube(axes, seed=self.seed).random(self.count)
        return drawn


def _bounded(count: int) -> int:
    if not 1 <= count <= MOST:
        raise ValueError(f"over: {count} scenes: must be from 1 to {MOST}")
    return count

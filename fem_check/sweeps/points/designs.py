"""Which scenes a sweep has: a grid, pairs of a list, random points, or a Latin hypercube."""

import itertools
import math
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

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
class Random(Design):
    """Independent points, uniform in each range (in its logarithm for "log") or list."""

    count: int
    seed: int = 0

    def __post_init__(self) -> None:
        _check(self.count, self.seed)

    def size(self, axes: Sequence[Axis]) -> int:
        """As it is given."""
        return self.count

    def points(self, axes: Sequence[Axis]) -> Iterator[tuple[Any, ...]]:
        """From the seed."""
        shares = np.random.default_rng(self.seed).random((self.count, len(axes)))
        return _at(axes, shares)


@dataclass(frozen=True)
class LatinHypercube(Design):
    """Points of which each field, cut into `count` equal parts, has one in every part.

    >>> from fem_check.sweeps import Between, LatinHypercube
    >>> from fem_check.sweeps.points.axes import axes_of
    >>> axes = axes_of({"growth.alpha": Between(0.0, 1.0), "sheet.width": Between(1.0, 2.0)})
    >>> points = list(LatinHypercube(10, seed=1).points(axes))
    >>> print(sorted(int(10 * alpha) for alpha, width in points))
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]
    """

    count: int
    seed: int = 0

    def __post_init__(self) -> None:
        _check(self.count, self.seed)

    def size(self, axes: Sequence[Axis]) -> int:
        """As it is given."""
        return self.count

    def points(self, axes: Sequence[Axis]) -> Iterator[tuple[Any, ...]]:
        """From the seed."""
        from scipy.stats import qmc  # half a second, for those who need it

        return _at(axes, qmc.LatinHypercube(len(axes), seed=self.seed).random(self.count))


def _check(count: Any, seed: Any) -> None:
    validation.integer("count", count, 1)
    _bounded(count)
    validation.integer("seed", seed, 0)


def _bounded(count: int) -> int:
    if not 1 <= count <= MOST:
        raise ValueError(f"over: {count} scenes: must be from 1 to {MOST}")
    return count


def _at(axes: Sequence[Axis], shares: Any) -> Iterator[tuple[Any, ...]]:
    return zip(*(axis.at(shares[:, i]) for i, axis in enumerate(axes)), strict=True)

"""Integrals over cells of functions that turn round at points where the sheet is at rest.

A cell carries polynomials by their values at order x order Gauss-Legendre points of [-1, 1]^2. Where
the integrand is not smooth on a cell, the cell is halved along the direction in which the motion
varies more, and the polynomials are interpolated to the halves. Cells so graded towards a point
converge geometrically with the number of halvings.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Rule(NamedTuple):
    """Gauss points and weights of one direction, and interpolation of n values from there.

    halves: to the Gauss points of the two halves, (n, n) each; with_ends: to -1, the points and 1,
    (n + 2, n); inverse: values at the points to coefficients of Legendre polynomials, (n, n).
    """

    points: Array
    weights: Array
    halves: tuple[Array, Array]
    with_ends: Array
    inverse: Array


@lru_cache
def gauss(order: int) -> Rule:
    """The rule with `order` points."""
    points, weights = gauss_legendre(order)
    inverse = np.linalg.inv(np.polynomial.legendre.legvander(points, order - 1))
    first, second, with_ends = (
        np.polynomial.legendre.legvander(places, order - 1) @ inverse
        for places in ((points - 1) / 2, (points + 1) / 2, np.concatenate([[-1], points, [1]]))
    )
    return Rule(points, weights, (first, second), with_ends, np.asarray(inverse, float))


class Graded(NamedTuple):
    """Cells after grading: values (channels, cells, n, n), owners (cells,) and shares (cells,) of the
    area of the cell that they come from."""

    values: Array
    owners: Integers
    shares: Array

    def integrals(self, functions: Array) -> Array:
        """Integrals of (functions, cells, n, n) summed for each owner, (functions, owners)."""
        weights = gauss(functions.shape[-1]).weights
        sums = ((functions @ weights) @ weights) * self.shares
        return np.stack([np.bincount(self.owners, s) for s in sums])


def graded(
    values: Array,
    owners: Integers,
    roughness: Callable[[Array, Integers], tuple[NDArray[np.bool_], Integers]],
    halvings: int,
) -> Graded:
    """Halve cells until they are smooth.

    values: (channels, cells, n, n), polynomials at the Gauss points; owners: (cells,), 0, 1, ..., the
    problem (here: the time) that a cell belongs to; roughness(values, owners) tells which cells to
    halve and along which local axis (0 or 1); halvings: the most that one cell is halved.
    """
    rule = gauss(values.shape[-1])
    parts: list[Graded] = []
    share = 1.0
    for depth in range(halvings + 1):
        rough, axis = roughness(values, owners)
        if depth == halvings:
            rough[:] = False
        smooth = ~rough
        parts.append(Graded(values[:, smooth], owners[smooth], np.full(smooth.sum(), share)))
        if not rough.any():
            break
        values, owners = _halved(values[:, rough], owners[rough], axis[rough], rule)
        share /= 2
    return Graded(
        np.concatenate([p.values for p in parts], axis=1),
        np.concatenate([p.owners for p in parts]),
        np.concatenate([p.shares for p in parts]),
    )


def _halved(values: Array, owners: Integers, axis: Integers, rule: Rule) -> tuple[Array, Integers]:
    """The halves of all cells, along axis 0 or 1 of each."""
    across = axis == 0
    first, second = values[:, across], values[:, ~across]
    ends = np.cumsum([first.shape[1], first.shape[1], second.shape[1]])
    halves = np.empty((len(values), 2 * values.shape[1], *values.shape[2:]))
    begin, end = rule.halves  # into their places: to copy them takes longer than the products
    np.matmul(begin, first, out=halves[:, : ends[0]])
    np.matmul(end, first, out=halves[:, ends[0] : ends[1]])
    np.matmul(second, begin.T, out=halves[:, ends[1] : ends[2]])
    np.matmul(second, end.T, out=halves[:, ends[2] :])
    ours, theirs = owners[across], owners[~across]
    return halves, np.concatenate([ours, ours, theirs, theirs])

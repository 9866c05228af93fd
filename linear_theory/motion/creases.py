"""Cells cut along the curve on which an integrand has a crease.

Friction with a direction has another tangent on either side of the curve where slip across it vanishes.
A cell that the curve crosses is cut in two curved cells: along the local axis on which the level varies
more, every line of Gauss points is divided where the level is 0, and each part gets Gauss points of its
own, by interpolation. Gauss quadrature then sees smooth functions along these lines, and across them
one that has at most a kink, where the curve leaves the cell by its side.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.motion.cells import Graded, gauss

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

NEWTON_STEPS = 2
"""From the chord between neighbouring points, on lines where the level is nearly linear; what the place
of a kink is off counts squared."""

Level = Callable[[Array, Integers], Array]


def cut(cells: Graded, level: Level, area: int, halvings: int) -> Graded:
    """The cells, of which those on which the level changes sign are cut there.

    level(values, owners): (cells, n, n), a polynomial on each cell; area: the channel of the values
    that counts the area, which is shared between the parts; halvings: the most of a cell that the curve
    leaves by a side, so that what has a kink there is small.
    """
    at = level(cells.values, cells.owners)
    crossed = np.logical_and(at.min((1, 2)) < 0, at.max((1, 2)) > 0)
    if not crossed.any():
        return cells
    left, inside = [_some(cells, ~crossed)], _some(cells, crossed)
    at = at[crossed]
    across = abs(np.diff(at, axis=1)).sum((1, 2)) > abs(np.diff(at, axis=2)).sum((1, 2))
    inside.values[:, across] = inside.values[:, across].swapaxes(-1, -2)  # now along the last axis
    ready = []
    for left_over in range(halvings, -1, -1):
        met = _meets(level(inside.values, inside.owners))
        some = met.any(1)
        leaving = some & ~met.all(1) & (left_over > 0)
        left.append(_some(inside, ~some))
        ready.append(_some(inside, some & ~leaving))
        if not leaving.any():
            break
        inside = _halved_aside(_some(inside, leaving))
    whole = _joined(ready)
    return _joined([*left, *_divided(whole, level(whole.values, whole.owners), area)])


def _joined(parts: list[Graded]) -> Graded:
    return Graded(
        np.concatenate([part.values for part in parts], axis=1),
        np.concatenate([part.owners for part in parts]),
        np.concatenate([part.shares for part in parts]),
    )


def _some(cells: Graded, which: Any) -> Graded:
    return Graded(cells.values[:, which], cells.owners[which], cells.shares[which])


def _halved_aside(cells: Graded) -> Graded:
    """Halves along the first axis."""
    halves = [half @ cells.values for half in gauss(cells.values.shape[-1]).halves]
    return Graded(
        np.concatenate(halves, axis=1), np.tile(cells.owners, 2), np.tile(cells.shares / 2, 2)
    )


def _divided(cells: Graded, at: Array, area: int) -> list[Graded]:
    """The parts of cells below and above the place of their level 0, along the last axis."""
    root, n = _roots(at)[..., None], at.shape[-1]
    share = (gauss(n).points + 1) / 2
    lengths = root + 1, 1 - root
    places = np.concatenate([lengths[0] * share - 1, root + lengths[1] * share], axis=-1)
    values, parts = _interpolated(cells.values, places), []
    for k, length in enumerate(lengths):
        part = values[..., k * n : (k + 1) * n]
        part[area] *= length / 2
        parts.append(cells._replace(values=part))
    return parts


def _meets(level: Array) -> NDArray[np.bool_]:
    """Whether a level (cells, n, n) changes sign along each line of the last axis, (cells, n)."""
    ends = level @ gauss(level.shape[-1]).with_ends.T
    return np.asarray((ends.min(-1) < 0) & (ends.max(-1) > 0))


def _interpolated(values: Array, places: Array) -> Array:
    """Values (channels, cells, n, n) along their last axis at places (cells, n, m)."""
    rule = gauss(values.shape[-1])
    weights = np.polynomial.legendre.legvander(places, values.shape[-1] - 1) @ rule.inverse
    return np.moveaxis(weights @ np.moveaxis(values, 0, -1), -1, 0)


def _roots(level: Array) -> Array:
    """Where levels (cells, n, n) change sign along the last axis, (cells, n); 1 where they do not."""
    rule = gauss(level.shape[-1])
    nodes = np.concatenate([[-1.0], rule.points, [1.0]])
    ends = level @ rule.with_ends.T
    changes = (ends[..., 1:] > 0) != (ends[..., :-1] > 0)
    first = changes.argmax(-1)
    low, high = nodes[first], nodes[first + 1]
    below, above = (np.take_along_axis(ends, first[..., None] + k, -1)[..., 0] for k in (0, 1))
    there = changes.any(-1)
    root = np.where(there, low + (high - low) * below / np.where(there, below - above, 1.0), 1.0)
    coefficients = level @ rule.inverse.T
    degree = level.shape[-1] - 1
    slopes = np.polynomial.legendre.legder(np.moveaxis(coefficients, -1, 0))
    for _ in range(NEWTON_STEPS):
        powers = np.polynomial.legendre.legvander(root, degree)
        value = (powers * coefficients).sum(-1)
        slope = (powers[..., :degree] * np.moveaxis(slopes, 0, -1)).sum(-1)
        step = np.where(there & (slope != 0), value / np.where(slope == 0, 1.0, slope), 0.0)
        root = np.where(there, np.clip(root - step, low, high), root)
    return np.asarray(root)

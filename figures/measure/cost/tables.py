"""The tables of `make cost`: what was measured, and the powers that it follows.

Every table is a list of frozen dataclasses, one row each, written as CSV after a line that tells how
it was made. Columns that do not depend on the machine stand first.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from figures.common.records import Table
from linear_theory.common.records import read_rows

COMMAND = "python -m figures.measure.cost"

DIGITS = 4
"""Significant digits written: more than times repeat."""

SMALLER_IS_FINER = ("rtol", "slip speed")
"""Knobs that are turned down for a smaller error; all others count work."""

FALLS = 1.5
"""Least ratio of the errors of neighbours that still converge; beyond, they are on a plateau."""

REFERENCE = "references"
"""Level of the rows that tell by how much the references of a panel differ."""

LAST = 3
"""Points, those of most work, that give the growth of the time: the others hold fixed costs."""

Row = TypeVar("Row")


@dataclass(frozen=True)
class Point:
    """One measurement of one level.

    panel: "field", "linear speed", "nonlinear speed" or "growth"; knob: what is varied, value: of it;
    error: relative, against a reference by another method; claimed: what the result itself says of
    its numerical error, model_claimed: of its distance to the target; NaN where nothing is known.
    seconds: median of the repeats, fastest and slowest of them.
    """

    panel: str
    level: str
    knob: str
    value: float
    error: float
    claimed: float
    model_claimed: float
    repeats: int
    seconds: float
    fastest: float
    slowest: float


@dataclass(frozen=True)
class Order:
    """Powers that a level follows as a knob is turned from `first` to `last`.

    error_order: p of error ~ value^-p (value^p for knobs that are turned down), over the `points` that
    converge; plateau: the error where it no longer falls, NaN if it does to the end. time_exponent: q
    of seconds ~ value^q (value^-q) over the last points; efficiency: s of error ~ seconds^-s.
    """

    panel: str
    level: str
    knob: str
    first: float
    last: float
    points: int
    error_order: float
    plateau: float
    time_exponent: float
    efficiency: float


def curves(points: Sequence[Point]) -> Iterator[list[Point]]:
    """The points of each panel, level and knob, from coarse to fine, in the order of appearance."""
    keys = list(dict.fromkeys((p.panel, p.level, p.knob) for p in points))
    for key in keys:
        chosen = [p for p in points if (p.panel, p.level, p.knob) == key]
        yield sorted(chosen, key=lambda p: p.value, reverse=is_turned_down(key[2]))


def is_turned_down(knob: str) -> bool:
    """Whether a smaller value means more accuracy."""
    return knob in SMALLER_IS_FINER


def orders(points: Sequence[Point]) -> list[Order]:
    """Of all curves of more than one point."""
    return [order(curve) for curve in curves(points) if len(curve) > 1]


def order(curve: Sequence[Point]) -> Order:
    """Of one curve, coarse to fine."""
    sign = 1.0 if is_turned_down(curve[0].knob) else -1.0
    falling = converging(curve)
    value, error, seconds = (
        np.array([getattr(p, name) for p in falling]) for name in ("value", "error", "seconds")
    )
    last = curve[-LAST:]
    return Order(
        curve[0].panel,
        curve[0].level,
        curve[0].knob,
        curve[0].value,
        curve[-1].value,
        len(falling),
        sign * slope(value, error),
        curve[-1].error if len(falling) < len(curve) else math.nan,
        -sign * slope(np.array([p.value for p in last]), np.array([p.seconds for p in last])),
        -slope(seconds, error),
    )


def converging(curve: Sequence[Point]) -> list[Point]:
    """The first points, up to where the error no longer falls."""
    found = [curve[0]]
    for before, after in itertools.pairwise(curve):
        if not before.error >= FALLS * after.error:
            break
        found.append(after)
    return found


def slope(x: np.ndarray, y: np.ndarray) -> float:
    """p of y ~ x^p by least squares in logarithms; NaN for fewer than two points."""
    if x.size < 2 or not np.all(y > 0) or np.ptp(x) == 0:
        return math.nan
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def cheapest(points: Sequence[Point]) -> list[Point]:
    """Those that no other point beats in both error and time, by rising time."""
    best: list[Point] = []
    for point in sorted(points, key=lambda p: (p.seconds, p.error)):
        if not best or point.error < best[-1].error:
            best.append(point)
    return best


def write(rows: Sequence[Any], path: Path, words: str) -> Path:
    """Rows of one dataclass as a table, after the command and `words` that tell how it was made."""
    return Table(path, type(rows[0]), COMMAND, words, DIGITS).write(rows)


def read(path: Path, kind: type[Row]) -> list[Row]:
    """The rows of a table. Raises FileNotFoundError, naming the command that makes it."""
    return read_rows(path, kind, COMMAND)

"""Model error: the distance of a theory to the nonlinear sheet, from a table of measured distances.

The target is the planar nonlinear sheet with a growth law, area measure and load, under dry friction,
too stiff for friction to change its shape. Three levels were compared with it for sine waves (see
`figures/measure/model_error.py`): a narrow strip at finite strain, small strain (order = 1 of
`crawl_speed`) and the second order in alpha (order = 2). With V of order alpha^2 the distances are

    |V - V_target| = D alpha^2,                 the second order: D alpha^4,

and D varies slowly with width, Poisson ratio and alpha. Between points of the table, the largest value
at the surrounding points times a safety factor is used.
"""

import functools
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.records import read_rows
from linear_theory.common.shown import Shown
from linear_theory.friction.laws import Coulomb
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

PATH = Path(__file__).parents[1] / "data" / "model_error.csv"
COMMAND = "python -m figures.measure.model_error"

LEVELS = ("strip", "first order", "second order")
"""Names of the theories, as in `fem_check.choice.levels`, and their columns of the table."""

SAFETY = 1.25
"""Safety factor between points of the table. For none of 32 other sheets, waves and growths (widths
0.12 to 0.85 L, alpha 0.03 to 0.38), under three loads, was D above its value at the surrounding
points. Of 34 more, half of them with nu = 0.2 or 0.4 and alpha = 0.05 or 0.15, in the middle between
points, the distance is at most 0.79 of the bound (`figures.measure.limits.model_error_between`)."""

SAME = 1e-12
"""Relative difference below which numbers count as equal."""


@dataclass(frozen=True)
class Row(Shown):
    """One point of the table; speeds over alpha^2 L/T.

    nonlinear: speed of the target, for alpha = 0 the limit V_2, nan where the sheet has no equilibrium;
    error: sum of its numerical error and that of any level; strip, first_order, second_order:
    difference of the level to the target, nan where a level has no answer.
    """

    width: float
    poisson: float
    count: int
    growth_law: str
    area: str
    load: str
    alpha: float
    nonlinear: float
    error: float
    strip: float
    first_order: float
    second_order: float


Model = tuple[str, str, str, int]
"""growth_law, area, load and count."""


@dataclass(frozen=True, eq=False)
class _Grid:
    """Distances for one model: axes W/L, nu and alpha, and |difference| + error, (3, W, nu, alpha)."""

    axes: tuple[Array, Array, Array]
    distances: Array


def model_error(level: str, scene: Scene) -> float:
    """Measured bound of |V - V_target| for a theory, absolute, length/time.

    level: "strip", "first order" or "second order"; the target has the growth, load and friction of the
    scene, which must be planar. The numerical error of V itself is not included.

    0 for growth constant in time. NaN where the distance is unknown: any wave other than a sine with 1
    or 2 waves on the sheet (its amplitude is absorbed in alpha); widths outside 0.1 to 2 L (1 L for two
    waves); Poisson ratios outside 0 to 1/2, |alpha| above 0.4; friction other than dry; and points
    where the level or the target has no speed. The strip is known for narrower sheets, too, whose
    distance to it falls faster than the width. Between points of the table the bound is mostly 1.5 to
    3 times the difference, and more where that changes sign. Raises ValueError for an unknown level and
    FileNotFoundError if the table is missing.
    """
    validation.choice("level", level, LEVELS)
    sheet, series, growth, contact = scene.sheet, scene.drive.series, scene.growth, scene.contact
    if growth.alpha == 0 or (series is not None and not series.moves):
        return 0.0  # the sheet is at rest in all theories
    if contact.friction != Coulomb() or series is None or series.sine_amplitude is None:
        return math.nan
    model = growth.law.name, str(growth.energy_area), str(contact.load), abs(series.count)
    grid = table().get(model)
    if grid is None:
        return math.nan
    strength = abs(growth.alpha) * series.sine_amplitude
    bound = _bound(grid, level, (sheet.width / sheet.length, sheet.poisson, strength))
    return bound * scene.unit


def _bound(grid: _Grid, level: str, point: tuple[float, float, float]) -> float:
    """Bound of the distance at the point (W/L, nu, alpha), in L/T."""
    alpha = point[2]
    if alpha == 0:
        return 0.0
    narrowest, next_width = grid.axes[0][:2]
    if level == "strip" and 0 < point[0] < narrowest:
        slopes = [_bound(grid, level, (w, *point[1:])) / w for w in (narrowest, next_width)]
        return SAFETY * point[0] * max(slopes)
    around = [_around(axis, value) for axis, value in zip(grid.axes, point, strict=True)]
    if any(places.size == 0 for places in around):
        return math.nan
    widths, poissons, alphas = around
    power = 2
    if level == "second order":
        power, alphas = 4, alphas[grid.axes[2][alphas] > 0]  # at alpha = 0 the difference is 0/0
    strengths = grid.axes[2][alphas]
    values = grid.distances[LEVELS.index(level)][np.ix_(widths, poissons, alphas)]
    largest = (values * strengths ** (2.0 - power)).max()  # NaN if any of them is
    safety = 1.0 if all(places.size == 1 for places in around) else SAFETY
    return float(safety * largest * alpha**power)


def _around(axis: Array, value: float) -> NDArray[np.intp]:
    """Indices of the points around a value: one if it is a point, else two, or none outside."""
    same = np.flatnonzero(abs(axis - value) <= SAME * abs(value))
    if same.size:
        return same
    above = int(np.searchsorted(axis, value))
    return np.arange(above - 1, above + 1) if 0 < above < axis.size else np.arange(0)


@functools.cache
def table(path: Path = PATH) -> dict[Model, _Grid]:
    """The table grouped by model; read once."""
    rows = read(path)
    models = sorted({(r.growth_law, r.area, r.load, r.count) for r in rows})
    return {
        model: _grid([r for r in rows if (r.growth_law, r.area, r.load, r.count) == model])
        for model in models
    }


def _grid(rows: list[Row]) -> _Grid:
    points = np.array([(r.width, r.poisson, r.alpha) for r in rows])
    axes = [np.unique(column) for column in points.T]
    distances = np.full((len(LEVELS), *(axis.size for axis in axes)), math.nan)
    places = tuple(np.searchsorted(axis, column) for axis, column in zip(axes, points.T, strict=True))
    differences = np.array([(r.strip, r.first_order, r.second_order) for r in rows]).T
    distances[:, *places] = abs(differences) + [r.error for r in rows]
    return _Grid((axes[0], axes[1], axes[2]), distances)


def read(path: Path = PATH) -> list[Row]:
    """The rows of a table. Raises FileNotFoundError, naming the command that makes it."""
    return read_rows(path, Row, COMMAND)

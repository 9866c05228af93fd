"""Speeds that tell how far in alpha the theories reach, and the coefficient V_4.

    python -m figures.measure.reach [--rtol 3e-4]

Writes two tables for the default model (growth law exp, energy per grown area, current load, dry
friction, one sine wave): figures/data/reach_speeds.csv, V/alpha^2 of the nonlinear sheet and of three
theories over widths and alpha, and figures/data/reach.csv, for each sheet V_2, V_4 of V = V_2 alpha^2 +
V_4 alpha^4 + ... and the largest alpha up to which a theory stays within 1, 5 and 10 per cent of the
sheet. Some minutes of computing.
"""

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from fem_check.shell.cycle.motion import UnresolvedError
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.statics.equilibrium import ConvergenceError
from figures.common.command import parser
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import planar_scene
from figures.measure.model_error import (
    BASE,
    SMALL_ALPHA,
    Case,
    first_order_ratio,
    leading_of,
    strip_ratio,
)
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


COMMAND = "python -m figures.measure.reach"

RTOL = 3e-4
"""Of speeds: V_4 alpha^2 is a hundredth of V_2 at alpha = 0.1."""

WIDTHS = (0.1, 0.2, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0)
POISSONS = (0.5, 0.0)
ALPHAS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45)

LIMIT_STEP = 0.005
"""To which the alpha is narrowed down beyond which no shape is found."""

FIT_ALPHA = 0.3
"""Largest alpha of the fit of V_4."""

FITS = ((1, 2, 3), (1, 2), (0, 1, 2))
"""Powers of alpha^2 that are fitted to V/alpha^2 - V_2, of which the power 0 takes up an error of the
mesh that is the same at all alpha."""

DIGITS = 6
"""Significant digits written."""

SHARES = (0.01, 0.05, 0.1)
"""Of the speed, up to which a theory reaches."""


@dataclass(frozen=True)
class Point:
    """V/alpha^2 of the nonlinear sheet (alpha = 0: V_2), its error, and that of the theories; L/T."""

    width: float
    poisson: float
    alpha: float
    nonlinear: float
    error: float
    strip: float
    first_order: float
    second_order: float


@dataclass(frozen=True)
class Reach:
    """Of one sheet: V_2, V_4 and their errors, L/T; largest alphas at which a theory is within a share.

    limit: largest alpha for which speeds are known; a reach that equals it is that long at least.
    """

    width: float
    poisson: float
    second: float
    second_error: float
    fourth: float
    fourth_error: float
    limit: float
    strip_5: float
    strip_10: float
    second_order_1: float
    second_order_5: float
    second_order_10: float


WORDS = "width in L, speeds and coefficients in L/T"
SPEEDS = Table(DATA / "reach_speeds.csv", Point, COMMAND, WORDS, DIGITS)
REACHES = Table(DATA / "reach.csv", Reach, COMMAND, WORDS, DIGITS)


def points(width: float, poisson: float, rtol: float = RTOL) -> list[Point]:
    """Speeds of one sheet at all alphas at which it has a shape, and at the last one."""
    case = Case(width, poisson, 1, *BASE[:2])
    second, error = leading_of(width, poisson, 1, BASE, rtol)
    strip, (first, _) = (
        strip_ratio(case, BASE[2], SMALL_ALPHA),
        first_order_ratio(width, poisson, 1, BASE[2], SMALL_ALPHA, rtol),
    )
    found = [Point(width, poisson, 0.0, second, error, strip, first, second)]
    for alpha in ALPHAS:
        point = point_at(case, alpha, second, rtol)
        if point is None:
            limit = largest_alpha(lambda a: planar_scene(case.sheet, 1, a), found[-1].alpha, alpha)
            last = point_at(case, limit, second, rtol)
            return found + ([last] if last and last.alpha > found[-1].alpha else [])
        found.append(point)
    return found


def point_at(case: Case, alpha: float, second: float, rtol: float) -> Point | None:
    """All speeds at one alpha; None where the sheet has no shape."""
    scene = planar_scene(case.sheet, case.count, alpha, case.growth_law, case.area)
    try:
        found = cycle_speed(scene, BASE[2], rtol=rtol, atol=rtol * alpha**2)
    except (ConvergenceError, UnresolvedError):
        return None
    strip = strip_ratio(case, BASE[2], alpha)
    first, _ = first_order_ratio(case.width, case.poisson, case.count, BASE[2], alpha, rtol)
    unit = alpha**2
    return Point(
        case.width, case.poisson, alpha, found.mean / unit, found.error / unit, strip, first, second
    )


def largest_alpha(scene: Callable[[float], Scene], low: float, high: float) -> float:
    """Where between two alphas the scenes have shapes no longer, to LIMIT_STEP."""
    while high - low > LIMIT_STEP * 1.01:
        middle = LIMIT_STEP * round((low + high) / 2 / LIMIT_STEP)
        try:
            cycle_of_shapes(scene(middle))
            low = middle
        except ConvergenceError:
            high = middle
    return low


def reach(table: Sequence[Point]) -> Reach:
    """What the points of one sheet say."""
    start, limit = table[0], table[-1].alpha
    strips = [reached(table, "strip", share) for share in SHARES[1:]]
    seconds = [reached(table, "second_order", share) for share in SHARES]
    coefficients = (start.nonlinear, start.error, *fourth_coefficient(table))
    return Reach(start.width, start.poisson, *coefficients, limit, *strips, *seconds)


def reached(table: Sequence[Point], theory: str, share: float) -> float:
    """Largest alpha up to which |V_theory/V - 1| <= share; 0 where that does not hold as alpha -> 0."""
    deviation = curve(table, theory)
    if abs(deviation(0.0)) > share:
        return 0.0
    crossings = [deviation.solve(level, extrapolate=False) for level in (share, -share)]
    return float(np.concatenate(crossings).min(initial=table[-1].alpha))


def curve(table: Sequence[Point], theory: str) -> CubicSpline:
    """V_theory/V - 1 against alpha for one sheet, by a cubic spline, even in alpha."""
    deviations = np.array([getattr(p, theory) / p.nonlinear - 1 for p in table])
    ends = ((1, 0.0), "not-a-knot" if len(table) > 2 else (2, 0.0))
    return CubicSpline([p.alpha for p in table], deviations, bc_type=ends)


def fourth_coefficient(table: Sequence[Point]) -> tuple[float, float]:
    """V_4 and its error, from V/alpha^2 - V_2 = V_4 alpha^2 + V_6 alpha^4 + ... up to FIT_ALPHA.

    Of the fits FITS the first is taken; the error is the largest difference of the others to it. NaN
    where the points are too few.
    """
    chosen = [p for p in table if 0 < p.alpha <= FIT_ALPHA]
    if len(chosen) < len(FITS[0]) + 1:
        return math.nan, math.nan
    square = np.array([p.alpha**2 for p in chosen])
    change = np.array([p.nonlinear - p.second_order for p in chosen])
    value, *others = (
        float(np.linalg.lstsq(square[:, None] ** powers, change)[0][powers.index(1)]) for powers in FITS
    )
    return value, max(abs(other - value) for other in others)


def compute(path: Path, rtol: float = RTOL) -> list[Point]:
    """All points, sheet after sheet, written as they come."""
    sheets = list(itertools.product(POISSONS, WIDTHS))
    found: list[Point] = []
    for poisson, width in tracked("reach", sheets):
        found += points(width, poisson, rtol)
        SPEEDS.write(found, path)
    return found


def reaches(table: Sequence[Point]) -> list[Reach]:
    """One row for each sheet."""
    sheets = itertools.groupby(table, lambda p: (p.width, p.poisson))
    return [reach(list(group)) for _, group in sheets]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write both tables."""
    settings = {"rtol": (RTOL, "relative error of the speeds")}
    options = parser(COMMAND, __doc__, DATA, **settings).parse_args(arguments)
    speeds, limits = (options.out / table.path.name for table in (SPEEDS, REACHES))
    compute(speeds, options.rtol)
    # from the speeds as they are written: rounding them changes V_4 by more than its own digits
    REACHES.write(reaches(SPEEDS.read(speeds)), limits)


if __name__ == "__main__":
    main()

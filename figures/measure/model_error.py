"""How far three theories are from the nonlinear sheet: the table that `model_error` reads.

    python -m figures.measure.model_error [--out FILE] [--rtol 1e-3] [--resume]

Writes linear_theory/data/model_error.csv: ten minutes of computing; --resume keeps the sheets
that are in the file already. Sine waves, every growth law, area measure and load, under dry friction.
The nonlinear sheet is planar, its shapes static and not affected by friction. Rows of alpha = 0 hold
the limits of V/alpha^2, for the nonlinear sheet V_2.

Where no stable static shape is found the table holds nan, and larger alphas are not tried: at the
middle of the long sides of a wide sheet, where c = -1, the stretching energy (eq. 1a) does not resist
the compression (see `fem_check.shell.statics.ellipticity`).
"""

import functools
import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import astuple, dataclass, fields
from pathlib import Path

from fem_check.shell.cycle.motion import UnresolvedError
from fem_check.shell.cycle.speed import Cycle
from fem_check.shell.statics.equilibrium import ConvergenceError
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import planar_scene
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.airy import airy_series
from linear_theory.deformation.field import LinearField
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import WEIGHTS as LOADS
from linear_theory.growth.growth import Growth, Reference
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.line.finite import line_cycle_speed
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.crawl import field_speed
from linear_theory.speed.model_error import COMMAND, PATH, Row
from linear_theory.speed.second_order import second_order
from linear_theory.wave.travelling import SineWave

RTOL = 1e-3
"""Error asked of V, relative to V or to alpha^2 L/T, whichever is larger."""

WIDTHS = (0.1, 0.25, 0.5, 1.0, 2.0)
POISSONS = (0.0, 0.5)
COUNTS = (1, 2)
ALPHAS = (0.1, 0.2, 0.3, 0.4)

WIDEST = 2.0
"""Wavelengths across: wider sheets would take as long as all others, and lose their shape at alpha =
0.2."""

BASE = "exp", "grown", "current"
"""Growth law, area and load from which V_2 of the others is reckoned."""

SECOND_SHARE = 0.3
"""Of rtol, for V_2: its error must not hide the small distance of the second order from the sheet."""

SMALL_ALPHA = 1e-3
"""At which V/alpha^2 of strip and first order stands for its limit: what is left is of order 1e-6."""

DIGITS = 5
"""Significant digits written: less than the errors leave."""

TABLE = Table(PATH, Row, COMMAND, "width in L, speeds and differences over alpha^2 L/T", DIGITS)


@dataclass(frozen=True)
class Case:
    """A sheet, its wave, and what shapes it."""

    width: float
    poisson: float
    count: int
    growth_law: str
    area: str

    @property
    def sheet(self) -> Sheet:
        """Of length 1."""
        return Sheet(width=self.width, poisson=self.poisson)


def cases() -> Iterator[Case]:
    """All of them, in the order of the table."""
    for width, poisson, count in itertools.product(WIDTHS, POISSONS, COUNTS):
        if width * count <= WIDEST:
            for model in itertools.product(GROWTH_LAWS, Reference):
                yield Case(width, poisson, count, *model)


def rows(case: Case, rtol: float = RTOL) -> list[Row]:
    """The limits alpha -> 0 and all alphas, under every load."""
    seconds = {load: leading(case, load, rtol) for load in LOADS}
    found = [limits(case, load, *seconds[load], rtol) for load in LOADS]
    exists = True
    for alpha in ALPHAS:
        speeds = nonlinear_speeds(case, alpha, rtol) if exists else {}
        exists = bool(speeds)
        for load in LOADS:
            speed = speeds.get(load, (math.nan, math.nan))
            found.append(compared(case, load, alpha, speed, seconds[load], rtol))
    return found


def leading(case: Case, load: str, rtol: float) -> tuple[float, float]:
    """V_2 and its error.

    V_2 is linear in the coefficients k of the growth law and m of the area measure and in the load (see
    `second_field` and `second_order`): one call for each, besides that of BASE, gives all 18 models.
    """
    areas = {area: Growth(1.0, energy_area=area).energy_weight for area in Reference}
    law, area = GROWTH_LAWS[case.growth_law].square, areas[Reference(case.area)]
    grown, undeformed = areas[Reference.GROWN], areas[Reference.UNDEFORMED]
    shares = {
        ("metric", *BASE[1:]): 1 - law,
        (BASE[0], "undeformed", BASE[2]): (area - grown) / (undeformed - grown),
        (*BASE[:2], load): float(load != BASE[2]),
    }
    shares = {model: share for model, share in shares.items() if share}
    shares[BASE] = 1 - sum(shares.values())
    found = [leading_of(case.width, case.poisson, case.count, model, rtol) for model in shares]
    weights = list(shares.values())
    value = sum(w * second for w, (second, _) in zip(weights, found, strict=True))
    return value, sum(abs(w) * error for w, (_, error) in zip(weights, found, strict=True))


@functools.cache
def leading_of(
    width: float, poisson: float, count: int, model: tuple[str, str, str], rtol: float
) -> tuple[float, float]:
    """V_2 of one growth law, area and load, and its error."""
    sheet = Sheet(width=width, poisson=poisson)
    found = second_order(sheet, SineWave(count), *model, rtol=SECOND_SHARE * rtol)
    return found.second, found.second_error


def limits(case: Case, load: str, second: float, error: float, rtol: float) -> Row:
    """The row of alpha = 0."""
    strip = strip_ratio(case, load, SMALL_ALPHA)
    first, first_error = first_order_ratio(
        case.width, case.poisson, case.count, load, SMALL_ALPHA, rtol
    )
    differences = (strip - second, first - second, 0.0)
    return _row(case, load, 0.0, second, error + first_error, differences)


def compared(
    case: Case,
    load: str,
    alpha: float,
    speed: tuple[float, float],
    second: tuple[float, float],
    rtol: float,
) -> Row:
    """One point of the table from V/alpha^2 of the nonlinear sheet and from V_2, each with its
    error."""
    ratio, error = speed
    strip = strip_ratio(case, load, alpha)
    first, first_error = first_order_ratio(case.width, case.poisson, case.count, load, alpha, rtol)
    error += max(second[1], 0.0 if math.isnan(first) else first_error)
    differences = (strip - ratio, first - ratio, second[0] - ratio)
    return _row(case, load, alpha, ratio, error, differences)


def _row(
    case: Case,
    load: str,
    alpha: float,
    nonlinear: float,
    error: float,
    differences: tuple[float, float, float],
) -> Row:
    model = (case.growth_law, case.area, load)
    return Row(case.width, case.poisson, case.count, *model, alpha, nonlinear, error, *differences)


def nonlinear_speeds(case: Case, alpha: float, rtol: float) -> dict[str, tuple[float, float]]:
    """V/alpha^2 and its error by load; empty where the sheet has no shape."""
    scene = planar_scene(case.sheet, case.count, alpha, case.growth_law, case.area)
    try:
        cycle = Cycle(scene)
        tolerance = Tolerance(rtol, rtol * alpha**2)
        speeds = {load: cycle.speed(tolerance, Contact(load)) for load in LOADS}
    except (ConvergenceError, UnresolvedError):
        return {}
    return {load: (v.mean / alpha**2, v.error / alpha**2) for load, v in speeds.items()}


def strip_ratio(case: Case, load: str, alpha: float) -> float:
    """V/alpha^2 of the narrow strip, right to rounding."""
    speed = line_cycle_speed(alpha, case.growth_law, load, case.count, body="strip")
    return float(speed) / alpha**2


@functools.cache
def first_order_ratio(
    width: float, poisson: float, count: int, load: str, alpha: float, rtol: float
) -> tuple[float, float]:
    """V/alpha^2 of the small-strain theory and its error; NaN where its load is not positive."""
    try:
        found = field_speed(small_strain(width, poisson, count, 0.1 * rtol), alpha, load, rtol=rtol)
    except ValueError as problem:
        if "alpha" not in str(problem):
            raise
        return math.nan, math.nan
    return found.mean / alpha**2, found.error / alpha**2


@functools.cache
def small_strain(width: float, poisson: float, count: int, rtol: float) -> LinearField:
    """Deformation per unit alpha."""
    return airy_series(Sheet(width=width, poisson=poisson), SineWave(count), rtol=rtol)


def compute(path: Path, rtol: float = RTOL, kept: Sequence[Row] = ()) -> list[Row]:
    """All rows but those kept, written as they come."""
    chosen, found = list(cases()), {astuple(case): rows_of(case, kept) for case in cases()}
    for case in tracked("model error", chosen):
        if not found[astuple(case)]:
            found[astuple(case)] = rows(case, rtol)
            TABLE.write([row for some in found.values() for row in some], path)
    return [row for some in found.values() for row in some]


def rows_of(case: Case, table: Sequence[Row]) -> list[Row]:
    """Those of a case."""
    return [row for row in table if astuple(row)[: len(fields(Case))] == astuple(case)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(
        __doc__,
        arguments,
        rtol=(RTOL, "error of the speeds"),
        resume=(False, "keep the rows that are there"),
    )
    kept = TABLE.read(options.out) if options.resume and options.out.exists() else []
    compute(options.out, options.rtol, kept)


if __name__ == "__main__":
    main()

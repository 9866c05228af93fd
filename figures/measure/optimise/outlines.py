"""Best outlines of given area and length, by gradients, against the rectangle; and the nonlinear sheet.

    python -m figures.measure.optimise.outlines [--out FILE]

Writes figures/data/best_outlines.csv, one row at a time; it goes on where the file ends. The sheet of
the paper, area L^2/2, alpha = 0.1, is a trapezoid or a sum of four Legendre polynomials, nowhere
narrower than a fifth of its mean. Of two starts the better end is kept. The rectangle and the best
outline are then asked of the nonlinear sheet, by a cycle of its shapes.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem_check import Material, Membrane, Scene, cycle_speed
from fem_check.outlines.best import BestOutline, best_outline
from fem_check.outlines.shapes import LegendreShape, Shape
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from linear_theory import Contact, Sheet, SineWave, Tanh, TravellingWave
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.protocol import Wave

ALPHA = 0.1
SHEET = Sheet()

WAVES: dict[str, Wave] = {
    "sine": SineWave(),
    "pulse": TravellingWave(np.array([1.0, 0.3]), np.array([0.0, 0.0])),
}

FRICTIONS = {"viscous": "viscous", "tanh": Tanh(0.02), "dry": "coulomb"}
"""Slip speed in L/T."""

TRAPEZOID, GENERAL = 1, 4
"""Coefficients."""

PLACES = (
    ("sine", "viscous", GENERAL),
    ("sine", "tanh", GENERAL),
    ("sine", "viscous", TRAPEZOID),
    ("sine", "tanh", TRAPEZOID),
    ("pulse", "tanh", GENERAL),
    ("sine", "dry", GENERAL),
    ("pulse", "viscous", GENERAL),
    ("sine", "dry", TRAPEZOID),
)

STARTS = ((0.0, 0.0, 0.0, 0.0), (0.3, -0.2, 0.1, 0.1))

RTOL = 2e-3


@dataclass(frozen=True)
class Row:
    """A best outline. Speeds are towards +y or -y, the way of the rectangle, over alpha^2 L/T.

    coefficients: how many; a1 to a4: of it, see `LegendreShape`; rectangle, best: by theory, error: of
    the latter; left: percent that the certificate leaves; other: the worse end of the starts;
    sheet_rectangle, sheet_best: of the nonlinear sheet, sheet_error: of the latter; evaluations;
    seconds of the processor.
    """

    wave: str
    friction: str
    coefficients: int
    a1: float
    a2: float
    a3: float
    a4: float
    rectangle: float
    best: float
    error: float
    left: float
    other: float
    sheet_rectangle: float
    sheet_best: float
    sheet_error: float
    evaluations: int
    seconds: float


TABLE = Table(
    DATA / "best_outlines.csv",
    Row,
    "python -m figures.measure.optimise.outlines",
    f"area L^2/2, length L, alpha = {ALPHA:g}; speeds over alpha^2 L/T, left in percent, seconds of the "
    "processor",
    5,
)


def shape_of(row: Row) -> LegendreShape:
    """The outline of a row."""
    return LegendreShape(SHEET.width, SHEET.length, [row.a1, row.a2, row.a3, row.a4])


def searched(wave: str, friction: str, count: int, start: Sequence[float]) -> BestOutline:
    """From one start. Away from +y where the rectangle goes that way."""
    over = {f"coefficients.{i}": (-1.0, 1.0) for i in range(count)}
    shape, contact = LegendreShape(SHEET.width, SHEET.length, start), Contact(friction=law(friction))
    towards = -1 if (wave, friction) == ("pulse", "tanh") else 1
    return best_outline(shape, WAVES[wave], ALPHA, over, contact, towards=towards, rtol=RTOL)


def law(friction: str) -> object:
    """By its name in the table."""
    return FRICTIONS[friction]


def by_sheet(shape: Shape, wave: str, friction: str) -> CrawlSpeed:
    """The speed of the nonlinear sheet of that outline."""
    sheet = Sheet(shape.length, float(shape.widths().max()))
    stretching = Membrane(Material(sheet.thickness, sheet.poisson))
    scene = Scene(sheet, WAVES[wave], ALPHA, effects=[stretching], mesh=shape.mesh(1, 1))
    return cycle_speed(scene, friction=law(friction), rtol=5e-3)


def row(place: tuple[str, str, int]) -> Row:
    """Of a wave, a friction and a number of coefficients."""
    begin, (wave, friction, count) = time.process_time(), place
    ends = [searched(wave, friction, count, start[:count]) for start in STARTS]
    best = max(ends, key=lambda one: one.speed.value)
    assert isinstance(best.shape, LegendreShape)
    rectangle = LegendreShape(SHEET.width, SHEET.length, [0.0])
    flat, shaped = (by_sheet(shape, wave, friction) for shape in (rectangle, best.shape))
    unit, sign = ALPHA**2, np.sign(flat.mean)
    numbers = (*best.shape.coefficients, 0.0, 0.0, 0.0)[:GENERAL]
    return Row(
        wave,
        friction,
        count,
        *numbers,
        rectangle=ends[0].start.value / unit,
        best=best.speed.value / unit,
        error=best.speed.error / unit,
        left=100 * best.certificate.gain / abs(best.speed.value),
        other=min(one.speed.value for one in ends) / unit,
        sheet_rectangle=sign * flat.mean / unit,
        sheet_best=sign * shaped.mean / unit,
        sheet_error=shaped.error / unit,
        evaluations=sum(one.evaluations for one in ends),
        seconds=time.process_time() - begin,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments)
    Filling(TABLE, options.out, lambda one: (one.wave, one.friction, one.coefficients)).fill(
        PLACES, row
    )


if __name__ == "__main__":
    main()

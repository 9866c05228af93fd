"""Best outlines of given area and length, by gradients, against the rectangle; and the nonlinear sheet.

    python -m figures.measure.optimise.outlines [--out FILE]

Writes figures/data/best_outlines.csv, one row at a time; it goes on where the file ends. The sheet of
the paper, area L^2/2, alpha = 0.1, is a trapezoid or a sum of four Legendre polynomials, nowhere
narrower than a fifth of its mean, nor wider than twice that. The rectangle and the best outline are
then asked of the nonlinear sheet, by a cycle of its shapes.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem_check import Material, Membrane, Scene, cycle_speed
from fem_check.outlines.best import BestOutline, best_outline
from fem_check.outlines.gradient import outline_gradient
from fem_check.outlines.shapes import LegendreShape, Shape
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from linear_theory import Contact, Sheet, SineWave, Tanh, TravellingWave
from linear_theory.friction.law import FrictionLaw
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.protocol import Wave

ALPHA = 0.1
SHEET = Sheet()

WAVES: dict[str, Wave] = {
    "sine": SineWave(),
    "pulse": TravellingWave(np.array([1.0, 0.3]), np.array([0.0, 0.0])),
}

FRICTIONS: dict[str, FrictionLaw | str] = {"viscous": "viscous", "tanh": Tanh(0.02), "dry": "coulomb"}
"""Slip speed in L/T."""

TRAPEZOID, GENERAL = 1, 4
"""Coefficients."""

PLACES = (
    ("sine", "viscous", GENERAL),
    ("sine", "tanh", GENERAL),
    ("pulse", "tanh", GENERAL),
    ("sine", "tanh", TRAPEZOID),
    ("sine", "dry", TRAPEZOID),
    ("sine", "dry", GENERAL),
)

START = (0.2, -0.1, 0.1, 0.1)
"""No outline with the symmetries of the rectangle, which may be a saddle."""

RTOL = 3e-3


@dataclass(frozen=True)
class Row:
    """A best outline. Speeds are towards +y or -y, the way of the rectangle, over alpha^2 L/T.

    coefficients: how many; a1 to a4: of it, see `LegendreShape`; rectangle, best: by theory, error: of
    the latter; left: percent that the certificate leaves; sheet_rectangle, sheet_best: of the nonlinear
    sheet, sheet_error: of the latter; evaluations; seconds of the processor.
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
    sheet_rectangle: float
    sheet_best: float
    sheet_error: float
    evaluations: int
    seconds: float


TABLE = Table(
    DATA / "best_outlines.csv",
    Row,
    "python -m figures.measure.optimise.outlines",
    f"area L^2/2, length L, alpha = {ALPHA:g}; speeds over alpha^2 L/T, left in percent, seconds of "
    "one core",
    5,
)


def shape_of(row: Row) -> LegendreShape:
    """The outline of a row."""
    return LegendreShape(SHEET.width, SHEET.length, [row.a1, row.a2, row.a3, row.a4])


def searched(wave: str, friction: str, count: int, start: Sequence[float]) -> BestOutline:
    """From one start. Away from +y where the rectangle goes that way."""
    over = {f"coefficients.{i}": (-2.0, 2.0) for i in range(count)}
    shape, contact = LegendreShape(SHEET.width, SHEET.length, start), Contact(friction=law(friction))
    towards = -1 if (wave, friction) == ("pulse", "tanh") else 1
    return best_outline(shape, WAVES[wave], ALPHA, over, contact, towards=towards, rtol=RTOL)


def law(friction: str) -> FrictionLaw | str:
    """By its name in the table."""
    return FRICTIONS[friction]


def by_sheet(shape: Shape, wave: str, friction: str) -> CrawlSpeed:
    """The speed of the nonlinear sheet of that outline."""
    sheet = Sheet(shape.length, float(shape.widths().max()))
    stretching = Membrane(Material(sheet.thickness, sheet.poisson))
    scene = Scene(sheet, WAVES[wave], ALPHA, effects=[stretching], mesh=shape.mesh(1, 1))
    return cycle_speed(scene, friction=law(friction), rtol=2e-2)


def row(place: tuple[str, str, int]) -> Row:
    """Of a wave, a friction and a number of coefficients."""
    begin, (wave, friction, count) = time.process_time(), place
    best = searched(wave, friction, count, START[:count])
    assert isinstance(best.shape, LegendreShape)
    rectangle = LegendreShape(SHEET.width, SHEET.length, [0.0])
    flat, shaped = (by_sheet(shape, wave, friction) for shape in (rectangle, best.shape))
    contact = Contact(friction=law(friction))
    plain = outline_gradient(rectangle, WAVES[wave], ALPHA, ["length"], contact, rtol=RTOL).speed
    unit, sign = ALPHA**2, float(np.sign(flat.mean))
    a1, a2, a3, a4 = (*best.shape.coefficients, 0.0, 0.0, 0.0)[:GENERAL]
    return Row(
        wave=wave,
        friction=friction,
        coefficients=count,
        a1=a1,
        a2=a2,
        a3=a3,
        a4=a4,
        rectangle=abs(plain.mean) / unit,
        best=best.speed.value / unit,
        error=best.speed.error / unit,
        left=100 * best.certificate.gain / abs(best.speed.value),
        sheet_rectangle=sign * flat.mean / unit,
        sheet_best=sign * shaped.mean / unit,
        sheet_error=shaped.error / unit,
        evaluations=best.evaluations,
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

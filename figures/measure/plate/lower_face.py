"""V of two bonded layers with friction on the mid-surface and on the lower face of the sheet.

    python -m figures.measure.plate.lower_face [--out FILE]

Writes figures/data/lower_face.csv: two minutes of one core; it goes on where the file ends. Along each
line beta = +-3 alpha/h V/alpha^2 tends to a constant as alpha -> 0. On the lower face theory stands
beside cycles of shapes and steps in time at two couplings, from which that limit is extrapolated; dry
friction itself has no steps.
"""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from fem_check import cycle_speed, simulate
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure import saddle
from figures.measure.plate.saddle_range import BILAYER, GROUNDS
from linear_theory import Contact, Coulomb, FrictionLaw, OnLowerFace, crawl_speed, second_order
from linear_theory.scene.scene import Scene

SHARE = 0.3
"""The larger beta over that at which the pressure vanishes somewhere; the other is half of it."""

RTOL, THEORY, STEPS = 1e-3, 1e-4, 64
"""Of cycles, of theory, and the fewer steps of a period."""

LAWS: dict[str, FrictionLaw] = {"dry": Coulomb(), **saddle.LAWS}
"""For speeds per unit alpha."""


@dataclass(frozen=True)
class Row:
    """V/alpha^2 over L/T as alpha -> 0; way: the sign of beta/alpha; error: of `lower`.

    middle, lower: theory on the mid-surface and on the lower face; cycle, stepper: on the lower face.
    """

    ground: str
    law: str
    way: int
    middle: float
    lower: float
    error: float
    cycle: float
    stepper: float
    seconds: float


TABLE = Table(
    DATA / "lower_face.csv",
    Row,
    "python -m figures.measure.plate.lower_face",
    f"sine wave, V/alpha^2 in L/T on beta = way {BILAYER:g} alpha/L, seconds of the processor",
    6,
)


class Line(NamedTuple):
    """A ground, a law and the sign of beta/alpha."""

    ground: str
    law: str
    way: int


def line_of(row: Row) -> Line:
    """Of a row."""
    return Line(row.ground, row.law, row.way)


def wanted() -> list[Line]:
    """All lines of the table."""
    return [Line(g, law, way) for g in GROUNDS for law in LAWS for way in (1, -1)]


def scene(line: Line, alpha: float, lower: bool = True) -> Scene:
    """A sheet of two layers on its ground."""
    place, wave, law = saddle.PLACES[line.ground], saddle.WAVES["sine"], LAWS[line.law]
    if lower:
        law = OnLowerFace(law)
    beta = line.way * BILAYER * alpha
    if law.width > 0:
        return saddle.scene(place, wave, law, alpha, beta)
    found = saddle.scene(place, wave, saddle.LAWS["viscous"], alpha, beta)
    without = tuple(effect for effect in found.effects if effect.law is None)
    return found.but(effects=without, contact=Contact("ground", law))


class Theory(NamedTuple):
    """V/alpha^2 on the mid-surface and on the lower face, the error of that, and the alpha used."""

    middle: float
    lower: float
    error: float
    alpha: float


def theory_on(line: Line) -> Theory:
    """Theory on a line."""
    flat = saddle.scene(saddle.PLACES[line.ground], saddle.WAVES["sine"], saddle.LAWS["tanh"], 1, 0)
    alpha = SHARE * second_order(flat, rtol=RTOL).lift_off[1] / BILAYER
    middle, lower = (
        crawl_speed(scene(line, alpha, lower), order=2, rtol=THEORY) for lower in (False, True)
    )
    square = alpha**2
    return Theory(middle.mean / square, lower.mean / square, lower.error / square, alpha)


def row(line: Line) -> Row:
    """One row of the table."""
    begin = time.process_time()
    middle, lower, error, alpha = theory_on(line)
    cycle = limit(lambda a: cycle_speed(scene(line, a), rtol=RTOL).mean, alpha)
    stepper = math.nan if line.law == "dry" else limit(lambda a: stepped(line, a), alpha)
    return Row(*line, middle, lower, error, cycle, stepper, time.process_time() - begin)


def stepped(line: Line, alpha: float) -> float:
    """V of the second period, the error of second order in the step extrapolated."""
    few, many = (
        float(simulate(scene(line, alpha), 2, steps=s, mesh_error=False).period_speeds[-1])
        for s in (STEPS, 2 * STEPS)
    )
    return (4 * many - few) / 3


def limit(speed: Callable[[float], float], alpha: float) -> float:
    """V/alpha^2 as alpha -> 0, of a speed whose next order is two higher."""
    whole, half = (speed(a) / a**2 for a in (alpha, alpha / 2))
    return (4 * half - whole) / 3


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    Filling(TABLE, out, line_of).fill(wanted(), row)


if __name__ == "__main__":
    main()

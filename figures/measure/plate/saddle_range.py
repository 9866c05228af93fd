"""How far the quadratic form of V holds: V of cycles of shapes and of steps along two rays.

    python -m figures.measure.plate.saddle_range [--out FILE]

Writes figures/data/saddle_range.csv: three minutes of one core; it goes on where the file ends. The
rays are the lines beta = +-3 alpha/h of two equal layers of which one grows, on the paper's ground
and on one 100 times as stiff. Along a ray the form says that V/alpha^2 is constant.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

from fem_check import cycle_speed
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.saddle import COEFFICIENT, LAWS, PLACES, WAVES, by_steps, scene
from linear_theory import second_order
from linear_theory.speed.plate.quadratic_form import QuadraticForm

GROUNDS = ("paper", "stiff ground")

BILAYER = 100.0
"""beta L/alpha of two equal layers at h = 0.03 L: 3 L/h."""

SHARES = (0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0)
"""beta over that at which the pressure vanishes somewhere."""

BY_STEPS = (1.0, 2.0, 4.0)
"""Shares at which the stepper runs, too."""

RTOL = 3e-3


@dataclass(frozen=True)
class Row:
    """V/alpha^2 in L/T: of the form, of a cycle of shapes with its error, and of the stepper, NaN where
    it has not run.

    way: the sign of beta/alpha; beta, lift_off: size, over 1/L; seconds: of cycle and stepper together.
    """

    ground: str
    law: str
    way: int
    lift_off: float
    beta: float
    form: float
    cycle: float
    cycle_error: float
    stepper: float
    seconds: float


TABLE = Table(
    DATA / "saddle_range.csv",
    Row,
    "python -m figures.measure.plate.saddle_range",
    f"V/alpha^2 in L/T along beta = way {BILAYER:g} alpha/L, beta in 1/L, seconds of the processor",
    6,
)


class Place(NamedTuple):
    """A ground, a law, a ray and a place on it, over that of lift-off."""

    ground: str
    law: str
    way: int
    share: float


def place_of(row: Row) -> Place:
    """Of a row."""
    return Place(row.ground, row.law, row.way, round(row.beta / row.lift_off, 4))


def wanted() -> list[Place]:
    """All places of the table, ray by ray."""
    return [Place(g, law, way, s) for law in LAWS for g in GROUNDS for way in (1, -1) for s in SHARES]


@cache
def form_on(ground: str, law: str) -> QuadraticForm:
    """The quadratic form of a ground and a law."""
    flat = scene(PLACES[ground], WAVES["sine"], LAWS[law], 0.01, 0.0)
    return second_order(flat, rtol=COEFFICIENT).coefficients


def row(place: Place) -> Row:
    """One row of the table."""
    begin, form = time.process_time(), form_on(place.ground, place.law)
    sheet, wave, law = PLACES[place.ground], WAVES["sine"], LAWS[place.law]
    limit = form.lift_off[1]
    beta = place.share * limit
    alpha, small = beta / BILAYER, 0.5 * limit / BILAYER
    cycle = cycle_speed(scene(sheet, wave, law, alpha, place.way * beta), rtol=RTOL)
    steps = by_steps(sheet, wave, law)
    stepper = steps(alpha, place.way * beta) if place.share in BY_STEPS else math.nan
    return Row(
        *(place.ground, place.law, place.way),
        lift_off=limit,
        beta=beta,
        form=form.at(small, place.way * BILAYER * small).value / small**2,
        cycle=cycle.mean / alpha**2,
        cycle_error=cycle.error / alpha**2,
        stepper=stepper / alpha**2,
        seconds=time.process_time() - begin,
    )


def within(rows: Sequence[Row], ground: str, law: str, share: float) -> float:
    """The |beta| over 1/L up to which form and cycles differ by less than a share of V on both rays.

    Interpolated in beta^2, by which the difference grows; infinite where it stays below in the whole
    table. Raises ValueError, naming the command that makes the table, where it has no such rows.
    """
    return min(_crossing(ray(rows, ground, law, way), share) for way in (1, -1))


def ray(rows: Sequence[Row], ground: str, law: str, way: int) -> list[Row]:
    """The rows of one ray, by |beta|. Raises ValueError where the table has none."""
    found = [r for r in rows if (r.ground, r.law, r.way) == (ground, law, way)]
    if not found:
        raise ValueError(f"no {ground}, {law} in the table; `{TABLE.command}` makes it")
    return sorted(found, key=lambda r: r.beta)


def _crossing(rows: Sequence[Row], share: float) -> float:
    square, missed = 0.0, 0.0
    for r in rows:
        off = abs(r.form / r.cycle - 1)
        if off > share:
            part = (share - missed) / (off - missed)
            return math.sqrt(square + part * (r.beta**2 - square))
        square, missed = r.beta**2, off
    return math.inf


def complete(rows: Sequence[Row]) -> list[tuple[str, str]]:
    """Grounds and laws of which the table has both rays whole."""
    known = {place_of(r) for r in rows}
    missing = {(place.ground, place.law) for place in wanted() if place not in known}
    return [(g, law) for g in GROUNDS for law in LAWS if (g, law) not in missing]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    Filling(TABLE, out, place_of).fill(wanted(), row)


if __name__ == "__main__":
    main()

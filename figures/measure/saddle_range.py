"""How far the quadratic form of V holds: V of cycles of shapes and of steps along two rays.

    python -m figures.measure.saddle_range [--out FILE]

Writes figures/data/saddle_range.csv: three minutes of one core; it goes on where the file ends. The
rays are the lines beta = +-3 alpha/h of two equal layers of which one grows, on the paper's ground
and on one 100 times as stiff. Along a ray the form says that V/alpha^2 is constant.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

from fem_check import cycle_speed
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.measure.saddle import COEFFICIENT, LAWS, PLACES, WAVES, by_steps, scene
from linear_theory import second_order
from linear_theory.speed.quadratic_form import QuadraticForm

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
    "python -m figures.measure.saddle_range",
    f"V/alpha^2 in L/T along beta = way {BILAYER:g} alpha/L, beta in 1/L, seconds of the processor",
    6,
)


def row(ground: str, law: str, way: int, share: float, form: QuadraticForm) -> Row:
    """One row of the table; form: of this ground and law."""
    begin, place, rubs, wave = time.process_time(), PLACES[ground], LAWS[law], WAVES["sine"]
    limit = form.lift_off[1]
    beta = share * limit
    alpha, small = beta / BILAYER, 0.5 * limit / BILAYER
    asked = scene(place, wave, rubs, alpha, way * beta)
    cycle = cycle_speed(asked, rtol=RTOL)
    stepper = by_steps(place, wave, rubs)(alpha, way * beta) if share in BY_STEPS else math.nan
    return Row(
        ground,
        law,
        way,
        lift_off=limit,
        beta=beta,
        form=form.at(small, way * BILAYER * small).value / small**2,
        cycle=cycle.mean / alpha**2,
        cycle_error=cycle.error / alpha**2,
        stepper=stepper / alpha**2,
        seconds=time.process_time() - begin,
    )


def within(rows: Sequence[Row], ground: str, law: str, share: float) -> float:
    """The |beta| over 1/L up to which form and cycles differ by less than a share of V on both rays.

    Interpolated in beta^2, by which the difference grows; the largest beta of the table where it stays
    below. Raises ValueError, naming the command that makes the table, where it has no such rows.
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
    return rows[-1].beta


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    rows = TABLE.read(out) if out.exists() else []
    rays = [(ground, law) for law in LAWS for ground in GROUNDS]
    for ground, law in tracked("rays", [ray for ray in rays if not _known(rows, *ray)]):
        flat = scene(PLACES[ground], WAVES["sine"], LAWS[law], 0.01, 0.0)
        form = second_order(flat, rtol=COEFFICIENT).coefficients
        rows += [row(ground, law, way, s, form) for way in (1, -1) for s in SHARES]
        TABLE.write(rows, out)


def _known(rows: Sequence[Row], ground: str, law: str) -> bool:
    return any((r.ground, r.law) == (ground, law) for r in rows)


if __name__ == "__main__":
    main()

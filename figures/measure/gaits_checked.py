"""Whether the errors that are stated for bending gaits at random hold: some of them, run much finer.

    python -m figures.measure.gaits_checked [--out FILE] [--gaits figures/data/gaits.csv] [--every 5]
        [--workers 2]

Reads the table of `figures.measure.gaits` and writes figures/data/gaits_checked.csv, one row for every
fifth of its scenes that has a speed other than 0 (as symmetry makes that of a standing wave) and a
finite error; those that do not pass through themselves first, beyond which a speed is that of no real
sheet. Each runs again at a quarter of the tolerance, on a mesh 1.5 times finer in each direction: a
stated error is wrong if the speed moves by more. A run goes on where the file ends.
"""

import time
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import numpy as np

from fem_check.shell.stepping.run import Run
from fem_check.shell.stepping.settings import Settings
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure import gaits
from linear_theory.common.errors import SheetcrawlError

FINER = (6, 12)
"""Cells of the finer mesh."""

SHARPER = 4
"""Factor by which the tolerance of the steps is smaller."""

NOTHING = 1e-6
"""L/T; smaller speeds are 0 by symmetry, and their errors roundoff."""


@dataclass(frozen=True)
class Row:
    """A gait with the speed and the error that were stated, and its speed on the finer mesh with
    shorter steps, NaN if that stops; holds: whether they differ by at most the error (1, 0), -1 if
    unknown; crossed: whether either passes through itself; L/T, seconds of the processor."""

    number: int
    alpha: float
    kappa: float
    wave: str
    ground: str
    friction: str
    inertia: int
    speed: float
    error: float
    finer: float
    holds: int
    crossed: int
    seconds: float
    said: str


TABLE = Table(
    DATA / "gaits_checked.csv",
    Row,
    "python -m figures.measure.gaits_checked",
    f"finer: rtol = {gaits.RTOL / SHARPER:g}, cells {FINER}; alpha, kappa in 1/L, speeds in L/T",
    gaits.DIGITS,
)


def chosen(rows: Sequence[gaits.Row], every: int) -> list[gaits.Row]:
    """The scenes to check, those that do not pass through themselves first."""
    found = [
        row
        for row in rows
        if row.number % every == 0 and np.isfinite(row.error) and abs(row.speed) > NOTHING
    ]
    return sorted(found, key=lambda row: (row.crossed > 0, row.number))


def checked(stated: gaits.Row) -> Row:
    """Run a gait again, much finer, and compare."""
    gait = gaits.gait_of(stated)
    begin, crossed = time.process_time(), stated.crossed > 0
    known = {**vars(gait), "speed": stated.speed, "error": stated.error}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            run = Run(gait.scene.but(cells=FINER), Settings(gaits.PERIODS, rtol=gaits.RTOL / SHARPER))
            run.finish(None, None)
            found = run.trajectory()
    except SheetcrawlError as error:
        spent = time.process_time() - begin
        return Row(
            **known, finer=np.nan, holds=-1, crossed=int(crossed), seconds=spent, said=str(error)
        )
    finer = found.mean_speed
    crossed = crossed or (found.crossed is not None and bool(found.crossed.any()))
    row = Row(**known, finer=finer, holds=0, crossed=int(crossed), seconds=0.0, said="")
    holds = int(abs(finer - stated.speed) <= stated.error)
    return replace(row, holds=holds, seconds=time.process_time() - begin)


def main(arguments: Sequence[str] | None = None) -> None:
    """Check and write the table after each scene."""
    options = TABLE.options(
        __doc__,
        arguments,
        gaits=(str(gaits.TABLE.path), "table of gaits to check"),
        every=(5, "check those whose number it divides"),
        workers=(1, "processes"),
    )
    rows = chosen(gaits.TABLE.read(Path(options.gaits)), options.every)
    compute = partial(_numbered, {row.number: row for row in rows})
    numbers = [row.number for row in rows]
    Filling(TABLE, options.out, lambda row: row.number).fill(numbers, compute, options.workers)


def _numbered(rows: Mapping[int, gaits.Row], number: int) -> Row:
    return checked(rows[number])


if __name__ == "__main__":
    main()

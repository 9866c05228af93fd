"""Large deflections of shells that shear, by another code: the table behind words of the validation.

    python -m figures.measure.naghdi [--out FILE]

Writes figures/data/naghdi.csv, one row for every load, and goes on where the file ends. Needs ngsolve
(`pip install sheetcrawl[peers]`); two minutes of one core. The same shells as in
figures/validation/problems/shells.py, but of Naghdi's model, whose fibres need not stay normal: with
the shear stiffness of the material, and with thirty times that, next to Kirchhoff-Love.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table

STIFF = 30.0
"""Times the shear stiffness of the material: a thirtieth of what shear does, which is 2 % at most."""

DEGREE = 5


@dataclass(frozen=True)
class Row:
    """Deflections of the named points, the second NaN where there is one, at a share of the load.

    cells: along each side; shear: stiffness over that of the material; seconds: of the processor.
    """

    problem: str
    cells: int
    shear: float
    share: float
    first: float
    second: float
    seconds: float


TABLE = Table(
    DATA / "naghdi.csv",
    Row,
    "python -m figures.measure.naghdi",
    f"NGSolve, degree {DEGREE}; of the hemisphere outward, inward",
    7,
)

PATHS: dict[tuple[str, int, float], tuple[float, ...]] = {
    ("semi-cylinder", 6, 1.0): (0.1, 0.25),
    ("hemisphere", 6, 1.0): (0.05, 0.25, 0.5),
    ("semi-cylinder", 6, STIFF): (0.1, 0.25),
    ("hemisphere", 6, STIFF): (0.05,),
    ("hemisphere", 8, 1.0): (0.05, 0.25, 0.5),
}
"""Shares of the load by problem, cells and shear."""

Key = tuple[str, int, float, float]


def keys() -> list[Key]:
    """Of all rows."""
    return [(*path, share) for path, shares in PATHS.items() for share in shares]


@lru_cache
def solved(problem: str, cells: int, shear: float) -> dict[float, tuple[tuple[float, float], float]]:
    """Deflections and seconds at each share of the load."""
    from figures.measure.naghdi.shells import PROBLEMS  # ngsolve is of the peers

    begin, found = time.process_time(), {}
    shell = PROBLEMS[problem](cells, DEGREE, shear)
    for share in PATHS[problem, cells, shear]:
        shell.load(share)
        found[share] = shell.deflections(), time.process_time() - begin
    return found


def row(key: Key) -> Row:
    """Compute one row."""
    problem, cells, shear, share = key
    (first, second), seconds = solved(problem, cells, shear)[share]
    return Row(problem, cells, shear, share, first, second, seconds)


def known(problem: str, share: float, shear: float = 1.0) -> Row:
    """The row of the finest mesh."""
    rows = [r for r in TABLE.read() if (r.problem, r.share, r.shear) == (problem, share, shear)]
    return max(rows, key=lambda r: r.cells)


def main(arguments: Sequence[str] | None = None) -> None:
    """Fill the table."""
    options = TABLE.options(__doc__, arguments)
    Filling(TABLE, options.out, lambda r: (r.problem, r.cells, r.shear, r.share)).fill(keys(), row)

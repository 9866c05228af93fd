"""Results that others published, computed here: the table of docs/validation.md.

    python -m figures.measure.validation [--out FILE] [--only NAME]

Writes figures/data/validation.csv, one row for every number, and goes on where the file ends; a row
whose comparison has changed since, its numbers, its inputs or its scene files, is computed again. Ten
minutes of one core. --only computes the numbers of one comparison in any case, and prints them.
"""

import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.validation.catalogue import COMPARISONS
from figures.validation.comparison import agree
from linear_theory import Estimate
from linear_theory.common.errors import ViscousRegimeWarning

Key = tuple[str, int]

DIGITS = 10


@dataclass(frozen=True)
class Row:
    """One number: there with its accuracy, here with its error, and whether they agree (1, 0).

    comparison, number: its place in the catalogue; identity: of the comparison that was computed;
    seconds: of the processor, for all numbers of the comparison.
    """

    comparison: str
    number: int
    there: float
    accuracy: float
    here: float
    error: float
    agrees: int
    seconds: float
    identity: str


TABLE = Table(
    DATA / "validation.csv",
    Row,
    "python -m figures.measure.validation",
    "units as in the catalogue; seconds of one core",
    DIGITS,
)


def keys() -> list[Key]:
    """Of all numbers, in the order of the catalogue."""
    return [(name, k) for name, c in COMPARISONS.items() for k in range(len(c.numbers))]


@lru_cache
def solved(name: str) -> tuple[tuple[Estimate, ...], float]:
    """All numbers of a comparison, and what they cost; the numbers of one are asked for in turn."""
    begin = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)
        found = tuple(COMPARISONS[name].calculation.full())
    return found, time.process_time() - begin


def row(key: Key) -> Row:
    """Compute one number."""
    name, k = key
    comparison = COMPARISONS[name]
    (found, seconds), number = solved(name), comparison.numbers[k]
    here = found[k]
    return Row(
        name,
        k,
        number.value,
        number.accuracy,
        here.value,
        here.error,
        int(agree(number.value, number.accuracy, here.value, here.error)),
        seconds,
        comparison.identity,
    )


def fresh(row: Row) -> bool:
    """Whether a row is that of the comparison as it stands."""
    comparison = COMPARISONS.get(row.comparison)
    return comparison is not None and comparison.identity == row.identity


def main(arguments: Sequence[str] | None = None) -> None:
    """Fill the table."""
    options = TABLE.options(__doc__, arguments, only=("", "compute one comparison alone, by its name"))
    if options.only and options.only not in COMPARISONS:
        raise SystemExit(f"--only {options.only!r}: must be one of {', '.join(COMPARISONS)}")
    wanted = [key for key in keys() if options.only in ("", key[0])]
    Filling(TABLE, options.out, lambda r: (r.comparison, r.number), fresh).fill(wanted, row)
    if options.only:
        print("\n".join(map(told, map(row, wanted))))


def told(row: Row) -> str:
    """A number in a line."""
    name = COMPARISONS[row.comparison].numbers[row.number].name
    pairs = (row.there, row.accuracy), (row.here, row.error)
    there, here = (f"{value:.10g} +- {error:.2g}" for value, error in pairs)
    verdict = "agree" if row.agrees else "differ"
    return f"{name}: there {there}, here {here}: they {verdict}; {row.seconds:.2g} s"

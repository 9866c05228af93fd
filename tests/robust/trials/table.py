"""Thousands of random questions, each by its number: what was stated, what was true.

    python -m tests.robust.trials.table [--workers 2] [--out FILE]

Writes figures/data/random_trials.csv; an hour of one core, and it goes on where the file ends. Any row
can be asked again by `python -m tests.robust.trials.families`, whose trials they are.
"""

import resource
import time
from collections.abc import Sequence
from dataclasses import dataclass

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from tests.robust.trials.families import outcome

SEED = 2026

COUNTS = {
    "line": 1000,
    "speed": 500,
    "direction": 200,
    "field": 200,
    "bent": 150,
    "outline": 60,
    "prediction": 60,
    "command": 2000,
    "damaged": 2000,
    "kept": 1000,
}


@dataclass(frozen=True)
class Row:
    """A trial. refused: 1 if there was no answer; true, stated: errors, of the worst quantity, and
    their ratio; seconds of the processor, the better answer included; memory: the most that the
    process has had, MB."""

    family: str
    number: int
    refused: int
    true: float
    stated: float
    ratio: float
    seconds: float
    memory: float


TABLE = Table(
    DATA / "random_trials.csv",
    Row,
    "python -m tests.robust.trials.table",
    f"seed {SEED}; errors in units of the question, see tests/robust/trials",
    4,
)

Key = tuple[str, int]


def wanted() -> list[Key]:
    """All trials, the families mixed, so that a table that is not complete has some of each."""
    keys = [
        (number / count, family, number) for family, count in COUNTS.items() for number in range(count)
    ]
    return [(family, number) for _, family, number in sorted(keys)]


def measured(key: Key) -> Row:
    """One trial."""
    begin = time.process_time()
    found = outcome.__wrapped__(key[0], SEED, key[1])
    seconds = time.process_time() - begin
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return Row(*key, int(found.refused), found.true, found.stated, found.ratio, seconds, memory)


def main(arguments: Sequence[str] | None = None) -> None:
    """The table."""
    chosen = TABLE.options(__doc__, arguments, workers=(1, "processes"))
    filling = Filling(TABLE, chosen.out, lambda row: (row.family, row.number))
    filling.fill(wanted(), measured, chosen.workers)


if __name__ == "__main__":
    main()

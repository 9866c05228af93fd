"""Best waves on a strip on dry ground by the optimiser, against the bound and a linear program.

    python -m figures.measure.optimise.line [--out FILE]

Fills figures/data/best_waves.csv, row by row: ten minutes of computing, half of it for 40 harmonics.
For N harmonics with |c| <= 1, from waves at random: nTV/(alpha L) at alpha = 1e-3, where the small
strain makes it median c - mean c to 1e-3. Starts are the wave of 2 harmonics that is given, and seven
of a Sobol sequence.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem_check.optimisation import Harmonics, Optimum, optimise
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.optimise.one_arc import best_of_one_arc
from linear_theory import Scene, Sheet, TravellingWave
from linear_theory.line.best.dry import dry_bound

ALPHA = 1e-3

HARMONICS = (2, 3, 5, 10, 20, 40)

STARTS = 8


@dataclass(frozen=True)
class Row:
    """One number of harmonics.

    bound: that no wave reaches; most, reached: the linear program, too high and reached by a wave;
    best: of all starts; middle: their median; ended: how many are within 2 % of the best. left: percent
    that the certificate leaves, which holds up to 2. answers; seconds of processor time.
    """

    harmonics: int
    bound: float
    most: float
    reached: float
    best: float
    middle: float
    ended: int
    left: float
    answers: int
    seconds: float


TABLE = Table(
    DATA / "best_waves.csv",
    Row,
    "python -m figures.measure.optimise.line",
    f"nTV/(alpha L) at alpha = {ALPHA:g}, |c| <= 1, dry friction; left in percent, seconds of one core",
    5,
)


def found(harmonics: int, starts: int = STARTS) -> Optimum:
    """The best wave of so many harmonics."""
    scene = Scene(Sheet(), TravellingWave(np.array([1.0, 0.2]), np.zeros(2)), alpha=ALPHA)
    over = {"wave": Harmonics(harmonics, largest=1.0)}
    return optimise(scene, over, level="strip", starts=starts, check=False)


def row(harmonics: int) -> Row:
    """Of the table."""
    begin = time.process_time()
    best = found(harmonics)
    seconds = time.process_time() - begin
    program = best_of_one_arc(harmonics)
    return Row(
        harmonics=harmonics,
        bound=dry_bound(harmonics),
        most=program.most,
        reached=program.reached,
        best=best.value.value / ALPHA,
        middle=float(np.median([one.value for one in best.starts])) / ALPHA,
        ended=best.agreed,
        left=100 * best.left,
        answers=best.answers,
        seconds=seconds,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute the rows that are missing."""
    options = TABLE.options(__doc__, arguments)
    Filling(TABLE, options.out, key=lambda one: one.harmonics).fill(HARMONICS, row)


if __name__ == "__main__":
    main()

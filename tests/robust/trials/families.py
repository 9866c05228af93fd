"""Random questions, each with a better answer to compare with: does any error understate?

    python -m tests.robust.trials.families FAMILY COUNT [SEED]

asks COUNT questions of one of the FAMILIES and prints every trial whose error is understated and the
largest true error over the stated one. A trial is drawn from (seed, number) alone, so that one that
failed can be asked again. The suite asks the first few of each family (`test_random_trials`), and
`tests.robust.trials.table` thousands.
"""

import sys
import warnings
from collections.abc import Callable
from functools import cache

import numpy as np

from tests.robust.trials import command, damaged, kept, levels, theory
from tests.robust.trials.outcome import Outcome

Trial = Callable[[np.random.Generator], Outcome]

FAMILIES: dict[str, Trial] = {
    "speed": theory.speed,
    "line": theory.line,
    "direction": theory.direction,
    "field": levels.field,
    "outline": levels.outline,
    "bent": levels.bent,
    "prediction": levels.prediction,
    "command": command.command,
    "damaged": damaged.damaged,
    "kept": kept.kept,
}


@cache
def outcome(family: str, seed: int, number: int) -> Outcome:
    """Trial `number` of a family."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # remarks on regimes and reach
        return FAMILIES[family](np.random.default_rng([seed, number]))


def run(family: str, count: int, seed: int) -> float:
    """Print what fails, and the largest ratio, which is returned."""
    worst = 0.0
    for number in range(count):
        found = outcome(family, seed, number)
        worst = max(worst, found.ratio)
        if found.ratio > 1:
            print(f"{number}: {found.ratio:.3g} {found.words}", flush=True)
    print(
        f"{family}, {count} trials of seed {seed}: largest true error over the stated one {worst:.3g}"
    )
    return worst


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], int(sys.argv[2]), int([*sys.argv, "1"][3])) > 1)

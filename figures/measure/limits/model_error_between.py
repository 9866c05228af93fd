"""Whether the model error holds between the points of its table: random sheets, measured.

    python -m figures.measure.limits.model_error_between [--out FILE] [--sheets 40] [--resume]

Writes figures/data/model_error_between.csv: some ten minutes of computing. The sheets have widths,
Poisson ratios (0.2 and 0.4 among them) and alphas (0.05 and 0.15 among them) at which nothing was
measured for `linear_theory/data/model_error.csv`; each is compared, under every load, with the theories
whose bound that table gives.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.measure.model_error import RTOL, Case, compared, leading, nonlinear_speeds
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import WEIGHTS as LOADS
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.scene.scene import Scene
from linear_theory.speed.model_error import LEVELS, model_error
from linear_theory.wave.travelling import SineWave

SHEETS, SEED = 40, 20261127

POISSONS, ALPHAS = (0.2, 0.4), (0.05, 0.15)
"""In the middle between points of the table, where a bound is hardest; every second sheet has them."""

WIDTHS = {1: (0.1, 0.9), 2: (0.1, 0.45)}
"""Range of widths by waves on the sheet: wider ones have no stable shape beyond small alphas."""

STEEPEST = 0.38


@dataclass(frozen=True)
class Trial:
    """One theory and one sheet; difference, bound and error over alpha^2 L/T.

    difference: of the theory to the nonlinear sheet; bound: that of `model_error`; error: numerical, of
    both speeds.
    """

    sheet: int
    width: float
    poisson: float
    count: int
    growth_law: str
    area: str
    load: str
    alpha: float
    level: str
    difference: float
    bound: float
    error: float

    @property
    def share(self) -> float:
        """Of the bound, what the difference certainly takes."""
        return max(abs(self.difference) - self.error, 0.0) / self.bound


TABLE = Table(
    DATA / "model_error_between.csv",
    Trial,
    "python -m figures.measure.limits.model_error_between",
    "width in L, difference, bound and error over alpha^2 L/T",
    5,
)


def chosen(sheets: int = SHEETS) -> list[tuple[Case, float]]:
    """Random sheets with their alphas, the same at every call."""
    random, found = np.random.default_rng(SEED), []
    for i in range(sheets):
        count = int(random.integers(1, 3))
        width = float(np.exp(random.uniform(*np.log(WIDTHS[count]))))
        poisson, alpha = float(random.uniform(0.02, 0.48)), float(random.uniform(0.03, STEEPEST))
        if i % 2 == 0:
            poisson, alpha = float(random.choice(POISSONS)), float(random.choice(ALPHAS))
        law, area = str(random.choice(list(GROWTH_LAWS))), str(random.choice(list(Reference)))
        case = Case(round(width, 3), round(poisson, 3), count, law, area)
        found.append((case, round(alpha, 3)))
    return found


def trials(number: int, case: Case, alpha: float, rtol: float = RTOL) -> Iterator[Trial]:
    """All loads and theories of a sheet; none where it has no stable shape or no bound is known."""
    speeds = nonlinear_speeds(case, alpha, rtol)
    for load in LOADS if speeds else ():
        row = compared(case, load, alpha, speeds[load], leading(case, load, rtol), rtol)
        scene = Scene(
            case.sheet,
            SineWave(case.count),
            alpha,
            growth_law=case.growth_law,
            area=case.area,
            contact=Contact(load),
        )
        differences = row.strip, row.first_order, row.second_order
        for level, difference in zip(LEVELS, differences, strict=True):
            bound = model_error(level, scene) / alpha**2
            if not math.isnan(bound + difference):
                model = (case.growth_law, case.area, str(load))
                sheet = (number, case.width, case.poisson, case.count)
                yield Trial(*sheet, *model, alpha, level, difference, bound, row.error)


def compute(path: Path, sheets: int = SHEETS, kept: Sequence[Trial] = ()) -> list[Trial]:
    """All trials but those of sheets that are kept, written as they come."""
    found, known = list(kept), {trial.sheet for trial in kept}
    open_ones = [(i, *case) for i, case in enumerate(chosen(sheets)) if i not in known]
    for number, case, alpha in tracked("model error between", open_ones):
        found += trials(number, case, alpha)
        if found:
            TABLE.write(sorted(found, key=lambda trial: trial.sheet), path)
    return found


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table, and print the largest share of a bound for each theory."""
    options = TABLE.options(
        __doc__,
        arguments,
        sheets=(SHEETS, "how many random sheets"),
        resume=(False, "keep the sheets that are there"),
    )
    kept = TABLE.read(options.out) if options.resume and options.out.exists() else []
    found = sorted(compute(options.out, options.sheets, kept), key=lambda trial: trial.level)
    for level, group in itertools.groupby(found, lambda trial: trial.level):
        shares = [trial.share for trial in group]
        print(f"{level}: {len(shares)} trials, at most {max(shares):.2f} of the bound")


if __name__ == "__main__":
    main()

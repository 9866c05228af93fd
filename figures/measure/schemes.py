"""What the scheme of time integration does to the speed of a sheet that snaps through.

    python -m figures.measure.schemes [--out FILE] [--rtol 0.03]

Writes figures/data/schemes.csv: five minutes of computing. Three sheets of `figures.measure.gaits`, on
the printed ground under dry friction, driven by a wave of half a cycle over the sheet, without inertia
and with a density of 1e-5 E T^2/L^2: by backward differences, which damp what the steps do not resolve,
by Newmark's rule with steps that follow from rtol, and as the paper has it (beta = 1/4, gamma = 1/2,
steps of 5e-3, here in periods).
"""

import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass

from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.schemes import BackwardDifferences, Newmark, Scheme
from fem_check.shell.stepping.simulation import simulate
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.measure.gaits import Gait

RTOL, PERIODS = 0.03, 2

SHEETS = {"flat": (-0.25, 0.0), "bent": (-0.3, 3.3), "snapping": (-0.25, -5.0)}
"""alpha and the rest curvature per c, 1/L."""

SCHEMES: dict[str, Scheme | None] = {
    "none": None,
    "backward differences": BackwardDifferences(),
    "Newmark": Newmark(),
    "Newmark, 5e-3": Newmark(step=5e-3),
}
"""None: the sheet has no mass."""

DIGITS = 4


@dataclass(frozen=True)
class Row:
    """V of the last period in L/T with its estimated error, NaN where no step is found.

    before: V of the period before it; snapped: share of the steps that do not resolve the motion;
    crossed: share of the states in which the sheet passes through itself. seconds: of the processor.
    """

    sheet: str
    scheme: str
    speed: float
    error: float
    before: float
    snapped: float
    crossed: float
    steps: int
    seconds: float


TABLE = Table(
    DATA / "schemes.csv",
    Row,
    "python -m figures.measure.schemes",
    "phase wave, printed ground, dry friction; speeds in L/T, seconds of the processor",
    DIGITS,
)


def row(sheet: str, name: str, rtol: float = RTOL) -> Row:
    """One run."""
    scheme, begin = SCHEMES[name], time.process_time()
    scene = Gait(0, *SHEETS[sheet], "phase", "printed", "dry", int(scheme is not None)).scene
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            given = scheme is not None and scheme.step is not None
            found = simulate(scene, PERIODS, None if given else rtol, scheme=scheme)
        except ConvergenceError:
            lost = (float("nan"),) * 5
            return Row(sheet, name, *lost, 0, time.process_time() - begin)
    before, last = (float(v) for v in found.period_speeds[-2:])
    crossed = 0.0 if found.crossed is None else float(found.crossed.mean())
    shares = float(found.snapped.mean()), crossed
    steps, seconds = len(found.times) - 1, time.process_time() - begin
    return Row(sheet, name, last, found.speed.error, before, *shares, steps, seconds)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, rtol=(RTOL, "relative error of the velocities"))
    chosen = [(sheet, name) for sheet in SHEETS for name in SCHEMES]
    TABLE.write([row(*c, options.rtol) for c in tracked("schemes", chosen)], options.out)


if __name__ == "__main__":
    main()

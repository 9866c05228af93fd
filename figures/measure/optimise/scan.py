"""Best numbers of a scene by its gradient, against a plain scan of a grid.

    python -m figures.measure.optimise.scan [--out FILE]

Fills figures/data/best_numbers.csv, one row for each question, 5 to 100 s of the processor. The number
of waves is taken as a real number here (`FractionalWave`), which scene files do not have. A search and
a scan agree where the best places differ by no more than the spacing of the grid, and the search is no
worse than the scan but for the errors of both.
"""

import itertools
import math
import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.optimise import couplings
from figures.measure.optimise.rows import Row, told
from linear_theory import Contact, Scene, Sheet, SineWave, TravellingWave, crawl_speed, speed_gradient
from linear_theory.common.errors import SheetcrawlError
from linear_theory.gradient import parameters
from linear_theory.optimisation.problem import Evaluation, Region, Unusable
from linear_theory.optimisation.search import Ascent, Climbed, climb
from linear_theory.optimisation.starts import starts

Array = NDArray[np.float64]

RTOL, SCANNED = 1e-3, 1e-3
"""Of the speeds, of searches and of scans."""

STARTS = 3

HOW = Ascent(iterations=40, change=1e-6)

PULSE = TravellingWave(np.array([1.0, 0.2]), np.zeros(2))
"""Runs against the wave while growth is small."""


class Over(NamedTuple):
    """A number that may change, between bounds, and how many places of it are scanned."""

    name: str
    low: float
    high: float
    places: int

    @property
    def grid(self) -> Array:
        """The places."""
        return np.linspace(self.low, self.high, self.places)

    @property
    def spacing(self) -> float:
        """Of the grid."""
        return (self.high - self.low) / (self.places - 1)


class Question(NamedTuple):
    """A scene, what may change, and whether V (1) or -V (-1) is to be large."""

    scene: Scene
    over: tuple[Over, ...]
    sign: int = 1

    def at(self, numbers: Sequence[float]) -> Scene:
        """The scene with these numbers."""
        found = self.scene
        for one, number in zip(self.over, numbers, strict=True):
            found = parameters(one.name)[0].changed(found, float(number))
        return found

    def numbers(self, point: Array) -> list[float]:
        """Of a point with coordinates from 0 to 1."""
        return [
            one.low + float(x) * (one.high - one.low) for one, x in zip(self.over, point, strict=True)
        ]

    def __call__(self, point: Array) -> Evaluation:
        """V and its gradient; see `linear_theory.optimisation.problem.Objective`."""
        names = [one.name for one in self.over]
        try:
            found = speed_gradient(self.at(self.numbers(point)), names, rtol=RTOL)
        except (SheetcrawlError, ArithmeticError) as problem:
            raise Unusable(str(problem)) from None
        ranges = np.array([one.high - one.low for one in self.over])
        value, speed = self.sign * found.speed.mean, found.speed
        gradient, doubt = self.sign * ranges * found.values, ranges * found.errors
        return Evaluation(value, speed.error, gradient, doubt, "; ".join(found.kinks))

    @property
    def region(self) -> Region:
        """All of it."""
        half = np.full(len(self.over), 0.5)
        return Region(0 * half, 1 + 0 * half, half, half)


def _flat(width: float, friction: str, wave: TravellingWave, alpha: float = 0.1) -> Scene:
    contact = Contact.named("current", friction, None)
    return Scene(Sheet(width=width), wave, alpha=alpha, contact=contact)


COUNT, WIDTH = Over("wave.count", 0.3, 1.8, 31), Over("sheet.width", 0.1, 1.0, 19)

QUESTIONS = {
    "waves, viscous strip": Question(_flat(0.05, "viscous", SineWave()), (COUNT,)),
    "waves, paper's sheet": Question(_flat(0.5, "coulomb", SineWave()), (COUNT,)),
    "width, sine": Question(_flat(0.5, "coulomb", SineWave()), (WIDTH,)),
    "width, pulse, against the wave": Question(_flat(0.5, "coulomb", PULSE, 0.05), (WIDTH,), -1),
    "alpha and waves, pulse, against the wave": Question(
        _flat(0.5, "coulomb", PULSE),
        (Over("growth.alpha", 0.02, 0.14, 9), Over("wave.count", 0.5, 2.0, 16)),
        -1,
    ),
}


TABLE = Table(
    DATA / "best_numbers.csv",
    Row,
    "python -m figures.measure.optimise.scan",
    f"V in L/T at first order unless said, {STARTS} starts each; seconds of one core",
    6,
)


def searched(question: Question, count: int = STARTS) -> list[Climbed]:
    """Climbs from a Sobol sequence, the best one first."""
    points = starts(question.region, count, seed=0)
    ends = [climb([question], question, question.region, point, HOW) for point in points]
    return sorted(ends, key=lambda one: -one.value)


class Scanned(NamedTuple):
    """The best place of a grid and V there, towards the side that is asked for."""

    numbers: tuple[float, ...]
    value: float
    error: float


def scanned(question: Question) -> Scanned:
    """The grid, every place on its own by `crawl_speed`."""
    found = []
    for numbers in itertools.product(*(one.grid for one in question.over)):
        speed = crawl_speed(question.at(numbers), rtol=SCANNED)
        found.append(Scanned(numbers, question.sign * speed.mean, speed.error))
    return max(found, key=lambda one: one.value)


WHOLE, MOST_WHOLE = "whole waves, paper's sheet", 4
"""The question, and the largest number that is scanned."""


def whole_row() -> Row:
    """The best whole number of waves: one of the two beside the best real one, at least 1."""
    question, begin = QUESTIONS["waves, paper's sheet"], time.process_time()
    ends = searched(question, 1)
    (real,) = question.numbers(ends[0].point)
    near = {max(1, math.floor(real)), max(1, math.ceil(real))}
    found = {count: crawl_speed(question.at([count]), rtol=RTOL) for count in near}
    best = max(found, key=lambda count: found[count].mean)
    middle = time.process_time()
    speeds = {n: crawl_speed(question.at([n]), rtol=SCANNED) for n in range(1, MOST_WHOLE + 1)}
    most = max(speeds, key=lambda count: speeds[count].mean)
    return Row(
        question=WHOLE,
        names="wave.count",
        found=told([best]),
        scanned=told([most]),
        spacing="1",
        value=found[best].mean,
        error=found[best].error,
        scan_value=speeds[most].mean,
        scan_error=speeds[most].error,
        ended=1,
        evaluations=ends[0].evaluations + len(near),
        places=MOST_WHOLE,
        seconds=middle - begin,
        scan_seconds=time.process_time() - middle,
    )


def row(name: str) -> Row:
    """Of the table."""
    if name == couplings.QUESTION:
        return couplings.row()
    if name == WHOLE:
        return whole_row()
    question, begin = QUESTIONS[name], time.process_time()
    ends = searched(question)
    middle = time.process_time()
    scan = scanned(question)
    best = ends[0].found
    assert best is not None

    return Row(
        question=name,
        names=" ".join(one.name for one in question.over),
        found=told(question.numbers(ends[0].point)),
        scanned=told(scan.numbers),
        spacing=told([one.spacing for one in question.over]),
        value=best.value,
        error=best.error,
        scan_value=scan.value,
        scan_error=scan.error,
        ended=sum(one.value >= best.value - 0.01 * abs(best.value) for one in ends),
        evaluations=sum(one.evaluations for one in ends),
        places=int(np.prod([one.places for one in question.over])),
        seconds=middle - begin,
        scan_seconds=time.process_time() - middle,
    )


def asked() -> list[str]:
    """All questions, in the order of the table."""
    return [*QUESTIONS, WHOLE, couplings.QUESTION]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute the rows that are missing."""
    options = TABLE.options(__doc__, arguments)
    Filling(TABLE, options.out, lambda one: one.question).fill(asked(), row)


if __name__ == "__main__":
    main()

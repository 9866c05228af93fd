"""What optimisation buys: the sine against the best wave of its size, on five sheets, by every level.

    python -m figures.measure.optimise.buys [--out FILE]

Fills figures/data/optimisation_buys.csv, one row for each search, 5 s to some minutes of the processor;
it goes on where the file ends. Every wave is valued by every level, the nonlinear sheet (a cycle of
static shapes) above all. Searches at first order climb from the sine and from waves of a Sobol
sequence; at second order and on the cycle from the best wave of first order.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from fem_check import Harmonics, optimise, solve
from fem_check.optimisation.result import Optimum
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from linear_theory import Contact, Coulomb, Directional, Scene, Sheet, SineWave, TravellingWave, Viscous
from linear_theory.friction.law import FrictionLaw
from linear_theory.optimisation.search import Ascent

ALPHA = 0.1

SHEETS: dict[str, tuple[Sheet, FrictionLaw]] = {
    "paper": (Sheet(width=0.5), Coulomb()),
    "strip": (Sheet(width=0.1), Coulomb()),
    "wide": (Sheet(width=1.0), Coulomb()),
    "viscous": (Sheet(width=0.375), Viscous()),
    "directional": (Sheet(width=0.5), Directional(0.5, 1.0, 1.0)),
}
"""Widths over L; all with a Poisson ratio of 1/2. "viscous" has the shape of the hydrogel of the
README; "directional" resists backward slip twice as much as forward slip."""

SIZES = {
    "largest": partial(Harmonics, largest=1.0),
    "mean_square": partial(Harmonics, mean_square=0.5),
}
"""Of the waves, those of the sine: largest |c|, and the mean of c^2."""

LEVELS = ("strip", "first order", "second order", "cycle")

GIVEN = "sine"
"""In place of a level: the wave that no one has searched for."""

FEW, MORE = 2, 5
"""Harmonics; with more of them only those levels search whose gradients are cheap."""

BY_ADJOINT = ("strip", "first order")

RTOL = {"strip": 1e-3, "first order": 1e-3, "second order": 1e-3, "cycle": 1e-2}
"""Of the speeds of a search."""

FINAL = 3e-3
"""Of the speeds on the cycle by which waves are valued."""

STARTS = {"strip": 4, "first order": 3}
"""Of searches by adjoints; the others have one."""

HOW = {"strip": Ascent(), "first order": Ascent(iterations=30, change=1e-5)}
NEAR = Ascent(iterations=12, change=1e-4)
"""Of climbs, by level, and of those from a wave that is good already: numerical errors of speeds leave
no more to be gained."""


@dataclass(frozen=True)
class Place:
    """A search. sheet, size: of SHEETS and SIZES; harmonics; level: by which it finds speeds."""

    sheet: str
    size: str
    harmonics: int
    level: str


@dataclass(frozen=True)
class Row(Place):
    """Its wave and what that is worth.

    strip, first, second, cycle: V in L/T by these levels, with their numerical errors. left: percent
    that the certificate leaves; seconds of the processor, of the search (beyond that of first order,
    from which it begins) and of the cycle that values the wave. mean, cosine, sine: of the wave,
    amplitudes of its harmonics in turn.
    """

    strip: float
    strip_error: float
    first: float
    first_error: float
    second: float
    second_error: float
    cycle: float
    cycle_error: float
    left: float
    seconds: float
    cycle_seconds: float
    mean: float
    cosine: str
    sine: str

    @property
    def wave(self) -> TravellingWave:
        """As an object."""
        cosine, sine = (np.array([float(a) for a in t.split()]) for t in (self.cosine, self.sine))
        return TravellingWave(cosine, sine, mean=self.mean)


TABLE = Table(
    DATA / "optimisation_buys.csv",
    Row,
    "python -m figures.measure.optimise.buys",
    f"V in L/T, alpha = {ALPHA:g}, one wave on the sheet; left in percent, seconds of one core",
    6,
)


def scene(sheet: str, wave: TravellingWave | None = None) -> Scene:
    """One of SHEETS under a wave, the sine unless given."""
    shape, law = SHEETS[sheet]
    return Scene(shape, wave or SineWave(), alpha=ALPHA, contact=Contact("current", law))


def _nearby(place: Place) -> TravellingWave:
    """The best wave of first order; from the table, where that has it."""
    wanted = Place(place.sheet, place.size, place.harmonics, "first order")
    kept = TABLE.read() if TABLE.path.exists() else []
    return next((one.wave for one in kept if place_of(one) == wanted), None) or _wave(search(wanted)[0])


def _wave(found: Optimum) -> TravellingWave:
    wave = found.scene.drive.series
    assert wave is not None
    return wave


def search(place: Place) -> tuple[Optimum, float]:
    """The best wave, and the seconds that its search took."""
    over = {"wave": SIZES[place.size](place.harmonics)}
    near = place.level not in BY_ADJOINT
    start = scene(place.sheet, _nearby(place) if near else None)
    begin = time.process_time()
    found = optimise(
        start,
        over,
        level=place.level,
        rtol=RTOL[place.level],
        starts=STARTS.get(place.level, 1),
        how=HOW.get(place.level, NEAR),
        check=False,
    )
    return found, time.process_time() - begin


def row(place: Place) -> Row:
    """Of the table."""
    if place.level == GIVEN:
        sine = TravellingWave(np.zeros(1), np.ones(1))
        return valued(place, sine, float("nan"), 0.0)
    found, seconds = search(place)
    return valued(place, _wave(found), 100 * found.left, seconds)


def valued(place: Place, wave: TravellingWave, left: float, seconds: float) -> Row:
    """A wave by all levels."""
    own = scene(place.sheet, wave)
    found = {level: solve(own, level, RTOL[level]).speed for level in LEVELS[:-1]}
    begin = time.process_time()
    found["cycle"] = solve(own, "cycle", FINAL).speed
    spent = time.process_time() - begin
    cosine, sine = (" ".join(f"{a:.5f}" for a in part) for part in (wave.cosine, wave.sine))
    values: dict[str, Any] = {}
    for level, speed in found.items():
        name = level.split()[0]
        values |= {name: speed.mean, f"{name}_error": speed.error}
    return Row(
        **vars(place),
        **values,
        left=left,
        seconds=seconds,
        cycle_seconds=spent,
        mean=wave.mean,
        cosine=cosine,
        sine=sine,
    )


def places() -> Iterator[Place]:
    """In an order in which any part of the table covers all sheets."""
    for sheet in SHEETS:
        yield Place(sheet, "largest", 1, GIVEN)
    for size in SIZES:
        for level in BY_ADJOINT:
            yield from (Place(sheet, size, FEW, level) for sheet in SHEETS)
    for level in BY_ADJOINT:
        yield from (Place(sheet, "largest", MORE, level) for sheet in SHEETS)
    for size in SIZES:
        for level in reversed(LEVELS[2:]):
            yield from (Place(sheet, size, FEW, level) for sheet in SHEETS)


def place_of(found: Row) -> Place:
    """Without its wave."""
    return Place(found.sheet, found.size, found.harmonics, found.level)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute the rows that are missing."""
    options = TABLE.options(__doc__, arguments)
    Filling(TABLE, options.out, place_of).fill(list(places()), row)


if __name__ == "__main__":
    main()

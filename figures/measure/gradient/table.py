"""The gradient of the speed against central differences, at random scenes, and what it costs.

    python -m figures.measure.gradient [--out FILE] [--scenes 100] [--workers 2]

Writes figures/data/gradients.csv: three minutes of one core; a run goes on where the file ends, and
each row is made from its number alone. Random scenes: a sheet, a travelling wave of 2 to 5 harmonics
with a mean, a coupling of either sign, a load, and a law of friction. Of each:

* V on a frozen grid of times and cells, along a random direction in the space of all parameters: the
  derivative by the adjoint, and by central differences of fourth order;
* the errors that `speed_gradient` states, against those it has: the derivatives of a speed that is 10
  to 30 times as accurate are the truth. The parameter whose error is the largest share of the stated
  one is written down.

Then the cost of 40 parameters, of a wave of 18 harmonics and of a sine: seconds of the processor for
the gradient over those for the speed. That of a sine needs a hundredth of what 18 harmonics need, of
which the derivatives are asked for: they are compared with the speed of such a wave, too.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.gradient.frozen import difference
from figures.measure.gradient.scenes import LAWS, names_of, scene_of
from linear_theory import Scene, TravellingWave, crawl_speed
from linear_theory.gradient import SpeedGradient, speed_gradient

SEED = 20261126

LOOSE = {"viscous": 1e-3, "tanh": 1e-3, "directional": 3e-3, "coulomb": 1e-2}
"""Relative tolerances of the speeds whose gradients are checked."""

TIGHT = {"viscous": 3e-5, "tanh": 1e-4, "directional": 3e-4, "coulomb": 1e-3}
"""Of those that are the truth."""

MANY = 18
"""Harmonics of the waves with 40 parameters."""

ROUNDING = 1e-12
"""Of the largest derivative; smaller errors do not count."""

DIGITS = 4


@dataclass(frozen=True)
class Row:
    """One scene.

    kind: "accuracy", "cost" of 40 parameters of a wave that has their harmonics, or "cost of a sine",
    which has not; friction, load, harmonics, alpha, width, poisson: of the scene; count: of parameters;
    rtol: of the speed.
    difference: of the derivative along a random direction by the adjoint and by central differences, on
    a frozen grid, over the size of all its parts. parameter: the one whose derivative has the largest
    share of its stated error; gradient, error: its derivative and stated error; true_error; share.
    ratio: seconds of the gradient over those of the speed; against: over those of the speed of a wave
    that has all harmonics. seconds: of the processor, for the row. NaN where not measured.
    """

    number: int
    kind: str
    friction: str
    load: str
    harmonics: int
    alpha: float
    width: float
    poisson: float
    count: int
    rtol: float
    difference: float
    parameter: str
    gradient: float
    error: float
    true_error: float
    share: float
    ratio: float
    against: float
    seconds: float


TABLE = Table(
    DATA / "gradients.csv",
    Row,
    "python -m figures.measure.gradient",
    "V in L/T; difference: between the derivative by the adjoint and by central "
    "differences on a frozen grid, relative; share: largest error of a derivative over the stated one, "
    "that of the parameter; ratio: processor time of the gradient over that of the speed; against: "
    "over that of the speed of a wave with all harmonics",
    DIGITS,
)


class Key(NamedTuple):
    """What makes a row."""

    kind: str
    number: int


class Worst(NamedTuple):
    """The parameter whose true error is the largest share of the stated one."""

    parameter: str
    gradient: float
    error: float
    true_error: float
    share: float

    @classmethod
    def of(cls, loose: SpeedGradient, tight: SpeedGradient) -> "Worst":
        """Errors below rounding do not count."""
        errors = abs(loose.values - tight.values)
        floor = ROUNDING * abs(tight.values).max()
        shares = np.maximum(errors - floor, 0.0) / np.maximum(loose.errors, floor)
        i = int(np.argmax(shares))
        return cls(loose.names[i], *(float(a[i]) for a in (loose.values, loose.errors, errors, shares)))


UNKNOWN = Worst("", np.nan, np.nan, np.nan, np.nan)


def row_of(key: Key) -> Row:
    """The row of a kind and a number, from these alone."""
    begin, name = time.process_time(), LAWS[key.number % len(LAWS)]
    random = np.random.default_rng((SEED, key.number))
    made = MAKERS[key.kind](name, random)
    return replace(made, number=key.number, kind=key.kind, seconds=time.process_time() - begin)


def accuracy(name: str, random: np.random.Generator) -> Row:
    """Of both derivatives of a random scene, and of the stated errors."""
    scene = scene_of(name, random)
    over = names_of(scene)
    off = difference(scene, random)
    loose, ratio, _ = timed(name, scene, over)
    return _row(name, scene, len(over), off, worst(scene, over, name, loose), ratio)


def worst(scene: Scene, over: Sequence[str], name: str, loose: SpeedGradient | None = None) -> Worst:
    """Of a scene with friction of that kind, against a speed that is more accurate."""
    loose = loose or speed_gradient(scene, over, rtol=LOOSE[name])
    return Worst.of(loose, speed_gradient(scene, over, rtol=TIGHT[name]))


def cost(name: str, random: np.random.Generator) -> Row:
    """Of the derivatives by the mean, the harmonics, and numbers of the sheet."""
    scene = scene_of(name, random, MANY)
    over = _forty(scene)
    ratio = timed(name, scene, over)[1]
    return _row(name, scene, len(over), np.nan, UNKNOWN, ratio, ratio)


def cost_of_a_sine(name: str, random: np.random.Generator) -> Row:
    """The same at a sine, which has one of these harmonics."""
    full = scene_of(name, random, MANY)
    over, scene = _forty(full), full.but(wave=TravellingWave(np.zeros(1), np.ones(1)))
    loose, ratio, seconds = timed(name, scene, over)
    found = worst(scene, over, name, loose)
    return _row(name, scene, len(over), np.nan, found, ratio, seconds / timed_speed(name, full))


def _forty(scene: Scene) -> list[str]:
    return [one for one in names_of(scene) if not one.startswith("friction")]


MAKERS = {"accuracy": accuracy, "cost": cost, "cost of a sine": cost_of_a_sine}
"""Of the kinds of rows."""


def timed(name: str, scene: Scene, over: Sequence[str]) -> tuple[SpeedGradient, float, float]:
    """A gradient, seconds of the processor for it over those for the speed, and these seconds."""
    start = time.process_time()
    found = speed_gradient(scene, over, rtol=LOOSE[name])
    both, speed = time.process_time() - start, timed_speed(name, scene)
    return found, (both - speed) / speed, both - speed


def timed_speed(name: str, scene: Scene) -> float:
    """Seconds of the processor for a speed."""
    start = time.process_time()
    crawl_speed(scene, rtol=LOOSE[name], method="ritz")
    return time.process_time() - start


def _row(
    name: str,
    scene: Scene,
    count: int,
    off: float,
    found: Worst,
    ratio: float,
    against: float = np.nan,
) -> Row:
    wave = scene.wave
    assert isinstance(wave, TravellingWave)
    return Row(
        number=0,
        kind="",
        friction=name,
        load=str(scene.contact.load),
        harmonics=wave.cosine.size,
        alpha=scene.alpha,
        width=scene.sheet.width,
        poisson=scene.sheet.poisson,
        count=count,
        rtol=LOOSE[name],
        difference=off,
        **found._asdict(),
        ratio=ratio,
        against=against,
        seconds=0.0,
    )


def wanted(scenes: int) -> list[Key]:
    """Of all rows."""
    costs = [Key(kind, number) for kind in ("cost", "cost of a sine") for number in range(len(LAWS))]
    return [Key("accuracy", number) for number in range(scenes)] + costs


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute the rows that are missing; the table is written after each."""
    options = TABLE.options(__doc__, arguments, scenes=(100, "random scenes"), workers=(1, "processes"))
    filling = Filling(TABLE, options.out, key=lambda row: Key(row.kind, row.number))
    filling.fill(wanted(options.scenes), row_of, options.workers)

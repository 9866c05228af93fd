"""Gradients of order 2 and of cycles of shapes against differences of whole evaluations.

Random scenes as in `table`; of two of three the wave has a symmetry, V(t_0 - t) = V(t), by which only a
part of the period is solved for, and half of the parameters break it: amplitudes of sines beside
cosines, of cosines and of even harmonics beside odd sines. The truth is the extrapolated central
difference of speeds that are found anew to a finer tolerance, those of cycles on a finer mesh.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fem_check import cycle_gradient, cycle_speed
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.gradient.scenes import LAWS, names_of, scene_of
from linear_theory import Scene, TravellingWave, crawl_speed
from linear_theory.gradient import Parameter, SpeedGradient, speed_gradient
from linear_theory.speed.result import CrawlSpeed

SEED = 20261127

SYMMETRIES = ("none", "cosines", "odd sines")
"""Of the waves, in turn."""

LOOSE = {"viscous": 1e-3, "tanh": 1e-3, "directional": 3e-3, "coulomb": 1e-2}
"""Relative tolerances of speeds of order 2 whose gradients are checked."""

TIGHT = {"viscous": 1e-5, "tanh": 1e-5, "directional": 1e-4, "coulomb": 2e-3}
"""Of those that are the truth."""

COARSE, FINE = (2, 4), (3, 6)
"""Meshes of cycles: of the gradient and of the truth."""

CYCLE, CYCLE_TRUTH = 1e-2, 2e-3
"""Tolerances of cycles."""

STABLE = 0.6
"""Share of the growth of other scenes at which flat sheets do not wrinkle."""

STEPS = 0.04, 0.02
"""Of differences, relative to 1 for waves, else to the parameter, but for those of SIZES."""

SIZES = {"sheet.poisson": 0.2}

DIGITS = 4


@dataclass(frozen=True)
class Row:
    """One scene.

    theory: "order 2" or "cycle"; symmetry: of the wave, one of SYMMETRIES; friction, load, harmonics,
    alpha, width, poisson: of the scene; rtol: of the speed. parameter: the one whose derivative has the
    largest share of its errors; gradient, error: its derivative and stated error; truth, doubt: that by
    differences and its own error; share: of the difference of both in the larger of these errors.
    seconds: of the processor, for the row.
    """

    number: int
    theory: str
    symmetry: str
    friction: str
    load: str
    harmonics: int
    alpha: float
    width: float
    poisson: float
    rtol: float
    parameter: str
    gradient: float
    error: float
    truth: float
    doubt: float
    share: float
    seconds: float


TABLE = Table(
    DATA / "gradients_other.csv",
    Row,
    "python -m figures.measure.gradient.others",
    "V in L/T; share: of the difference to differences of speeds in the stated error of the "
    "derivative, or in theirs if that is larger; the largest of all parameters of a scene",
    DIGITS,
)


class Key(NamedTuple):
    """What makes a row."""

    theory: str
    number: int


class Level(NamedTuple):
    """How a gradient and a more accurate speed are found; rtol: of the speed of the gradient."""

    rtol: float
    gradient: Callable[[Scene, Sequence[str]], SpeedGradient]
    speed: Callable[[Scene], CrawlSpeed]


def level_of(theory: str, law: str) -> Level:
    """For friction of that kind."""
    if theory == "cycle":
        return Level(
            CYCLE,
            lambda scene, over: cycle_gradient(scene.but(cells=COARSE), over, rtol=CYCLE),
            lambda scene: cycle_speed(scene.but(cells=FINE), rtol=CYCLE_TRUTH),
        )
    return Level(
        LOOSE[law],
        lambda scene, over: speed_gradient(scene, over, order=2, rtol=LOOSE[law]),
        lambda scene: crawl_speed(scene, order=2, rtol=TIGHT[law]),
    )


def row_of(key: Key) -> Row:
    """The row of a theory and a number, from these alone."""
    begin, name = time.process_time(), LAWS[key.number % len(LAWS)]
    symmetry = SYMMETRIES[key.number % len(SYMMETRIES)]
    random = np.random.default_rng((SEED, key.number, len(key.theory)))
    scene = with_symmetry(scene_of(name, random), symmetry)
    if key.theory == "cycle":
        scene = scene.but(alpha=STABLE * scene.alpha)
    over = chosen(scene, symmetry, counts(key, name), random)
    level = level_of(key.theory, name)
    found = level.gradient(scene, over)
    truths = np.array([truth(scene, one, level.speed) for one in found.parameters])
    shares = abs(found.values - truths[:, 0]) / np.maximum(found.errors, truths[:, 1])
    i = int(np.argmax(shares))
    wave = scene.wave
    assert isinstance(wave, TravellingWave)
    return Row(
        number=key.number,
        theory=key.theory,
        symmetry=symmetry,
        friction=name,
        load=str(scene.contact.load),
        harmonics=wave.cosine.size,
        alpha=scene.alpha,
        width=scene.sheet.width,
        poisson=scene.sheet.poisson,
        rtol=level.rtol,
        parameter=found.names[i],
        gradient=float(found.values[i]),
        error=float(found.errors[i]),
        truth=float(truths[i, 0]),
        doubt=float(truths[i, 1]),
        share=float(shares[i]),
        seconds=time.process_time() - begin,
    )


def with_symmetry(scene: Scene, symmetry: str) -> Scene:
    """The scene with the part of its wave that has the symmetry."""
    wave = scene.wave
    assert isinstance(wave, TravellingWave)
    sizes = np.hypot(wave.cosine, wave.sine)
    nothing, odd = np.zeros_like(sizes), np.arange(sizes.size) % 2 == 0
    parts = {
        "none": (wave.cosine, wave.sine, wave.mean),
        "cosines": (sizes, nothing, wave.mean),
        "odd sines": (nothing, sizes * odd, 0.0),
    }
    cosine, sine, mean = parts[symmetry]
    return scene.but(wave=TravellingWave(cosine, sine, wave.count, wave.period, mean))


def counts(key: Key, law: str) -> tuple[int, int]:
    """Of parameters that break the symmetry of the wave, and of others: few where speeds are dear."""
    if key.theory == "cycle":
        return 1, 1
    if law == "coulomb":
        return ((1, 0), (0, 1))[key.number // len(LAWS) % 2]
    return 2, 1


def chosen(
    scene: Scene, symmetry: str, sizes: tuple[int, int], random: np.random.Generator
) -> list[str]:
    """Parameters, those first that break the symmetry; sizes: how many of these, and of others."""
    wave = scene.wave
    assert isinstance(wave, TravellingWave)
    highest = max(wave.cosine.size, 2)
    harmonics = [f"wave.{part}.{k}" for k in range(highest) for part in ("cosine", "sine")]
    names = list(dict.fromkeys([*names_of(scene), *harmonics]))
    breaking = {
        "none": harmonics,
        "cosines": [name for name in harmonics if ".sine" in name],
        "odd sines": [name for name in harmonics if ".cosine" in name or int(name[-1]) % 2],
    }[symmetry]
    others = [name for name in names if name not in breaking]
    some = zip((breaking, others), sizes, strict=True)
    return [str(name) for names, n in some for name in random.choice(names, n, replace=False)]


def truth(scene: Scene, one: Parameter, speed: Callable[[Scene], CrawlSpeed]) -> tuple[float, float]:
    """The derivative by differences over two steps, extrapolated, and its error.

    That is what the extrapolation changes, and what errors of the speeds make of it.
    """
    value = one.value(scene)
    size = SIZES.get(one.name, 1.0 if one.name.startswith("wave.") else abs(value))
    slopes, noise = [], 0.0
    for step in STEPS:
        h = step * size
        ends = [speed(one.changed(scene, value + sign * h)) for sign in (1, -1)]
        slopes.append((ends[0].mean - ends[1].mean) / (2 * h))
        noise = max(end.error for end in ends) / h
    best = (4 * slopes[1] - slopes[0]) / 3
    return best, abs(best - slopes[1]) + noise


def wanted(scenes: int, cycles: int) -> list[Key]:
    """Of all rows."""
    both = (("order 2", scenes), ("cycle", cycles))
    return [Key(theory, number) for theory, count in both for number in range(count)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute the rows that are missing; the table is written after each."""
    options = TABLE.options(
        __doc__,
        arguments,
        scenes=(30, "random scenes of order 2"),
        cycles=(20, "random scenes of cycles"),
        workers=(1, "processes"),
    )
    filling = Filling(TABLE, options.out, key=lambda row: Key(row.theory, row.number))
    filling.fill(wanted(options.scenes, options.cycles), row_of, options.workers)


if __name__ == "__main__":
    main()

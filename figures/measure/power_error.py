"""Distance of the power of the theories to that of the nonlinear sheet, for random scenes.

    python -m figures.measure.power_error [scenes] [seed]

prints a line for each scene, and the largest coefficients of `linear_theory.speed.power_error`.
"""

import sys
import warnings
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from fem_check import Material, Membrane, Scene, cycle_speed
from fem_check.choice.levels import LEVELS
from linear_theory import (
    BeyondReachWarning,
    Sheet,
    SheetcrawlError,
    SineWave,
    Tolerance,
    TravellingWave,
    pulse_wave,
)
from linear_theory.friction.contact import Contact
from linear_theory.speed.power_error import power_error

THEORIES = ("strip", "first order", "second order")


class Distances(NamedTuple):
    """Relative distances of THEORIES to the nonlinear sheet, their bounds, and coefficients."""

    scene: Scene
    distances: tuple[float, ...]
    bounds: tuple[float, ...]
    coefficients: dict[str, float]


def random_scene(random: np.random.Generator) -> Scene:
    """A flat sheet, its wave, growth and contact."""
    sheet = Sheet(width=float(np.exp(random.uniform(np.log(0.1), 0))), poisson=random.uniform(0, 0.5))
    other = TravellingWave(
        np.array([1.0, random.uniform(0.2, 0.6)]), np.array([0.0, random.uniform(-0.4, 0.4)])
    )
    waves = SineWave(), SineWave(count=2), pulse_wave(0.3), other
    wave = waves[random.integers(len(waves))]
    friction = str(random.choice(["coulomb", "coulomb", "viscous"]))
    load = str(random.choice(["current", "grown", "material"]))
    return Scene(
        sheet,
        wave,
        float(random.choice([-1, 1]) * np.exp(random.uniform(np.log(0.02), np.log(0.3)))),
        growth_law=str(random.choice(["exp", "linear", "metric"])),
        area=str(random.choice(["grown", "undeformed"])),
        effects=[Membrane(Material(sheet.thickness, sheet.poisson))],
        cells=(4, 8 * abs(wave.count)),
        contact=Contact.named(load, friction),
    )


def distances(scene: Scene) -> Distances:
    """Of one scene. Raises what `cycle_speed` raises."""
    target = cycle_speed(scene, rtol=1e-2).power.value
    found, bounds = [], []
    for level in THEORIES:
        power = LEVELS[level](scene, Tolerance(1e-3).of_speed(scene.alpha, scene.unit)).power
        found.append(abs(power.value / target - 1))
        bounds.append((power_error(level, scene, power.value) + power.error) / target)
    size = abs(scene.alpha) * float(abs(scene.extremes).max())
    even, series = scene.drive.changes_sign, scene.drive.series
    waves = 1 if series is None else abs(series.count)
    per = {
        "strip": scene.sheet.width / scene.sheet.length * waves,
        "first order, even" if even else "first order": size**2 if even else size,
        "second order": size**2,
    }
    parts = zip(per.items(), found, strict=True)
    return Distances(scene, tuple(found), tuple(bounds), {name: d / s for (name, s), d in parts})


def measured(count: int, seed: int) -> Iterator[Distances]:
    """Of random scenes whose nonlinear sheet has a cycle."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        try:
            yield distances(random_scene(random))
        except (SheetcrawlError, ArithmeticError) as problem:
            print(f"no cycle: {problem}", file=sys.stderr)


def main(count: int = 70, seed: int = 1) -> None:
    """Print the table."""
    warnings.simplefilter("ignore", BeyondReachWarning)
    largest: dict[str, Any] = {}
    for row in measured(count, seed):
        held = all(d <= b or np.isnan(b) for d, b in zip(row.distances, row.bounds, strict=True))
        print(*(f"{d:.2e} <= {b:.2e}" for d, b in zip(row.distances, row.bounds, strict=True)), held)
        for name, value in row.coefficients.items():
            largest[name] = max(value, largest.get(name, 0.0))
    print(largest)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))

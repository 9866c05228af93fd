"""How far friction that deforms the sheet changes its speed: random sheets, waves, loads and laws.

    python -m figures.measure.limits.friction_strength [--out FILE] [--scenes 30] [--resume]

Writes figures/data/friction_strength.csv: a few minutes of computing. Levels that compute shapes
without friction take a scene up to `WEAK`, the strain by friction over that by growth. Every scene is
stepped in time three times, on one mesh and with the same steps, whose errors so cancel: at that
strength, at a tenth of it, and at a thousandth, where friction does not act back.
"""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fem_check.shell.effects.friction import WEAK, Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.simulation import simulate
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import membrane
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.friction.load import WEIGHTS as LOADS
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Wave
from linear_theory.wave.pulse import pulse_wave
from linear_theory.wave.travelling import SineWave

SCENES, SEED = 30, 20261128

STRENGTHS = (1.0, 0.1, 1e-3)
"""Strain by friction over WEAK times that by growth."""

SLIPS = (0.05, 0.05, 10.0)
"""Slip speeds over alpha L/T: nearly dry, twice as often as viscous."""

STEPS, PERIODS = 48, 2


@dataclass(frozen=True)
class Trial:
    """One scene; wave: "sine" or "pulse"; slip: v0 over alpha L/T; speed: V T/(alpha L) where friction
    does not act back; strong, tenth: by how much V differs from it at WEAK and a tenth, over V."""

    scene: int
    width: float
    poisson: float
    wave: str
    count: int
    load: str
    slip: float
    alpha: float
    speed: float
    strong: float
    tenth: float


TABLE = Table(
    DATA / "friction_strength.csv",
    Trial,
    "python -m figures.measure.limits.friction_strength",
    "width in L, slip and speed over alpha L/T, strong and tenth relative to V",
    4,
)


def chosen(scenes: int = SCENES) -> list[tuple[Sheet, str, Wave, str, float, float]]:
    """Sheet, wave and its name, load, slip, alpha: random, the same at every call."""
    random, found = np.random.default_rng(SEED), []
    for _ in range(scenes):
        width, poisson = float(random.uniform(0.15, 1.0)), float(random.uniform(0, 0.5))
        kind, count = str(random.choice(["sine", "pulse"])), int(random.integers(1, 3))
        wave: Wave = SineWave(count)
        if kind == "pulse":
            wave = pulse_wave(float(random.uniform(0.25, 0.5)), count)
        load, slip = str(random.choice(list(LOADS))), float(random.choice(SLIPS))
        sheet = Sheet(width=round(width, 3), poisson=round(poisson, 3))
        found.append((sheet, kind, wave, load, slip, round(float(random.uniform(0.03, 0.3)), 3)))
    return found


def trial(
    number: int, sheet: Sheet, kind: str, wave: Wave, load: str, slip: float, alpha: float
) -> Trial:
    """The speeds of one scene at all strengths."""
    speeds = [stepped(sheet, wave, load, slip * alpha, alpha, s * WEAK) for s in STRENGTHS]
    strong, tenth = ((v - speeds[-1]) / speeds[-1] for v in speeds[:-1])
    count = getattr(wave, "count", 1)
    about = (sheet.width, sheet.poisson, kind, count, load, slip, alpha)
    return Trial(number, *about, speeds[-1] / alpha, strong, tenth)


def stepped(
    sheet: Sheet,
    wave: Wave,
    load: str,
    slip: float,
    alpha: float,
    strength: float,
    steps: int = STEPS,
) -> float:
    """V of the last period, L/T."""
    weight = strength * alpha * sheet.thickness / sheet.length  # mu = E = 1
    effects = (membrane(sheet), Gravity(weight, load), Friction(1.0, slip))
    cells = (3, 6 * getattr(wave, "count", 1))
    scene = Scene(sheet, wave, alpha, effects=effects, cells=cells)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)  # viscous crawling is meant
        return simulate(scene, PERIODS, steps=steps).mean_speed


def compute(path: Path, scenes: int = SCENES, kept: Sequence[Trial] = ()) -> list[Trial]:
    """All trials but those that are kept, written as they come; none where a sheet has no shape."""
    found, known = list(kept), {one.scene for one in kept}
    open_ones = [(i, *scene) for i, scene in enumerate(chosen(scenes)) if i not in known]
    for scene in tracked("friction strength", open_ones):
        try:
            found.append(trial(*scene))
        except ConvergenceError:
            continue
        TABLE.write(sorted(found, key=lambda one: one.scene), path)
    return found


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table, and print the largest changes."""
    options = TABLE.options(
        __doc__,
        arguments,
        scenes=(SCENES, "how many random scenes"),
        resume=(False, "keep the scenes that are there"),
    )
    kept = TABLE.read(options.out) if options.resume and options.out.exists() else []
    found = compute(options.out, options.scenes, kept)
    for name in ("strong", "tenth"):
        changes = np.array([abs(getattr(one, name)) for one in found])
        print(f"{name}: median {np.median(changes):.2g}, largest {changes.max():.2g} of V")


if __name__ == "__main__":
    main()

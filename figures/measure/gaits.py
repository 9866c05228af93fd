"""Bending gaits at random: how many end with a speed, how many with a reason, at what cost.

    python -m figures.measure.gaits [--out FILE] [--count 300] [--seconds 180] [--workers 2]

Writes figures/data/gaits.csv, one row for each scene; the scene of a number is always the same. Hours
of computing for all 300; a run goes on where the file ends. alpha is uniform in [-0.4, 0.4], the rest
curvature per c, kappa, in [-20, 20]/L; the waves have unit amplitude: "sine" one wave on the sheet,
"phase" half a wave (what an excitable wave does, row F10 of the paper's checks), "pulse" a crest a
quarter of the sheet wide, "standing" one that stands still. Ground "printed" is that of the paper, in
which the sheet sinks by 0.022 L, "stiff" a hundred times stiffer. Friction "dry" has v0 = 0.02 L/T,
"printed" v0 = 42 L/T (1 in the paper's unit, whose period is 42). Inertia, where there is any, has the
density 1e-5 E T^2/L^2, with which the lowest bending vibration has a period of 0.09 T.
"""

import signal
import time
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from types import FrameType
from typing import Any

import numpy as np

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.material import Material
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from linear_theory import FieldWave, Sheet, SineWave, pulse_wave
from linear_theory.common.errors import SheetcrawlError
from linear_theory.scene.scene import Scene
from linear_theory.wave.protocol import Wave

SHEET = Sheet()
MATERIAL = Material(SHEET.thickness, SHEET.poisson)
WEIGHT, DENSITY = 2.5e-4, 1e-5
"""rho g of the paper, force per area, and a mass per volume."""

GROUNDS = {"printed": 0.5, "stiff": 50.0}
FRICTIONS = {"dry": 0.02, "printed": 42.0}

RTOL, PERIODS = 0.1, 2

CELLS = (4, 8)

DIGITS = 4


def _half(x: Any, y: Any, t: Any) -> Any:
    return np.sin(np.pi * y - 2 * np.pi * t) + 0 * x


def _standing(x: Any, y: Any, t: Any) -> Any:
    return np.cos(2 * np.pi * y) * np.sin(2 * np.pi * t) + 0 * x


WAVES: dict[str, Wave] = {
    "sine": SineWave(),
    "phase": FieldWave(_half, 1.0, name="half a cycle over the sheet"),
    "pulse": pulse_wave(width=0.25),
    "standing": FieldWave(_standing, 1.0, name="standing"),
}


@dataclass(frozen=True)
class Row:
    """A scene and how it ended.

    outcome: "converged", "stated" (a speed whose error misses the tolerance and says so), "stopped" (no
    further step, with the last state), "late" (out of time). V in L/T, its estimated error, that of the
    mesh among it; shares of the steps in which the sheet snapped and of the states in which it crosses
    itself; steps and repeated ones; seconds of the processor; said: why it has no speed, or what its
    speed lacks.
    """

    number: int
    alpha: float
    kappa: float
    wave: str
    ground: str
    friction: str
    inertia: int
    outcome: str
    speed: float
    error: float
    mesh_error: float
    snapped: float
    crossed: float
    steps: int
    rejected: int
    seconds: float
    said: str


TABLE = Table(
    DATA / "gaits.csv",
    Row,
    "python -m figures.measure.gaits",
    f"rtol = {RTOL:g}; alpha, kappa in 1/L, speeds in L/T, seconds of the processor",
    DIGITS,
)


@dataclass(frozen=True)
class Gait:
    """A scene by its names."""

    number: int
    alpha: float
    kappa: float
    wave: str
    ground: str
    friction: str
    inertia: int

    @property
    def scene(self) -> Scene:
        """The scene on a coarse mesh, whose error is estimated."""
        effects: list[Effect] = [Membrane(MATERIAL), Bending(MATERIAL), Gravity(WEIGHT)]
        effects += [Ground(GROUNDS[self.ground]), Friction(1.0, FRICTIONS[self.friction])]
        if self.inertia:
            effects.append(Inertia(DENSITY, MATERIAL))
        return Scene(SHEET, WAVES[self.wave], self.alpha, self.kappa, effects, cells=CELLS)


def gait(number: int) -> Gait:
    """The scene of that number."""
    random = np.random.default_rng(number)
    alpha, kappa = random.uniform(-0.4, 0.4), random.uniform(-20, 20)
    wave, ground, friction = (str(random.choice(list(k))) for k in (WAVES, GROUNDS, FRICTIONS))
    inertia = int(random.integers(2))
    return Gait(number, round(alpha, 4), round(kappa, 3), wave, ground, friction, inertia)


def gait_of(row: Row) -> Gait:
    """The scene of a row, by its number: the table rounds alpha and kappa."""
    return gait(row.number)


class LateError(Exception):
    """The time of a scene is over."""


def _ring(signum: int, frame: FrameType | None) -> None:
    raise LateError


def tried(
    chosen: Gait,
    seconds: float,
    rtol: float = RTOL,
    mesh_error: bool = True,
    periods: int = PERIODS,
) -> Row:
    """Simulate within that many seconds of the processor."""
    begin = time.process_time()
    found: Trajectory | None = None
    signal.signal(signal.SIGVTALRM, _ring)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = simulate(chosen.scene, periods, rtol, mesh_error=mesh_error)
        outcome, said = "converged" if found.speed.converged else "stated", found.speed.model
    except LateError:
        outcome, said = "late", f"not done within {seconds:g} s"
    except SheetcrawlError as error:
        outcome, said = "stopped", str(error)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    nothing = Row(**vars(chosen), outcome=outcome, said=said, **NOTHING)
    row = replace(nothing, seconds=time.process_time() - begin)
    return row if found is None else _filled(row, found)


NOTHING: dict[str, Any] = {
    **dict.fromkeys(("speed", "error", "mesh_error", "snapped", "crossed", "seconds"), float("nan")),
    **dict.fromkeys(("steps", "rejected"), 0),
}


def _filled(row: Row, found: Trajectory) -> Row:
    speed, snapped, crossed = found.speed, found.snapped, found.crossed
    return replace(
        row,
        speed=speed.mean,
        error=speed.error,
        mesh_error=found.errors.mesh,
        snapped=float(snapped.mean()),
        crossed=float("nan") if crossed is None else float(crossed.mean()),
        steps=snapped.size - 1,
        rejected=found.rejected,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Simulate and write the table after each scene."""
    options = TABLE.options(
        __doc__,
        arguments,
        count=(300, "number of scenes"),
        seconds=(180.0, "of the processor, most for one scene"),
        workers=(1, "processes"),
    )
    wanted = [gait(number) for number in range(options.count)]
    Filling(TABLE, options.out, gait_of).fill(
        wanted, partial(tried, seconds=options.seconds), options.workers
    )


if __name__ == "__main__":
    main()

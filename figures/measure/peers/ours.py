"""The two scenes by `simulate`: Young's modulus 1, lengths in metres."""

import time
import warnings

import numpy as np

from fem_check import Bending, Friction, Gravity, Ground, Inertia, Material, Membrane, simulate
from fem_check.shell.stepping.schemes import BackwardDifferences
from fem_check.shell.stepping.trajectory import Trajectory
from fem_check.version import __version__
from figures.measure.peers import problems
from figures.measure.peers.problems import BLOCK, STRIP, THICKNESS, WIDTHS, Answer, Case
from linear_theory import FieldWave, Sheet, SineWave
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.scene.scene import Scene

MATERIAL = Material(THICKNESS, 0.0)

PRESSURE = 1e-5
"""Weight of the block over E h: it does not deform."""

SLIP = 1e-4
"""Width of the tanh law over the speed of the block."""

STIFFNESS = 5e5
"""Of the ground under the strip over E: it sinks in by 2e-5 L."""


def solve(case: Case) -> Answer:
    """Run a case."""
    begin = time.process_time()
    with warnings.catch_warnings():
        # at rest, as both end, all friction is in the linear part of the tanh law
        warnings.simplefilter("ignore", ViscousRegimeWarning)
        value, drift = _block(case) if case.problem == BLOCK else _strip(case)
    return Answer(value, drift, time.process_time() - begin, f"sheetcrawl {__version__}")


def _block(case: Case) -> tuple[float, float]:
    """Distance and drift; the ramp, half a period, is of a growth of zero."""
    weight = PRESSURE * THICKNESS
    effects = (
        Membrane(MATERIAL),
        Gravity(weight, incline=problems.INCLINE),
        Friction(problems.FRICTION, slip_speed=SLIP * problems.SPEED),
        Inertia(weight / problems.GRAVITY / THICKNESS, MATERIAL),
    )
    period = problems.WATCHED * problems.time_to_stop()
    wave = SineWave(period=period)
    scene = Scene(_sheet(BLOCK), wave, 0.0, effects=effects, cells=(case.across, case.along))
    motion = simulate(
        scene,
        periods=1,
        steps=case.steps,
        velocity=(0.0, -problems.SPEED),
        scheme=BackwardDifferences(),
    )
    place = motion.centre[1]
    rest = float(np.interp(motion.times[0] + period, motion.times, place))
    return float(place[0]) - rest, abs(float(place[-1]) - rest) / (period / 2)


def _strip(case: Case) -> tuple[float, float]:
    """Height of the ends, and the speed with which it still changes."""
    weight = 1 / (12 * problems.BENDING / THICKNESS**3)
    effects = (
        Membrane(MATERIAL),
        Bending(MATERIAL),
        Gravity(weight),
        Ground(STIFFNESS),
        Friction(problems.FRICTION, slip_speed=0.01),
    )
    bent = FieldWave(lambda x, y, t: np.ones(np.broadcast_shapes(x.shape, y.shape)), period=1.0)
    cells = (case.across, case.along)
    scene = Scene(_sheet(STRIP), bent, 0.0, -problems.CURVATURE, effects, cells=cells)
    motion = simulate(scene, periods=1, steps=case.steps)
    rises = [_rise(motion, t) for t in motion.times[-2:]]
    return rises[-1], abs(rises[1] - rises[0]) / float(motion.times[-1] - motion.times[-2])


def _rise(motion: Trajectory, t: float) -> float:
    """Of the ends above the middle."""
    _, along, height = motion.positions(t)
    ends, middle = np.isclose(abs(along), abs(along).max(), rtol=1e-3), np.isclose(along, 0, atol=1e-9)
    return float(height[ends].mean() - height[middle].mean())


def _sheet(problem: str) -> Sheet:
    return Sheet(width=WIDTHS[problem], poisson=0.0, thickness=THICKNESS)

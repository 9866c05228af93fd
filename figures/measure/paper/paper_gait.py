"""The bending sheet of the paper and its speed; what can be read in two ways has a name.

The paper's sheet, weight and ground, driven by an excitable wave from its start: the second and third
cycle count. A curvature kappa per c, in 1/L, serves all readings of the paper's beta: "printed" kappa =
beta, "thickness" kappa = beta/h, "hundred" kappa = 100 beta. Friction "viscous" is the paper's tanh law
with v0 = 1 in its own units, "dry" has v0 = 0.02 L a cycle.
"""

import functools
import math
import time
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Outline, simulate
from fem_check.excitable import Excitation
from fem_check.excitable.presets import excitable_preset
from fem_check.shell.stepping.further.second_runs import MESH_MARGIN
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import Sheet
from linear_theory.common.errors import SheetcrawlError
from linear_theory.scene.scene import Scene

SHEET = Sheet()
MATERIAL = Material(SHEET.thickness, SHEET.poisson)
WEIGHT, STIFFNESS, RIGID = 2.5e-4, 0.5, 50.0
"""rho g and k of the paper, and a ground in which the sheet sinks by a tenth as much at rest."""

CELLS, FINE = (4, 8), (6, 12)

PERIODS = 3

WAVE = "nu = -0.1"
"""The preset that has a wave of order one on the sheet."""

CYCLE = 42.4
"""About the time of its cycle, in units of the equation."""

FRICTIONS = {"viscous": 1.0, "dry": 0.02 / CYCLE}
"""Slip speeds, length over the unit of time of the equation."""

READINGS = {"printed": 1.0, "thickness": 1 / SHEET.thickness, "hundred": 100.0}
"""kappa L over the paper's beta."""

BACKWARD, FORWARD = (-0.25, -0.15), (-0.3, 0.1)
"""alpha and beta of the paper's two gaits."""

DIGITS = 4


@dataclass(frozen=True)
class Measured:
    """V in L per cycle of the second and of the third cycle, NaN where the run stopped.

    error: of the third, by the steps in time, the mesh, and the path through snap-throughs; not the
    difference of the cycles, since the wave itself changes from one to the next. NaN if not estimated.
    snapped: steps that do not resolve the motion; crossed: states in which the sheet crosses itself;
    seconds of the processor; said: why there is no speed.
    """

    second: float
    third: float
    error: float
    snapped: int
    crossed: int
    seconds: float
    said: str


@functools.cache
def wave(name: str = WAVE, body: Sheet | Outline = SHEET) -> Excitation:
    """The wave of a preset on a body, of unit of time 1, for as long as four cycles."""
    return excitable_preset(name).on(body, until=200.0, rtol=1e-2)


def paper_scene(
    alpha: float,
    kappa: float,
    friction: str = "viscous",
    *,
    waves: str = WAVE,
    weight: float = WEIGHT,
    ground: float = STIFFNESS,
    height: Any = None,
    cells: tuple[int, int] = CELLS,
    outline: Outline | None = None,
    size: float = 0.0,
) -> Scene:
    """The scene of a gait. height: of uneven ground; size: of the triangles of an outline."""
    on = Ground(ground, height=height)
    law = Friction(1.0, FRICTIONS[friction])
    effects = [Membrane(MATERIAL), Bending(MATERIAL), Gravity(weight), on, law]
    if outline is None:
        return Scene(SHEET, wave(waves), alpha, kappa, effects, cells=cells)
    body = Sheet(outline.length, outline.width, SHEET.poisson, SHEET.thickness)
    return Scene(body, wave(waves, outline), alpha, kappa, effects, mesh=outline.mesh(size))


def measured(scene: Scene, steps: int, coarse: Scene | None = None) -> Measured:
    """Its speeds. coarse: the scene on a coarser mesh, for an error on meshes that are given."""
    begin, nan = time.process_time(), float("nan")
    try:
        found = moved(scene, steps, mesh_error=scene.mesh is None)
    except SheetcrawlError as problem:
        said = " ".join(str(problem).split())
        return Measured(nan, nan, nan, 0, 0, time.process_time() - begin, said)
    mesh = found.errors.mesh if coarse is None else _difference(found, coarse, steps)
    return told(found, float(mesh), time.process_time() - begin)


def _difference(found: Trajectory, coarse: Scene, steps: int) -> float:
    """Error by the mesh, from the motion on a coarser one; infinite if that stops."""
    try:
        rough = moved(coarse, steps)
    except SheetcrawlError:
        return math.inf
    return MESH_MARGIN * abs(float(rough.period_speeds[-1] - found.period_speeds[-1]))


def told(found: Trajectory, mesh: float, seconds: float) -> Measured:
    """The speeds of a motion. mesh: its error of that kind, length per time."""
    second, third = found.period_speeds[-2:]
    error = float(np.nansum([found.errors.step, mesh, found.errors.snaps]))
    crossed = 0 if found.crossed is None else int(found.crossed.sum())
    second, third, error = (float(v) * found.scene.period for v in (second, third, error))
    return Measured(second, third, error, int(found.snapped.sum()), crossed, seconds, "")


def moved(scene: Scene, steps: int, mesh_error: bool = False, periods: int = PERIODS) -> Trajectory:
    """Its motion, without the warnings of what is known here: friction that acts as viscous."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return simulate(scene, periods, steps=steps, mesh_error=mesh_error)


def kept(value: float) -> float:
    """A number as the tables have it."""
    return float(f"{value:.{DIGITS}g}")

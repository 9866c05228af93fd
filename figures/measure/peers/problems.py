"""The two scenes, their exact results, and what is run; read in the environments of all codes.

Block: a flat stiff sheet slides down an incline of tan < mu and stops; after

    V^2/(2 a),   a = g (mu cos(incline) - sin(incline)),

and then rests. Strip: a strip with a natural curvature kappa along it lies on level ground by its
weight q per area, ends lifted by B kappa^2/(2 q) (first integral of the heavy elastica, at any slope,
tests/shell/heavy_elastica.py). Friction does not change that height: no force pulls along the part off
the ground. Metres, seconds and kilograms where a code has units.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRAVITY, MASS = 9.81, 1.0
"""m/s^2, and mass per area in kg/m^2."""

FRICTION = 0.5

BENDING = 0.009
"""B over q L^3, L = 1 m: that of the paper's sheet, h = 0.03 L and weight 2.5e-4 E."""

THICKNESS = 0.03

INCLINE, SPEED = 0.2, 1.0
"""Of the block: radians, and m/s at the start."""

CURVATURE = 3.0
"""Of the strip, 1/m."""

BLOCK, STRIP = "block", "strip"
TITLES = {BLOCK: "stopping distance on an incline", STRIP: "height of the ends of a bent strip"}

WIDTHS = {BLOCK: 0.1, STRIP: 0.04}

OURS = "sheetcrawl"
MUJOCO = "MuJoCo flex"
NEWTON = "Newton VBD"

WATCHED = 1.5
"""Of the block: its place is read after so many times the time to stop, and half as long after that."""


@dataclass(frozen=True)
class Case:
    """One run: elements along and across; step of time and duration in s, or (of this package) the
    number of steps per period; iterations per step, of codes that have them."""

    problem: str
    code: str
    along: int
    across: int
    step: float = 0.0
    steps: int = 0
    duration: float = 0.0
    iterations: int = 0

    @property
    def knob(self) -> str:
        """What is varied, in words."""
        if self.code == OURS:
            return f"{self.steps} steps" if self.problem == BLOCK else f"{self.along} elements"
        step = f"{1e3 * self.step:g} ms"
        return step if self.problem == BLOCK else f"{self.along} cells, {step}"


@dataclass(frozen=True)
class Answer:
    """Of a run: the distance or height in m; drift: speed in m/s with which it still changes at the
    end; seconds of the processor; NaN where the run failed, and `remark` why."""

    value: float
    drift: float
    seconds: float
    version: str
    remark: str = ""


def deceleration() -> float:
    """Of the block, m/s^2."""
    return GRAVITY * (FRICTION * math.cos(INCLINE) - math.sin(INCLINE))


def time_to_stop() -> float:
    """Of the block, s."""
    return SPEED / deceleration()


def exact(problem: str) -> float:
    """Distance or height in m."""
    if problem == BLOCK:
        return SPEED**2 / (2 * deceleration())
    return BENDING * CURVATURE**2 / 2


def bending() -> float:
    """B in N m, per width."""
    return BENDING * MASS * GRAVITY


def young() -> float:
    """Young's modulus in Pa; Poisson's ratio is 0."""
    return 12 * bending() / THICKNESS**3


def strip(case: Case, curvature: float) -> tuple[Array, Array]:
    """Vertices (points, 3), an arc along x, lowest point at the origin; triangles (elements, 3).

    The diagonals of neighbouring cells point in opposite directions: with one direction a strip that
    is flattened twists.
    """
    n, m = case.along, case.across
    along = np.repeat(np.linspace(-0.5, 0.5, n + 1), m + 1)
    across = np.tile((np.arange(m + 1) / m - 0.5) * WIDTHS[case.problem], n + 1)
    angle = curvature * along
    x = np.sin(angle) / curvature if curvature else along
    z = 2 * np.sin(angle / 2) ** 2 / curvature if curvature else 0 * along
    triangles = []
    for i in range(n):
        for j in range(m):
            p, q = i * (m + 1) + j, (i + 1) * (m + 1) + j
            pair = [(p, q, q + 1), (p, q + 1, p + 1)]
            triangles += pair if (i + j) % 2 == 0 else [(p, q, p + 1), (q, q + 1, p + 1)]
    return np.stack([x, across, z], 1), np.array(triangles)


def natural(case: Case) -> float:
    """Curvature of the sheet of a case."""
    return CURVATURE if case.problem == STRIP else 0.0


def followed(case: Case, positions: Callable[[], Array], advance: Callable[[], None]) -> Array:
    """Distance or height at the two times at which it is read, (2,): positions are asked for rarely."""
    start, steps = positions()[:, 0].mean(), round(case.duration / case.step)
    found = []
    for count in (early(case), steps - early(case)):
        for _ in range(count):
            advance()
        found.append(_measured(case, positions(), start))
    return np.array(found)


def early(case: Case) -> int:
    """Steps after which it is read first: the block should rest, the strip still settles a little."""
    return round(case.duration / case.step * (2 / 3 if case.problem == BLOCK else 0.9))


def _measured(case: Case, points: Array, start: float) -> float:
    if case.problem == BLOCK:
        return float(start - points[:, 0].mean())
    height = points[:, 2].reshape(case.along + 1, case.across + 1).mean(1)
    return float((height[0] + height[-1]) / 2 - height[case.along // 2])


def answer(case: Case, found: Array, seconds: float, version: str) -> Answer:
    """From `followed`."""
    if not np.all(np.isfinite(found)):
        return Answer(math.nan, math.nan, seconds, version, "unstable")
    between = case.duration - early(case) * case.step
    drift = abs(float(found[1] - found[0])) / between
    return Answer(float(found[0 if case.problem == BLOCK else 1]), drift, seconds, version)


def cases() -> list[Case]:
    """All runs, coarse to fine."""
    end, settled = WATCHED * 1.5 * time_to_stop(), 3.0
    ours = [Case(BLOCK, OURS, 2, 1, steps=n) for n in (32, 64, 128, 256)]
    ours += [Case(STRIP, OURS, n, 1, steps=4) for n in (4, 8, 12, 16, 24)]
    flex = [Case(BLOCK, MUJOCO, 8, 2, dt, duration=end) for dt in (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)]
    flex += [
        Case(STRIP, MUJOCO, n, 2, dt, duration=settled)
        for n, dt in ((8, 4e-3), (16, 2e-3), (32, 2e-3), (64, 1e-3))
    ]
    vbd = [
        Case(BLOCK, NEWTON, 8, 1, dt, duration=end, iterations=10) for dt in (1e-2, 5e-3, 2e-3, 1e-3)
    ]
    vbd += [
        Case(STRIP, NEWTON, 8, 2, dt, duration=settled / 2, iterations=5) for dt in (1e-3, 5e-4, 2.5e-4)
    ]
    return [*ours, *flex, *vbd]

"""The motion of a result as a recording."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.output.moving import Moving, turned
from fem_check.output.panels import arrow_places
from fem_check.output.pictures import moving_of
from fem_check.runs.recording import PHASES, Recording
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]

FLOOR = 20
"""Heights of uneven ground that are recorded along a length of the sheet."""

MARGIN = 0.5
"""How far beyond the sheet the ground is recorded, in lengths of the sheet."""


def recorded(result: Any, scene: Scene, speed: CrawlSpeed | None = None) -> Recording:
    """The motion of a result, for the scene that it answers: a speed, a prediction or a trajectory.

    speed: to be told instead of that of the result. Raises ValueError for a speed without a shape.
    """
    moving = moving_of(result)
    if not moving.has_shape:
        raise ValueError("result: must have a shape; a speed on a line, or a copied one, has none")
    repeats = moving.most_periods is None
    periods = moving.most_periods or 1
    points, triangles = moving.covering()
    frames = list(moving.frames(points, periods, PHASES))
    place = np.stack([frame.place for frame in frames])
    times = np.array([frame.time for frame in frames])
    centre = np.stack([frame.centre for frame in frames])
    heading = np.array([frame.heading for frame in frames])
    first = frames[0]
    back = turned(first.still[:2, :1] - first.centre[:, None], -first.heading)
    tails = arrow_places(points, triangles)
    return Recording(
        speed=speed or moving.speed,
        period=moving.period,
        length=moving.length,
        words=moving.words,
        direction=moving.direction,
        periods=periods,
        repeats=repeats,
        course_shown=moving.course(),
        points=points,
        triangles=triangles,
        times=times,
        place=place,
        wave=_wave(result, scene, points, times),
        growth=np.stack([frame.growth for frame in frames]),
        centre=centre,
        heading=heading,
        middle=points[:, 0] - back[:, 0],
        tails=tails,
        arrows=_arrows(moving, tails, times, heading),
        energies=moving.energies,
        load=_load(moving, points, times),
        **_floor(moving, place),
    )


def _load(moving: Moving, points: Array, times: Array) -> Array | None:
    """Normal load over the weight per area, where there is one below a sheet in space."""
    if not moving.presses:
        return None
    repeats = moving.most_periods is None
    phases = times / moving.period if repeats else np.arange(times.size) / PHASES
    return np.stack([moving.pressure(points, float(phase)) for phase in phases])


def _arrows(moving: Moving, tails: Array, times: Array, heading: Array) -> Array:
    """Friction in the frame of the ground, (n, 2, a); speeds tell it in that of the body."""
    if moving.most_periods is None:
        forces = [moving.friction(tails, float(t)) for t in times / moving.period]
        return np.stack([turned(force, angle) for force, angle in zip(forces, heading, strict=True)])
    return np.stack([moving.friction(tails, k / PHASES) for k in range(times.size)])


def _floor(moving: Moving, place: Array) -> dict[str, Array]:
    """The ground around all places of the sheet; level ground by its corners."""
    margin = MARGIN * moving.length
    low, high = place[:, :2].min((0, 2)) - margin, place[:, :2].max((0, 2)) + margin
    counts = [int(np.ceil(FLOOR * size / moving.length)) for size in high - low]
    x, y = (np.linspace(a, b, n) for a, b, n in zip(low, high, counts, strict=True))
    grid = np.meshgrid(x, y, indexing="ij")
    heights = np.reshape(moving.ground(*(v.ravel() for v in grid)), grid[0].shape)
    if not np.ptp(heights):
        x, y, heights = x[[0, -1]], y[[0, -1]], heights[:2, :2]
    return {"floor_x": x, "floor_y": y, "floor": np.array(heights)}


def _wave(result: Any, scene: Scene, points: Array, times: Array) -> Array:
    """c at the points, (n, p); as it was in the motion where that acts back on it."""
    x, y = points
    if isinstance(result, Trajectory):
        return np.stack([np.broadcast_to(result.model.growth(float(t), x, y), x.shape) for t in times])
    return np.stack([np.broadcast_to(scene.drive.value(x, y, float(t)), x.shape) for t in times])

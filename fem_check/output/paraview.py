"""Motions as time series for ParaView (XDMF), written by meshio, an optional package."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.output.crawling import Crawling
from fem_check.output.files import replacing, writable
from fem_check.output.moving import Moving, friction_at, turned
from fem_check.output.pictures import moving_of
from fem_check.output.simulated import Simulated
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.common.extras import optional

Array = NDArray[np.float64]

CELLS = {3: "triangle", 4: "quad"}

SAMPLES = 24
"""Times per period of a motion that repeats."""

REFINED = 6
"""Largest number of halvings: 4096 cells from one."""


class Grid(NamedTuple):
    """points (2, n) of the undeformed sheet, cells (m, 3 or 4)."""

    points: Array
    cells: NDArray[np.int64]


class Moment(NamedTuple):
    """Values at the points at one time, by name: (n,) or vectors (3, n)."""

    time: float
    values: dict[str, Array]


def write_paraview(result: Any, path: str | Path, refine: int = 2) -> None:
    """Write displacement, growth, friction and stress of a motion over the undeformed sheet.

    result: a trajectory, at all its kept times; or a speed or a prediction with a shape, at 25 times
    over one period; or a recorded motion, at 24 times in each period and the last one. path: of the
    .xdmf file; one file holds all. refine: 0 to 6, how often the elements of a trajectory are halved,
    since a few elements of high degree hold more than their corners show.

    At the points: displacement (3), length, in the frame of the ground, for Warp By Vector; wave, c;
    growth, alpha c, which rises from 0 during the ramp of a trajectory; friction (3), per undeformed
    area and mu times the weight, if there is any; pressure of a sheet in space on its ground, over the
    weight per area; in small-strain theory stress_xx, stress_yy, stress_xy in the axes of the sheet,
    units of Young's modulus.

    Raises ValueError for a result without a shape, a refine out of range and another suffix, OSError
    for a path that cannot be written to, and ModuleNotFoundError, with what to install, without meshio.

    >>> import os, tempfile
    >>> from fem_check import write_paraview
    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.1, rtol=1e-2)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_paraview(speed, os.path.join(folder, "crawl.xdmf"))
    ...     print(os.listdir(folder))
    ['crawl.xdmf']
    """
    meshio = optional("meshio", "paraview", "ParaView output")
    refine = validation.integer("refine", refine, 0)
    if refine > REFINED:
        raise ValueError(f"refine = {refine}: must be in [0, {REFINED}]")
    moving = moving_of(result)
    target = writable(path, (".xdmf",))
    if isinstance(result, Trajectory):
        grid, moments = _of_trajectory(result, refine)
    else:
        grid, moments = _of_frames(moving)
    flat = np.vstack([grid.points, np.zeros(grid.points.shape[1])])
    with replacing(target) as part, meshio.xdmf.TimeSeriesWriter(part, data_format="XML") as writer:
        writer.write_points_cells(flat.T, [(CELLS[grid.cells.shape[1]], grid.cells)])
        for moment in moments:
            data = {name: np.asarray(values).T for name, values in moment.values.items()}
            writer.write_data(moment.time, point_data=data)


def _of_trajectory(run: Trajectory, refine: int) -> tuple[Grid, Iterator[Moment]]:
    model = run.model
    mesh = model.discretisation.mesh.refined(refine)
    points, moving = np.asarray(mesh.p), Simulated(run)
    region = model.discretisation.points(points)

    def moments() -> Iterator[Moment]:
        for t, u in zip(run.stored_times, run.states, strict=True):
            wave = model.growth(t, *points)
            values = {
                "displacement": _in_space(region.displacement(u, (0,))[0]),
                "wave": wave,
                "growth": run.amplitude(t) * run.scene.alpha * wave,
            }
            phase = (t - run.start) / moving.period
            if moving.speed.regime != "none":
                values["friction"] = _in_space(moving.friction(points, phase))
            if moving.presses:
                values["pressure"] = moving.pressure(points, phase)
            yield Moment(float(t), values)

    return Grid(points, np.asarray(mesh.t.T)), moments()


def _of_frames(moving: Moving) -> tuple[Grid, Iterator[Moment]]:
    if not moving.has_shape:
        raise ValueError("result: must have a shape; a speed on a line, or a copied one, has none")
    points, triangles = moving.covering()

    def moments() -> Iterator[Moment]:
        for frame in moving.frames(points, moving.most_periods or 1, SAMPLES):
            values = {
                "displacement": _in_space(frame.place) - _in_space(points),
                "wave": moving.waves(points, np.array([frame.time]))[0],
                "growth": frame.growth,
            }
            if moving.speed.regime != "none":
                force, heading = friction_at(moving, points, frame.time)
                values["friction"] = _in_space(turned(force, frame.heading - heading))
            if moving.presses:
                phase = (frame.time - moving.at(points, 0.0).time) / moving.period
                values["pressure"] = moving.pressure(points, phase)
            if isinstance(moving, Crawling):
                values |= moving.stress(points, frame.time)
            yield Moment(frame.time, values)

    return Grid(points, triangles), moments()


def _in_space(values: Array) -> Array:
    """Vectors (2 or 3, n) as (3, n)."""
    return np.concatenate([values, np.zeros((3 - len(values), values.shape[1]))])

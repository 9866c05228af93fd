"""A scene stepped through time: growth ramped up from rest, then whole periods of its wave."""

import os
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.mesh.elements import default_cells
from fem_check.shell.stepping.run import Progress, Run, Target
from fem_check.shell.stepping.settings import Settings
from fem_check.shell.stepping.snapshot import check_path, check_writable, run_fingerprint
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

MESH_MARGIN = 2
"""The mesh's error is this multiple of the difference to a mesh 1.5 times coarser. The elastic part is
far below it; in dry friction it is the quadrature of a force that jumps, which falls unevenly."""


def simulate(
    scene: Scene,
    periods: int = 2,
    rtol: float | None = None,
    steps: int | None = None,
    *,
    ramp: float = 0.5,
    velocity: ArrayLike | None = None,
    snapshot: str | Path | None = None,
    snapshot_every: int = 50,
    keep_every: int = 1,
    mesh_error: bool = False,
    progress: bool | Callable[[Progress], None] = False,
) -> Trajectory:
    """The motion of a scene from the ungrown sheet at rest, through a ramp of growth and `periods`.

    rtol: error of the velocities by which steps are chosen (1e-2 unless given), about the relative
    error of V; steps: instead, so many equal steps per period. ramp: periods in which growth rises to
    its full size. velocity (components,): of the sheet at the start; with Inertia only.
    snapshot: file that is written after every `snapshot_every` steps, at the end, and when Ctrl-C stops
    the run. If it exists the run goes on from it, and ends with the same numbers, bit for bit, as one
    that was not interrupted (one thread, same machine). keep_every: states of so many steps are kept in
    the trajectory; see `Trajectory.shape_error`. mesh_error: estimate the error of the mesh from a
    second run on a coarser one. progress: True prints, a function is called after each step.

    Steps are short enough to see the harmonics in time of the wave that matter, many where they are
    high.

    A scene without Friction and Inertia has no motion in time; use `cycle_speed.cycle_speed`.
    Raises ValueError for such scenes, for values out of range, for `steps` too few to see the wave and
    for a wave that does not repeat after its period; SnapshotError, a ValueError, for a snapshot that
    is damaged or of another scene or run, for a place where none can be written, and for a wave or
    ground whose function can be known again neither by its content nor by a name; ConvergenceError
    (with the last state and its time as `parameter`) where steps become too small; KeyboardInterrupt
    after Ctrl-C, with a line that says what is kept. Warns (ViscousRegimeWarning) where Friction,
    regularised dry friction, acts as viscous: see `CrawlSpeed.regime`.

    >>> from fem_check import Friction, Gravity, Material, Membrane, Scene, simulate
    >>> from linear_theory import Sheet, SineWave
    >>> effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, slip_speed=0.005)]
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(1, 2))
    >>> motion = simulate(scene, periods=1, rtol=0.1)
    >>> print(f"V = {motion.speed.mean:.3f} L/T, friction is {motion.regime}")
    V = 0.016 L/T, friction is dry
    """
    begin, run, target = time.perf_counter(), None, None
    hint = "its arguments are sheet, wave, alpha and effects"
    scene = validation.instance("scene", scene, Scene, hint)
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise ValueError(f"progress = {validation.shown(progress)}: must be True, False or a function")
    if not (snapshot is None or isinstance(snapshot, str | Path)) or snapshot == "":
        raise ValueError(f"snapshot = {validation.shown(snapshot)}: must be the path of a file")
    settings = Settings(periods, rtol, steps, ramp, velocity, keep_every)
    every = validation.integer("snapshot_every", snapshot_every, 1)
    try:
        if snapshot is not None:
            target = _target(Path(snapshot), scene, settings, every)
        run, resumed = Run(scene, settings), np.nan
        if target is not None:
            resumed = run.resume(target)
        run.finish(target, (_printed if progress is True else progress) or None)
        difference = _mesh_error(run) if mesh_error else np.nan
    except KeyboardInterrupt:
        if progress is True:
            print(file=sys.stderr)
        # Not a class of its own, for which Python would not end as a process ends that was interrupted;
        # from None, since where in a step it struck tells the user nothing.
        raise KeyboardInterrupt(_interrupted(run, target)) from None
    found = replace(
        run.trajectory(),
        seconds=time.perf_counter() - begin,
        resumed_at=resumed,
        mesh_error=difference,
    )
    warn_if_viscous(scene.contact.friction, found.slip_ratio)
    return found


def _target(path: Path, scene: Scene, settings: Settings, every: int) -> Target:
    """Where the snapshots of a run go; refused before the work where there can be none."""
    check_path(path)
    if not os.path.exists(path):
        check_writable(path)
    return Target(path, run_fingerprint(path, scene, settings), every)


def _mesh_error(run: Run) -> float:
    """Of the mean speed, from the same run on a coarser mesh."""
    coarse = Run(coarser(run.scene), run.settings)
    coarse.finish(None, None)
    difference = coarse.trajectory().period_speeds[-1] - run.trajectory().period_speeds[-1]
    return float(MESH_MARGIN * abs(difference))


def _interrupted(run: Run | None, target: Target | None) -> str:
    """What is left of a run that was stopped, in one line; its snapshot is written first."""
    if run is None:
        return "simulate was stopped before its first step"
    run.rewind()
    now, end = run.history.time, float(run.marks[-1])
    text = f"simulate was stopped at t = {now:g} of {end:g}, after {run.steps} steps"
    if target is None:
        return f"{text}, which are lost; with snapshot='run.npz' it could be resumed by the same call"
    try:
        run.save(target)
    except OSError as error:
        return f"{text}; {target.path} could not be written ({error}) and holds what it held before"
    return f"{text}, all kept in {target.path}; the same call goes on from there"


def coarser(scene: Scene) -> Scene:
    """The scene on a mesh whose elements are about 1.5 times as long.

    Raises ValueError for a mesh that cannot be made coarser: of the scene's own, or of a single row.
    """
    if scene.mesh is not None:
        raise ValueError("mesh_error = True: must be False for a scene with a mesh of its own")
    across, along = scene.cells or default_cells(scene.drive, scene.planar)
    if min(across, along) < 2:
        raise ValueError(f"cells = {scene.cells}: must be at least 2 each way where mesh_error = True")
    return scene.but(cells=(round(across / 1.5), round(along / 1.5)))


def _printed(progress: Progress) -> None:
    share = 100 * progress.time / progress.end
    end = "\n" if progress.time >= progress.end * (1 - 1e-9) else ""
    print(
        f"\r{share:5.1f} %, {progress.steps} steps, {progress.left:.0f} s left ",
        end=end,
        file=sys.stderr,
        flush=True,
    )

"""Time integration of a scene: growth ramped up from rest, then whole periods of its wave."""

import os
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.mesh.elements import default_cells
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.run import Progress, Run, Target
from fem_check.shell.stepping.schemes import Scheme
from fem_check.shell.stepping.settings import Settings
from fem_check.shell.stepping.snapshot import check_path, check_writable, run_fingerprint
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

MESH_MARGIN = 2
"""Mesh error relative to the difference to a mesh 1.5 times coarser. The elastic part is far smaller;
with dry friction the quadrature of a discontinuous force dominates, which converges irregularly."""

SNAP_MARGIN = 2
"""Error of a speed with snap-throughs relative to the difference to a run with steps twice as long,
whose snaps start elsewhere and take another way."""

FEEDBACK_MARGIN = 2
"""Error of the speeds by a wave that the strain acts back on, relative to the difference to a run with
half the tolerance or half as many steps. Of second order, errors there are twice to four times as
large."""


def simulate(
    scene: Scene,
    periods: int = 2,
    rtol: float | None = None,
    steps: int | None = None,
    *,
    ramp: float = 0.5,
    velocity: ArrayLike | None = None,
    scheme: Scheme | None = None,
    snapshot: str | Path | None = None,
    snapshot_every: int = 50,
    keep_every: int = 1,
    mesh_error: bool = False,
    progress: bool | Callable[[Progress], None] = False,
) -> Trajectory:
    """The motion of a scene from the ungrown sheet at rest, through a ramp of growth and `periods`.

    rtol: error of the velocities, which controls the steps (1e-2 by default) and is about the relative
    error of V; steps: instead, number of equal steps per period. ramp: periods over which growth rises
    to its full amplitude. velocity (components,): of the sheet at the start; with Inertia only.
    scheme: `BackwardDifferences`, or `Newmark` as in the paper, which needs Inertia and is the default
    without Ground; either may give the length of the steps. snapshot: file written after every
    `snapshot_every` steps, at the end, and when Ctrl-C interrupts the run. If it exists, the run
    resumes from it, and the results are bit for bit those of an uninterrupted run (one thread, same
    machine). keep_every: interval, in steps, of states kept in the trajectory, see
    `Trajectory.shape_error`. mesh_error: estimate the mesh error from a second run on a coarser mesh.
    progress: True prints, a function is called after each step.

    Steps are short enough to resolve the significant harmonics in time of the wave. A sheet that snaps
    through is simulated a second time with longer steps, for the error of V, and so is one whose strain
    acts back on its wave (`StrainFeedback`): the two are then stepped together, at second order.

    A scene without Friction and Inertia is not time dependent; use `cycle_speed.cycle_speed`.
    Raises ValueError for such scenes, for values out of range, for too few `steps` to resolve the wave
    and for a wave that does not repeat after its period; SnapshotError, a ValueError, for a snapshot
    that is damaged or belongs to another scene or run, for a path that cannot be written to, and for a
    wave or ground whose function has neither identifiable content nor a name; ConvergenceError (with
    the last state and its time as `parameter`) if no further step is found, or too many are needed;
    KeyboardInterrupt after Ctrl-C, with a line that says what is kept. Warns (ViscousRegimeWarning) if
    Friction, regularised dry friction, acts as viscous: see `CrawlSpeed.regime`.

    >>> from fem_check import Friction, Gravity, Material, Membrane, Scene, simulate
    >>> from linear_theory import Sheet, SineWave
    >>> effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, slip_speed=0.005)]
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(1, 2))
    >>> motion = simulate(scene, periods=1, rtol=0.1)
    >>> print(f"V = {motion.speed.mean:.3f} L/T, friction is {motion.regime}")
    V = 0.016 L/T, friction is dry
    """
    run, target = None, None
    hint = "make one by Scene(sheet, wave, alpha, effects=...)"
    scene = validation.instance("scene", scene, Scene, hint)
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise ValueError(f"progress = {validation.shown(progress)}: must be True, False or a function")
    if not (snapshot is None or isinstance(snapshot, str | Path)) or snapshot == "":
        raise ValueError(f"snapshot = {validation.shown(snapshot)}: must be the path of a file")
    settings = Settings(periods, rtol, steps, ramp, velocity, keep_every, scheme)
    every = validation.integer("snapshot_every", snapshot_every, 1)
    try:
        if snapshot is not None:
            target = _target(Path(snapshot), scene, settings, every)
        run, resumed = Run(scene, settings), np.nan
        if target is not None:
            resumed = run.resume(target)
        run.finish(target, (_printed if progress is True else progress) or None)
        difference = _mesh_error(run) if mesh_error else np.nan
        jumps, feedback = _snap_error(run), _feedback_errors(run)
    except KeyboardInterrupt:
        if progress is True:
            print(file=sys.stderr)
        # Not a subclass, for which Python would not exit with the status of an interrupted process;
        # from None, since the traceback into a step does not help the user.
        raise KeyboardInterrupt(_interrupted(run, target)) from None
    found = replace(
        run.trajectory(),
        seconds=run.seconds,
        resumed_at=resumed,
        mesh_error=difference,
        snap_error=jumps,
        feedback_error=feedback.speed,
        growth_error=feedback.growth,
    )
    warn_if_viscous(scene.contact.friction, found.slip_ratio)
    return found


def _target(path: Path, scene: Scene, settings: Settings, every: int) -> Target:
    """Destination of the snapshots of a run; raises, before any work, if they cannot be written."""
    check_path(path)
    if not os.path.exists(path):
        check_writable(path)
    return Target(path, run_fingerprint(path, scene, settings), every)


def _mesh_error(run: Run) -> float:
    """Mesh error of the mean speed, from the same run on a coarser mesh."""
    coarse = Run(coarser(run.scene), run.settings)
    coarse.finish(None, None)
    difference = coarse.trajectory().period_speeds[-1] - run.trajectory().period_speeds[-1]
    return float(MESH_MARGIN * abs(difference))


class _FeedbackErrors(NamedTuple):
    """Of the speeds, length per time, and of c."""

    speed: float = np.nan
    growth: float = np.nan


def _feedback_errors(run: Run) -> _FeedbackErrors:
    """Errors by the feedback on the wave: that of the wave itself, and of the steps that both make.

    From a run with longer steps and larger elements of the wave: the largest differences over the
    periods, since one may be small by chance. NaN without feedback, infinite if that run fails.
    """
    if not run.scene.drive.has_state:
        return _FeedbackErrors()
    try:
        rough = Run(run.scene, run.settings.rougher(), coarse=True)
        rough.finish(None, None)
    except (ConvergenceError, ValueError):
        return _FeedbackErrors(np.inf, np.inf)
    speeds = rough.trajectory().period_speeds - run.trajectory().period_speeds
    found = (
        FEEDBACK_MARGIN * abs(apart).max() for apart in (speeds, run.feedback.apart(rough.feedback))
    )
    return _FeedbackErrors(*map(float, found))


def _snap_error(run: Run) -> float:
    """Error of the mean speed of a sheet that snaps through, from the same run with longer steps.

    NaN if it does not snap in the last period, infinite if the run with longer steps fails.
    """
    found = run.trajectory()
    if not found.snapped[found.last_period].any():
        return np.nan
    try:
        rough = Run(run.scene, run.settings.rougher())
        rough.finish(None, None)
    except (ConvergenceError, ValueError):
        return np.inf
    difference = rough.trajectory().period_speeds[-1] - found.period_speeds[-1]
    return float(SNAP_MARGIN * abs(difference))


def _interrupted(run: Run | None, target: Target | None) -> str:
    """Message on what is kept of an interrupted run, after writing its snapshot."""
    if run is None:
        return "simulate was interrupted before its first step"
    run.rewind()
    now, end = run.history.time, float(run.marks[-1])
    text = f"simulate was interrupted at t = {now:g} of {end:g}, after {run.steps} steps"
    if target is None:
        return f"{text}, which are lost; with snapshot='run.npz' the same call would resume the run"
    try:
        run.save(target)
    except OSError as error:
        return f"{text}; {error}; it is unchanged"
    return f"{text}, all kept in {target.path}; the same call resumes from there"


def coarser(scene: Scene) -> Scene:
    """The scene on a mesh with elements about 1.5 times as long.

    Raises ValueError for a mesh that cannot be coarsened: a given one, or one with a single row.
    """
    if scene.mesh is not None:
        raise ValueError("mesh_error = True: must be False for a scene with its own mesh")
    across, along = scene.cells or default_cells(scene.drive, scene.planar)
    if min(across, along) < 2:
        raise ValueError(f"cells = {scene.cells}: must both be >= 2 if mesh_error = True")
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

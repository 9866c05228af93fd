"""Time integration of a scene: growth ramped up from rest, then whole periods of its wave."""

import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.stepping.further import second_runs
from fem_check.shell.stepping.further.errors import Doubt, Further
from fem_check.shell.stepping.further.progress import Listener, Progress, Whole, printed
from fem_check.shell.stepping.run import Run, Target
from fem_check.shell.stepping.schemes import Scheme
from fem_check.shell.stepping.settings import Settings
from fem_check.shell.stepping.snapshot import check_path, check_writable, run_fingerprint
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


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
    progress: bool | Listener = False,
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
    progress: True prints, a function is called after each step, of further runs too (`Progress`).

    Steps are short enough to resolve the significant harmonics in time of the wave. A sheet that
    snaps through in the last period, or buckles and has inertia or dry friction, is simulated a second
    time with other steps, for the error of V: it may take another way. So is one whose strain acts back
    on its wave (`StrainFeedback`): the two are then stepped together, at second order. A sheet that
    touches itself in the last period (`SelfContact`) is simulated once more with a tenth of the gap
    between its layers.

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
    V = 0.015 L/T, friction is dry
    """
    run, target, further = None, None, False
    hint = "make one by Scene(sheet, wave, alpha, effects=...)"
    scene = validation.instance("scene", scene, Scene, hint)
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise ValueError(f"progress = {validation.shown(progress)}: must be True, False or a function")
    if not (snapshot is None or isinstance(snapshot, str | Path)) or snapshot == "":
        raise ValueError(f"snapshot = {validation.shown(snapshot)}: must be the path of a file")
    settings = Settings(periods, rtol, steps, ramp, velocity, keep_every, scheme)
    every = validation.integer("snapshot_every", snapshot_every, 1)
    coarse = second_runs.coarser(scene) if mesh_error else None
    try:
        if snapshot is not None:
            target = _target(Path(snapshot), scene, settings, every)
        run, resumed = Run(scene, settings), np.nan
        if target is not None:
            resumed = run.resume(target)
        whole = _whole(progress, mesh_error, scene.drive.has_state)
        run.finish(target, None if whole is None else _watching(run, whole))
        further = True
        mesh = Doubt() if coarse is None else second_runs.mesh_error(run, coarse, whole)
        feedback, growth = second_runs.feedback_errors(run, whole)
        jumps = second_runs.snap_error(run, whole)
        contact = second_runs.contact_error(run, whole)
    except KeyboardInterrupt:
        # Not a subclass, for which Python would not exit with the status of an interrupted process;
        # from None, since the traceback into a step does not help the user.
        raise KeyboardInterrupt(_interrupted(run, target, further)) from None
    finally:
        if progress is True and run is not None:
            print(file=sys.stderr)
    found = replace(
        run.trajectory(),
        seconds=run.seconds,
        resumed_at=resumed,
        further=Further(mesh, jumps, feedback, contact, growth),
    )
    warn_if_viscous(scene.contact.friction, found.slip_ratio)
    return found


def _whole(progress: bool | Listener | None, mesh_error: bool, feedback: bool) -> Whole | None:
    """What tells of the progress of all runs; None if no one listens."""
    if not progress:
        return None
    whole = Whole(printed if progress is True else progress, {})
    second_runs.plan(whole, *["mesh"] * mesh_error, *["feedback"] * feedback)
    return whole


def _watching(run: Run, whole: Whole) -> Listener:
    """What listens to the first run, and counts on another one when the sheet may branch."""
    listener = whole.of()

    def heard(progress: Progress) -> None:
        if run.branches:
            second_runs.plan(whole, "snaps")
        if run.touches:
            second_runs.plan(whole, "contact")
        listener(progress)

    return heard


def _target(path: Path, scene: Scene, settings: Settings, every: int) -> Target:
    """Destination of the snapshots of a run; raises, before any work, if they cannot be written."""
    check_path(path)
    if not os.path.exists(path):
        check_writable(path)
    return Target(path, run_fingerprint(path, scene, settings), every)


def _interrupted(run: Run | None, target: Target | None, further: bool) -> str:
    """Message on what is kept of an interrupted run, after writing its snapshot.

    further: whether the run itself had ended, and one that tells a part of its error was interrupted.
    """
    if run is None:
        return "simulate was interrupted before its first step"
    run.rewind()
    now, end = run.history.time, float(run.marks[-1])
    text = f"simulate was interrupted at t = {now:g} of {end:g}, after {run.steps} steps"
    if further:
        text = f"simulate was interrupted in a further run for the error, after all {run.steps} steps"
    if target is None:
        return f"{text}, which are lost; with snapshot='run.npz' the same call would resume the run"
    try:
        run.save(target)
    except OSError as error:
        return f"{text}; {error}; it is unchanged"
    if further:
        return (
            f"{text}, which are kept in {target.path}, but nothing of the further run; the same call "
            "starts it again"
        )
    return f"{text}, all kept in {target.path}; the same call resumes from there"

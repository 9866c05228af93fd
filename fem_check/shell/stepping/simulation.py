"""A scene stepped through time: growth ramped up from rest, then whole periods of its wave."""

import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.effects.friction import Friction
from fem_check.shell.point_state import PointState
from fem_check.shell.rates import Affine, Step
from fem_check.shell.scene import Scene, default_cells
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.power import Ledger, Moment, Works
from fem_check.shell.stepping.record import Record
from fem_check.shell.stepping.sliding import Sliding, sliding
from fem_check.shell.stepping.snapshot import fingerprint, load_snapshot, save_snapshot
from fem_check.shell.stepping.start import first_history
from fem_check.shell.stepping.step_control import History, step_size
from fem_check.shell.stepping.stepper import Stepper, StepResult
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import validation
from linear_theory.friction import warn_if_viscous

Array = NDArray[np.float64]

SNAP, PATIENCE = 3, 10
"""After so many failures in a row a step may take so many times the usual iterations: a sheet that
snaps over goes a long way however short the step is."""

MESH_MARGIN = 2
"""The mesh's error is this multiple of the difference to a mesh 1.5 times coarser. The elastic part is
far below it; in dry friction it is the quadrature of a force that jumps, which falls unevenly."""

CHECKED = 8
"""Of so many steps one is checked for negative curvature at its end, which costs a Hessian: a kept
factor, and symmetry, can hide it from the minimisations."""

LANDED = 1e-9
"""Share of the period within which a time counts as the end of a period."""


class Progress(NamedTuple):
    """time and end of the run, accepted and rejected steps, seconds spent and left (estimated)."""

    time: float
    end: float
    steps: int
    rejected: int
    seconds: float
    left: float


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
    snapshot: file that is written after every `snapshot_every` steps. If it exists the run goes on from
    it, and ends with the same numbers, bit for bit, as one that was not interrupted (one thread, same
    machine). keep_every: states of so many steps are kept in the trajectory. mesh_error: estimate the
    error of the mesh from a second run on a coarser one. progress: True prints, a function is called
    after each step.

    Steps are short enough to see the harmonics in time of the wave that matter; many where they are high.

    A scene without Friction and Inertia has no motion in time; use `cycle_speed.cycle_speed`.
    Raises ValueError for such scenes, for values out of range, `steps` too few to see the wave, and a
    wave that does not repeat after its period, SnapshotError for a snapshot that is
    damaged or of another scene or run, ConvergenceError (with the last state and its time as
    `parameter`) where steps become too small. Warns (ViscousRegimeWarning) where Friction, regularised
    dry friction, acts as viscous: see `CrawlSpeed.regime`.

    >>> from fem_check import Friction, Gravity, Material, Membrane, Scene, simulate
    >>> from linear_theory import Sheet, SineWave
    >>> effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, slip_speed=0.005)]
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(1, 2))
    >>> motion = simulate(scene, periods=1, rtol=0.1)
    >>> print(f"V = {motion.speed.mean:.3f} L/T, friction is {motion.regime}")
    V = 0.016 L/T, friction is dry
    """
    begin = time.perf_counter()
    run = Run(scene, periods, rtol, steps, ramp, velocity, snapshot_every, keep_every)
    resumed = run.resume(Path(snapshot)) if snapshot is not None else np.nan
    report = _printed if progress is True else progress
    run.finish(None if snapshot is None else Path(snapshot), report or None)
    difference = np.nan
    if mesh_error:
        coarse = Run(coarser(scene), periods, rtol, steps, ramp, velocity, snapshot_every, keep_every)
        coarse.finish(None, None)
        difference = coarse.trajectory().period_speeds[-1] - run.trajectory().period_speeds[-1]
        difference = MESH_MARGIN * abs(difference)
    found = replace(
        run.trajectory(),
        seconds=time.perf_counter() - begin,
        resumed_at=resumed,
        mesh_error=float(difference),
    )
    friction: Friction | None = scene.find(Friction)
    warn_if_viscous(found.speed, None if friction is None else friction.slip_speed)
    return found


class Run:
    """A simulation under way: everything that the next step depends on."""

    def __init__(
        self,
        scene: Scene,
        periods: int,
        rtol: float | None,
        steps: int | None,
        ramp: float,
        velocity: ArrayLike | None,
        snapshot_every: int,
        keep_every: int,
    ) -> None:
        periods = validation.integer("periods", periods, 1)
        if validation.real("ramp", ramp) < 0:
            raise ValueError(f"ramp = {ramp:g}: must be >= 0")
        self.snapshot_every = validation.integer("snapshot_every", snapshot_every, 1)
        self.keep_every = validation.integer("keep_every", keep_every, 1)
        self.scene, self.rtol, period = scene, rtol, scene.period
        self.settings = (periods, rtol, steps, ramp, repr(velocity), snapshot_every, keep_every)
        scene.survey.check_period()
        self.size = step_size(period, rtol, steps, scene.survey.rates)
        self.size.scale = abs(scene.alpha) * scene.sheet.length / period
        self.start = ramp * period
        self.stepper = Stepper(scene, self.start, self.size.dt)
        self.marks = self.start + period * np.arange(periods + 1)
        self.ledger, self.record = Ledger(scene), Record()
        self.region = self.stepper.region
        self.history = first_history(self.stepper, self.size.dt, velocity)
        self.moment = self._first_moment()

    def finish(self, path: Path | None, report: Callable[[Progress], None] | None) -> None:
        """Steps to the end, with a snapshot after every so many if there is a path."""
        begin, before = time.perf_counter(), self.history.time
        while self._remaining() > 0:
            self._advance()
            count = len(self.record.rows) - 1
            if path is not None and (count % self.snapshot_every == 0 or self._remaining() <= 0):
                self.stepper.forget()
                save_snapshot(path, self.arrays(), self.fingerprint())
            if report is not None:
                now, end, spent = self.history.time, self.marks[-1], time.perf_counter() - begin
                left = spent * (end - now) / max(now - before, 1e-300)
                report(Progress(now, end, count, self.record.rejected, spent, left))

    def trajectory(self) -> Trajectory:
        """What has been found so far."""
        record, aim = self.record, self.size.rtol
        times, states = np.array(record.times), np.array(record.states)
        return Trajectory(
            self.scene, self.start, record.table, times, states, record.rejected, 0.0, rtol=aim
        )

    def _remaining(self) -> float:
        """Time to the next end of a period (or of the ramp); 0 at the end."""
        tolerance = LANDED * self.scene.period
        ahead = self.marks[self.marks > self.history.time + tolerance]
        return float(ahead[0] - self.history.time) if ahead.size else 0.0

    def _advance(self) -> None:
        """One accepted step."""
        failures, check = 0, len(self.record.rows) % CHECKED == 0
        while True:
            dt = self.size.within(self._remaining())
            patience = PATIENCE if failures >= SNAP else 1
            try:
                result = self.stepper.attempt(self.history, dt, patience, check)
            except ConvergenceError as error:
                self._shorten(dt, error, last=patience > 1)
                failures += 1
                continue
            wrong = self.history.velocity_error(result.state, dt)
            velocity, _ = self.history.rules(dt)
            if self.size.judge(dt, self._rms(wrong), self._rms(velocity(result.state))):
                return self._accept(result, dt, wrong, velocity)
            self.record.rejected += 1

    def _shorten(self, dt: float, error: ConvergenceError, last: bool) -> None:
        self.record.rejected += 1
        if not self.size.halve(dt) and last:
            text = f"no step from t = {self.history.time:g}, however short: {error}"
            raise ConvergenceError(text, self.history.state, self.history.time) from error

    def _accept(self, result: StepResult, dt: float, wrong: Array, velocity: Affine) -> None:
        after = self.ledger.moment(result.state, result.rest, result.step, velocity(result.state))
        works = self.ledger.works(self.moment, after)
        slide = self._sliding(result, wrong)
        self.history, self.moment = self.history.advanced(result.state, dt), after
        counts = (result.iterations, result.repeats, result.buckled)
        self.record.add(result.time, self._centre(result.state), works, slide, counts)
        if (len(self.record.rows) - 1) % self.keep_every == 0 or self._remaining() <= 0:
            self.record.keep(result.time, result.state)

    def _sliding(self, result: StepResult, wrong: Array) -> Sliding:
        friction: Friction | None = self.scene.find(Friction)
        if friction is None:
            return Sliding(0.0, 0.0, np.zeros(2), np.zeros(2))
        state = PointState(self.region, result.state, (0,), result.rest, result.step)
        error = self.region.displacement(wrong, (0,))[0]
        return sliding(friction, state, error, self.region.measure)

    def _first_moment(self) -> Moment:
        """Of the start, which is also the first row of the record."""
        history, rest = self.history, self.stepper.rest(0.0)
        moving = history.velocity
        velocity = np.zeros_like(history.state) if moving is None else moving
        rule = self.stepper.at_points(Affine(1.0, history.state - velocity))
        step = self.stepper.held(Step(rule), history.state, rest)
        nothing = Works(*(np.zeros(()) for _ in Works._fields))
        still = Sliding(0.0, 0.0, np.zeros(2), np.zeros(2))
        self.record.add(0.0, self._centre(history.state), nothing, still)
        self.record.keep(0.0, history.state)
        return self.ledger.moment(history.state, rest, step, velocity)

    def _centre(self, u: Array) -> Array:
        """Centre of mass, (components,)."""
        measure = self.region.measure
        return np.asarray(self.region.position(u, (0,))[0] @ measure / measure.sum())

    def _rms(self, u: Array) -> float:
        """Root mean square over the sheet of a velocity along the ground."""
        square = (self.region.displacement(u, (0,))[0, :2] ** 2).sum(0)
        return float(np.sqrt(square @ self.region.measure / self.region.measure.sum()))

    def fingerprint(self) -> str:
        """Of the scene and of the run's settings."""
        return fingerprint(self.scene, self.settings)

    def arrays(self) -> dict[str, Array]:
        """All that the next step depends on and all that was recorded."""
        size, record, history = self.size, self.record, self.history
        found: dict[str, Any] = {
            "past_times": history.times,
            "past_states": history.states,
            "velocity": history.velocity,
            "acceleration": history.acceleration,
            "control": np.array([size.dt, size.scale, record.rejected]),
            "rows": np.array(record.rows),
            "stored_times": np.array(record.times),
            "states": np.array(record.states),
        }
        for name in ("area", "position", "sliding", "drag", "velocity"):
            found[f"moment_{name}"] = getattr(self.moment, name)
        return {name: value for name, value in found.items() if value is not None}

    def resume(self, path: Path) -> float:
        """Go on from a snapshot, if there is one; returns its time, else NaN."""
        if not path.exists():
            return np.nan
        found = load_snapshot(path, self.fingerprint())
        get = found.get
        self.history = History(
            found["past_times"], found["past_states"], get("velocity"), get("acceleration")
        )
        self.size.dt, self.size.scale = (float(v) for v in found["control"][:2])
        self.record = Record(
            list(found["rows"]),
            [float(t) for t in found["stored_times"]],
            list(found["states"]),
            int(found["control"][2]),
        )
        names = ("area", "sliding", "drag", "velocity")
        self.moment = replace(
            self.moment,
            state=self.history.state,
            rest=self.stepper.rest(self.history.time),
            position=found["moment_position"],
            **{name: get(f"moment_{name}") for name in names},
        )
        return self.history.time


def coarser(scene: Scene) -> Scene:
    """The scene on a mesh whose elements are about 1.5 times as long.

    Raises ValueError for a mesh that cannot be made coarser: of the scene's own, or of a single row.
    """
    if scene.mesh is not None:
        raise ValueError("mesh_error = True: must be False for a scene with a mesh of its own")
    across, along = scene.cells or default_cells(scene.sheet, scene.wave, scene.planar)
    if min(across, along) < 2:
        raise ValueError(f"cells = {scene.cells}: must be at least 2 each way where mesh_error = True")
    return replace(scene, cells=(round(across / 1.5), round(along / 1.5)))


def _printed(progress: Progress) -> None:
    share = 100 * progress.time / progress.end
    end = "\n" if progress.time >= progress.end * (1 - 1e-9) else ""
    print(
        f"\r{share:5.1f} %, {progress.steps} steps, {progress.left:.0f} s left ",
        end=end,
        file=sys.stderr,
        flush=True,
    )

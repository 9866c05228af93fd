"""A running simulation: its full state, which can be saved, resumed and rewound."""

import time
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fem_check.shell.coupling.dilation import longest_step
from fem_check.shell.coupling.feedback import Feedback
from fem_check.shell.effects.friction import Friction
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Affine, Step
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.statics.newton import Factorised
from fem_check.shell.statics.secants import Secants
from fem_check.shell.stepping.between import probe_region
from fem_check.shell.stepping.further.branching import DECISIVE, may_branch
from fem_check.shell.stepping.further.progress import Listener, Progress
from fem_check.shell.stepping.power import Ledger, Moment, Works
from fem_check.shell.stepping.record import COLUMNS, NO_COUNTS, Counts, Record
from fem_check.shell.stepping.schemes import History
from fem_check.shell.stepping.settings import Settings
from fem_check.shell.stepping.sliding import Sliding, sliding
from fem_check.shell.stepping.snapping import LONGEST, Snap, first_stiffness
from fem_check.shell.stepping.snapshot import check_writable, load_snapshot, save_snapshot
from fem_check.shell.stepping.start import first_history
from fem_check.shell.stepping.step_control import GROWTH, LANDED, step_size
from fem_check.shell.stepping.stepper import Stepper, StepResult
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common.threads import one_blas_thread
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

MOST_WORK = 60
"""Steps and repetitions of a run relative to the steps that a smooth motion would take."""

HARD = 50
"""Newton iterations of a step, above which the next one is not longer."""

CHECKED = 8
"""Interval, in steps, of checks for negative curvature at the end of a step, which cost a Hessian: a
reused factor, or symmetry, can hide it from the minimisations."""

MOMENT = ("area", "sliding", "touching", "drag", "velocity")
"""Arrays of a Moment that only some scenes have."""


SPARSE = ("data", "indices", "indptr")
"""Arrays of a sparse matrix in compressed rows."""


class Target(NamedTuple):
    """Destination of snapshots: file, fingerprint of the run, steps between two of them."""

    path: Path
    owner: str
    every: int


class Landing(NamedTuple):
    """State of the run after an accepted step, and the length of the record.

    control: step size and restraint of the next step. counts: rejected steps, rows and kept states of
    the record. factor: kept by the minimiser. past: of a wave that follows the motion, see `Feedback`.
    """

    history: History
    moment: Moment
    control: Array
    counts: tuple[int, int, int]
    factor: Factorised | None
    past: Any


class Run:
    """The time integration of a scene."""

    @one_blas_thread
    def __init__(self, scene: Scene, settings: Settings, coarse: bool = False) -> None:
        self._begun, self._before = time.perf_counter(), 0.0
        self.scene, self.settings, period = scene, settings, scene.period
        self.model = ShellModel(scene, scene.drive.followed(coarse))
        scene.drive.check_until(period * (settings.ramp + settings.periods))
        steps = settings.steps_of(period)
        self.size = step_size(period, settings.rtol, steps, scene.drive.rates, self.model.heavy)
        self.size.scale = abs(scene.alpha) * scene.sheet.length / period
        self.size.limit(longest_step(scene), period)
        self.snap = Snap(first_stiffness(scene.sheet))
        self.start = settings.ramp * period
        self.stepper = Stepper(self.model, self.start, self.size.dt)
        self.marks = self.start + period * np.arange(settings.periods + 1)
        self.ledger, self.record = Ledger(self.model), Record()
        self.region, self.probes = self.stepper.region, probe_region(self.model.discretisation)
        self.history = first_history(self.stepper, self.size.dt, settings.velocity, settings.scheme)
        self.feedback = Feedback.of(self.model)
        self.feedback.begin(self.history.state)
        self.free = self.history  # the last one that no restraint has led to
        self.moment = self._first_moment()
        self.landing = self._land()

    @property
    def seconds(self) -> float:
        """Spent so far, before an interruption included."""
        return self._before + time.perf_counter() - self._begun

    @property
    def steps(self) -> int:
        """Number of accepted steps so far."""
        return len(self.record.rows) - 1

    @property
    def branches(self) -> bool:
        """Whether the sheet could have taken another way in the last period, see `Trajectory`."""
        rows = np.array([row for row in self.record.rows if row[0] > self.marks[-2]])
        wanted = [COLUMNS.index(name) for name in DECISIVE]
        return may_branch(self.model, *rows[:, wanted].T) if rows.size else False

    @property
    def touches(self) -> bool:
        """Whether the sheet touches itself now, in the last period."""
        late = self.history.time >= self.marks[-2]
        return bool(late) and any(c.touches(self.history.state) for c in self.model.couplings)

    @one_blas_thread
    def finish(self, target: Target | None, report: Listener | None) -> None:
        """Step to the end, with snapshots at regular intervals if there is a target for them."""
        begin, before = time.perf_counter(), self.history.time
        if target is not None and self._remaining() > 0:
            check_writable(target.path)
        while self._remaining() > 0:
            self._check_work()
            self._advance()
            self.landing = self._land()
            if target is not None and (self.steps % target.every == 0 or self._remaining() <= 0):
                self.save(target)
            if report is not None:
                now, end, spent = self.history.time, self.marks[-1], time.perf_counter() - begin
                left = spent * (end - now) / max(now - before, 1e-300)
                report(Progress(now, end, self.steps, self.record.rejected, spent, left))

    def _check_work(self) -> None:
        """Raise ConvergenceError for a sheet that finds no rest, and for far too many steps."""
        if self.history.time - self.free.time > LONGEST * self.scene.period:
            text = f"no time step from t = {self.free.time:g} converges: the sheet moves on without end"
            raise ConvergenceError(text, self.free.state, self.free.time)
        asked = self.marks[-1] / min(self.size.natural or np.inf, self.size.largest)
        if self.steps + self.record.rejected > MOST_WORK * asked:
            text = f"{self.steps} steps and {self.record.rejected} repetitions lead to t = "
            text += f"{self.history.time:g} of {self.marks[-1]:g}: the motion is too rough"
            raise ConvergenceError(text, self.history.state, self.history.time)

    def trajectory(self) -> Trajectory:
        """The trajectory so far."""
        record = self.record
        return Trajectory(
            self.model,
            self.start,
            record.table,
            np.array(record.times),
            np.array(record.states),
            np.array(record.probes),
            record.rejected,
            0.0,
            rtol=self.size.rtol,
            corrects=self._corrects,
        )

    @property
    def _corrects(self) -> bool:
        """Whether the error of the steps is known: friction, not mass, balances a change of speed."""
        known = self.history.scheme.known_error and not self.model.heavy
        return self.size.rtol is not None and known

    def _remaining(self) -> float:
        """Time to the next end of a period (or of the ramp); 0 at the end of the run."""
        tolerance = LANDED * self.scene.period
        ahead = self.marks[self.marks > self.history.time + tolerance]
        return float(ahead[0] - self.history.time) if ahead.size else 0.0

    def _advance(self) -> None:
        """Make one accepted step."""
        check = len(self.record.rows) % CHECKED == 0
        while True:
            dt = self.size.within(self._remaining())
            try:
                result = self.stepper.attempt(self.history, dt, self.snap.stiffness, check)
            except ConvergenceError as error:
                self._failed(dt, error)
                continue
            wrong = self.history.velocity_error(result.state, dt)
            velocity, _ = self.history.rules(dt)
            speeds = self._rms(wrong), self._rms(velocity(result.state))
            if self.size.judge(dt, *speeds, forced=self.snap.restrained):
                return self._accept(result, dt, wrong, velocity)
            self.record.rejected += 1

    def _failed(self, dt: float, error: ConvergenceError) -> None:
        """Prepare another attempt. Raises ConvergenceError if there is nothing left to try."""
        self.record.rejected += 1
        if not self.snap.failed(shortest=not self.size.halve(dt)):
            text = f"no time step from t = {self.free.time:g} converges, however short: {error}"
            raise ConvergenceError(text, self.free.state, self.free.time) from error

    def _accept(self, result: StepResult, dt: float, wrong: Array, velocity: Affine) -> None:
        after = self.ledger.moment(result.state, result.rest, result.step, velocity(result.state))
        works = self.ledger.works(self.moment, after)
        slide = self._sliding(result, wrong)
        snapped = not self.size.resolved
        self.history, self.moment = self.history.advanced(result.state, dt, snapped), after
        if not self.snap.restrained:
            self.free = self.history
        elif self.snap.weak:
            self.size.dt = min(self.size.largest, GROWTH * dt)
        self.snap.succeeded()
        if result.iterations > HARD:
            self.size.dt = min(self.size.dt, dt)
        counts = Counts(result.iterations, result.repeats, result.buckled, snapped)
        self._note(result.state, works, slide, counts)
        kept = self.steps % self.settings.keep_every == 0 or self._remaining() <= 0
        self.feedback.accept(result.time, result.state, kept, snapped)
        if kept:
            self.record.keep(result.time, result.state)

    def _note(self, state: Array, works: Works, slide: Sliding, counts: Counts = NO_COUNTS) -> None:
        """Append a row to the record for the state at this time."""
        centre, probes = self._centre(state), self.probes.position(state, (0,))[0].T
        self.record.add(self.history.time, centre, works, slide, probes, counts)

    def _sliding(self, result: StepResult, wrong: Array) -> Sliding:
        friction: Friction | None = self.model.find(Friction)
        if friction is None:
            return Sliding(0.0, 0.0, np.zeros(2), np.zeros(2))
        entries = friction.entries
        state = PointState(self.region, result.state, entries, result.rest, result.step)
        error = self.region.displacement(wrong, entries)
        return sliding(friction, state, error, self.region.measure)

    def _first_moment(self) -> Moment:
        """The moment at the start, which is also the first row of the record."""
        history, rest = self.history, self.stepper.rest(0.0)
        known = history.velocity
        velocity = np.zeros_like(history.state) if known is None else known
        rule = self.stepper.at_points(Affine(1.0, history.state - velocity))
        moving = Step(rule, face=self.stepper.face_moving(history.state, velocity))
        step = self.stepper.held(moving, history.state, rest, 0.0)
        nothing = Works(*(np.zeros(()) for _ in Works._fields))
        still = Sliding(0.0, 0.0, np.zeros(2), np.zeros(2))
        self._note(history.state, nothing, still)
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

    def _land(self) -> Landing:
        record = self.record
        counts = record.rejected, len(record.rows), len(record.times)
        factor = self.stepper.minimiser.kept
        past = self.feedback.past
        return Landing(self.history, self.moment, self._control(), counts, factor, past)

    def _control(self) -> Array:
        """What the next step starts from, besides the history."""
        size, snap = self.size, self.snap
        return np.array([size.dt, size.scale, size.repeated, snap.stiffness, snap.steps])

    def _set_control(self, values: Array) -> None:
        self.size.dt, self.size.scale, repeated, self.snap.stiffness, steps = (float(v) for v in values)
        self.size.repeated, self.snap.steps, self.snap.failures = bool(repeated), int(steps), 0

    def rewind(self) -> None:
        """Return to the end of the last accepted step, from any point in the next one."""
        landing = self.landing
        self.history, self.moment = landing.history, landing.moment
        self._set_control(landing.control)
        self.record.rejected, rows, kept = landing.counts
        self.record.cut(rows, kept)
        self.stepper.minimiser.kept = landing.factor
        self.feedback.past = landing.past

    def save(self, target: Target) -> None:
        """Write a snapshot at the end of a step."""
        save_snapshot(target.path, self._arrays(), target.owner)

    def _arrays(self) -> dict[str, Array]:
        """The full state of the run and its record."""
        record, history = self.record, self.history
        found: dict[str, Any] = {
            "past_times": history.times,
            "past_states": history.states,
            "velocities": history.velocities,
            "acceleration": history.acceleration,
            "control": self._control(),
            "rejected": np.array(record.rejected),
            "seconds": np.array(self.seconds),
            "rows": np.array(record.rows),
            "probes": np.array(record.probes),
            "stored_times": np.array(record.times),
            "states": np.array(record.states),
            "moment_position": self.moment.position,
            **{f"moment_{name}": getattr(self.moment, name) for name in MOMENT},
            **self.feedback.arrays(),
        }
        kept = self.stepper.minimiser.kept
        if kept is not None:
            found |= {"hessian": kept.values, "shift": np.array(kept.shift)}
            secants = kept.secants
            if secants.steps:
                found |= {"steps": np.array(secants.steps), "changes": np.array(secants.changes)}
            if kept.coupled is not None:
                found |= {f"coupled_{name}": getattr(kept.coupled, name) for name in SPARSE}
        return {name: value for name, value in found.items() if value is not None}

    def resume(self, target: Target) -> float:
        """Resume from a snapshot, if there is one; returns its time, else NaN."""
        if not target.path.exists():
            return np.nan
        found = load_snapshot(target.path, target.owner)
        self._before = float(found["seconds"])
        get, minimiser = found.get, self.stepper.minimiser
        past = found["past_times"], found["past_states"], get("velocities"), get("acceleration")
        self.history = self.free = History(*past, self.history.scheme)
        self._set_control(found["control"])
        self.feedback.restore(found)
        self.record = Record(
            list(found["rows"]),
            list(found["probes"]),
            [float(t) for t in found["stored_times"]],
            list(found["states"]),
            int(found["rejected"]),
        )
        self.moment = replace(
            self.moment,
            state=self.history.state,
            rest=self.stepper.rest(self.history.time),
            position=found["moment_position"],
            **{name: get(f"moment_{name}") for name in MOMENT},
        )
        if "hessian" in found:
            secants = Secants(*(tuple(found.get(name, ())) for name in ("steps", "changes")))
            shift = float(found["shift"])
            coupled = None
            if "coupled_data" in found:
                size = 2 * (minimiser.sparsity.size,)
                coupled = sp.csr_array(tuple(found[f"coupled_{name}"] for name in SPARSE), shape=size)
            minimiser.kept = minimiser.factorised_again(found["hessian"], shift, secants, coupled)
        self.landing = self._land()
        return self.history.time

"""The energy balance: work of growth against stored and kinetic energy, friction and damping.

Growth does work on the sheet by changing its rest state. Over a step from (x0, r0) to (x1, r1), with r
the rest state, the potential energy U of the sheet, its weight and the ground changes by

    U(x1, r1) - U(x0, r0) = growth + motion,
    growth = [U(x1, r1) - U(x1, r0) + U(x0, r1) - U(x0, r0)]/2

exactly, where growth is the trapezoidal rule for the integral of dU/dr dr, so that no derivative with
respect to the rest state is needed. The work of dissipative forces is the mean of both ends times the
displacement. The residual of the balance, of second order in the step, is the dissipation of the
scheme: what the forces at the end of a step, with inertia, do along it beyond these changes and means.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from fem_check.shell.kinematics.rest_state import RestState
from fem_check.shell.model import ShellModel
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown
from linear_theory.energy.energy import Energy
from linear_theory.scene.dragged import mean_map_of

if TYPE_CHECKING:
    from fem_check.shell.stepping.trajectory import Trajectory

Array = NDArray[np.float64]


class _Works(NamedTuple):
    growth: Array
    elastic: Array
    weight: Array
    ground: Array
    kinetic: Array
    friction: Array
    damping: Array


class Works(Shown, _Works):
    """Energies in force times length; per step, or summed up to some times (arrays).

    growth: work of growth on the sheet. elastic, weight, ground, kinetic: increase of the energies
    (weight: with dead loads). friction, damping: dissipated energies. The balance is
    growth = elastic + weight + ground + kinetic + friction + damping + residual.
    """

    @property
    def residual(self) -> Array:
        """Residual of the balance: dissipation of the scheme, the error of the sums over steps."""
        return np.asarray(self.growth - sum(self[1:]))


STORES = ("elastic", "weight", "ground")
"""Entries of Works that are energies of effects, see `Effect.stored_as`."""


@dataclass(frozen=True, eq=False)
class Moment:
    """The sheet at the end of a step, with the quantities of the energy balance.

    velocity (size,): of the unknowns, for the kinetic energy; None without inertia. drag,
    sliding (components, points): forces of damping and of friction; touching (components, points): the
    points on which friction acts.
    """

    state: Array
    rest: RestState
    area: Array | None
    position: Array
    sliding: Array | None
    touching: Array | None
    drag: Array | None
    velocity: Array | None


class Ledger:
    """Balances the energy of a model step by step."""

    def __init__(self, model: ShellModel) -> None:
        self.region = model.discretisation.interior
        self.stored: list[tuple[int, Effect]] = [
            (STORES.index(e.stored_as), e)
            for e in model.effects
            if e.stored_as is not None and not e.idle(model.components)
        ]
        self.entries = tuple(sorted({k for _, e in self.stored for k in e.entries}))
        self.couplings = model.couplings
        self.areal_mass = sum(e.areal_mass for e in model.effects)
        self.damping = [e for e in model.effects if e.damps]
        self.friction: Friction | None = model.find(Friction)

    def moment(self, u: Array, rest: RestState, step: Step, velocity: Array | None) -> Moment:
        """Forces and positions at the end of a step (before the first one: of a step at rest)."""
        rubs, speed = self.friction, velocity if self.areal_mass else None
        entries: Entries = (0,) if rubs is None else rubs.entries
        state = PointState(self.region, u, entries, rest, step)
        force, touching = (None, None) if rubs is None else (rubs.force(state), rubs.touching(state))
        drag = self._drag(u, state)
        return Moment(u, rest, step.area, state.position, force, touching, drag, speed)

    def works(self, before: Moment, after: Moment) -> Works:
        """Works of the step between two moments."""
        area = None
        if before.area is not None and after.area is not None:
            # Weight per current area has no potential; the mean area over the step is used.
            area = (before.area + after.area) / 2
        old, new = before.rest, after.rest
        first, early = self._energies(before.state, (old, new), area)
        late, last = self._energies(after.state, (old, new), area)
        change = last - first
        growth = ((last - late) + (early - first)).sum() / 2
        friction = _loss(before.sliding, after.sliding, before.touching, after.touching)
        damping = _loss(before.drag, after.drag, before.position, after.position)
        kinetic = self._kinetic(after) - self._kinetic(before)
        values = (growth, *change, kinetic, friction, damping)
        return Works(*(np.asarray(value) for value in values))

    def _energies(self, u: Array, rests: tuple[RestState, ...], area: Array | None) -> Array:
        """Elastic energy, and energies of the weight and of the ground, for each rest state."""
        shape = PointState(self.region, u, self.entries, rests[0], Step(area=area))
        out = np.zeros((len(rests), 3))
        for energies, rest in zip(out, rests, strict=True):
            state = shape.under(rest)
            for slot, effect in self.stored:
                energies[slot] += effect.energy(state).sum()
        for coupling in self.couplings:
            out[:, STORES.index("elastic")] += coupling.energy_and_gradient(u)[0]
        return out

    def _kinetic(self, moment: Moment) -> float:
        if moment.velocity is None:
            return 0.0
        velocity = self.region.displacement(moment.velocity, (0,))[0]
        mass = self.areal_mass * self.region.measure
        return float(mass @ (velocity**2).sum(0)) / 2

    def _drag(self, u: Array, state: PointState) -> Array | None:
        """Force of contact damping alone, (3, points)."""
        if not self.damping:
            return None
        still = PointState(self.region, u, (0,), state.rest, Step(area=state.step.area))
        return np.asarray(sum((e.gradient(still) - e.gradient(state))[0] for e in self.damping))


def _loss(before: Array | None, after: Array | None, start: Array | None, end: Array | None) -> float:
    """Minus the work of a force on points that move from start to end."""
    if before is None or after is None or start is None or end is None:
        return 0.0
    return -float(((before + after) * (end - start)).sum()) / 2


def friction_load(model: ShellModel) -> float:
    """mu times the weight of the undeformed sheet normal to the ground; NaN if a scene lacks one."""
    friction, gravity = model.find(Friction), model.find(Gravity)
    if friction is None or gravity is None:
        return math.nan
    area = float(model.discretisation.interior.measure.sum())
    return float(friction.coefficient * gravity.weight * math.cos(gravity.incline) * area)


def energy_of(motion: "Trajectory") -> Energy | None:
    """Energy of the last period, over mu times the weight; None without Friction or Gravity.

    Work of growth that is still stored at the end of the period (elastic, of the ground, by the height
    of the sheet above it, kinetic) does not count: once the motion repeats there is none. What lifts
    the sheet along a slope does. Damping of the contact counts as friction. The error is the residual
    of the balance, the error of velocities from the steps, what further runs tell (see `SpeedErrors`),
    and the change from the period before, if there is one; infinite where a further run failed, without
    which it is not known which way the sheet takes.
    """
    load, contact = friction_load(motion.model), motion.scene.contact
    if math.isnan(load):
        return None
    last, *before = (motion.period_rows(k) for k in range(motion.periods - 1, -1, -1))
    table, steps = motion.table, np.diff(motion.times, prepend=0.0)
    friction = (table["friction"] + table["damping"]) / load
    works = friction + (table["weight"] / load if contact.slope else 0.0)
    error = float(friction[last] @ _doubt(motion, last))
    if before:
        error += abs(float(works[last].sum() - works[before[0]].sum()))
    period = motion.scene.period
    error = math.inf if motion.errors.failed else error / period + motion.further.power
    power = Estimate(float(works[last].sum()) / period, error)
    spent, mean = friction[last] / steps[last], mean_map_of(motion.scene)
    return Energy(
        power,
        spent,
        contact.friction,
        mean,
        contact.slope,
        across=motion.mean_across,
        heading=_heading(motion),
    )


def _heading(motion: "Trajectory") -> float:
    """Mean heading of the body over the last period, for laws whose axes turn with it; else 0."""
    if not motion.scene.contact.friction.follows_body:
        return 0.0
    path = motion.path
    last = path.times >= motion.times[motion.last_period.start]
    return float(path.heading[last].mean())


def _doubt(motion: "Trajectory", rows: slice) -> Array:
    """Relative error of the work of friction in each step, (rows,).

    Mean force times displacement lacks h^2/12 F'.v' of a step h, and as much by parts from F''.v: for
    one harmonic of frequency w and force proportional to velocity (w h)^2/6, which runs with dry
    friction show, too; twice that is taken, with the root mean square of w. To it comes the error of
    velocities: that of the fastest point, twice, since others are slower.
    """
    drive, law = motion.scene.drive, motion.scene.contact.friction
    frequency = drive.rates.of_rates(drive.period).total / (drive.rates.total or 1.0)
    steps, fastest = np.diff(motion.times, prepend=0.0)[rows], motion.table["fastest"][rows]
    wrong = fastest + abs(motion.table["step_y"][rows])
    before, after = (law.dissipation(np.stack([0 * v, v])) for v in (fastest, wrong))
    by_velocity = (after - before) / np.maximum(before, np.finfo(float).tiny)
    return 2 * by_velocity + (frequency * steps) ** 2 / 3

"""The friction balance of a cycle of shapes over a period, and the errors of its mean.

For a sine wave V(t) is of order alpha, but its mean only of order alpha^2, because V(t + T/2) = -V(t)
up to terms of order alpha^2. Therefore V(t) and V(t + T/2) are averaged first, and the mean is then
taken over half a period.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.frame import gyration
from fem_check.shell.cycle.motion import CycleMotion, depth_of, is_mirrored
from fem_check.shell.cycle.shapes import Shapes
from fem_check.shell.kinematics.places import ROUNDOFF, distinct
from linear_theory.balance.balance import Balance
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.balance.time_grid import TimeGrid, first_grid
from linear_theory.common.estimate import Estimate
from linear_theory.common.progress import track
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.contact import Contact
from linear_theory.motion.rigid import RigidNorm
from linear_theory.wave.protocol import PER_HARMONIC

Array = NDArray[np.float64]
Kind = TypeVar("Kind", bound=Balance)

TIMES_PER_PHASE = 8
"""Largest number of times per phase of the cycle: V(t) has kinks where the shapes have none, but if
more times are needed, the shapes are not resolved either."""

STATIC_NOISE = 1e-15
"""Roundoff of V in L/T, independent of alpha, since shapes are accurate to 1e-16 L. Measured on 2 x 4
to 8 x 16 elements: 1e-16 to 6e-16, root mean square over the times."""

LOT = 24
"""Number of times per batch: limits the memory."""

STICKING = 0.01
"""Fraction of the sheet at rest that counts as sticking."""

TIME_SHARE, HIDDEN = 0.3, 0.1
"""Fraction of the tolerance allotted to the quadrature in time, and the fraction of that below which
harmonics of the wave may alias."""


WORK_HALVINGS = 3
"""Of cells for the power of friction: the elements are larger than the cells of theory."""


class PairedPeriod(NamedTuple):
    """Motion over one period from the friction balance, V in length per time.

    grid: times of a quarter or half of the period; leading: (2, times, 3), V_x, V_y, Omega at the
    times of the grid and half a period later; mean, error (3,): of V_x, V_y, Omega, without the errors
    from phases and mesh; fastest: largest speed relative to the ground; sticks: see `CrawlSpeed`;
    works: (2, times, 3), see `Balance.works`, over the load at rest; power: mean power of growth,
    likewise without the errors from phases and mesh.
    """

    grid: TimeGrid
    leading: Array
    mean: Array
    error: Array
    fastest: float
    sticks: bool
    works: Array
    power: Estimate


class Change(NamedTuple):
    """One Newton step of a motion (2, times, 3), and the works (2, times, 3) of that motion."""

    leading: Array
    works: Array


@dataclass(frozen=True, eq=False)
class CycleBalance:
    """A cycle of shapes, its contact with the ground, and the resolution of the friction balance.

    order: Gauss points per cell and direction; halvings: of cells towards stagnation points;
    tolerance: of V, relative to the root mean square of the velocities.
    """

    shapes: Shapes
    contact: Contact
    order: int
    halvings: int
    tolerance: float
    mirrored: bool

    @classmethod
    def of(cls, shapes: Shapes, contact: Contact, rtol: float) -> "CycleBalance":
        """The balance resolved for a relative error rtol of the mean.

        V is smaller than the velocities by a factor alpha where halves of the period cancel to first
        order; the tolerance is alpha rtol then.
        """
        share = min(abs(shapes.scene.alpha) or 1.0, 1.0) if _opposed(shapes, contact) else 1.0
        digits = -math.log10(rtol * share)
        order = min(max(math.ceil(1.5 + 0.9 * digits), 5), 14)
        halvings = math.ceil(3.4 * digits)  # the last cell has the area 10^-digits of the first
        return cls(shapes, contact, order, halvings, 0.02 * 10**-digits, _mirrored(shapes, contact))

    @cached_property
    def norm(self) -> RigidNorm:
        """The norm of motions and of their errors."""
        return RigidNorm(gyration(self.shapes.discretisation), self.mirrored)

    @property
    def noise(self) -> float:
        """Roundoff of V, length/time: smaller differences are not significant."""
        scene = self.shapes.scene
        return STATIC_NOISE * scene.sheet.length / scene.period

    @property
    def reversal_time(self) -> float | None:
        """t_0 with V(t_0 - t) = V(t), if the wave and the sheet have that symmetry.

        Only in the plane, where a shape does not depend on earlier ones; also on a slope, since the
        velocity along y at (y, t) is that at (-y, t_0 - t).
        """
        reversal = self.shapes.scene.drive.reversal_time
        if reversal is None or not self.mirrored or self.contact.friction.map is not None:
            return None
        return (
            reversal
            if is_mirrored(self.shapes.scene, self.shapes.discretisation.mesh, axis=1)
            else None
        )

    @property
    def speed_per_rate(self) -> float:
        """Largest mean V for dc/dt of root mean square 1."""
        scene = self.shapes.scene
        return scene.speed_per_rate(not _opposed(self.shapes, self.contact))

    def on(self, shapes: Shapes) -> "CycleBalance":
        """The balance of other shapes of the same scene."""
        return replace(self, shapes=shapes, mirrored=_mirrored(shapes, self.contact))

    def finer(self) -> "CycleBalance":
        """On finer cells, by which the error of the cells is known."""
        return replace(self, order=self.order + 2, halvings=self.halvings + 6)

    def average(self, tolerance: Tolerance) -> PairedPeriod:
        """Mean motion over a period, with as many times as the tolerance needs and noise permits."""
        grid, most = self._first_grid(), TIMES_PER_PHASE * len(self.shapes.states)
        found = self.balance(grid.times)
        while True:
            values = _paired(found.leading)
            mean, time_error = grid.means(values)
            goal = max(TIME_SHARE * self.norm.allowed(mean, tolerance), self.noise)
            speeds = self.norm.speeds(values)
            finer = self._finer(grid, speeds, goal)
            if finer is None or grid.times.size > most:
                break
            added = ~np.isin(finer.times, grid.times)
            grid, found = finer, found.joined(self.balance(finer.times[added]), added)
        roundoff = self.norm.each(1e-12 * found.fastest + self.noise)
        cell_error, work_error = self._quadrature_errors(grid, found)
        error = time_error + cell_error + roundoff
        sticks = bool(found.rest.max() > STICKING)
        power = self.power(grid, found.works)
        power = Estimate(power.value, power.error + work_error + 1e-12 * found.fastest)
        return PairedPeriod(grid, found.leading, mean, error, found.fastest, sticks, found.works, power)

    def balance(self, times: Array, near: Array | None = None) -> RigidMotion:
        """Motion at given times and half a period later, leading and remainder (2, times, 3).

        near: a motion (2, times, 3) from which to start, of shapes that differ little.
        """
        later = self._with_partners(times)
        guess = None if near is None else near.reshape(-1, 3)
        starts = track("friction balance over the period", range(0, later.size, LOT))
        lots = [
            self._balance(later[i : i + LOT]).solve(_guess(guess, slice(i, i + LOT))) for i in starts
        ]
        leading, remainder, rest, fastest, works = zip(*lots, strict=True)
        shape = 2, times.size
        return RigidMotion(
            np.concatenate(leading).reshape(*shape, 3),
            np.concatenate(remainder).reshape(*shape, 3),
            np.concatenate(rest).reshape(shape),
            max(fastest),
            np.concatenate(works).reshape(*shape, 3),
        )

    def step(self, times: Array, leading: Array) -> Change:
        """One Newton step from a motion (2, times, 3) on other shapes or cells, and its works here."""
        times, start = self._with_partners(times), leading.reshape(-1, 3)
        nothing = np.zeros((LOT, 3))
        steps = [
            self._balance(times[i : i + LOT]).correction(
                start[i : i + LOT], nothing[: times[i : i + LOT].size]
            )
            for i in range(0, times.size, LOT)
        ]
        change = np.concatenate([step.leading for step in steps]).reshape(leading.shape)
        return Change(change, np.concatenate([s.works for s in steps]).reshape(leading.shape))

    def power(self, grid: TimeGrid, works: Array) -> Estimate:
        """Mean power of growth over mu times the weight, from works (2, times, 3) on the grid."""
        return Estimate(*grid.mean(self._powers(works).mean(0)))

    def _powers(self, works: Array) -> Array:
        """Of friction and of raising the load, (2, times)."""
        return np.asarray(works[..., 0] + self.contact.slope * works[..., 2])

    def mean(self, grid: TimeGrid, leading: Array) -> Array:
        """Mean V_x, V_y, Omega (3,) of motions (2, times, 3) on the grid and half a period later."""
        return grid.means(_paired(leading))[0]

    def whole_period(self, period: PairedPeriod) -> tuple[Array, Array, Array]:
        """Ascending times (T,) of one period from about 0 on, V_x, V_y, Omega (3, T), and power."""
        length = self.shapes.scene.period
        values = np.concatenate([period.leading, self._powers(period.works)[..., None]], axis=-1)
        times, rigid = self._with_partners(period.grid.times), values.reshape(-1, 4).T
        if self.reversal_time is not None:
            times = np.concatenate([times, self.reversal_time - times])
            rigid = np.concatenate([rigid, rigid], axis=1)
        share = np.mod(times / length, 1)
        share[share > 1 - ROUNDOFF] = 0.0  # the end of a period is the start of the next
        _, first = np.unique(distinct(share)[1], return_index=True)
        return share[first] * length, rigid[:3, first], rigid[3, first]

    def _finer(self, grid: TimeGrid, speeds: Array, goal: float) -> TimeGrid | None:
        """The finer grid that the goal requires; None if it is met and no harmonic aliases."""
        if grid.error(speeds) > goal:
            return grid.refined(speeds, goal)[0]
        scene = self.shapes.scene
        rate = HIDDEN * goal / self.speed_per_rate if self.speed_per_rate else math.inf
        harmonic = min(scene.drive.rates.needed(rate), self._highest)
        finer = grid.with_steps(scene.period / (PER_HARMONIC * harmonic))
        return finer if finer.times.size > grid.times.size else None

    @property
    def _highest(self) -> int:
        """Highest harmonic of the shapes."""
        return len(self.shapes.states) // 2

    def _first_grid(self) -> TimeGrid:
        """Half a period, or half of that if V(t_0 - t) = V(t) gives the rest."""
        length, reversal = self.shapes.scene.period, self.reversal_time
        if reversal is None:
            return first_grid(0.0, length / 2, 4)
        return first_grid(reversal / 2, reversal / 2 + length / 4, 2)

    def _quadrature_errors(self, grid: TimeGrid, found: RigidMotion) -> tuple[Array, float]:
        """Largest change on finer cells, at three times: of the paired motion (3,), of the power."""
        some = np.unique((np.array([0.07, 0.41, 0.77]) * grid.times.size).astype(int))
        change, works = self.finer().step(grid.times[some], found.leading[:, some])
        powers = self._powers(works - found.works[:, some]).mean(0)
        return np.asarray(abs(_paired(change)).max(1)), float(abs(powers).max())

    def _with_partners(self, times: Array) -> Array:
        """Times, then those half a period later."""
        return np.concatenate([times, times + self.shapes.scene.period / 2])

    @cached_property
    def _motion(self) -> CycleMotion:
        law, depth = self.contact.friction, depth_of(self.shapes, self.contact)
        of = self.shapes, self.contact.load, self.order, self.mirrored
        return CycleMotion(*of, map=law.map, depth=depth)

    def _balance(self, times: Array) -> Balance:
        return self.balance_of(Balance, times)

    def balance_of(self, kind: type[Kind], times: Array) -> Kind:
        """The balance of friction at times (T,), of a class that may know more of it."""
        motion, law, slope = self._motion.at(times), self.contact.friction, self.contact.slope
        resolution = self.halvings, self.tolerance
        rest = self._motion.weight
        return kind(motion, motion.dilation, 1.0, law, *resolution, slope, rest, WORK_HALVINGS)


def _guess(near: Array | None, some: slice) -> RigidMotion | None:
    """Some of the motions (times, 3) from which to start."""
    if near is None:
        return None
    part = near[some]
    return RigidMotion(part, np.zeros_like(part), np.zeros(len(part)), 0.0)


def _opposed(shapes: Shapes, contact: Contact) -> bool:
    """Whether the other half of the period is the opposite motion to first order in alpha."""
    return shapes.scene.drive.changes_sign and contact.friction.reversible and contact.slope == 0


def _mirrored(shapes: Shapes, contact: Contact) -> bool:
    """Whether motion and friction are mirror symmetric in x."""
    return is_mirrored(shapes.scene, shapes.discretisation.mesh) and contact.friction.mirrored


def _paired(leading: Array) -> Array:
    """Means of V_x, V_y, Omega at each time and half a period later, (3, times)."""
    return np.asarray(leading.mean(0).T)

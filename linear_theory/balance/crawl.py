"""A crawling sheet (field, growth coupling, contact) and the resolution of its friction balance."""

import math
from dataclasses import dataclass, replace
from dataclasses import field as dataclass_field
from functools import cached_property
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.balance import LINEAR, Balance
from linear_theory.balance.load_check import check_load
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.common.progress import track
from linear_theory.deformation.field import LinearField
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.motion.motion import CellGrid, Motion
from linear_theory.motion.rigid import RigidNorm
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]
Kind = TypeVar("Kind", bound=Balance)

MOST_TIMES = 4096
MOST_WORK = 8_000_000
"""Limits of the number of times and of the work at all times together (see `Crawl.work`), some tens of
seconds."""

SMALL_SHARE = 1e-4
"""Of a slip, for the slope of the dissipation along it."""


JUMPS = 3.0
"""Of the change on finer cells, for a map of friction that may have jumps at places that are not known:
two of 14 random ones were off by 1.2 and 1.7 changes."""

BATCH = 10_000
"""Points per batch; halving of cells makes ten times as many, which fit in the cache."""


class Known(NamedTuple):
    """The motion at given ascending times."""

    times: Array
    motion: RigidMotion

    def between(self, times: Array) -> RigidMotion:
        """The motion at other times by linear interpolation of q."""
        leading, remainder = (
            np.stack([np.interp(times, self.times, column) for column in q.T], axis=1)
            for q in (self.motion.leading, self.motion.remainder)
        )
        return RigidMotion(leading, remainder, np.zeros(times.size), 0.0)


class CellErrors(NamedTuple):
    """Errors from cells: of the counted motion (3,), of q_0, q_1 (2, 3) and of works p_0, p_1 (2,)."""

    counted: Array
    orders: Array
    works: Array


@dataclass(frozen=True)
class Resolution:
    """Cells per wave, Gauss points per cell and direction, halvings, tolerance of q."""

    density: float
    order: int
    halvings: int
    tolerance: float

    def finer(self) -> "Resolution":
        """The next finer resolution, for error estimates and for refinement."""
        return Resolution(1.5 * self.density, self.order + 1, self.halvings + 6, 0.1 * self.tolerance)


def first_resolution(rtol: float) -> Resolution:
    """Four cells per wave, halved until the cell at a stagnation point has an area of about rtol^1.6.

    Near such a point the integrand of the remainder behaves like 1/distance, so that the error falls
    like the square root of the area of the last cell.
    """
    digits = -math.log10(rtol)
    order = min(max(math.ceil(2.5 + 0.8 * digits), 5), 14)
    return Resolution(4.0, order, max(math.ceil(5.3 * digits - 7), 2), 0.02 * rtol)


def joint_resolution(rtol: float, smooth: bool = False) -> Resolution:
    """That of a motion whose mean is of first order, found as one (see `Balance`).

    Near a stagnation point its integrand is bounded: the error falls like the area of the last cell.
    smooth: no cell is halved, so that more points cost little.
    """
    digits = -math.log10(rtol)
    order = min(max(math.ceil((2.5 if smooth else 1.5) + 0.8 * digits), 4), 14)
    return Resolution(4.0, order, max(math.ceil(3 * digits - 2), 2), 0.02 * rtol)


@dataclass(frozen=True)
class Crawl:
    """A crawling sheet (field, growth coupling, contact) and the resolution of its balance.

    waves: along the sheet, that the cells resolve even if its own wave has longer ones only.
    """

    field: LinearField
    alpha: float
    contact: Contact
    resolution: Resolution
    waves: int = dataclass_field(default=0, kw_only=True)

    @classmethod
    def to(cls, rtol: float, field: LinearField, alpha: float, contact: Contact) -> "Crawl":
        """With the resolution that a tolerance asks for at first."""
        crawl = cls(field, alpha, contact, first_resolution(rtol))
        smooth = not contact.friction.limited
        return replace(crawl, resolution=joint_resolution(rtol, smooth)) if crawl.joint else crawl

    @property
    def drive(self) -> Drive:
        """The wave on the sheet."""
        return self.field.drive

    @property
    def starts_at_second_order(self) -> bool:
        """Whether c(t + T/2) = -c(t), so that the leading q_0 has exactly no mean."""
        return self.drive.changes_sign and self.contact.friction.reversible

    @property
    def mirrored(self) -> bool:
        """Whether motion and friction are mirror symmetric in x."""
        return self.field.mirrored and self.contact.friction.mirrored

    @property
    def counts_leading(self) -> bool:
        """Whether q_0 is part of the counted motion."""
        return not self.starts_at_second_order

    @property
    def joint(self) -> bool:
        """Whether q_0 + alpha q_1 is solved for as one (see `Balance`)."""
        return self.counts_leading and abs(self.alpha) > LINEAR

    def balance(self, times: Array, known: Known | None = None) -> RigidMotion:
        """Rigid motion at the given times, in batches; known: the motion at other times, as a guess."""
        size = max(BATCH // self._motion(times[:1]).area.size, 1)
        batches = []
        for i in track("friction balance over the period", range(0, times.size, size)):
            some = times[i : i + size]
            batches.append(self._balance(some).solve(known and known.between(some)))
        leading, remainder, rest, fastest, works = zip(*batches, strict=True)
        return RigidMotion(
            np.concatenate(leading),
            np.concatenate(remainder),
            np.concatenate(rest),
            max(fastest),
            np.concatenate(works),
        )

    @property
    def reversal_time(self) -> float | None:
        """t_0 with V(t_0 - t) = V(t), where the wave and the sheet have that symmetry.

        A sheet that is no rectangle need not be the same under y -> -y.
        """
        alike = self.mirrored and self.field.rectangular and self.contact.friction.map is None
        return self.drive.reversal_time if alike else None

    @cached_property
    def work(self) -> int:
        """Work per time: points of the balance plus unknowns of the deformation solved for."""
        return self.points + self.field.numbers

    @cached_property
    def points(self) -> int:
        """Points of the balance."""
        return int(self._motion(np.zeros(1)).area.size)

    def affords(self, times: Array) -> bool:
        """Whether the balance at these times is within the work limit."""
        return self.work * times.size <= MOST_WORK

    def reaches(self, count: float) -> bool:
        """Whether a number of times is within the work limit."""
        return count <= min(MOST_TIMES, MOST_WORK / self.work)

    @property
    def speed_per_rate(self) -> float:
        """Largest counted V for dc/dt of root mean square 1."""
        return self.drive.speed_per_rate(self.alpha, self.counts_leading)

    @property
    def norm(self) -> RigidNorm:
        """The norm of motions and of their errors."""
        return RigidNorm(self.field.gyration, self.mirrored)

    def counted(self, motion: RigidMotion) -> Array:
        """V_x, V_y, Omega at each time, without terms whose mean vanishes by symmetry, (3, times)."""
        second = self.alpha**2 * motion.remainder.T
        return self.alpha * motion.leading.T + second if self.counts_leading else second

    def quadrature_errors(self, times: Array, motion: RigidMotion) -> "CellErrors":
        """What finer cells change, at the most of three times.

        From one Newton step; 0 for a q_0 without a mean. More for a map of friction that may jump
        within a cell, where a change is no bound.
        """
        friction = self.contact.friction.map
        chance = 1.0 if friction is None or any(friction.creases) else JUMPS
        some = np.unique((np.array([0.07, 0.41, 0.77]) * times.size).astype(int))
        finer = replace(self, resolution=self.resolution.finer())
        step = finer._balance(times[some]).correction(motion.leading[some], motion.remainder[some])
        orders = chance * abs(np.stack([step.leading, step.remainder])).max(1)
        if self.starts_at_second_order:
            orders[0] = 0.0
        works = step.works[:, :2] - motion.works[some, :2]
        return CellErrors(chance * abs(self.counted(step)).max(1), orders, chance * abs(works).max(0))

    def field_error(self, motion: RigidMotion) -> float:
        """Error of V_x, V_y and g Omega each (see `RigidNorm`) due to the error of the deformation.

        The missing short waves alternate in sign and nearly cancel in the balance: the factors measured
        for widths from 0.1 L to 2 L are at most 0.05 (sines) and 0.004 (pulses), against 0.2 and 0.02
        used here.
        """
        speed = self.field.error * abs(self.alpha) * motion.fastest
        by_load = 0.0 if self.contact.load is Load.MATERIAL else 0.4 * abs(self.alpha)
        return speed * (by_load + (0.0 if self.starts_at_second_order else 0.02))

    def work_errors(self, motion: RigidMotion) -> Array:
        """Errors of p_0 and p_1 (see `Balance.works`) due to that of the deformation, (2,).

        That of velocities; friction is balanced, so that what follows of V does no work. The load has
        the error of the strain, which is larger: twice is assumed.
        """
        power = self.power_per_speed(motion) * self.field.error * motion.fastest
        return np.array([power, 0.0 if self.contact.load is Load.MATERIAL else 2 * power])

    def power_per_speed(self, motion: RigidMotion) -> float:
        """Most that friction dissipates more per speed, at slips of any direction up to the fastest.

        1 for dry friction, 2 |v|/v_1 for viscous friction of the unit v_1, both times a map.
        """
        if not motion.fastest:
            return 0.0
        law, angles = self.contact.friction.per(self.alpha), 2 * np.pi / 16 * np.arange(16.0)
        slip = motion.fastest * np.stack([np.cos(angles), np.sin(angles)])
        more = law.dissipation((1 + SMALL_SHARE) * slip) - law.dissipation(slip)
        steepest = float(more.max()) / (SMALL_SHARE * motion.fastest)
        if law.map is None:
            return steepest
        return steepest * float(law.map.values(*self._motion(np.zeros(1)).position, 0.0).max())

    @property
    def grid(self) -> CellGrid:
        """Cells of the balance."""
        across, along = self.drive.short_waves
        along = max(along, self.waves)
        density = self.resolution.density
        grid = CellGrid.graded(self.field.sheet, along, density, self.mirrored, across)
        friction = self.contact.friction.map
        return grid if friction is None else grid.cut_at(*friction.creases)

    def _motion(self, times: Array) -> Motion:
        return self.field.motion(times, self.grid, self.resolution.order)

    def _rate(self, times: Array, motion: Motion) -> Array:
        """e of the load 1 + alpha e, (times, cells, n, n)."""
        return self.contact.load.rate(motion.dilation, motion.growth)

    def _balance(self, times: Array) -> Balance:
        return self.balance_of(Balance, times)

    def balance_of(self, kind: type[Kind], times: Array) -> Kind:
        """The balance at given times, as an object of that class."""
        motion, r = self._motion(times), self.resolution
        rate = self._rate(times, motion)
        check_load(motion, rate, self.alpha)
        law, rest = self.contact.friction.per(self.alpha), motion.whole_area
        if law.map is not None:
            share = law.map.values(*motion.position, np.reshape(times, (-1, 1, 1, 1)))
            motion = replace(motion, area=motion.area * share)
        resolution = r.halvings, r.tolerance
        return kind(motion, rate, self.alpha, law, *resolution, rest=rest, joint=self.joint)

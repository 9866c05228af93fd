"""Means over a period of the derivatives along directions, with their errors.

The course of a balance over a period (its times, cells and motions) is frozen. The derivative of V along
a direction has, at every time, a value: its mean is taken by the same rule as that of V, with the same
estimate of its error; what finer cells and higher degrees of the deformation change at three times is
the error of the rest.

V of a wave with c(t + T/2) = -c(t) is of second order in alpha, as the leading q_0 has no mean, exactly;
nor has its derivative along a direction that keeps this symmetry: it is left out there.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Crawl
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.maps import FrictionMap
from linear_theory.gradient.adjoint import LawChange
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.quantity import Quantity
from linear_theory.gradient.sensitivity import MapChange, Sensitivity, Wanted, sensitivities

Array = NDArray[np.float64]

CHECKED = 0.07, 0.41, 0.77
"""Shares of the times at which finer cells and higher degrees are tried."""

MORE_DEGREES = 8
"""By which the deformation is finer there."""

SAFETY = 2.0
"""Of the largest change there, for the mean over all times."""


class Means(NamedTuple):
    """Derivatives (k, directions) of the means of quantities per unit alpha, and their errors.

    flat: whether at some time there is a motion that friction does not resist.
    """

    values: Array
    errors: Array
    flat: bool


@dataclass(frozen=True)
class Derivatives:
    """Of quantities along directions, for the course of a balance."""

    course: Course
    directions: Sequence[Direction]
    quantities: Sequence[Quantity]

    def means(self) -> Means:
        """Over the period."""
        course, crawl = self.course, self.course.crawl
        times, motion = course.grid.times, course.motion
        values, flat = self._at(crawl, times, motion.leading, motion.remainder)
        count = values.shape[:2]
        mean, error = course.grid.means(values.reshape(-1, times.size))
        some = np.unique((np.array(CHECKED) * times.size).astype(int))
        finer, _ = self._at(_finer(crawl), times[some], motion.leading[some], motion.remainder[some])
        change = abs(finer - values[..., some]).max(-1)
        return Means(
            mean.reshape(count), error.reshape(count) + SAFETY * change, bool(flat.any())
        )

    def _at(
        self, crawl: Crawl, times: Array, leading: Array, remainder: Array
    ) -> tuple[Array, NDArray[np.bool_]]:
        """Derivatives at times (T,), (k, directions, T), and where friction does not resist."""
        q, wanted = leading + crawl.alpha * remainder, self._wanted
        whole = sensitivities(crawl, times, q, crawl.alpha, wanted)
        growths = self._growths(whole.x, whole.y, times)
        found = self._along(whole, growths, crawl.alpha)
        if self._without_leading.any():
            first = sensitivities(crawl, times, leading, 0.0, wanted)
            part = self._along(first, growths, 0.0)
            found = found - np.where(self._without_leading[:, None], part, 0.0)
        return found, whole.flat

    def _along(self, at: Sensitivity, growths: tuple[Array, Array], alpha: float) -> Array:
        """From sensitivities, (k, directions, T); alpha: of the load, 0 for the leading motion."""
        crawl = self.course.crawl
        one, other = (s.reshape(len(s), s.shape[1], -1) for s in (at.value, at.rate))
        c, rate = (g.reshape(*g.shape[:2], -1) for g in growths)
        found = np.einsum("kts,pts->kpt", one, c, optimize=True)
        found += np.einsum("kts,pts->kpt", other, rate, optimize=True)
        law, maps = 0, 0
        for p, d in enumerate(self.directions):
            slip = d.alpha / crawl.alpha - d.slip - d.period
            found[:, p] += slip * at.slip + d.width * at.width + d.poisson * at.poisson
            if alpha:
                found[:, p] += d.alpha * at.alpha
            if d.law is not None:
                found[:, p] += at.laws[law]
                law += 1
            if d.map is not None:
                found[:, p] += at.maps[maps]
                maps += 1
        return found

    def _growths(self, x: Array, y: Array, times: Array) -> tuple[Array, Array]:
        """dc and its rate for each direction at points and times, (directions, T, X, Y).

        Of a motion known over half a period by its reversal in time, with c(-y, t_0 - t) in the mean:
        that is what it does in the other half.
        """
        crawl = self.course.crawl
        reversal, shape = crawl.reversal_time, (times.size, x.size, y.size)
        at = x[:, None], y, times[:, None, None]
        found = np.zeros((2, len(self.directions), *shape))
        for p, direction in enumerate(self.directions):
            change = direction.growth
            if change is None:
                continue
            found[0, p], found[1, p] = change.value(*at), change.rate(*at)
            if reversal is not None:
                back = x[:, None], -y, reversal - times[:, None, None]
                found[0, p] = (found[0, p] + change.value(*back)) / 2
                found[1, p] = (found[1, p] - change.rate(*back)) / 2
        return found[0], found[1]

    @cached_property
    def _wanted(self) -> Wanted:
        crawl = self.course.crawl
        own, alpha, mirrored = crawl.contact.friction, crawl.alpha, crawl.mirrored
        laws, maps = [], []
        for one in self.directions:
            if one.law is not None:
                ahead, behind = one.law.ahead, one.law.behind
                assert isinstance(ahead, FrictionLaw) and isinstance(behind, FrictionLaw)
                laws.append(LawChange(ahead.per(alpha), behind.per(alpha), one.law.apart, mirrored))
            if one.map is not None:
                ahead, behind = one.map.ahead, one.map.behind
                assert isinstance(ahead, FrictionMap) and isinstance(behind, FrictionMap)
                maps.append(MapChange(ahead, behind, one.map.apart, mirrored and not own.map.mirrored))
        return Wanted(
            self.quantities,
            sheet=any(d.width or d.poisson for d in self.directions),
            across=any(d.growth is not None and d.growth.across for d in self.directions),
            laws=laws,
            maps=maps,
        )

    @cached_property
    def _without_leading(self) -> NDArray[np.bool_]:
        """Along which directions q_0 keeps no mean, (directions,)."""
        crawl = self.course.crawl
        if not crawl.starts_at_second_order:
            return np.zeros(len(self.directions), bool)
        return np.array([_keeps(direction, crawl) for direction in self.directions], bool)


def _keeps(direction: Direction, crawl: Crawl) -> bool:
    """Whether a direction keeps c(t + T/2) = -c(t) and friction that is the same for -v."""
    law, growth = direction.law, direction.growth
    if law is not None and not (law.ahead.reversible and law.behind.reversible):
        return False
    if growth is None:
        return True
    sheet, period = crawl.field.sheet, crawl.drive.period
    share = np.array([-0.43, -0.17, 0.08, 0.31])
    return growth.changes_sign(sheet.width * share, sheet.length * share, period * share, period)


def _finer(crawl: Crawl) -> Crawl:
    """With finer cells and a deformation of higher degree."""
    field = crawl.field
    assert isinstance(field, RitzField)
    degree = tuple(d + MORE_DEGREES for d in field.degree)
    finer = RitzField(field.drive, RitzSolver(field.sheet, degree))
    return replace(crawl, field=finer, resolution=crawl.resolution.finer())

"""The gradient of the speed to second order in alpha, V = V_1 alpha + V_2 alpha^2.

V_1 and V_2 are the means of q_0 and q_1 (see `speed.second_order`). With the velocity v_1 + a v_2 and
the load 1 + a e the balance has the solution q = q_0 + a q_1 + ... for small a of either sign, and the
adjoint of that balance (`adjoint`) gives its change dq(a). Hence

    dV_1 = mean [dq(a) + dq(-a)]/2,     dV_2 = mean [dq(a) - dq(-a)]/(2 a),

up to a^2. The changes of v_1, v_2 and e with a parameter are those of the deformation, by differences
of three solutions, exact for amplitudes, in which it is quadratic. This costs two more solutions of the
deformation per parameter.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Resolution
from linear_theory.balance.period import resolved
from linear_theory.common.progress import track
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.deformation.second.field import SecondOrderField, second_order_field
from linear_theory.friction.law import FrictionLaw
from linear_theory.gradient.adjoint import AdjointBalance, Weights
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.means import CHECKED, COARSE, PER_HARMONIC, SAFETY, law_changes
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.quantity import ALONG
from linear_theory.motion.motion import Motion
from linear_theory.scene.scene import Scene
from linear_theory.speed.expansion import (
    TINY_ALPHA,
    Coefficients,
    cells,
    field_tolerance,
    of_second,
    tiny,
)

Array = NDArray[np.float64]

SMALL, SMALL_DRY = 1e-4, 2e-2
"""a of the differences; the latter for dry friction, where points at rest move with a and cells must
resolve by how far."""

STEP = 1e-4
"""Of a parameter, relative to it or to 1."""

NEWTON_STEPS = 3
"""From q_0 + a q_1."""


class Orders(NamedTuple):
    """Derivatives of V_1 and V_2 and their errors, (2, parameters) each."""

    values: Array
    errors: Array


def order_gradients(
    scene: Scene, over: Sequence[Parameter], directions: Sequence[Direction], rtol: float
) -> Orders:
    """Of a scene with a mirror-symmetric motion; raises ValueError for another one."""
    law = scene.contact.friction.per(scene.alpha)
    field = second_order_field(scene.sheet, scene.wave, scene.growth, field_tolerance(rtol))
    if not (field.mirrored and law.mirrored) or law.map is not None:
        raise ValueError("order = 2: must be 1 for a sheet that may turn, or whose friction has a map")
    contact, highest = replace(scene.contact, friction=law), max(d.highest for d in directions)
    waves = highest * abs(getattr(scene.wave, "count", 1))
    least = ritz_error.first_degrees(scene.sheet, math.ceil(waves), COARSE) if waves else (3, 3)
    across, along = (max(pair) for pair in zip(least, field.first.degree, strict=True))
    if (across, along) != field.first.degree:
        solver = RitzSolver(scene.sheet, (across, along))
        field = SecondOrderField(RitzField(field.drive, solver), scene.growth)
    crawl = Coefficients(
        field, TINY_ALPHA, tiny(contact), cells(rtol, field, contact), waves=math.ceil(waves / 2)
    )
    course = resolved(crawl, of_second(rtol, field)).course
    if highest:
        course = course.on(course.grid.with_steps(scene.period / (PER_HARMONIC * highest)))
    return _Second(scene, course, law, field, over, directions).orders()


@dataclass(frozen=True)
class _Second:
    scene: Scene
    course: Course
    law: FrictionLaw
    field: SecondOrderField
    over: Sequence[Parameter]
    directions: Sequence[Direction]

    def orders(self) -> Orders:
        """Means over the period."""
        grid, crawl = self.course.grid, self.course.crawl
        times = grid.times
        values = self._at(times, np.arange(times.size), crawl.resolution)
        some = np.unique((np.array(CHECKED) * times.size).astype(int))
        finer = self._at(times[some], some, crawl.resolution.finer())
        flat = values.reshape(-1, times.size)
        means, errors = (part.reshape(values.shape[:2]) for part in grid.means(flat))
        errors = errors + SAFETY * abs(finer - values[..., some]).max(-1)
        if crawl.starts_at_second_order:
            kept = np.array([d.keeps_sign(crawl.drive) for d in self.directions])
            means[0, kept] = errors[0, kept] = 0.0
        return Orders(means, errors)

    def _at(self, times: Array, which: NDArray[np.int64], resolution: Resolution) -> Array:
        """Derivatives of q_0 and q_1 at times (T,), (2, parameters, T)."""
        small = SMALL if self.law.width > 0 else SMALL_DRY
        here = self._motion(self.scene, times, resolution)
        pairs = list(zip(self.over, self.directions, strict=True))
        changes = [
            self._change(one, direction, times, resolution, here)
            for one, direction in track("deformation by each parameter", pairs)
        ]
        motion = self.course.motion
        ahead, behind = (
            self._by_each(
                self._weights(a, here, motion.leading[which] + a * motion.remainder[which], resolution),
                a,
                changes,
            )
            for a in (small, -small)
        )
        return np.stack([(ahead + behind) / 2, (ahead - behind) / (2 * small)])

    def _weights(self, a: float, here: Motion, q: Array, resolution: Resolution) -> Weights:
        """Derivatives of the motion at v_1 + a v_2, with the load 1 + a e; q: near that motion."""
        rate = self.course.crawl.contact.load.rate(here.dilation, here.growth)
        moving = replace(here, velocity=_velocity(here, a), second=None)
        steps = resolution.halvings, resolution.tolerance
        balance = AdjointBalance(moving, rate, a, self.law, *steps, joint=True)
        for _ in range(NEWTON_STEPS):
            q = balance.polished(q, a)
        laws = law_changes(self.directions, self.scene.alpha, mirrored=True)
        return balance.weights(q, a, [ALONG], laws)

    def _by_each(self, at: Weights, a: float, changes: Sequence[Motion | None]) -> Array:
        """Derivatives of q by each parameter, (parameters, T)."""
        load, rows, laws = self.course.crawl.contact.load, [], iter(at.laws)
        for d, change in zip(self.directions, changes, strict=True):
            row = (d.alpha / self.scene.alpha - d.slip - d.period) * at.slip[0]
            if change is not None:
                rate = load.rate(change.dilation, change.growth)
                row = row + (at.velocity[0] * _velocity(change, a)).sum((0, 2, 3, 4))
                row = row + (at.load[0] * rate).sum((1, 2, 3))
            if d.law is not None:
                row = row + next(laws)[0]
            rows.append(row)
        return np.stack(rows)

    def _motion(self, scene: Scene, times: Array, resolution: Resolution) -> Motion:
        """That of a scene near the own one, on the cells of that one."""
        own = replace(self.course.crawl, resolution=resolution).grid
        stretch = scene.sheet.width / self.scene.sheet.width
        grid = replace(own, x_edges=tuple(stretch * x for x in own.x_edges))
        field = self.field
        if scene is not self.scene:
            solver = RitzSolver(scene.sheet, field.first.degree)
            field = SecondOrderField(RitzField(scene.drive.fine, solver), scene.growth)
        return field.motion(times, grid, resolution.order)

    def _change(
        self, one: Parameter, of: Direction, times: Array, resolution: Resolution, here: Motion
    ) -> Motion | None:
        """The derivative of the motion by a parameter, one-sided; None if there is none.

        Towards smaller values of Poisson's ratio, which may be at its bound.
        """
        if not (of.harmonics or of.growth or of.width or of.poisson):
            return None
        value = one.value(self.scene)
        step = STEP * max(abs(value), 1.0) * (-1 if of.poisson else 1)
        near, far = (
            self._motion(one.changed(self.scene, value + k * step), times, resolution) for k in (1, 2)
        )

        def slope(name: str) -> Array:
            start, middle, end = (getattr(motion, name) for motion in (here, near, far))
            return np.asarray((4 * middle - end - 3 * start) / (2 * step))

        return replace(
            here,
            velocity=slope("velocity"),
            second=slope("second"),
            dilation=slope("dilation"),
            growth=slope("growth"),
        )


def _velocity(motion: Motion, a: float) -> Array:
    """v_1 + a v_2."""
    assert motion.second is not None
    return np.asarray(motion.velocity + a * motion.second)

"""The gradients of speed, power and cost of transport to second order, from those of q_0 and q_1.

With V = alpha V_1 + alpha^2 V_2, V_2 that of all sources of second order at the ratio beta/alpha (0 for
a planar sheet), and the power over mu and the weight P = |alpha| (p_0 + alpha p_1),

    dV = alpha dV_1 + alpha^2 dV_2 + (V_1 + 2 alpha V_2) dalpha,

and likewise for P: by alpha at a fixed ratio, which dV_2 counts where it changes.
"""

import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.common.tolerance import Tolerance
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.quantity import ALONG, WORK
from linear_theory.gradient.result import (
    MotionGradient,
    SpeedGradient,
    kinks_of,
)
from linear_theory.gradient.second.means import SecondDerivatives
from linear_theory.gradient.second.shapes import Shapes
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import completed
from linear_theory.speed.expansion import Coefficients
from linear_theory.speed.plate.speed import plate_motion
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.second_order import plane_motion
from linear_theory.speed.wave_error import with_wave_error

Array = NDArray[np.float64]

QUANTITIES = ALONG, WORK


class _Found(NamedTuple):
    """A speed, and the derivatives of V and of the power, with their errors (2, parameters)."""

    speed: CrawlSpeed
    values: Array
    errors: Array
    kinks: tuple[str, ...]
    seconds: float


def second_speed_gradient(
    scene: Scene, chosen: tuple[Parameter, ...], directions: Sequence[Direction], rtol: float
) -> SpeedGradient:
    """See `gradient.speed.speed_gradient`."""
    found = _found(scene, chosen, directions, rtol, 1)
    speed, seconds = found.speed, found.seconds
    values, errors = found.values[0], found.errors[0]
    return SpeedGradient(speed, chosen, values, errors, found.kinks, seconds, speed.seconds)


def second_motion_gradient(
    scene: Scene, chosen: tuple[Parameter, ...], directions: Sequence[Direction], rtol: float
) -> MotionGradient:
    """See `gradient.speed.motion_gradient`; the cost is P/|V|."""
    found = _found(scene, chosen, directions, rtol, 2)
    speed, sign = found.speed, np.sign(found.speed.mean)
    along, power = zip(found.values, found.errors, strict=True)
    told = (found.kinks, found.seconds, speed.seconds)
    return MotionGradient.of(speed, chosen, along, power, (sign * along[0], along[1]), told)


def _found(
    scene: Scene,
    chosen: tuple[Parameter, ...],
    directions: Sequence[Direction],
    rtol: float,
    count: int,
) -> _Found:
    """Of the first quantities."""
    speed, shapes, course = _solved(scene, rtol)
    start, alpha = time.perf_counter(), scene.alpha
    of = SecondDerivatives(scene, shapes, course, chosen, directions, QUANTITIES[:count], rtol)
    derivatives, errors, flat, rough = of.means()
    own, own_errors = (part[:, 1] for part in course.means())
    (work, work_errors), power = course.works(), speed.power
    both = np.stack([own, work]), np.stack([own_errors, work_errors])
    totals = np.array([[speed.mean, speed.error], [power.value, power.error]])
    by_alpha, period = (np.array([getattr(d, n) for d in directions]) for n in ("alpha", "period"))
    powers, slopes = np.array([alpha, alpha**2]), np.array([1.0, 2 * alpha])
    values, found = [], []
    for i, sign in enumerate((1.0, np.sign(alpha))[:count]):
        value = sign * (powers @ derivatives[i] + by_alpha * (slopes @ both[0][i]))
        error = abs(powers) @ errors[i] + abs(by_alpha) * (abs(slopes) @ both[1][i])
        error = error + (2 * abs(by_alpha / alpha) + abs(period)) * totals[i, 1]
        values.append(value - period * totals[i, 0])
        found.append(error)
    rows = np.array(values), np.array(found)
    if speed.sticks:  # V is not smooth in alpha then
        rows = np.full_like(rows[0], np.nan), np.full_like(rows[1], np.inf)
    seconds = time.perf_counter() - start
    return _Found(speed, *rows, kinks_of(speed.sticks, flat, rough), seconds)


def check_second(scene: Scene) -> None:
    """Raise ValueError for a scene whose speed to second order has no gradient."""
    law = scene.contact.friction
    if law.on_lower_face:
        raise ValueError(
            "effects: friction must act on the mid-surface, not on the lower face, of which the speed "
            "is no quadratic form and has no gradient; differences of speeds know it"
        )
    if not (scene.drive.mirrored and law.mirrored) or law.map is not None:
        raise ValueError(
            "order = 2: the sheet must not turn, nor its friction have a map: there is no gradient"
            + (", but of order = 1" if scene.planar else "")
        )


def _solved(scene: Scene, rtol: float) -> tuple[CrawlSpeed, Shapes, Course]:
    """The speed, and the deformation and the motion that it is of; raises ValueError as below."""
    check_second(scene)
    motions: list[tuple[Shapes, Course]] = []

    def solve(tolerance: Tolerance) -> CrawlSpeed:
        if scene.planar:
            speed, course = plane_motion(scene, tolerance)
            assert isinstance(course.crawl, Coefficients)
            motions.append((Shapes(course.crawl.field, scene.contact.load), course))
            return speed
        found = plate_motion(scene, tolerance)
        assert found.course is not None
        motions.append((Shapes.of(scene, found.terms), found.course))
        return found.speed

    speed = completed(with_wave_error(scene, Tolerance(rtol), solve), scene, 2, "ritz")
    return speed, *motions[-1]

"""Gradients of the speed and of the cost of transport in the theory of small strain.

With velocities per unit alpha, V = alpha mean(q), and q balances friction (`adjoint`). Along a
direction in which the wave changes by dc and alpha by da,

    dq(t) = int value dc + rate dc/dt dA + ...   (`sensitivity`),
    dV = alpha mean(dq) + V da/alpha.

The law is one for speeds per unit alpha, f(alpha w): the logarithms of alpha, of the slip speed (with
the opposite sign) and of the period act on it alike, since v is proportional to 1/T and V(T, s) =
F(s T)/T.
"""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Crawl
from linear_theory.balance.period import resolved
from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.progress import Report, watched
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.ritz import ritz_field
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.means import Derivatives, Means
from linear_theory.gradient.parameters.names import parameters
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.quantity import ACROSS, ALONG, WORK, Quantity
from linear_theory.gradient.resting import rests
from linear_theory.gradient.result import CostGradient, SpeedGradient, kinks_of
from linear_theory.gradient.second.speed import (
    second_cost_gradient,
    second_speed_gradient,
)
from linear_theory.scene.level import PLATE, THEORY
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import ORDERS, completed, speed_of
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.wave_error import with_wave_error
from linear_theory.wave.fractional import count_of

Array = NDArray[np.float64]

METHOD = "ritz"
"""The deformation of which there is an adjoint."""

MOST_WAVES = 150
"""On the sheet, of a harmonic that the wave need not have: six seconds of computing."""

FIELD_SHARE = 0.1
"""Fraction of rtol allotted to the deformation."""


@one_blas_thread
def speed_gradient(
    scene: Scene,
    over: Any,
    order: int = 1,
    rtol: float = 1e-4,
    *,
    progress: bool | Report | None = None,
) -> SpeedGradient:
    """Derivatives of the mean speed V with respect to parameters, by one adjoint solve for all.

    scene: planar, as for `crawl_speed`, of any wave, with alpha not 0. over: parameters, objects or
    names of fields as in scene files, entries of lists by their number from 0:
    "growth.alpha" (or "alpha"), "sheet.width" (at fixed length and c(x, y, t)), "sheet.poisson"; of a
    `TravellingWave` "wave.cosine.0" (the amplitude of cos phi), "wave.sine.0", "wave.amplitude.0",
    "wave.phase.0", ..., also of harmonics that the wave does not have yet, of up to 150 waves on the
    sheet, "wave.mean", "wave.period" and "wave.count" (as a real number, see `FractionalWave`); of
    friction "friction.slip_speed", "friction.forward", "friction.backward", "friction.sideways",
    "friction.heading", "friction.map.mu.0"; of a sheet that bends "growth.curvature_coupling",
    "sheet.thickness" (at fixed weight per area), "gravity.weight" and "ground.stiffness". Other waves
    have parameters by `WaveFamily`. order: of the theory, as for `crawl_speed`; 2 for motions that are
    mirror symmetric, of planar sheets and of those that bend on their ground, without friction on the
    lower face (see `gradient.second`): harmonics of a travelling wave cost as one, each other parameter
    that changes the deformation costs two deformations. rtol: of the speed; the errors of the
    derivatives follow from it and are estimated each. progress: True prints on stderr, a function is
    called with a `progress.Progress`.

    Where V has a kink, as where part of the sheet is at rest under dry friction (to the accuracy of the
    deformation), the result is a subgradient, and `kinks` says why. Errors do not count that of a
    measured wave.

    Raises ValueError for parameters that are not known or that the scene does not have, and for scenes
    beyond the theory.

    >>> from linear_theory import Contact, Scene, Sheet, SineWave, Tanh, speed_gradient
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.2, contact=Contact("current", Tanh(0.05)))
    >>> found = speed_gradient(scene, ["alpha", "sheet.width", "wave.cosine.1"], rtol=1e-3)
    >>> for name, value in zip(found.names, found.values, strict=True):
    ...     print(f"{name:13} {value:7.3f}")
    growth.alpha    0.658
    sheet.width    -0.008
    wave.cosine.1   0.135
    """
    _check_order(order)
    with watched(progress, "speed_gradient"):
        return (_first if order == 1 else _second)(scene, over, rtol)


def _check_order(order: int) -> None:
    if validation.integer("order", order) not in ORDERS:
        raise ValueError(f"order = {order}: must be one of {', '.join(map(str, ORDERS))}")


def _first(scene: Scene, over: Any, rtol: float) -> SpeedGradient:
    """Of order 1."""
    found = _Solved.of(scene, over, rtol)
    start = time.perf_counter()
    means = found.means([ALONG])
    values, errors = found.by_motion(means, 0, found.speed.estimate)
    seconds = time.perf_counter() - start
    kinks = found.kinks(means)
    return SpeedGradient(
        found.speed, found.parameters, values, errors, kinks, seconds, found.speed.seconds
    )


@one_blas_thread
def cost_gradient(
    scene: Scene,
    over: Any,
    order: int = 1,
    rtol: float = 1e-4,
    *,
    progress: bool | Report | None = None,
) -> CostGradient:
    """Derivatives of the cost of transport (`CrawlSpeed.cost_of_transport`, over mu), likewise.

    With P the power of friction and D the speed in any direction, d(P/D) = dP/D - P dD/D^2. Arguments
    as for `speed_gradient`. Raises ValueError as it does, and
    where the cost is infinite as no distance is resolved.

    >>> from linear_theory import Contact, Scene, Sheet, SineWave, Tanh, cost_gradient
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.2, contact=Contact("current", Tanh(0.05)))
    >>> print(f"{cost_gradient(scene, 'alpha', rtol=1e-3)['growth.alpha']:.1f}")
    -12.8
    """
    _check_order(order)
    with watched(progress, "cost_gradient"):
        return (_cost if order == 1 else _second_cost)(scene, over, rtol)


def _second_cost(scene: Scene, over: Any, rtol: float) -> CostGradient:
    """Of order 2."""
    return second_cost_gradient(scene, *_asked(scene, over, 2), rtol)


def _cost(scene: Scene, over: Any, rtol: float) -> CostGradient:
    """Of order 1."""
    found = _Solved.of(scene, over, rtol)
    speed, cost = found.speed, found.speed.cost_of_transport
    if not np.isfinite(cost.value) or not np.isfinite(cost.error):
        raise ValueError("scene: must move by a distance that is resolved, else its cost is infinite")
    start = time.perf_counter()
    velocity = speed._velocity
    moving = [ALONG] if found.course.crawl.mirrored else [ALONG, ACROSS]
    means = found.means([*moving, WORK])
    distance, distance_error = 0.0, 0.0
    for i, component in enumerate((1, 0)[: len(moving)]):
        share = velocity[component] / np.hypot(*velocity)
        own = Estimate(float(velocity[component]), speed.error)
        value, error = found.by_motion(means, i, own)
        distance, distance_error = distance + share * value, distance_error + abs(share) * error
    power, power_error = found.by_motion(means, len(moving), speed.power, np.sign(scene.alpha))
    size = float(np.hypot(*velocity))
    values = (power - cost.value * distance) / size
    errors = (power_error + cost.value * distance_error + cost.error * abs(distance)) / size
    errors = errors + speed.error / size * abs(values)
    seconds, kinks = time.perf_counter() - start, found.kinks(means)
    return CostGradient(speed, found.parameters, values, errors, kinks, seconds, speed.seconds)


def _second(scene: Scene, over: Any, rtol: float) -> SpeedGradient:
    """Of order 2."""
    return second_speed_gradient(scene, *_asked(scene, over, 2), rtol)


def _asked(scene: Any, over: Any, order: int = 1) -> tuple[tuple[Parameter, ...], list[Direction]]:
    """Parameters and their directions. Raises ValueError as `speed_gradient` does."""
    scene = validation.instance("scene", scene, Scene)
    (PLATE if order == 2 and not scene.planar else THEORY).require(scene)
    if scene.alpha == 0:
        raise ValueError(
            "alpha = 0: must not be 0, where V = 0 whatever the wave; second_order gives V/alpha"
        )
    chosen = parameters(over)
    directions = [one.direction(scene) for one in chosen]
    _check_waves(scene, chosen, directions)
    return chosen, directions


def _check_waves(scene: Scene, chosen: Sequence[Parameter], directions: Sequence[Direction]) -> None:
    """Raise ValueError for a harmonic that is too short."""
    series = scene.drive.series
    for one, direction in zip(chosen, directions, strict=True):
        if not direction.highest:
            continue
        count = abs(count_of(scene.wave))
        own = count * int(series.harmonics[-1]) if series is not None else 0.0
        if (waves := direction.highest * count) > max(MOST_WAVES, own):
            raise ValueError(
                f"over = {one.name!r}: the harmonic has {waves:.0f} waves on the sheet, must have at "
                f"most {MOST_WAVES}, or as many as the wave of the scene: work grows with their cube"
            )


class _Solved(NamedTuple):
    """A scene whose motion is known, and the directions of its parameters."""

    speed: CrawlSpeed
    course: Course
    parameters: tuple[Parameter, ...]
    directions: Sequence[Direction]
    rtol: float

    @classmethod
    def of(cls, scene: Scene, over: Any, rtol: float) -> "_Solved":
        """Raises ValueError as `speed_gradient` does."""
        chosen, directions = _asked(scene, over)
        tolerance = Tolerance(rtol)
        courses: list[Course] = []

        def solve(tolerance: Tolerance) -> CrawlSpeed:
            start = time.perf_counter()
            own = tolerance.of_speed(scene.alpha, scene.unit)
            least = max(FIELD_SHARE * own.rtol, validation.SMALLEST_RTOL)
            field = ritz_field(scene.sheet, scene.wave, rtol=least)
            found = resolved(Crawl.to(own.rtol, field, scene.alpha, scene.contact), own)
            courses.append(found.course)
            speed = speed_of(found, own)
            return replace(speed, seconds=time.perf_counter() - start)

        speed = completed(with_wave_error(scene, tolerance, solve), scene, 1, METHOD)
        return cls(speed, courses[-1], chosen, directions, tolerance.rtol)

    def means(self, quantities: Sequence[Quantity]) -> Means:
        """Derivatives of the means of quantities."""
        return Derivatives(self.course, self.directions, quantities, self.rtol**0.5).means()

    def kinks(self, means: Means) -> tuple[str, ...]:
        """Why derivatives are subgradients only."""
        dry = self.course.crawl.contact.friction.width == 0
        still = dry and (self.course.motion.fastest == 0 or rests(self.course))
        return kinks_of(self.speed.sticks or still, means.flat)

    def by_motion(
        self, means: Means, which: int, own: Estimate, sign: float = 1.0
    ) -> tuple[Array, Array]:
        """Of a speed that is alpha times a quantity, or |alpha| times that with its sign; own: it."""
        alpha = self.course.crawl.alpha
        explicit = np.array([one.alpha / alpha - one.period for one in self.directions])
        values = sign * alpha * means.values[which] + own.value * explicit
        return values, abs(alpha) * means.errors[which] + own.error * abs(explicit)

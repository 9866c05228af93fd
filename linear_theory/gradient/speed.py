"""Gradients of speed, power and cost of transport in the theory of small strain.

With velocities per unit alpha, V = alpha mean(q), and q balances friction (`adjoint`). Along a
direction in which the wave changes by dc and alpha by da,

    dq(t) = int value dc + rate dc/dt dA + ...   (`sensitivity`),
    dV = alpha mean(dq) + V da/alpha.

The law is one for speeds per unit alpha, f(alpha w): the logarithms of alpha, of the slip speed (with
the opposite sign) and of the period act on it alike, since v is proportional to 1/T and V(T, s) =
F(s T)/T.
"""

import time
from typing import Any

import numpy as np

from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.progress import Report, watched
from linear_theory.common.threads import one_blas_thread
from linear_theory.gradient.means import Means
from linear_theory.gradient.quantity import ACROSS, ALONG, WORK
from linear_theory.gradient.result import (
    Array,
    CostGradient,
    MotionGradient,
    PowerGradient,
    SpeedGradient,
)
from linear_theory.gradient.second.speed import second_motion_gradient, second_speed_gradient
from linear_theory.gradient.solved import Solved, asked
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import ORDERS


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
    found = Solved.of(scene, over, rtol)
    start = time.perf_counter()
    means = found.means([ALONG])
    values, errors = found.by_motion(means, 0, found.speed.estimate)
    seconds = time.perf_counter() - start
    kinks = found.kinks(means)
    return SpeedGradient(
        found.speed, found.parameters, values, errors, kinks, seconds, found.speed.seconds
    )


@one_blas_thread
def power_gradient(
    scene: Scene,
    over: Any,
    order: int = 1,
    rtol: float = 1e-4,
    *,
    progress: bool | Report | None = None,
) -> PowerGradient:
    """Derivatives of the mean power of growth (`CrawlSpeed.power`, over mu and the weight), likewise.

    The power is that which friction takes. Arguments and errors as for `speed_gradient`.
    Raises ValueError as it does.

    >>> from linear_theory import Contact, Scene, Sheet, SineWave, Tanh, power_gradient
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.2, contact=Contact("current", Tanh(0.05)))
    >>> print(f"{power_gradient(scene, 'alpha', rtol=1e-3)['growth.alpha']:.2f}")
    0.81
    """
    return motion_gradient(scene, over, order, rtol, progress=progress).power


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
    found = motion_gradient(scene, over, order, rtol, progress=progress).cost
    if found is None:
        raise ValueError("scene: must move by a distance that is resolved, else its cost is infinite")
    return found


@one_blas_thread
def motion_gradient(
    scene: Scene,
    over: Any,
    order: int = 1,
    rtol: float = 1e-4,
    *,
    progress: bool | Report | None = None,
) -> MotionGradient:
    """Derivatives of speed, power and cost of transport by one adjoint solve; as `speed_gradient`.

    >>> from linear_theory import Contact, Scene, Sheet, SineWave, Tanh
    >>> from linear_theory.gradient import motion_gradient
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.2, contact=Contact("current", Tanh(0.05)))
    >>> found = motion_gradient(scene, "alpha", rtol=1e-3)
    >>> print(*(f"{part['growth.alpha']:.2f}" for part in (found.speed, found.power, found.cost)))
    0.66 0.81 -12.85
    """
    _check_order(order)
    with watched(progress, "motion_gradient"):
        if order == 2:
            return second_motion_gradient(scene, *asked(scene, over, 2), rtol)
        return _motion(Solved.of(scene, over, rtol))


def _motion(found: Solved) -> MotionGradient:
    """Of order 1."""
    start, speed = time.perf_counter(), found.speed
    moving = [ALONG] if found.course.crawl.mirrored else [ALONG, ACROSS]
    means = found.means([*moving, WORK])
    kinks, seconds = found.kinks(means), time.perf_counter() - start
    along = found.by_motion(means, 0, speed.estimate)
    power = found.by_motion(means, len(moving), speed.power, float(np.sign(found.course.crawl.alpha)))
    distance = _by_distance(found, means, len(moving))
    told = (kinks, seconds, speed.seconds)
    return MotionGradient.of(speed, found.parameters, along, power, distance, told)


def _by_distance(found: Solved, means: Means, components: int) -> tuple[Array, Array]:
    """Derivatives of the speed in the direction of the motion, and their errors (parameters,)."""
    velocity = found.speed._velocity
    size = float(np.hypot(*velocity)) or 1.0
    values = errors = np.zeros(len(found.parameters))
    for which, component in enumerate((1, 0)[:components]):
        share = velocity[component] / size
        own = Estimate(float(velocity[component]), found.speed.error)
        value, error = found.by_motion(means, which, own)
        values, errors = values + share * value, errors + abs(share) * error
    return values, errors


def _second(scene: Scene, over: Any, rtol: float) -> SpeedGradient:
    """Of order 2."""
    return second_speed_gradient(scene, *asked(scene, over, 2), rtol)

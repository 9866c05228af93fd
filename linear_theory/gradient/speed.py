"""The gradient of the speed of a sheet."""

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl
from linear_theory.balance.period import Resolved, resolved
from linear_theory.common.shown import Shown, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.ritz import RitzField, ritz_field
from linear_theory.gradient.means import Derivatives
from linear_theory.gradient.parameters.names import parameters
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.quantity import ALONG
from linear_theory.scene.level import THEORY
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import speed_of
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SpeedGradient(Shown):
    speed: CrawlSpeed
    over: tuple[Parameter, ...]
    values: Array
    errors: Array
    kinks: tuple[str, ...]
    seconds: float
    speed_seconds: float


@one_blas_thread
def speed_gradient(scene: Scene, over, order: int = 1, rtol: float = 1e-4) -> SpeedGradient:
    chosen = parameters(over)
    directions = [one.direction(scene) for one in chosen]
    THEORY.require(scene)
    tolerance = Tolerance(rtol).of_speed(scene.alpha, scene.unit)
    start = time.process_time()
    deformation = ritz_field(scene.sheet, scene.wave, rtol=max(0.1 * rtol, 1e-13))
    found = resolved(Crawl.to(tolerance.rtol, deformation, scene.alpha, scene.contact), tolerance)
    speed = speed_of(found, tolerance)
    middle = time.process_time()
    means = Derivatives(found.course, directions, [ALONG], rtol**0.5).means()
    alpha = scene.alpha
    explicit = np.array([d.alpha / alpha - d.period for d in directions])
    values = alpha * means.values[0] + speed.mean * explicit
    errors = abs(alpha) * means.errors[0] + speed.error * abs(explicit)
    return SpeedGradient(speed, chosen, values, errors, (), time.process_time() - middle, middle - start)

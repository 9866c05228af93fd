"""Numbers of an answer that a constraint may bound."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.optimisation.objectives import (
    CostOfTransport,
    Distance,
    Objective,
    Power,
    Speed,
)
from fem_check.optimisation.options.stretch import Stretch
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.problem import Unusable
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]

TIMES = 32
"""Of a period at which heights are looked at."""

BETWEEN = 0.25
"""Of second differences, by which a value between two times may exceed both: an eighth of those of a
parabola, twice as much for what is sampled four times in its own period only."""


@dataclass(frozen=True)
class Measured(Objective):
    """A number of a speed and its scene. of: found from them; raises `Unusable` where there is none."""

    name: str  # type: ignore[misc]
    unit: str  # type: ignore[misc]
    found: Callable[[CrawlSpeed, Scene], Estimate]

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        value = self.found(speed, scene)
        if not np.isfinite(value.value):
            raise Unusable(f"{self.name}: is not known of this motion")
        return value


def _efficiency(speed: CrawlSpeed, scene: Scene) -> Estimate:
    return speed.efficiency


def _turning(speed: CrawlSpeed, scene: Scene) -> Estimate:
    """Anticlockwise; that of a motion with mirror symmetry is 0."""
    return _rigid(speed, 2)


def _sideways(speed: CrawlSpeed, scene: Scene) -> Estimate:
    return _rigid(speed, 0)


def _rigid(speed: CrawlSpeed, component: int) -> Estimate:
    if speed.turning is None:
        return Estimate(0.0, 0.0)
    return Estimate(float(speed.turning.mean[component]), float(speed.turning.error[component]))


def _height(speed: CrawlSpeed, scene: Scene) -> Estimate:
    """The largest of any point above the plane of the ground, at any time."""
    if speed.deformation is None:
        raise Unusable("height: the answer has no shape")
    points, _ = speed.deformation.covering()
    places = speed.deformation.places(points, scene.period * np.arange(TIMES) / TIMES)
    if places.shape[0] < 3:
        raise Unusable("height: the sheet lies flat on the ground")
    return largest_of_period(places[2])


def largest_of_period(values: Array) -> Estimate:
    """Over the times of a period (first axis) and points; the error is what may lie between them.

    >>> import numpy as np
    >>> from fem_check.optimisation.options.quantities import largest_of_period
    >>> value, error = largest_of_period(np.cos(2 * np.pi * (np.arange(32) + 0.5) / 32))
    >>> print(value < 1.0 < value + error)
    True
    """
    ahead, behind = np.roll(values, -1, axis=0), np.roll(values, 1, axis=0)
    between = values + BETWEEN * np.maximum(2 * values - ahead - behind, 0.0)
    largest = float(values.max())
    return Estimate(largest, float(between.max()) - largest + 1e-12 * abs(largest))


QUANTITIES: dict[str, Objective] = {
    "speed": Speed(),
    "distance per period": Distance(),
    "cost of transport": CostOfTransport(),
    "power": Power(),
    "efficiency": Measured("efficiency", "", _efficiency),
    "turning rate": Measured("turning rate", "1/time", _turning),
    "speed sideways": Measured("speed sideways", "length/time", _sideways),
    "stretch": Stretch(),
    "height": Measured("height", "length", _height),
}
"""By their names."""

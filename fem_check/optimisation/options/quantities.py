"""Numbers of an answer that a constraint may bound."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from fem_check.optimisation.objectives import (
    CostOfTransport,
    Distance,
    Objective,
    OfScene,
    Power,
    Speed,
)
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.problem import Unusable
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed

TIMES = 32
"""Of a period at which heights are looked at, and half of them for the error."""

ALONG = 65
"""Points along the sheet at which growth is."""


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


@dataclass(frozen=True)
class Stretch(OfScene):
    """The largest that growth asks for, at any point and time: 1.1 is a tenth longer."""

    name: ClassVar[str] = "stretch"
    unit: ClassVar[str] = ""

    def of_scene(self, scene: Scene) -> Estimate:
        """See OfScene."""
        growths = scene.alpha * scene.drive.growths(*_points(scene))
        stretch = np.asarray(scene.growth.law.stretch(np.asarray(growths)))
        return _largest(stretch, 1.0)


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


def _points(scene: Scene) -> tuple[Any, Any]:
    """Along the middle and the edges of the sheet, (n,)."""
    half, width = scene.sheet.length / 2, scene.sheet.width / 2
    x, y = np.meshgrid([-width, 0.0, width], np.linspace(-half, half, ALONG))
    return x.ravel(), y.ravel()


def _height(speed: CrawlSpeed, scene: Scene) -> Estimate:
    """The largest of any point above the plane of the ground, at any time."""
    if speed.deformation is None:
        raise Unusable("height: the answer has no shape")
    points, _ = speed.deformation.covering()
    places = speed.deformation.places(points, scene.period * np.arange(TIMES) / TIMES)
    if places.shape[0] < 3:
        raise Unusable("height: the sheet lies flat on the ground")
    return _largest(places[2], 0.0)


def _largest(values: Any, rest: float) -> Estimate:
    """Over times (first axis) and points; the error is what half of the times miss, and rounding."""
    largest = float(values.max())
    error = largest - float(values[::2].max()) + 1e-12 * abs(largest - rest)
    return Estimate(largest, error)


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

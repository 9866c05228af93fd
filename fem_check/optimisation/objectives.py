"""What is to be made large, or small, of the speed of a scene."""

import math
from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Value
from linear_theory.optimisation.problem import Unusable
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed


class Objective(Value):
    """A number of a speed, of which larger is better for sign = 1, smaller for sign = -1.

    name: for people; unit: likewise, empty for plain numbers.
    """

    name: ClassVar[str]
    unit: ClassVar[str]
    sign: ClassVar[float] = 1.0

    @abstractmethod
    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """Raises `Unusable` where there is none."""

    def slope(self, scene: Scene) -> float | None:
        """Its derivative by the mean speed at a given scene; None if it is not proportional to that."""
        return None


@dataclass(frozen=True)
class Speed(Objective):
    """The mean speed. towards: 1 for +y, the way of the wave, -1 for -y."""

    towards: int = 1
    name: ClassVar[str] = "speed"
    unit: ClassVar[str] = "length/time"

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        return Estimate(self.towards * speed.mean, speed.error)

    def slope(self, scene: Scene) -> float:
        """See Objective."""
        return float(self.towards)


@dataclass(frozen=True)
class Distance(Objective):
    """The distance in one period, towards +y."""

    name: ClassVar[str] = "distance per period"
    unit: ClassVar[str] = "length"

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        return Estimate(scene.period * speed.mean, scene.period * speed.error)


@dataclass(frozen=True)
class CostOfTransport(Objective):
    """Work of growth over weight times distance, over the coefficient of friction; to be small."""

    name: ClassVar[str] = "cost of transport"
    unit: ClassVar[str] = "mu"
    sign: ClassVar[float] = -1.0

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        cost = speed.cost_of_transport
        if not math.isfinite(cost.value):
            raise Unusable("cost of transport: the sheet gets nowhere, or its power is not known")
        return cost


@dataclass(frozen=True)
class Given(Objective):
    """A function of the speed, a `CrawlSpeed`; to be large.

    It returns a number, taken as exact but for the relative error of the speed, or an `Estimate`.
    Raises ValueError where it returns no finite number.
    """

    function: Callable[[CrawlSpeed], Any]
    name: ClassVar[str] = "objective"
    unit: ClassVar[str] = ""

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        found = self.function(speed)
        value, error = found if isinstance(found, Estimate) else (found, math.nan)
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise ValueError(
                f"objective: returned {validation.shown(found)}: must be a finite number or an Estimate"
            )
        if isinstance(found, Estimate) and error < 0:
            raise ValueError(f"objective: returned {validation.shown(found)}: error must be >= 0")
        if math.isnan(error):
            error = abs(value) * speed.error / max(abs(speed.mean), speed.error, 1e-300)
        return Estimate(float(value), float(error))


OBJECTIVES: dict[str, Objective] = {
    "speed": Speed(),
    "speed towards -y": Speed(-1),
    "distance per period": Distance(),
    "cost of transport": CostOfTransport(),
}
"""By their names."""


def objective_of(given: object) -> Objective:
    """An objective, by its name, or of a function. Raises ValueError for anything else."""
    if isinstance(given, Objective):
        return given
    if callable(given):
        return Given(given)
    return OBJECTIVES[validation.choice("objective", given, OBJECTIVES)]

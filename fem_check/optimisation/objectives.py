"""What is to be made large, or small, of the speed of a scene."""

import math
from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, NamedTuple

from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Value
from linear_theory.optimisation.problem import Unusable
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed


class Slopes(NamedTuple):
    """Derivatives of a number of a motion by its mean speed, its power, and the period alone."""

    speed: float
    power: float = 0.0
    period: float = 0.0


class Objective(Value):
    """A number of a speed, of which larger is better for sign = 1, smaller for sign = -1.

    name: for people; unit: likewise, empty for plain numbers. differentiable: whether it is a function
    of speed, power and period, whose derivatives are `slopes`; with_power: whether the power enters;
    smooth_if_dry: whether dry friction, too, leaves it without kinks.
    """

    name: ClassVar[str]
    unit: ClassVar[str]
    sign: ClassVar[float] = 1.0
    differentiable: ClassVar[bool] = False
    with_power: ClassVar[bool] = False
    smooth_if_dry: ClassVar[bool] = False

    @abstractmethod
    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """Raises `Unusable` where there is none."""

    def slopes(self, speed: CrawlSpeed, scene: Scene) -> Slopes:
        """Of a differentiable one, of a motion along the sheet; raises `Unusable` where `of` does."""
        raise TypeError(f"{self.name}: has no derivatives by the speed")


class OfScene(Objective):
    """A number of the scene alone, which no answer is needed for."""

    @abstractmethod
    def of_scene(self, scene: Scene) -> Estimate:
        """Raises `Unusable` where there is none."""

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        return self.of_scene(scene)


@dataclass(frozen=True)
class Speed(Objective):
    """The mean speed. towards: 1 for +y, the way of the wave, -1 for -y."""

    towards: int = 1
    name: ClassVar[str] = "speed"
    unit: ClassVar[str] = "length/time"
    differentiable: ClassVar[bool] = True

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        return Estimate(self.towards * speed.mean, speed.error)

    def slopes(self, speed: CrawlSpeed, scene: Scene) -> Slopes:
        """See Objective."""
        return Slopes(float(self.towards))


@dataclass(frozen=True)
class Distance(Objective):
    """The distance in one period, towards +y."""

    name: ClassVar[str] = "distance per period"
    unit: ClassVar[str] = "length"
    differentiable: ClassVar[bool] = True

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        return Estimate(scene.period * speed.mean, scene.period * speed.error)

    def slopes(self, speed: CrawlSpeed, scene: Scene) -> Slopes:
        """See Objective."""
        return Slopes(scene.period, period=speed.mean)


@dataclass(frozen=True)
class Power(Objective):
    """The mean power of growth, over mu times the weight."""

    name: ClassVar[str] = "power"
    unit: ClassVar[str] = "length/time"
    differentiable: ClassVar[bool] = True
    with_power: ClassVar[bool] = True
    smooth_if_dry: ClassVar[bool] = True

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        power = speed.power
        if not math.isfinite(power.value):
            raise Unusable("power: is not known of this motion")
        return power

    def slopes(self, speed: CrawlSpeed, scene: Scene) -> Slopes:
        """See Objective."""
        return Slopes(0.0, power=1.0)


@dataclass(frozen=True)
class CostOfTransport(Objective):
    """Work of growth over weight times distance, over the coefficient of friction; to be small."""

    name: ClassVar[str] = "cost of transport"
    unit: ClassVar[str] = "mu"
    sign: ClassVar[float] = -1.0
    differentiable: ClassVar[bool] = True
    with_power: ClassVar[bool] = True

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        cost = speed.cost_of_transport
        if not math.isfinite(cost.value):
            raise Unusable("cost of transport: the sheet gets nowhere, or its power is not known")
        return cost

    def slopes(self, speed: CrawlSpeed, scene: Scene) -> Slopes:
        """See Objective: of P/|V|."""
        cost = self.of(speed, scene).value
        return Slopes(-cost / speed.mean, power=1 / abs(speed.mean))


@dataclass(frozen=True)
class Given(Objective):
    """A function of the speed, a `CrawlSpeed`; to be large.

    It returns a number, whose error is by how much it changes where the speed and its power change by
    theirs, or an `Estimate`. Raises ValueError where it returns no finite number.
    """

    function: Callable[[CrawlSpeed], Any]
    name: ClassVar[str] = "objective"
    unit: ClassVar[str] = ""

    def of(self, speed: CrawlSpeed, scene: Scene) -> Estimate:
        """See Objective."""
        found = self.function(speed)
        if not isinstance(found, Estimate):
            value = self._number(found, found)
            return Estimate(value, sum(self._change(value, pair) for pair in moved(speed)))
        value, error = (self._number(part, found) for part in found)
        if error < 0:
            raise ValueError(f"objective: returned {validation.shown(found)}: error must be >= 0")
        return Estimate(value, error)

    def _change(self, value: float, pair: Sequence[CrawlSpeed]) -> float:
        """The most by which one of two speeds changes it."""
        found = [self.function(one) for one in pair]
        return max(abs(self._number(one, one) - value) for one in found)

    def _number(self, value: Any, found: Any) -> float:
        """Those of numpy, too."""
        try:
            return validation.real("objective", value)
        except ValueError:
            raise ValueError(
                f"objective: returned {validation.shown(found)}: must be a finite number or an Estimate"
            ) from None


def moved(speed: CrawlSpeed) -> list[tuple[CrawlSpeed, CrawlSpeed]]:
    """A speed with more and with less by each of its errors: of the mean, the turning, the power.

    Raises `Unusable` for errors that are not known.
    """
    turning, energy = speed.turning, speed.energy
    errors = [speed.error] if turning is None else [speed.error, *turning.error]
    if not all(map(math.isfinite, errors)):
        raise Unusable("the error of the speed is not known")
    found = [_pair(lambda sign: _with_mean(speed, sign * speed.error))] if speed.error else []
    if turning is not None and turning.error.any():
        found.append(
            _pair(
                lambda sign: replace(
                    speed, turning=replace(turning, mean=turning.mean + sign * turning.error)
                )
            )
        )
    if energy is not None and energy.power.error and math.isfinite(energy.power.error):
        value, error = energy.power
        found.append(
            _pair(
                lambda sign: replace(
                    speed, energy=replace(energy, power=Estimate(value + sign * error, error))
                )
            )
        )
    return found


def _pair(made: Callable[[float], CrawlSpeed]) -> tuple[CrawlSpeed, CrawlSpeed]:
    return made(1.0), made(-1.0)


def _with_mean(speed: CrawlSpeed, change: float) -> CrawlSpeed:
    """Moved faster by that, at all times."""
    mean = Estimate(speed.mean + change, speed.error)
    return replace(speed, estimate=mean, velocity=speed.velocity + change)


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

"""The gradient of a speed, of a power or of a cost."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown, with_error
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]

FEW = 7
"""Most parameters that are shown one by one."""

AT_REST = (
    "part of the sheet is at rest at some time, where dry friction balances a range of forces: V may "
    "have a kink, and this is one of its subgradients"
)
FLAT = (
    "at some time friction does not resist a motion of the sheet: V may have a kink, and this is one "
    "of its subgradients"
)
ROUGH = (
    "under dry friction a derivative depends on the step over which it is taken: V may have a kink, "
    "and this is one of its subgradients"
)


@dataclass(frozen=True)
class Gradient(Shown):
    """Derivatives of a quantity of a scene with respect to parameters.

    speed: the speed of the scene; parameters: with respect to which; values, errors (parameters,): the
    derivatives and their estimated numerical errors, absolute, in units of the quantity per parameter.
    kinks: why they are subgradients only, in words; empty where the quantity is smooth.
    seconds, speed_seconds: time for the derivatives and for the speed.
    """

    speed: CrawlSpeed
    parameters: tuple[Parameter, ...]
    values: Array
    errors: Array
    kinks: tuple[str, ...]
    seconds: float
    speed_seconds: float

    @property
    def names(self) -> tuple[str, ...]:
        """Of the parameters."""
        return tuple(one.name for one in self.parameters)

    def __getitem__(self, name: str) -> float:
        """The derivative by the parameter of that name. Raises KeyError for another one."""
        return float(dict(zip(self.names, self.values, strict=True))[name])

    def _title(self) -> str:
        smooth = "subgradient" if self.kinks else "gradient"
        return f"{type(self).__name__}: {smooth}, {len(self.names)} parameters"

    def _rows(self) -> Mapping[str, Any]:
        each = zip(self.names, self.values, self.errors, strict=True)
        rows: dict[str, Any] = {name: with_error(value, error) for name, value, error in each}
        if len(rows) > FEW:
            names = ", ".join(self.names)
            rows = {"parameters": names, "values": self.values, "errors": self.errors}
        words = {f"kinks[{i}]": kink for i, kink in enumerate(self.kinks)}
        seconds = {"seconds": self.seconds, "speed_seconds": self.speed_seconds}
        return {**words, **seconds, **rows}

    def _contents(self) -> Mapping[str, Any]:
        found = {"speed": self.speed, "names": self.names, "values": self.values, "errors": self.errors}
        seconds = {"seconds": self.seconds, "speed_seconds": self.speed_seconds}
        return {**found, "kinks": self.kinks, **seconds}


@dataclass(frozen=True, repr=False)
class SpeedGradient(Gradient):
    """That of the mean speed, length per time and unit of each parameter; see `speed_gradient`.

    >>> from linear_theory import Scene, Sheet, SineWave, speed_gradient
    >>> found = speed_gradient(Scene(Sheet(), SineWave(), alpha=0.2), ["alpha"], rtol=1e-3)
    >>> print(found.names, found.errors < 1e-2, found.kinks)
    ('growth.alpha',) [ True] ()
    """


@dataclass(frozen=True, repr=False)
class PowerGradient(Gradient):
    """That of the power of growth, over mu and the weight, a speed; see `power_gradient`.

    >>> from linear_theory import Scene, Sheet, SineWave, power_gradient
    >>> found = power_gradient(Scene(Sheet(), SineWave(), alpha=0.2), ["alpha"], rtol=1e-3)
    >>> print(found["growth.alpha"] > 0)  # as larger growth slides farther
    True
    """


@dataclass(frozen=True, repr=False)
class CostGradient(Gradient):
    """That of the cost of transport, over mu; see `cost_gradient`.

    >>> from linear_theory import Scene, Sheet, SineWave, cost_gradient
    >>> found = cost_gradient(Scene(Sheet(), SineWave(), alpha=0.2), ["alpha"], rtol=1e-3)
    >>> print(found["growth.alpha"] < 0)  # as larger growth crawls more cheaply
    True
    """


Told = tuple[tuple[str, ...], float, float]
"""Kinks, seconds and speed_seconds of a gradient."""


class MotionGradient(NamedTuple):
    """The gradients of the three numbers of one motion; cost: None where that is infinite."""

    speed: SpeedGradient
    power: PowerGradient
    cost: CostGradient | None

    @classmethod
    def of(
        cls,
        speed: CrawlSpeed,
        chosen: tuple[Parameter, ...],
        along: tuple[Array, Array],
        power: tuple[Array, Array],
        distance: tuple[Array, Array],
        told: Told,
    ) -> "MotionGradient":
        """From derivatives and their errors, of V, of the power, of the speed in any direction."""
        kinks, *seconds = told
        cost, size = speed.cost_of_transport, float(np.hypot(*speed._velocity))
        by_cost = None
        if np.isfinite(cost.value) and np.isfinite(cost.error):
            values = (power[0] - cost.value * distance[0]) / size
            errors = (power[1] + cost.value * distance[1] + cost.error * abs(distance[0])) / size
            errors = errors + speed.error / size * abs(values)
            by_cost = CostGradient(speed, chosen, values, errors, kinks, *seconds)
        return cls(
            SpeedGradient(speed, chosen, *along, kinks, *seconds),
            PowerGradient(speed, chosen, *power, kinks, *seconds),
            by_cost,
        )


def kinks_of(sticks: bool, flat: bool, rough: bool = False) -> tuple[str, ...]:
    """Why derivatives are subgradients only: parts at rest, motions that friction does not resist, V
    that is not smooth."""
    both = ((AT_REST, sticks), (FLAT, flat), (ROUGH, rough))
    return tuple(words for words, there in both if there)

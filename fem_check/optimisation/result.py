"""What an optimisation found: the best scene, what it is worth, and why it is held to be the best."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fem_check.answer.units import Units
from fem_check.choice.result import Prediction
from fem_check.optimisation.objectives import Given, Objective
from fem_check.optimisation.words import shown
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown, number
from linear_theory.optimisation.certificate import GAIN, Certificate
from linear_theory.scene.scene import Scene


@dataclass(frozen=True)
class Start(Shown):
    """From where to where one climb led. first, value: of the objective at its ends, NaN where it has
    none; words: how it ended; answers: how many were asked for; seconds."""

    first: float
    value: float
    words: str
    answers: int
    seconds: float


@dataclass(frozen=True)
class Check(Shown):
    """The objective by a higher level, of the best scene and of the given one (None where it has none).

    failed: why the level has no answer for the best scene, in words; empty if it has.
    """

    level: str
    best: Estimate | None
    start: Estimate | None
    failed: str = ""


@dataclass(frozen=True)
class Limited(Shown):
    """A number of the answer that must keep to a bound: its value, and what of the objective moving the
    bound by 1 brings, 0 where it does not hold. unit: of the number, as that of an `Objective`. beyond:
    by how much it misses the bound, over the size of that; 0 if it keeps to it."""

    name: str
    value: Estimate
    bound: float
    brings: float
    unit: str
    beyond: float = 0.0


@dataclass(frozen=True)
class Regime(Shown):
    """The objective in one of several regimes, with the best scene there."""

    name: str
    value: Estimate
    scene: Scene = field(repr=False)

    def _contents(self) -> Mapping[str, Any]:
        return {"name": self.name, "value": self.value}


@dataclass(frozen=True)
class Scale(Shown):
    """What a gain is compared with. size: >= 0, in units of the objective; words: what it is, where it
    is not the value itself."""

    size: float
    words: str = ""

    @classmethod
    def of(cls, objective: Objective, value: Estimate, first: Sequence[float]) -> "Scale":
        """That of a value; first: of the starts, NaN where there is none.

        The value itself, unless it is 0 within its error, or of a function, whose 0 may lie anywhere:
        then how far the starts lie from it, half of them farther, where that is more.
        """
        away = [abs(one - value.value) for one in first if not math.isnan(one)]
        spread, size = float(np.median(away)) if away else 0.0, abs(value.value)
        if (isinstance(objective, Given) or size <= value.error) and spread > size:
            return cls(spread, "the distance of the starts from the best")
        return cls(size)

    def share(self, part: float) -> float:
        """A part >= 0 of it; of nothing, nothing is 0 and all else infinite."""
        if self.size:
            return part / self.size
        return 0.0 if part == 0 else math.inf if part > 0 else math.nan


@dataclass(frozen=True, eq=False)
class Optimum(Shown):
    """The best scene of an optimisation.

    scene: the best one; values: its fields and amplitudes by name, in the units of their bounds;
    objective; answer: its `Prediction` by the level of the search; value: of the objective, with the
    numerical error; start: of the scene as it was given, None if it has none; certificate: of the last
    objective that was climbed (see `linear_theory.optimisation.certificate`), and `rounding`, by how
    much that differs from the value where dry friction was smoothed, 0 elsewhere; sensitivities: the
    derivative of the objective by each value; starts: how each climb ended; check: by the next higher
    level, None if there is none or none was asked for; answers: that were computed, without those that
    a file had kept; seconds. units: of the numbers, None for plain ones; field_units: of the fields.
    scale: of the objective, which shares are of; without_effect: fields between whose bounds it does
    not change within its errors; outside: where the scene as given lies outside of the bounds, in
    words: the first climb then began at the nearest scene inside. slopes: of the values by the unknowns
    of the search. limits: numbers that must keep to bounds; regimes: of a robust optimum, by: "worst"
    or "mean" of them; its answer is that of the worst.
    """

    scene: Scene
    values: Mapping[str, Any]
    objective: Objective
    answer: Prediction
    value: Estimate
    start: Estimate | None
    certificate: Certificate
    rounding: float
    sensitivities: Mapping[str, float]
    starts: tuple[Start, ...]
    check: Check | None
    answers: int
    seconds: float
    units: Units | None = None
    field_units: Mapping[str, str] = field(default_factory=dict)
    scale: "Scale" = field(default_factory=lambda: Scale(1.0))
    without_effect: tuple[str, ...] = ()
    outside: tuple[str, ...] = ()
    slopes: tuple[float, ...] = ()
    limits: tuple[Limited, ...] = ()
    regimes: tuple[Regime, ...] = ()
    by: str = ""

    @property
    def unit(self) -> str:
        """Of the objective, in the units of the scene file if it has some."""
        return self.in_units(self.objective.unit)

    def in_units(self, unit: str) -> str:
        """A unit of the library in those of the scene file."""
        if self.units is None:
            return unit
        named = {"length/time": self.units.speed, "length": self.units.length}
        return {**named, "1/time": f"1/{self.units.time}"}.get(unit, unit)

    @property
    def level(self) -> str:
        """Of the search."""
        return self.answer.level

    @property
    def left(self) -> float:
        """Share of the scale that may be left in the neighbourhood; NaN if not known."""
        return self.scale.share(self.certificate.gain + self.rounding)

    @property
    def at_bounds(self) -> Mapping[str, float]:
        """What moving the bound of each value brings, by its unit, all constraints kept; 0 where none
        holds it."""
        sign, found = self.objective.sign, self.certificate.multipliers
        slopes = zip(self.values, found, self.slopes, strict=True)
        return {name: float(sign * push / slope) for name, push, slope in slopes}

    @property
    def converged(self) -> bool:
        """Whether the certificate holds: at most GAIN is left, there is a gradient, and all limits are
        kept to."""
        kept = not any(one.beyond for one in self.limits)
        return kept and not self.certificate.kink and self.left <= GAIN

    @property
    def agreed(self) -> int:
        """How many starts ended within GAIN of the best one."""
        best = max(one.value * self.objective.sign for one in self.starts if not math.isnan(one.value))
        near = GAIN * self.scale.size
        return sum(one.value * self.objective.sign >= best - near for one in self.starts)

    def __str__(self) -> str:
        from fem_check.optimisation.text import text

        return text(self)

    def _title(self) -> str:
        met = "converged" if self.converged else "NOT converged"
        return f"Optimum: {self.objective.name} {shown(self.value)} {self.unit}, {met}"

    def _rows(self) -> Mapping[str, Any]:
        return {
            "level": self.level,
            "values": ", ".join(f"{name} {number(value)}" for name, value in self.values.items()),
            "start": "unknown" if self.start is None else self.start.value,
            "left": self.left,
            "starts": f"{self.agreed} of {len(self.starts)} ended here",
            "seconds": self.seconds,
        }

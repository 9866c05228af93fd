"""An answer: a speed, the level that gave it, why that one, and what it leaves out."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from fem_check.answer.block import block
from fem_check.answer.energy import measure
from fem_check.answer.record import row
from fem_check.choice.levels import ASIDE, TARGET
from linear_theory.common.drawable import Drawable
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown, number
from linear_theory.common.tolerance import Tolerance
from linear_theory.energy.growth import GrowthPower
from linear_theory.friction.regime import Regime
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed, speed_in_words

BY_FRICTION = "deformation by friction, taken as too weak"
TO_A_SHEET = "distance to a sheet"


@dataclass(frozen=True)
class Prediction(Drawable, Shown):
    """A speed and the level that gave it.

    speed: `speed.error` is the numerical error and `speed.model_error` the distance to the target, NaN
    where unknown (never for level = "auto"). level: a key of `levels.LEVELS`; reason: why this level
    was chosen and no cheaper one, in words. converged: whether `error`, numerical plus model error,
    meets the tolerance (or none was asked for, tolerance = None) and there is no caution: what else is
    wrong with the speed, in words. not_in_error: parts that were not estimated, in words, of a level
    that is not compared with the target. seconds: total time, with the levels that were tried in vain.
    left_out: effects that the target itself neglects, in words: it is a flat sheet without thickness on
    which friction alone acts. scene, tolerance: the question. passed: the levels that were not chosen,
    and why. `str` prints the answer in a dozen lines (see `answer.block`), in units of the length L of
    the sheet and the period T of the wave.

    >>> from fem_check import predict
    >>> from linear_theory import Sheet, SineWave
    >>> found = predict(Sheet(), SineWave(), alpha=0.25, rtol=0.2)
    >>> print(f"V = {found.mean:.2f} +- {found.error:.2f} L/T: {found.reason}")
    V = 0.10 +- 0.01 L/T: strip meets the tolerance
    >>> print(str(found).splitlines()[2])
      speed     0.101 ± 0.015 L/T, along the wave; 10.1 % of L per period
    """

    speed: CrawlSpeed
    level: str
    reason: str
    converged: bool
    seconds: float
    left_out: tuple[str, ...]
    scene: Scene
    tolerance: Tolerance | None
    passed: tuple["Passed", ...] = ()
    not_in_error: tuple[str, ...] = ()
    caution: str = ""

    @property
    def mean(self) -> float:
        """Mean speed, length per time, positive towards +y."""
        return self.speed.mean

    @property
    def error(self) -> float:
        """Numerical plus model error, absolute; NaN where the latter is unknown.

        Of a level that is not compared with the target (see not_in_error) the numerical error.
        """
        alone = self.not_in_error and math.isnan(self.speed.model_error)
        return self.speed.error if alone else total_error(self.speed)

    @property
    def model_error(self) -> float:
        """Distance of the level to the target, absolute."""
        return self.speed.model_error

    @property
    def regime(self) -> Regime:
        """See `CrawlSpeed.regime`."""
        return self.speed.regime

    @property
    def power(self) -> Estimate:
        """See `CrawlSpeed.power`; this and what is made of it with the model errors, as printed.

        Their errors are NaN where that of the speed is: where a model error is not known.

        >>> from fem_check import predict
        >>> from linear_theory import Sheet, SineWave
        >>> found = predict(Sheet(), SineWave(), alpha=0.25, rtol=1e-2)
        >>> print(f"{found.cost_of_transport.value:.2f} mu, efficiency {found.efficiency.value:.2f}")
        2.64 mu, efficiency 0.38
        """
        return measure(self, "power")

    @property
    def cost_of_transport(self) -> Estimate:
        """See `CrawlSpeed.cost_of_transport`."""
        return measure(self, "cost_of_transport")

    @property
    def efficiency(self) -> Estimate:
        """See `CrawlSpeed.efficiency`."""
        return measure(self, "efficiency")

    def growth_power(self, friction_strain: float) -> GrowthPower:
        """See `CrawlSpeed.growth_power`. Raises ValueError as that does."""
        return self.speed.growth_power(friction_strain)

    def to_row(self) -> dict[str, Any]:
        """A row of a table of many answers: numbers and texts by name, those of the scene with dots.

        What is unknown is None; the columns of the answer are named as in the records of sweeps.

        >>> from fem_check import predict
        >>> from linear_theory import Sheet, SineWave
        >>> row = predict(Sheet(), SineWave(), alpha=0.25, rtol=0.2).to_row()
        >>> print(f"{row['mean']:.2f} +- {row['error']:.2f}", row["level"], row["scene.sheet.width"])
        0.10 +- 0.01 strip 0.5
        """
        return row(self)

    def __str__(self) -> str:
        return block(self)

    def _title(self) -> str:
        return f"Prediction: {speed_in_words(self.mean, self.error, self.converged)}"

    def _rows(self) -> Mapping[str, Any]:
        numerical, wave = self.speed.error - self.speed.wave_error, self.speed.wave_error
        errors = f"{numerical:.2g} numerical, {number(self.speed.model_error)} model"
        if wave:
            errors += f", {wave:.2g} wave"
        answer = {"level": self.level, "reason": self.reason, "error": errors}
        left_out = {"left_out": "; ".join(self.left_out)} if self.left_out else {}
        friction = {"regime": self.speed.regime, "model": self.speed.model}
        return {**answer, **friction, **left_out, "seconds": self.seconds}

    def _contents(self) -> Mapping[str, Any]:
        return {"mean": self.mean, "error": self.error, **super()._contents()}


class _Passed(NamedTuple):
    level: str
    why: str
    seconds: float


class Passed(Shown, _Passed):
    """A level that was not chosen, why (in words), and the time spent on it in seconds."""


def not_estimated(level: str, speed: CrawlSpeed) -> tuple[str, ...]:
    """Parts of the model error of a level that it does not estimate, in words.

    A cycle of shapes is exact but for the deformation by friction, where a scene has its coefficient; a
    one-dimensional body is what was asked for, and no sheet.
    """
    parts = {TARGET: (BY_FRICTION,), **dict.fromkeys(ASIDE, (TO_A_SHEET,))}
    return parts.get(level, ()) if math.isnan(speed.model_error) else ()


def total_error(speed: CrawlSpeed) -> float:
    """Numerical plus model error, absolute; NaN where the model error is unknown."""
    return speed.error + speed.model_error

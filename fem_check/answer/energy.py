"""Energy of an answer in words: cost of transport and efficiency."""

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from fem_check.answer.rounding import measured, plain
from linear_theory.common.estimate import Estimate
from linear_theory.speed.result import ENERGIES, CrawlSpeed

if TYPE_CHECKING:
    from fem_check.choice.result import Prediction

ROUGH = 0.5
"""Relative error from which on a cost is only called rough."""


def energy(found: "Prediction") -> str:
    """Cost of transport and efficiency with numerical and known model errors; empty if unknown."""
    speed = with_model_errors(found.speed)
    cost, efficiency = speed.cost_of_transport, speed.efficiency
    if speed.energy is not None and math.isinf(speed.error):
        return "cost of transport and efficiency unknown: the error of the speed is not known"
    if speed.energy is None or math.isnan(cost.value):
        return ""
    if math.isinf(cost.value):
        return "cost of transport infinite: growth does work, and no distance is resolved"
    if cost.error > ROUGH * cost.value:
        return f"cost of transport about {plain(cost.value, 1)} mu, which this level knows but roughly"
    if math.isnan(found.speed.model_error) and not found.not_in_error:
        return (
            f"cost of transport about {plain(cost.value, 1)} mu by this level, whose distance to the "
            "nonlinear sheet is not known"
        )
    shown = f"cost of transport {measured(*cost).with_unit('mu')}{_known(found, cost)}"
    lacking = speed.energy.undragged
    percent = measured(100 * efficiency.value, 100 * efficiency.error).with_unit("%")
    share = f"unknown, for {lacking}" if lacking else percent
    return f"{shown}: work of growth per weight and distance; efficiency {share}"


def with_model_errors(speed: CrawlSpeed) -> CrawlSpeed:
    """The speed with the known model errors in those of V and of the power."""
    if speed.energy is None:
        return speed
    more, own = (0.0 if math.isnan(e) else e for e in (speed.model_error, speed.energy.model_error))
    estimate = Estimate(speed.mean, speed.error + more)
    return replace(speed, estimate=estimate, energy=speed.energy.in_doubt(own))


def measure(found: "Prediction", name: str) -> Estimate:
    """One of ENERGIES, its error with the distance of the level to the nonlinear sheet.

    The error is NaN where that distance is not known, as that of the speed is, and of what is not
    finite. Of a level that is not compared with the sheet (see `Prediction.not_in_error`) it is
    numerical.
    """
    known: Estimate = getattr(with_model_errors(found.speed), name)
    own = found.speed.energy
    distances = [] if own is None else [own.model_error]
    if name != "power":
        distances.append(found.speed.model_error)
    unknown = not found.not_in_error and any(map(math.isnan, distances))
    return Estimate(known.value, math.nan) if unknown or not math.isfinite(known.value) else known


def energies(found: "Prediction") -> dict[str, float]:
    """Power, cost of transport and efficiency with their errors by name; none if not known."""
    numbers: dict[str, float] = {}
    for name in ENERGIES if found.speed.energy is not None else ():
        numbers[name], numbers[f"{name}_error"] = measure(found, name)
    return numbers


def _known(found: "Prediction", cost: Estimate) -> str:
    """The cost at the coefficient of a scene that names one."""
    mu = next((effect.mu for effect in found.scene.effects if effect.mu), None)
    return "" if mu is None else f" = {plain(mu * cost.value)} at mu = {plain(mu)}"

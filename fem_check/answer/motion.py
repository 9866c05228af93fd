"""The direction of motion of a sheet in words, with sideways motion and turning."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from fem_check.answer.rounding import measured
from fem_check.answer.units import Units
from fem_check.answer.wave_words import direction
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.protocol import Drive

if TYPE_CHECKING:
    from fem_check.choice.result import Prediction


def heading(drive: Drive, mean: float, error: float) -> str:
    """Along or against the wave; for a wave without a direction of its own, towards +y or -y."""
    if mean == 0 and error == 0:
        return "at rest"
    if not abs(mean) > error:
        return "direction unknown"
    way = direction(drive)
    if way == 0:
        return "towards +y" if mean > 0 else "towards −y"
    return "along the wave" if way * mean > 0 else "against the wave"


def per_period(found: "Prediction", units: Units, error: float) -> str:
    """Distance travelled per period, in the unit of length or in per cent of the sheet's length L."""
    scene = found.scene
    way, wrong = (size * scene.period for size in (found.mean, error))
    if units == Units.of_sheet(scene.sheet.length, scene.period):
        share = (100 / scene.sheet.length * size for size in (abs(way), wrong))
        return f"{measured(*share).value} % of L per period"
    shown = measured(units.of_length(abs(way)), units.of_length(wrong))
    return f"{shown.value} {units.length} per period"


def sideways_and_turning(speed: CrawlSpeed, period: float, units: Units) -> Iterator[tuple[str, str]]:
    """Extra lines for a motion without mirror symmetry, with numerical errors; else none."""
    if speed.turning is None:
        return
    (across, _, rate), (across_error, _, rate_error) = speed.turning.mean, speed.turning.error
    shown = measured(units.of_speed(across), units.of_speed(across_error))
    side = _side(across, across_error, "towards +x", "towards −x")
    yield "sideways", f"{shown.with_unit(units.speed)}{side} (numerical error)"
    turn = math.degrees(period)
    shown = measured(turn * rate, turn * rate_error)
    side = _side(rate, rate_error, "anticlockwise", "clockwise")
    yield "turning", f"{shown.with_unit('degrees per period')}{side} (numerical error)"


def _side(value: float, error: float, positive: str, negative: str) -> str:
    if not abs(value) > error:
        return ""
    return f", {positive if value > 0 else negative}"

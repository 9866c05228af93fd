"""Answers for programs: plain data, in the units of the question."""

import math
from typing import TYPE_CHECKING, Any

from fem_check.answer.units import Units

if TYPE_CHECKING:
    from fem_check.choice.prediction import Prediction


def record(found: "Prediction", units: Units | None) -> dict[str, Any]:
    """The answer for programs, in the units of the question; what is unknown is None."""
    speed = found.speed
    numbers = {
        "mean": found.mean,
        "error": found.error,
        "numerical_error": speed.error - speed.wave_error,
        "wave_error": speed.wave_error,
        "model_error": speed.model_error,
        "slip_ratio": speed.slip_ratio,
        "seconds": found.seconds,
        "alpha": found.scene.alpha,
    }
    return {
        **{name: value if math.isfinite(value) else None for name, value in numbers.items()},
        "unit": units.speed if units else "length/time",
        "converged": found.converged,
        "regime": speed.regime,
        "level": found.level,
        "reason": found.reason,
        "model": speed.model,
        "left_out": list(found.left_out),
        "reach": speed.reach,
    }

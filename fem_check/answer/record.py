"""Answers for programs: plain data, in the units of the question."""

import math
from typing import TYPE_CHECKING, Any

from fem_check.answer.energy import energies, energy
from fem_check.answer.units import Units
from linear_theory.common.shown import flat

if TYPE_CHECKING:
    from fem_check.choice.result import Prediction


def record(found: "Prediction", units: Units | None) -> dict[str, Any]:
    """The answer for programs, in the units of the question; what is unknown is None,
    an infinite error, too.

    error: as the block says it; not_in_error: its parts that were not estimated, in words. energy: in
    words, since an infinite cost of transport is None among the numbers. tolerance: None where none was
    asked for.
    """
    asked = found.tolerance
    return {
        **numbers_of(found),
        "seconds": found.seconds,
        "alpha": found.scene.alpha,
        "unit": units.speed if units else "length/time",
        "converged": found.converged,
        "tolerance": None if asked is None else {"rtol": asked.rtol, "atol": asked.atol},
        "caution": found.caution,
        "not_in_error": list(found.not_in_error),
        "regime": found.regime,
        "energy": energy(found),
        "level": found.level,
        "reason": found.reason,
        "model": found.speed.model,
        "left_out": list(found.left_out),
        "reach": found.speed.reach,
    }


def row(found: "Prediction") -> dict[str, Any]:
    """See `Prediction.to_row`."""
    return {
        **numbers_of(found),
        "level": found.level,
        "reason": found.reason,
        "converged": found.converged,
        "caution": found.caution or None,
        "not_in_error": "; ".join(found.not_in_error) or None,
        "regime": str(found.regime),
        "beyond_reach": found.speed.beyond_reach or None,
        "seconds": found.seconds,
        **flat(found.scene.to_dict(arrays=False), "scene."),
    }


def numbers_of(found: "Prediction") -> dict[str, float | None]:
    """The speed and the energy with their errors by name, None where unknown."""
    speed = found.speed
    numbers = {
        "mean": found.mean,
        "error": found.error,
        "numerical_error": speed.error - speed.wave_error,
        "wave_error": speed.wave_error,
        "model_error": speed.model_error,
        "slip_ratio": speed.slip_ratio,
        **energies(found),
    }
    return {name: float(value) if math.isfinite(value) else None for name, value in numbers.items()}

"""Checks of sheets and waves, made first by every public function."""

from typing import Any

from linear_theory.common import validation
from linear_theory.common.functions import callable_with
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Wave

WAVE_PARTS = ("period", "value", "rate")
"""Attributes that define a wave, see `protocol.Wave`."""

SIGNATURE, MEANING = "(x, y, t, length=1.0)", "the length that of the sheet"
"""Arguments with which solvers call value and rate, of a wave's own class."""


def sheet(value: object, name: str = "sheet") -> Sheet:
    """`value`, which must be a Sheet. Raises ValueError, with a remedy, for anything else."""
    hint = ""
    if value is Sheet:
        hint = "write Sheet()"
    elif _is_wave(value):
        hint = "a wave was given; the arguments are sheet, wave, alpha"
    elif hasattr(value, "corners") and hasattr(value, "mesh"):
        hint = "pass an outline to plane_stress_field, or to Scene(..., mesh=outline.mesh(size))"
    return validation.instance(name, value, Sheet, hint)


def wave(value: Any, name: str = "wave") -> Wave:
    """`value`, which must satisfy `protocol.Wave`. Raises ValueError otherwise."""
    if _is_wave(value):
        validation.positive(f"{name}.period", value.period)
        for part in ("value", "rate"):
            callable_with(f"{name}.{part}", getattr(value, part), SIGNATURE, 4, MEANING)
        return value
    hint = "must be a SineWave, a TravellingWave or a FieldWave"
    if isinstance(value, type):
        hint += f"; a class was given, use an instance, {value.__name__}(...)"
    elif isinstance(value, Sheet):
        hint += "; a sheet was given; the arguments are sheet, wave, alpha"
    elif callable(value):
        hint += "; for a function of x, y, t use FieldWave(function, period)"
    else:
        missing = ", ".join(part for part in WAVE_PARTS if not hasattr(value, part))
        hint += f", or have their {', '.join(WAVE_PARTS)} (no {missing})"
    raise ValueError(f"{name} = {validation.shown(value)}: {hint}")


def _is_wave(value: object) -> bool:
    """Whether a value is an instance, not a class, with all attributes of a wave."""
    return not isinstance(value, type) and all(hasattr(value, part) for part in WAVE_PARTS)

"""The checks of sheets and waves that every public function makes first."""

from typing import Any

from linear_theory.common import validation
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Wave

WAVE_PARTS = ("period", "value", "rate")
"""What makes an object a wave, see `protocol.Wave`."""


def sheet(value: object, name: str = "sheet") -> Sheet:
    """`value`, which must be a Sheet. Raises ValueError that says what to do with anything else."""
    hint = ""
    if value is Sheet:
        hint = "write Sheet()"
    elif _is_wave(value):
        hint = "a wave stands in its place, the order is sheet, wave, alpha"
    elif hasattr(value, "corners") and hasattr(value, "mesh"):
        hint = "an outline goes to plane_stress_field, or into Scene(..., mesh=outline.mesh(size))"
    return validation.instance(name, value, Sheet, hint)


def wave(value: Any, name: str = "wave") -> Wave:
    """`value`, which must have what `protocol.Wave` asks for. Raises ValueError otherwise."""
    if _is_wave(value):
        validation.positive(f"{name}.period", value.period)
        return value
    hint = "must be a SineWave, a TravellingWave or a FieldWave"
    if isinstance(value, type):
        hint += f"; make one of it, {value.__name__}(...)"
    elif isinstance(value, Sheet):
        hint += "; a sheet stands in its place, the order is sheet, wave, alpha"
    elif callable(value):
        hint += "; FieldWave(function, period) makes one of a function of x, y, t"
    else:
        missing = ", ".join(part for part in WAVE_PARTS if not hasattr(value, part))
        hint += f", or have their {', '.join(WAVE_PARTS)} (no {missing})"
    raise ValueError(f"{name} = {validation.shown(value)}: {hint}")


def _is_wave(value: object) -> bool:
    """Whether it is an object, and no class, with all parts of a wave."""
    return not isinstance(value, type) and all(hasattr(value, part) for part in WAVE_PARTS)

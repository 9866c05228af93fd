"""Numbers with units, as they stand in lists and ranges of a sweep."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.files.quantities import NUMBER, Quantity, unit_of


def measured(value: Any) -> Quantity | None:
    """A number, with its unit if it has one; None for anything else."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Quantity("", str(value), float(value), None) if math.isfinite(value) else None
    parts = NUMBER.fullmatch(value) if isinstance(value, str) else None
    if parts is None or not math.isfinite(float(parts[1])):
        return None
    unit = unit_of(parts[2]) if parts[2] else None
    if parts[2] and unit is None:
        return None  # the scene file then says what is wrong
    return Quantity("", str(value), float(parts[1]), unit)


def in_unit(part: Quantity, unit: Any) -> float:
    """The number in that unit. Raises ValueError where it is of something else."""
    if (part.unit is None) != (unit is None):
        raise ValueError(f"{part.text!r}: all must have units, or none")
    if unit is None or part.unit == unit:
        return part.number
    if not part.unit.is_compatible_with(unit):
        raise ValueError(f"{part.text!r}: must be a quantity in {unit:~P} or the like")
    return part.into(unit)


def unit_name(part: Quantity | None) -> str:
    """As pint writes it; empty for plain numbers."""
    return "" if part is None or part.unit is None else f"{part.unit:~P}"


def tidied(found: NDArray[np.float64]) -> NDArray[np.float64]:
    """Without the rounding of exp and log: 1.0 for 1.0000000000000002."""
    return np.array([float(f"{value:.14g}") for value in found])

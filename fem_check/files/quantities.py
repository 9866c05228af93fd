"""Quantities as people write them, a number and its unit, for scene files and for the command."""

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from fem_check.files.units import registry, unit_named

if TYPE_CHECKING:
    import pint

NUMBER = re.compile(
    r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|[+-]?(?:nan|inf(?:inity)?))\s*(.*?)\s*", re.I
)


LONGEST = 60
"""Characters of a unit."""

ENDLESS = re.compile(r"\d{3}|(\*\*|\^)[\s(+-]*\d+[\s)]*(\*\*|\^)|\d\s*\)*\s*(\*\*|\^)")
"""Large numbers, and powers of numbers and of powers, which pint would work out: m**9**9**9."""


class Kind(NamedTuple):
    """How a quantity is written, a unit of it, and its powers of length, time and stress."""

    example: str
    base: str
    powers: tuple[int, int, int]


KINDS = {
    "length": Kind("40 mm", "m", (1, 0, 0)),
    "time": Kind("8 s", "s", (0, 1, 0)),
    "speed": Kind("0.1 mm/s", "m/s", (1, -1, 0)),
    "share": Kind("12 %", "dimensionless", (0, 0, 0)),
    "angle": Kind("5 deg", "radian", (0, 0, 0)),
    "curvature": Kind("0.2 1/mm", "1/m", (-1, 0, 0)),
    "pressure": Kind("1 MPa", "Pa", (0, 0, 1)),
    "density": Kind("1100 kg/m^3", "kg/m^3", (-2, 2, 1)),
    "foundation stiffness": Kind("2 kPa/mm^2", "Pa/m^2", (-2, 0, 1)),
    "contact damping": Kind("3 Pa*s/mm", "Pa*s/m", (-1, 1, 1)),
}
"""By name. A stiffness of the ground is a pressure per penetration squared, its damping a pressure per
speed (eq. 2)."""

ANGLES = ("radian", "milliradian", "degree", "turn", "arcminute", "arcsecond", "grade")
"""Units of angles, which have no dimension: a slope of 5 % is no angle of 5 %."""

UNIT_OF_ANGLE = "needs a unit, as in '5 deg' or '0.1 rad'"
"""What a plain angle is told that might be in degrees or in radians."""


TURN_ENDS = "must be from -180 deg to 180 deg, -pi to pi in radians"
"""What a direction is told that is out of range, whatever its unit."""


@dataclass(frozen=True)
class Quantity:
    """A number with its unit, None for a plain one. kind: a key of KINDS; text: as it was written."""

    kind: str
    text: str
    number: float
    unit: Any  # a pint.Unit, named for type checkers only where pint is not yet loaded

    @property
    def has_dimension(self) -> bool:
        """Whether its number depends on the units of length, time and stress."""
        return any(KINDS[self.kind].powers)

    def into(self, unit: Any) -> float:
        """The number in another unit of the same dimension; a plain number as it is."""
        if self.unit is None:
            return self.number
        return float(self.number * self.unit._REGISTRY.Quantity(1.0, self.unit).to(unit).magnitude)


def read(value: object, kind: str) -> Quantity:
    """A number and its unit, from text or from a plain number.

    kind: a key of KINDS. Raises ValueError, without the name of what it is, for anything else, and for
    a unit of something else.

    >>> from fem_check.files.quantities import read
    >>> print(read("1.5 cm", "length").into("mm"), read(0.12, "share").into("percent"))
    15.0 0.12
    """
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Quantity(kind, f"{value:g}", float(value), None)
    example = f"must be {_article(kind)} {kind} such as '{KINDS[kind].example}'"
    parts = NUMBER.fullmatch(value) if isinstance(value, str) else None
    if parts is None:
        raise ValueError(f"{example}, or a plain number")
    number, unit_text = float(parts[1]), parts[2]
    if not unit_text:
        return Quantity(kind, str(value), number, None)
    unit = unit_of(unit_text)
    if unit is None:
        raise ValueError(f"{unit_text!r} is not a known unit; {example}")
    if not _fits(unit, kind):
        raise ValueError(f"is not {_article(kind)} {kind}; {example}")
    return Quantity(kind, str(value), number, unit)


def direction(angle: Quantity) -> float:
    """An angle in radians that says where something points; plain numbers are in radians already.

    Raises ValueError, without the name of what it is, beyond half a turn.
    """
    found = angle.into("radian")
    if abs(found) > math.pi * (1 + 1e-12):
        raise ValueError(TURN_ENDS)
    return min(max(found, -math.pi), math.pi)  # half a turn may be rounded up


def length_unit(text: str) -> "pint.Unit":
    """The unit of length of that name. Raises ValueError for anything else."""
    unit = unit_of(text)
    if unit is None or not _fits(unit, "length"):
        raise ValueError("must be a unit of length such as 'mm'")
    return unit


def _fits(unit: "pint.Unit", kind: str) -> bool:
    """Whether it is a unit of that kind."""
    base = unit_of(KINDS[kind].base)
    if not unit.is_compatible_with(base):
        return False
    return kind not in ("share", "angle") or (str(unit) in ANGLES) == (kind == "angle")


def _article(word: str) -> str:
    return "an" if word[0] in "aeiou" else "a"


def unit_of(text: str) -> "pint.Unit | None":
    """The unit of that name; None where there is none, and where it would take for ever to work out."""
    if len(text) > LONGEST or ENDLESS.search(text):
        return None
    registry(text)  # outside of the try: a pint that is broken is no unknown unit
    try:
        return unit_named(text)
    except Exception:  # pint fails on text in many ways: "mmm", "m/0", "1/", "m m ("
        return None

"""The units of a scene file: its numbers in units of length, time and stress that are its own."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from fem_check.answer.units import Units
from fem_check.files.fields import Table
from fem_check.files.mistakes import Mistakes, Place
from fem_check.files.quantities import KINDS, UNIT_OF_ANGLE, Quantity, length_unit
from fem_check.files.units import registry

BASES: dict[str, Place] = {"length": ("sheet", "length"), "time": ("wave", "period")}
"""Whose units are those of the file."""

SOLVED: Place = ("wave", "until")
"""Instead of the period, of a wave that has none of its own."""


class System(NamedTuple):
    """Units of length and time, and Young's modulus, which is the unit of stress; None if plain."""

    length: Any = None
    time: Any = None
    young: Quantity | None = None

    @property
    def plain(self) -> bool:
        """Whether all numbers are in units of the sheet."""
        return self.length is None

    @property
    def units(self) -> Units | None:
        """In which answers are told."""
        return None if self.plain else Units(f"{self.length:~P}", f"{self.time:~P}")

    def number(self, found: Quantity | None, default: float = 0.0) -> float:
        """A quantity in these units, the default where it is None."""
        if found is None:
            return default
        if found.unit is None:
            return found.number
        length, time, stress = KINDS[found.kind].powers
        if not found.has_dimension:
            return found.into("radian" if found.kind == "angle" else "dimensionless")
        unit = self.length**length * self.time**time
        if not stress:
            return found.into(unit)
        assert self.young is not None
        return found.into(unit * self.young.unit) / self.young.number

    def factor(self, unit: str | None) -> float:
        """A named unit of length in that of the file. Raises ValueError beside plain numbers."""
        if self.plain:
            if unit is not None:
                raise ValueError(f"unit = {unit!r}: must be left out, all other numbers are plain")
            return 1.0
        if unit is None:
            raise ValueError("unit: must be given, such as 'mm', since [sheet] length has a unit")
        return float(registry().Quantity(1.0, length_unit(unit)).to(self.length).magnitude)


def system_of(tables: Mapping[str, Table], mistakes: Mistakes) -> System | None:
    """The units of the quantities of a file; None where they do not fit together.

    Those with a dimension must all have units, or all be plain; 0 is 0 in all of them. Angles
    have units beside such, too, so that none in degrees is taken for one in radians.
    """
    all_of_them = [(p, q) for name, table in tables.items() for p, q in _quantities(table, (name,))]
    dimensional = {place: q for place, q in all_of_them if q.has_dimension}
    named = [(place, q) for place, q in dimensional.items() if q.unit is not None]
    if not named:
        return System()
    first = f"{_words(named[0][0])} = {named[0][1].text!r}"
    fine = True
    for place, q in all_of_them:
        if q.unit is None and q.number != 0 and (q.has_dimension or q.kind == "angle"):
            needs = (
                UNIT_OF_ANGLE if q.kind == "angle" else f"needs a unit, as in '{KINDS[q.kind].example}'"
            )
            mistakes.add(place, f"{place[-1]} = {q.text}: {needs}, beside {first}")
            fine = False
    bases = BASES if SOLVED not in dimensional else {**BASES, "time": SOLVED}
    for kind, place in bases.items():
        if place not in dimensional and place[0] in tables:
            words = f"{place[-1]}: must be given, such as '{KINDS[kind].example}', beside {first}"
            mistakes.add(place, words)
            fine = False
    young = dimensional.get(("sheet", "young"))
    stress = next((p for p, q in named if KINDS[q.kind].powers[2] and p != ("sheet", "young")), None)
    if stress is not None and young is None and "sheet" in tables:
        beside = f"{_words(stress)} = {dimensional[stress].text!r}"
        mistakes.add(("sheet", "young"), f"young: must be given, such as '1 MPa', beside {beside}")
        fine = False
    if not fine or not all(place in dimensional for place in bases.values()):
        return None
    length, time = (dimensional[place].unit for place in bases.values())
    return System(length, time, young)


def _quantities(value: Any, place: Place) -> Iterator[tuple[Place, Quantity]]:
    """All quantities of a table with their places."""
    if isinstance(value, Quantity):
        yield place, value
    elif isinstance(value, Table):
        for name in type(value).model_fields:
            yield from _quantities(getattr(value, name), (*place, name))
    elif isinstance(value, list) and value and not isinstance(value[0], int | float):
        for i, item in enumerate(value):
            yield from _quantities(item, (*place, i))


def _words(place: Place) -> str:
    table, *key = place
    return f"[{table}] {'.'.join(map(str, key))}"

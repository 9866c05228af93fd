"""What the best scene must keep to: numbers of its answer, and sums of its fields, between bounds."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from fem_check.answer.units import Units
from fem_check.optimisation.objectives import Given, Objective
from fem_check.optimisation.options.quantities import QUANTITIES
from fem_check.optimisation.unknowns import Unknowns
from fem_check.sweeps.points.measures import in_unit, measured
from linear_theory.common import validation
from linear_theory.common.shown import Value, number
from linear_theory.optimisation.problem import Linear

SIDES = {"at_most": (1.0, "<="), "at_least": (-1.0, ">=")}
"""Sign and sign of relation."""


@dataclass(frozen=True)
class Bound(Value):
    """Bounds of a number, plain or as text with a unit.

    of: of what number: by default that of the answer that the bound is given under ("cost of
    transport", "power", "speed", "distance per period", "efficiency", "turning rate", "speed sideways",
    "stretch", the largest that growth asks for, "height" of the sheet above the ground); else a
    function of the `CrawlSpeed`, or a mapping of unknowns to weights, whose weighted sum it is.
    exactly: for such sums alone. Raises ValueError for others.

    >>> from fem_check import Bound
    >>> print(Bound(at_most=3.0), Bound(exactly=1.0, of={"friction.forward": 0.5}).side)
    Bound(at_most=3) exactly
    """

    at_most: float | str | None = None
    at_least: float | str | None = None
    exactly: float | str | None = None
    of: Callable[[Any], Any] | Mapping[str, float] | None = None

    def __post_init__(self) -> None:
        given = self.given
        if not given:
            raise ValueError("at_most, at_least, exactly: one of them must be given")
        if "exactly" in given and (len(given) > 1 or not isinstance(self.of, Mapping)):
            raise ValueError(
                "exactly: must be alone, and of a sum of fields; numbers of an answer have at_most or "
                "at_least"
            )
        for name, value in given.items():
            if measured(value) is None:
                shown = validation.shown(value)
                raise ValueError(f"{name} = {shown}: must be a finite number, with or without a unit")
        if isinstance(self.of, Mapping):
            if not self.of:
                raise ValueError("of = {}: must map unknowns to weights")
            for name, weight in self.of.items():
                validation.real(f"of: {name}", weight)
            return
        given_of: object = self.of
        if given_of is not None and not callable(given_of):
            shown = validation.shown(given_of)
            raise ValueError(
                f"of = {shown}: must be a function of the speed, or map unknowns to weights"
            )

    def _rows(self) -> dict[str, Any]:
        return self.given | ({} if self.of is None else {"of": self.of})

    @property
    def given(self) -> dict[str, float | str]:
        """Those that are."""
        names = (*SIDES, "exactly")
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    @property
    def side(self) -> str:
        """The names of those that are given."""
        return ", ".join(self.given)

    def definition(self) -> dict[str, Any]:
        """As plain data."""
        of = dict(self.of) if isinstance(self.of, Mapping) else None
        return {**self.given, "of": of if of or self.of is None else "function"}


@dataclass(frozen=True)
class Side:
    """One bound of a number of the answer. sign: 1 for at most, -1 for at least; unit: of the bound,
    empty for plain numbers."""

    key: str
    quantity: Objective
    sign: float
    bound: float
    unit: str = ""

    @property
    def name(self) -> str:
        """For people."""
        relation = "<=" if self.sign > 0 else ">="
        return f"{self.key} {relation} {self.measured(self.bound)}"

    def measured(self, value: float) -> str:
        """A number of it with the unit."""
        return f"{number(value)} {self.unit}".rstrip()


def checked(given: object) -> dict[str, Bound]:
    """Constraints by name. Raises ValueError, by name, for what is none."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise ValueError(
            f"constraints = {validation.shown(given)}: must map names to a Bound, as in "
            "{'cost of transport': Bound(at_most=3)}"
        )
    for name, bound in given.items():
        if not isinstance(bound, Bound):
            raise ValueError(f"constraints: {name} = {validation.shown(bound)}: must be a Bound")
        if bound.of is None and name not in QUANTITIES:
            known = ", ".join(map(repr, QUANTITIES))
            raise ValueError(
                f"constraints: {validation.shown(name)}: must be one of {known}, or have `of`"
            )
    return dict(given)


def sides_of(constraints: Mapping[str, Bound], units: Units | None) -> list[Side]:
    """Those on numbers of an answer. Raises ValueError for a unit of something else, or without one."""
    found = []
    for key, bound in constraints.items():
        if isinstance(bound.of, Mapping):
            continue
        quantity = QUANTITIES[key] if bound.of is None else Given(bound.of)
        ends = {
            name: _plain(f"{key}: {name}", value, quantity, units)
            for name, value in bound.given.items()
        }
        if len(ends) > 1 and ends["at_least"] >= ends["at_most"]:
            raise ValueError(
                f"constraints: {key}: at_least = {number(ends['at_least'])}: must be < at_most = "
                f"{number(ends['at_most'])}"
            )
        unit = unit_of(quantity.unit, units)
        found += [Side(key, quantity, SIDES[name][0], value, unit) for name, value in ends.items()]
    return found


def _plain(name: str, given: float | str, quantity: Objective, units: Units | None) -> float:
    """A bound in the units of the scene."""
    part = measured(given)
    assert part is not None
    if part.unit is None:
        return part.number
    unit = unit_of(quantity.unit, units)
    try:
        if not unit:
            raise ValueError("must be a plain number, as those of the scene are")
        wanted = measured(f"1 {unit}")
        assert wanted is not None
        return in_unit(part, wanted.unit)
    except ValueError as problem:
        raise ValueError(f"constraints: {name} = {given!r}: {problem}") from None


def unit_of(unit: str, units: Units | None) -> str:
    """Of a quantity in the units of a scene file; empty for plain numbers."""
    if units is None or unit in ("", "mu"):
        return ""
    return {"length": units.length, "length/time": units.speed, "1/time": f"1/{units.time}"}[unit]


def sums_of(constraints: Mapping[str, Bound], unknowns: Unknowns) -> list[Linear]:
    """Those on sums of fields, over the unknowns. Raises ValueError, by name, for no unknown."""
    return [
        one
        for key, bound in constraints.items()
        if isinstance(bound.of, Mapping)
        for one in _sums(key, bound, bound.of, unknowns)
    ]


def _sums(key: str, bound: Bound, weights: Mapping[str, float], unknowns: Unknowns) -> list[Linear]:
    names = unknowns.names
    for name in weights:
        if name not in names:
            raise ValueError(
                f"constraints: {key}: of {name!r}: must be among what may change, {', '.join(names)}"
            )
    for field in unknowns.fields:
        if field.name in weights and field.axis.said_as.spacing == "log":
            raise ValueError(f"constraints: {key}: of {field.name!r}: must not have spacing = 'log'")
    rest = np.zeros(len(names))
    slopes = unknowns.slopes(rest)
    row = np.array([weights.get(name, 0.0) for name in names])
    offset = float(row @ np.array([unknowns.values(rest)[name] for name in names]))
    scale = max(float(abs(row * slopes).max()), 1e-300)
    matrix, found = (row * slopes / scale)[None], []
    for side, given in bound.given.items():
        value = measured(given)
        assert value is not None
        if value.unit is not None:
            raise ValueError(
                f"constraints: {key}: {side} = {given!r}: must be a plain number, in the units of the "
                "bounds of its fields"
            )
        most = np.array([(value.number - offset) / scale])
        sign, relation = SIDES.get(side, (1.0, "="))
        name = f"{key} {relation} {number(value.number)}"
        found.append(Linear(name, sign * matrix, sign * most, side == "exactly"))
    return found

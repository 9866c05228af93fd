"""What a field of the scenes of a sweep is: the values of a list, or a range."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.files.quantities import Quantity
from fem_check.sweeps.points.fields import checked, takes_whole_numbers
from fem_check.sweeps.points.measures import in_unit, measured, tidied, unit_name
from linear_theory.common import validation
from linear_theory.common.shown import Value, plain
from linear_theory.common.validation import shown

SPACINGS = ("linear", "log")

MOST_VALUES = 10**7
"""On one axis."""


@dataclass(frozen=True)
class Between(Value):
    """A range of a field: numbers, or text with units such as "10 mm".

    count: values on a grid, both ends among them; not needed for random designs. spacing: "linear", or
    "log" for factors. Raises ValueError for ends that are not in order, and for what is no range.

    >>> from fem_check.sweeps import Between
    >>> print(Between(0.1, 10.0, count=3, spacing="log").on("growth.alpha").values())
    [0.1, 1.0, 10.0]
    """

    low: float | str
    high: float | str
    count: int | None = None
    spacing: str = "linear"

    def __post_init__(self) -> None:
        validation.choice("spacing", self.spacing, SPACINGS)
        if self.count is not None:
            validation.integer("count", self.count, 2)
            if self.count > MOST_VALUES:
                raise ValueError(f"count = {self.count}: must be at most {MOST_VALUES}")

    def on(self, path: str) -> "Range":
        """As the axis of a field."""
        low, high = (measured(end) for end in (self.low, self.high))
        if low is None or high is None:
            end = self.low if low is None else self.high
            raise ValueError(
                f"{validation.shown(end)}: must be a finite number, with or without a unit"
            )
        unit = low.unit
        ends = (low.number, in_unit(high, unit))
        if not ends[0] < ends[1]:
            raise ValueError(f"from {self.low} to {self.high}: must be from the lower to the higher")
        if self.spacing == "log" and ends[0] <= 0:
            raise ValueError(f"from {self.low}: must be > 0 for spacing = 'log'")
        return Range(path, ends, unit, self)


class Axis(Value):
    """A field and what it may be. unit: of its numbers, empty for plain ones and for words."""

    path: str

    @property
    def unit(self) -> str:
        """Of the numbers, as pint writes it."""
        return ""

    @property
    def size(self) -> int | None:
        """How many values there are; None for a range without a count."""
        raise NotImplementedError

    def values(self) -> list[Any]:
        """All of them, as a scene file has them but for the unit."""
        raise NotImplementedError

    def at(self, shares: NDArray[np.float64]) -> list[Any]:
        """The values at shares of the way, 0 to 1."""
        raise NotImplementedError

    def said(self, value: Any) -> Any:
        """A value with the unit, as a scene file has it."""
        return f"{value!r} {self.unit}" if self.unit and isinstance(value, int | float) else value


@dataclass(frozen=True)
class Listed(Axis):
    """Values one by one; quantities in the unit of the first."""

    path: str
    given: tuple[Any, ...]

    @property
    def unit(self) -> str:
        """Of the first value."""
        return unit_name(self._parts[0])

    @property
    def size(self) -> int:
        """All are."""
        return len(self.given)

    @cached_property
    def _parts(self) -> list[Quantity | None]:
        return [measured(value) if isinstance(value, str) else None for value in self.given]

    def values(self) -> list[Any]:
        """As they are given."""
        first = self._parts[0]
        if first is None or first.unit is None:
            return list(self.given)
        return [in_unit(part, first.unit) for part in self._parts if part is not None]

    def at(self, shares: NDArray[np.float64]) -> list[Any]:
        """Each as likely as the others."""
        values = self.values()
        return [values[min(int(share * len(values)), len(values) - 1)] for share in shares]


@dataclass(frozen=True)
class Range(Axis):
    """Numbers from the first to the last end."""

    path: str
    ends: tuple[float, float]
    pint_unit: Any
    said_as: Between

    @property
    def unit(self) -> str:
        """Of both ends."""
        return "" if self.pint_unit is None else f"{self.pint_unit:~P}"

    @property
    def size(self) -> int | None:
        """Where it is given."""
        return self.said_as.count

    def values(self) -> list[Any]:
        """With both ends."""
        assert self.size is not None
        found = self._numbers(np.linspace(0.0, 1.0, self.size))
        if self.said_as.spacing == "log":
            found = tidied(found)
        if self._whole and len({float(v) for v in found}) < len(found):
            raise ValueError(f"count = {self.size}: there are not so many whole numbers in the range")
        return self._plain(found)

    def at(self, shares: NDArray[np.float64]) -> list[Any]:
        """Between the ends."""
        if self._whole:  # each number as likely as the others
            low, high = self.ends
            found = low + np.minimum(np.floor(shares * (high - low + 1)), high - low)
            return self._plain(found)
        return self._plain(self._numbers(shares))

    @property
    def _whole(self) -> bool:
        return takes_whole_numbers(self.path)

    def _numbers(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        low, high = self.ends
        if self.said_as.spacing == "log":
            found = np.exp(math.log(low) + shares * (math.log(high) - math.log(low)))
        else:
            found = low + shares * (high - low)
        found = np.where(shares == 1.0, high, np.where(shares == 0.0, low, found))
        return np.rint(found) if self._whole else found

    def _plain(self, found: NDArray[np.float64]) -> list[Any]:
        return [int(v) for v in found] if self._whole else found.tolist()


def axis_of(path: object, given: Any) -> Axis:
    """The axis of a field: of a list, of a `Between`, or of one value.

    Raises ValueError, beginning with the path, for an unknown field, an empty list and a mixture of
    quantities with and without units.
    """
    name = checked(path)
    try:
        if isinstance(given, Between):
            return given.on(name)
        if isinstance(given, str | int | float) or not isinstance(given, Sequence | np.ndarray):
            raise ValueError("must be a list of values, or a range")
        values = given.tolist() if isinstance(given, np.ndarray) else list(given)
        if not values:
            raise ValueError("is an empty list, must have a value")
        _check_alike(values)
    except ValueError as problem:
        raise ValueError(f"{name} = {validation.shown(_told(given))}: {problem}") from None
    return Listed(name, tuple(plain(values)))


def axes_of(over: Mapping[str, Any]) -> tuple[Axis, ...]:
    """Of all fields, in their order. Raises ValueError with all that is wrong, and for none."""
    if not isinstance(over, Mapping) or not over:
        shown = validation.shown(over)
        raise ValueError(f"over = {shown}: must map fields to values, as in {{'growth.alpha': [...]}}")
    found, wrong = [], []
    for path, given in over.items():
        try:
            found.append(axis_of(path, given))
        except ValueError as problem:
            wrong.append(str(problem))
    if wrong:
        raise ValueError("over: " + "; ".join(wrong))
    return tuple(found)


def _told(given: Any) -> Any:
    return given.tolist() if isinstance(given, np.ndarray) else given


def _check_alike(values: Sequence[Any]) -> None:
    """Raise ValueError unless all values or none are quantities with units of one dimension."""
    for value in values:
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            raise ValueError(f"{shown(value)}: must be finite")
    parts = [measured(value) if isinstance(value, str) else None for value in values]
    united = [part for part in parts if part is not None and part.unit is not None]
    if united and len(united) < len(values):
        lone = next(v for v, part in zip(values, parts, strict=True) if part is None or not part.unit)
        raise ValueError(f"{lone!r}: needs a unit, beside {united[0].text!r}")
    for part in united:
        in_unit(part, united[0].unit)

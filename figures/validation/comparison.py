"""A published result and the calculation that is compared with it."""

import hashlib
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Any, Protocol

from linear_theory import Estimate

ROUNDOFF = 1e-13
"""Relative error of a closed form."""

SCENES = Path(__file__).parent / "scenes"
"""Scene files of comparisons that are scenes."""


class Confirmed(Enum):
    """How the number there was confirmed, the best first."""

    READ = "read in the source, or where the source is quoted"
    DERIVED = "derived and checked independently"
    MEMORY = "from memory, not confirmed"


@dataclass(frozen=True)
class Source:
    """Where a number comes from: its text, with a DOI or an arXiv number, and how it was confirmed."""

    text: str
    confirmed: Confirmed
    remark: str = ""


@dataclass(frozen=True)
class Number:
    """One published number.

    name: what it is; value: there; accuracy: of that number, absolute (half of its last digit unless
    its source says more); unit: of both; why: words for the page where the two differ.
    """

    name: str
    value: float
    accuracy: float
    unit: str = ""
    why: str = ""


class Calculation(Protocol):
    """Computes the numbers of a comparison here."""

    def full(self) -> Sequence[Estimate]:
        """Of the table, with errors."""

    def cheap(self) -> Sequence[Estimate]:
        """In tenths of a second, for the tests: differs from `full` by the errors of both at most."""

    @property
    def inputs(self) -> str:
        """What determines the result, as text."""


def _named(function: Callable[..., Any], settings: object) -> str:
    return f"{function.__module__}.{function.__qualname__} {settings!r}"


@dataclass(frozen=True)
class ByTolerance:
    """A function that estimates its own errors, at two tolerances."""

    function: Callable[..., Sequence[Estimate]]
    fine: Mapping[str, Any] = field(default_factory=dict)
    coarse: Mapping[str, Any] = field(default_factory=dict)
    shared: Mapping[str, Any] = field(default_factory=dict)

    def full(self) -> Sequence[Estimate]:
        """See Calculation."""
        return self.function(**self.shared, **self.fine)

    def cheap(self) -> Sequence[Estimate]:
        """See Calculation."""
        return self.function(**self.shared, **self.coarse)

    @property
    def inputs(self) -> str:
        """See Calculation."""
        return _named(self.function, (dict(self.shared), dict(self.fine)))


@dataclass(frozen=True)
class ByRefinement:
    """A function of a mesh or a truncation, computed on two: their difference is the error."""

    function: Callable[..., Sequence[float]]
    fine: Mapping[str, Any]
    coarse: Mapping[str, Any]
    shared: Mapping[str, Any] = field(default_factory=dict)

    def full(self) -> Sequence[Estimate]:
        """See Calculation."""
        fine = self.function(**self.shared, **self.fine)
        coarse = self.function(**self.shared, **self.coarse)
        return [Estimate(float(f), abs(float(f - c))) for f, c in zip(fine, coarse, strict=True)]

    def cheap(self) -> Sequence[Estimate]:
        """The coarse one: the error of `full` is the distance to it."""
        return [Estimate(float(c), 0.0) for c in self.function(**self.shared, **self.coarse)]

    @property
    def inputs(self) -> str:
        """See Calculation."""
        return _named(self.function, (dict(self.shared), dict(self.fine), dict(self.coarse)))


@dataclass(frozen=True)
class Closed:
    """A closed form, exact but for roundoff."""

    function: Callable[[], Sequence[float]]

    def full(self) -> Sequence[Estimate]:
        """See Calculation."""
        return [Estimate(float(v), ROUNDOFF * abs(v)) for v in self.function()]

    def cheap(self) -> Sequence[Estimate]:
        """See Calculation."""
        return self.full()

    @property
    def inputs(self) -> str:
        """See Calculation."""
        return _named(self.function, ())


@dataclass(frozen=True)
class Comparison:
    """Published numbers of one problem, and the calculation of all of them.

    name: short, unique; problem: what is computed, one sentence; scenes: files in SCENES that the
    calculation reads, where the problem is a scene of the package; slow: the cheap form is
    not, and the tests only check the table. Numbers and those computed stand in the same order.
    """

    name: str
    problem: str
    source: Source
    numbers: tuple[Number, ...]
    calculation: Calculation
    scenes: tuple[str, ...] = ()
    slow: bool = False

    @property
    def files(self) -> tuple[Path, ...]:
        """The scene files, and the tables of samples that they read."""
        found = [SCENES / scene for scene in self.scenes]
        for path in tuple(found):
            samples = tomllib.loads(path.read_text(encoding="utf-8")).get("wave", {}).get("csv")
            found += [SCENES / samples] if samples else []
        return tuple(found)

    @property
    def identity(self) -> str:
        """Changes with the numbers, the inputs of the calculation, and the files of the scene."""
        # Nine digits, as in the table: the last ones differ between processors.
        numbers = [(f"{n.value:.9g}", f"{n.accuracy:.9g}") for n in self.numbers]
        text = f"{self.calculation.inputs} {numbers}"
        for place in self.files:
            text += place.read_text(encoding="utf-8")
        return hashlib.sha256(text.encode()).hexdigest()[:12]


def agree(there: float, accuracy: float, here: float, error: float) -> bool:
    """Whether two numbers differ by their errors at most."""
    return abs(here - there) <= accuracy + error

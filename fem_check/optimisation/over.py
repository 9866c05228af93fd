"""What an optimisation may change: fields of a scene between bounds, and the harmonics of its wave."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.sweeps.points.axes import Between, Range
from fem_check.sweeps.points.fields import checked, takes_whole_numbers
from linear_theory.common import validation
from linear_theory.common.shown import Value, number
from linear_theory.optimisation.problem import Ball, Constraint, Linear
from linear_theory.scene.scene import Scene
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

WAVE = "wave"
"""The name of the harmonics among what may change; fields have dots in theirs."""

AMPLITUDES = ("wave.cosine", "wave.sine", "wave.amplitude", "wave.phase")
"""What names of amplitudes begin with, as gradients know them; none of them is a field by itself."""

ANSWERING = "run."
"""What fields that are not of the scene begin with."""

LEEWAY = 1 - math.cos(math.pi / 32)
"""Of |c|, within which a wave is of the size: that by which the bound is tightened, see GRID."""

GRID = 32
"""Phases to a wavelength of the highest harmonic at which |c| is bounded: between them it is larger by
a factor of 1/cos(pi/32) = 1.005 at the most (Ehlich and Zeller, Math. Z. 86, 41, 1964), which the bound
leaves room for."""

WIDEST = 1.5
"""Bound of amplitudes over the largest |c|; that of a wave with |c| <= 1 is at most 4/pi."""

STEEPNESS = 2
"""Random waves to start from have amplitudes that fall with this power of the harmonic."""


@dataclass(frozen=True)
class Field:
    """A field of a scene between two bounds, by its name in scene files; its unknown goes from 0 to 1.

    axis: with its ends, unit and spacing, as in sweeps. Raises ValueError for fields of whole numbers,
    which have no gradient.
    """

    axis: Range

    @classmethod
    def of(cls, path: object, given: object) -> "Field":
        """From a `Between`, or a pair of numbers or of texts with units."""
        if str(path).startswith(AMPLITUDES):
            raise ValueError(
                f"over: {path}: amplitudes change together, as harmonics of the wave: 'wave': "
                "Harmonics(...), or [harmonics] in a file"
            )
        name = checked(path)
        if name.startswith(ANSWERING):
            raise ValueError(f"over: {name}: says how a scene is answered, not what it is")
        if takes_whole_numbers(name):
            raise ValueError(
                f"over: {name}: takes whole numbers, which have no gradient; optimise for each of them"
            )
        if isinstance(given, tuple | list) and len(given) == 2:
            given = Between(*given)
        if not isinstance(given, Between):
            shown = validation.shown(given)
            raise ValueError(f"over: {name} = {shown}: must be (low, high), or a Between")
        if given.count is not None:
            raise ValueError(
                f"over: {name}: count = {given.count}: must be left out, all values between are tried"
            )
        try:
            return cls(given.on(name))
        except ValueError as problem:
            raise ValueError(f"over: {name} = {problem}") from None

    @property
    def name(self) -> str:
        """Of the field."""
        return self.axis.path

    def at(self, share: float) -> float:
        """Its number at an unknown."""
        return float(self.axis.at(np.array([share]))[0])

    def slope(self, share: float) -> float:
        """Derivative of the number by the unknown."""
        low, high = self.axis.ends
        if self.axis.said_as.spacing == "log":
            return self.at(share) * math.log(high / low)
        return high - low

    def said(self, share: float) -> Any:
        """Its value as a scene file has it, with the unit."""
        return self.axis.said(self.at(share))

    def share(self, number: float) -> float:
        """The unknown of a number; outside of 0 to 1 beyond the bounds."""
        low, high = self.axis.ends
        if self.axis.said_as.spacing == "log":
            return math.log(max(number, 1e-300) / low) / math.log(high / low)
        return (number - low) / (high - low)


@dataclass(frozen=True)
class Harmonics(Value):
    """The profile of a travelling wave: mean, and cosine and sine amplitudes up to that many harmonics.

    Of one size: largest: of |c| over a period; or mean_square: of c. Exactly one of them is given, > 0.
    Without `mean`, the mean of c is 0. Count of waves and period stay those of the scene.
    Raises ValueError for others.

    >>> from fem_check import Harmonics
    >>> print(Harmonics(5, largest=1.0).unknowns, Harmonics(5, mean_square=0.5, mean=False).unknowns)
    11 10
    """

    count: int
    largest: float | None = None
    mean_square: float | None = None
    mean: bool = True

    def __post_init__(self) -> None:
        validation.integer("count", self.count, 1)
        validation.flag("mean", self.mean)
        if (self.largest is None) == (self.mean_square is None):
            raise ValueError("largest, mean_square: one of them must be given, and not both")
        for name in ("largest", "mean_square"):
            if getattr(self, name) is not None:
                validation.positive(name, getattr(self, name))

    @property
    def unknowns(self) -> int:
        """Amplitudes, over the `unit`."""
        return 2 * self.count + self.mean

    @property
    def unit(self) -> float:
        """Of the amplitudes: the largest |c|, or the amplitude of the sine of that mean square."""
        if self.largest is not None:
            return self.largest
        return math.sqrt(2 * (self.mean_square or 0.0))

    @property
    def names(self) -> list[str]:
        """Of the unknowns: wave.cosine.0 is the amplitude of cos phi, as for `speed_gradient`."""
        found = [f"wave.{kind}.{k}" for kind in ("cosine", "sine") for k in range(self.count)]
        return found + ["wave.mean"] * self.mean

    @property
    def spread(self) -> Array:
        """Of random waves to start from."""
        falling = 1 / np.arange(1.0, self.count + 1) ** STEEPNESS
        return np.concatenate([falling, falling, [0.5] * self.mean])

    def wave(self, unknowns: Array, like: TravellingWave) -> TravellingWave:
        """With the count and the period of another one."""
        values, n = self.unit * unknowns, self.count
        mean = float(values[-1]) if self.mean else 0.0
        return TravellingWave(values[:n], values[n : 2 * n], like.count, like.period, mean)

    def of(self, wave: TravellingWave) -> Array:
        """The unknowns of a wave; harmonics beyond `count` are left out."""
        found = np.zeros(self.unknowns)
        kept = min(self.count, wave.cosine.size)
        found[:kept], found[self.count : self.count + kept] = wave.cosine[:kept], wave.sine[:kept]
        if self.mean:
            found[-1] = wave.mean
        return np.asarray(found / self.unit)

    def outside(self, wave: TravellingWave) -> list[str]:
        """How a wave is none of these, in words."""
        found, unknowns = [], self.of(wave)
        more = np.flatnonzero(np.hypot(wave.cosine, wave.sine)[self.count :]) + self.count + 1
        if more.size:
            found.append(f"wave has harmonics up to {more[-1]}, not up to {self.count}")
        if wave.mean and not self.mean:
            found.append(f"wave.mean = {number(wave.mean)}, not 0")
        if float(self.constraint.excess(unknowns).max()) > LEEWAY:
            found.append(f"its wave misses {self.constraint.name}")
        return found

    @cached_property
    def constraint(self) -> Constraint:
        """Of the size, over the unknowns."""
        if self.largest is None:
            weights = np.concatenate([np.ones(2 * self.count), [2.0] * self.mean])
            return Ball(f"mean square of c <= {self.mean_square:g}", weights, 1.0)
        phase = 2 * np.pi / (GRID * self.count) * np.arange(GRID * self.count)
        angle = np.multiply.outer(phase, np.arange(1, self.count + 1))
        rows = np.hstack([np.cos(angle), np.sin(angle), np.ones((phase.size, int(self.mean)))])
        most = np.full(2 * phase.size, math.cos(math.pi / GRID))
        return Linear(f"|c| <= {self.largest:g}", np.vstack([rows, -rows]), most)


def parts_of(over: Mapping[str, Any]) -> tuple[tuple[Field, ...], Harmonics | None]:
    """Fields and harmonics. Raises ValueError for what cannot be changed, by name, and for nothing."""
    if not isinstance(over, Mapping) or not over:
        raise ValueError(
            f"over = {validation.shown(over)}: must map fields to bounds, as in "
            "{'growth.alpha': (0.1, 0.3)}, or 'wave' to Harmonics"
        )
    harmonics = over.get(WAVE)
    if WAVE in over and not isinstance(harmonics, Harmonics):
        raise ValueError(f"over: wave = {validation.shown(harmonics)}: must be Harmonics")
    fields = tuple(Field.of(path, given) for path, given in over.items() if path != WAVE)
    if harmonics is not None:
        for field in fields:
            if field.name.startswith("wave.") and field.name != "wave.period":
                raise ValueError(f"over: {field.name}: must be left out beside harmonics of the wave")
            if field.name == "growth.swelling":
                raise ValueError(
                    "over: growth.swelling: must be growth.alpha beside harmonics of the wave: it is "
                    "the growth at the crest of a given one"
                )
    return fields, harmonics


def travelling(scene: Scene) -> TravellingWave:
    """The wave of a scene whose harmonics are to change. Raises ValueError for any other."""
    wave = scene.drive.series
    if wave is None:
        shown = validation.shown(scene.wave)
        raise ValueError(f"over: wave: the scene must have a travelling wave, not {shown}")
    return wave

"""Parameters of a travelling wave: amplitudes and phases of its harmonics, mean, period, number."""

import math
from abc import abstractmethod
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.gradient.direction import Direction, GrowthChange, Harmonic
from linear_theory.gradient.parameters.parameter import Parameter, lacks
from linear_theory.scene.scene import Scene
from linear_theory.wave.fractional import FractionalWave, count_of, profile_of, with_profile
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]


class OfWave(Parameter):
    """One of the numbers of a travelling wave."""

    def wave(self, scene: Scene) -> TravellingWave:
        """That of the scene, or the profile of a fractional one. Raises ValueError for another one."""
        profile = profile_of(scene.wave)
        if profile is None:
            raise lacks(self.name, "a TravellingWave", scene.wave)
        return profile

    def with_wave(self, scene: Scene, wave: TravellingWave) -> Scene:
        """The scene with that wave, or profile of a fractional one."""
        return scene.but(wave=with_profile(scene.wave, wave))


@dataclass(frozen=True)
class OfHarmonic(OfWave):
    """One of the numbers of a harmonic k = 1, 2, ..., which the wave may not have yet (0)."""

    harmonic: int
    field: ClassVar[str]

    def __post_init__(self) -> None:
        validation.integer("harmonic", self.harmonic, 1)

    @property
    def name(self) -> str:
        """Entries of lists count from 0: the amplitude of cos(phi) is "wave.cosine.0"."""
        return f"wave.{self.field}.{self.harmonic - 1}"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return self.number(*self.pair(scene))

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        wave, k = self.wave(scene), self.harmonic
        pair = self.with_number(*self.pair(scene), validation.real(self.name, value))
        cosine, sine = _padded(wave.cosine, k), _padded(wave.sine, k)
        cosine[k - 1], sine[k - 1] = pair
        return self.with_wave(scene, TravellingWave(cosine, sine, wave.count, wave.period, wave.mean))

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        return Direction((Harmonic(self.harmonic, *self.slope(*self.pair(scene))),))

    def pair(self, scene: Scene) -> tuple[float, float]:
        """Amplitudes of its cosine and sine."""
        wave, k = self.wave(scene), self.harmonic
        cosine, sine = (float(_padded(part, k)[k - 1]) for part in (wave.cosine, wave.sine))
        return cosine, sine

    @abstractmethod
    def number(self, cosine: float, sine: float) -> float:
        """The number, from the amplitudes."""

    @abstractmethod
    def with_number(self, cosine: float, sine: float, value: float) -> tuple[float, float]:
        """Amplitudes with another number."""

    @abstractmethod
    def slope(self, cosine: float, sine: float) -> tuple[float, float]:
        """What the amplitudes change by per unit of the number."""


@dataclass(frozen=True)
class Cosine(OfHarmonic):
    """The amplitude of cos(k phi)."""

    field = "cosine"

    def number(self, cosine: float, sine: float) -> float:
        """See OfHarmonic."""
        return cosine

    def with_number(self, cosine: float, sine: float, value: float) -> tuple[float, float]:
        """See OfHarmonic."""
        return value, sine

    def slope(self, cosine: float, sine: float) -> tuple[float, float]:
        """See OfHarmonic."""
        return 1.0, 0.0


@dataclass(frozen=True)
class Sine(OfHarmonic):
    """The amplitude of sin(k phi)."""

    field = "sine"

    def number(self, cosine: float, sine: float) -> float:
        """See OfHarmonic."""
        return sine

    def with_number(self, cosine: float, sine: float, value: float) -> tuple[float, float]:
        """See OfHarmonic."""
        return cosine, value

    def slope(self, cosine: float, sine: float) -> tuple[float, float]:
        """See OfHarmonic."""
        return 0.0, 1.0


@dataclass(frozen=True)
class Amplitude(OfHarmonic):
    """The a in a cos(k phi - psi), > 0."""

    field = "amplitude"

    def number(self, cosine: float, sine: float) -> float:
        """See OfHarmonic."""
        return math.hypot(cosine, sine)

    def with_number(self, cosine: float, sine: float, value: float) -> tuple[float, float]:
        """See OfHarmonic."""
        along = self.slope(cosine, sine)
        return value * along[0], value * along[1]

    def slope(self, cosine: float, sine: float) -> tuple[float, float]:
        """Raises ValueError for an amplitude of 0, which has no phase."""
        size = math.hypot(cosine, sine)
        if size == 0:
            k = self.harmonic - 1
            raise ValueError(
                f"over = {self.name!r}: the amplitude must not be 0, for it has no phase then; "
                f"use 'wave.cosine.{k}' and 'wave.sine.{k}'"
            )
        return cosine / size, sine / size


@dataclass(frozen=True)
class Phase(OfHarmonic):
    """The psi in a cos(k phi - psi), radians."""

    field = "phase"

    def number(self, cosine: float, sine: float) -> float:
        """See OfHarmonic."""
        return math.atan2(sine, cosine)

    def with_number(self, cosine: float, sine: float, value: float) -> tuple[float, float]:
        """See OfHarmonic."""
        size = math.hypot(cosine, sine)
        return size * math.cos(value), size * math.sin(value)

    def slope(self, cosine: float, sine: float) -> tuple[float, float]:
        """See OfHarmonic."""
        return -sine, cosine


@dataclass(frozen=True)
class Mean(OfWave):
    """The mean of the wave over a wavelength."""

    name = "wave.mean"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return self.wave(scene).mean

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        wave = self.wave(scene)
        changed = TravellingWave(wave.cosine, wave.sine, wave.count, wave.period, value)
        return self.with_wave(scene, changed)

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        self.wave(scene)
        return Direction((Harmonic(0, 1.0),))


@dataclass(frozen=True)
class Period(OfWave):
    """The period, in the time of which everything goes but the law of friction."""

    name = "wave.period"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return self.wave(scene).period

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return self.with_wave(scene, replace(self.wave(scene), period=value))

    def direction(self, scene: Scene) -> Direction:
        """Raises ValueError for a map of friction that has the period of the wave."""
        friction = scene.contact.friction.map
        if friction is not None and friction.kinetic:
            raise ValueError(f"over = {self.name!r}: the map of friction must not depend on time")
        return Direction(period=1 / self.value(scene))


@dataclass(frozen=True)
class Count(OfWave):
    """The number of waves on the sheet, which need not be whole: L over the wavelength.

    The speed of the wave, wavelength over period, changes with it.
    """

    name = "wave.count"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        self.wave(scene)
        return count_of(scene.wave)

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        wave, count = self.wave(scene), validation.real(self.name, value)
        if count.is_integer():
            return scene.but(wave=TravellingWave(wave.cosine, wave.sine, int(count), *_rest(wave)))
        return scene.but(wave=FractionalWave(wave, count))

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        wave, count, length = self.wave(scene), self.value(scene), scene.sheet.length
        k = wave.harmonics
        slope = TravellingWave(k * wave.sine, -k * wave.cosine, 1, wave.period)
        frequency = 2 * np.pi / wave.period

        def phase(y: Array, t: Array) -> Array:
            return 2 * np.pi * count * y / length - frequency * t

        def value(x: Array, y: Array, t: Array) -> Array:
            return 2 * np.pi * y / length * slope.profile(phase(y, t))

        def rate(x: Array, y: Array, t: Array) -> Array:
            return -frequency * 2 * np.pi * y / length * slope.profile_slope(phase(y, t))

        return Direction(growth=GrowthChange(value, rate, across=False))


def _rest(wave: TravellingWave) -> tuple[float, float]:
    return wave.period, wave.mean


def _padded(amplitudes: Array, harmonic: int) -> Array:
    """A copy with that many harmonics at least."""
    return np.pad(amplitudes, (0, max(harmonic - amplitudes.size, 0)))

"""A general wave of growth c(x, y, t), given by a function."""

import copy
import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.errors import Unidentifiable
from linear_theory.common.functions import callable_with
from linear_theory.common.shown import Value
from linear_theory.identity import content_key
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import Places
from linear_theory.wave.sampled import SampledDrive

Array = NDArray[np.float64]
Growth = Callable[[Any, Any, Any], ArrayLike]

STEP, HARMONIC = 1 / 512, 10
"""Step of the difference quotient in periods. The relative error of the k-th harmonic in time is about
(2 pi k STEP)**8 / 630 (4e-11 at k = HARMONIC); roundoff adds 1e-14 of the fundamental's rate."""

FINE_SHARES = 1e-6, 1e-4
"""Fraction of dc/dt that may lie in harmonics beyond the accuracy of a rate by differences: the first
value if that fraction is known; a wave with kinks satisfies neither."""

DIFFERENCE = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
"""Weights of (c(t + j h) - c(t - j h))/h in the central difference of eighth order."""


class FieldWave(Value):
    """c(x, y, t) = value(x, y, t) in the coordinates of the sheet (origin at its centre).

    value: function of arrays x, y (units of length) and t that broadcast; returns c, dimensionless, of
    their common shape (or one that broadcasts to it). period: time after which c repeats. rate: dc/dt,
    same arguments; by default a central difference of eighth order (see STEP), whose step solvers
    reduce for waves with high harmonics. Solvers refuse a wave that does not repeat after its period,
    and a rate that is not the derivative of value. name: identifies the functions, for instance in a
    snapshot of a run, where their code cannot (see `identity.content_key`); different functions must
    have different names.

    Waves are equal if their periods are equal and their functions have the same content or the same
    name; a function that cannot be identified by its content is equal only to itself.

    Raises ValueError for a period that is not finite and positive, a value or rate that is no function
    of three arguments, a name that is not text, and, when they are called, for results that are not
    finite, real and of that shape.

    >>> import numpy as np
    >>> from linear_theory import FieldWave
    >>> oblique = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), period=1.0)
    >>> print(oblique.rate(x=0.0, y=[0.0, 0.5], t=0.0).round(6))  # -2 pi cos 2 pi (x + y - t)
    [-6.283185  6.283185]
    """

    def __init__(
        self, value: Growth, period: float, rate: Growth | None = None, *, name: str | None = None
    ) -> None:
        self._value = callable_with("value", value, "(x, y, t)", 3)
        self._rate = None if rate is None else callable_with("rate", rate, "(x, y, t)", 3)
        self._period = validation.positive("period", period)
        self._step = STEP
        self.name = None if name is None else validation.label("name", name)

    def identified_by(self) -> object:
        """The content from which its key is computed."""
        functions = (self._value, self._rate) if self.name is None else self.name
        return functions, self.period

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, FieldWave):
            return NotImplemented
        if self is other:
            return True
        try:
            return hash(self) == hash(other) and content_key(self) == content_key(other)
        except Unidentifiable:
            return False

    def __hash__(self) -> int:
        """Hash without the functions, whose content changes with the arrays and names they read."""
        return hash((self.period, self.name))

    def _contents(self) -> Mapping[str, Any]:
        known = {"value": self._value, "period": self.period}
        if self._rate is not None:
            known["rate"] = self._rate
        return known if self.name is None else {**known, "name": self.name}

    @property
    def differenced(self) -> bool:
        """Whether the rate is computed by differences of values."""
        return self._rate is None

    def resolving(self, harmonic: float) -> "FieldWave":
        """The same wave, with the rate as accurate up to this harmonic as by default up to HARMONIC."""
        if not self.differenced or harmonic <= HARMONIC:
            return self
        finer = FieldWave(self._value, self._period, name=self.name)
        finer._step = STEP * HARMONIC / harmonic
        return finer

    def on(self, sheet: Sheet, places: Places | None = None) -> "FieldDrive":
        """The wave on a body within that rectangle; places: points of its outline, see `Wave`."""
        return FieldDrive(self, sheet, places)

    @property
    def period(self) -> float:
        """Units of time."""
        return self._period

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The function is in units of length: `length` has no effect."""
        return _evaluate("value", self._value, x, y, t)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt; x, y, t broadcast. `length` has no effect."""
        if self._rate is not None:
            return _evaluate("rate", self._rate, x, y, t)
        t = validation.real_array("t", t)
        step = self._step * self.period
        total: Array = np.zeros(())
        for j, weight in DIFFERENCE.items():
            ahead = self.value(x, y, t + j * step)
            total = total + weight * (ahead - self.value(x, y, t - j * step))
        return np.asarray(total / step)


class FieldDrive(SampledDrive):
    """A general wave on a body; returned by `FieldWave.on`. Differences have the default step."""

    wave: FieldWave

    @cached_property
    def fine(self) -> "FieldDrive":
        """The drive with the step of a rate by differences adapted to the harmonics of the wave."""
        if not self.wave.differenced:
            return self
        known = [h for h in map(self.rates.highest, FINE_SHARES) if h < math.inf]
        finer = copy.copy(self)  # with the cached samples of the values, which are the same
        finer.wave = self.wave.resolving(known[0]) if known else self.wave
        return finer

    def _check_rate(self) -> None:
        if not self.wave.differenced:
            super()._check_rate()


def _evaluate(name: str, function: Growth, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
    points = [validation.real_array(n, v) for n, v in (("x", x), ("y", y), ("t", t))]
    result = validation.real_array(f"{name}(x, y, t)", function(*points))
    shape = np.broadcast_shapes(*(p.shape for p in points))
    try:
        return np.array(np.broadcast_to(result, shape))
    except ValueError:
        raise ValueError(
            f"{name}(x, y, t) has shape {result.shape}: must broadcast to that of the points, {shape}"
        ) from None

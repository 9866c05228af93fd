"""States from which an excitable wave starts: c and w at time 0, as plain data."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


class Start(Value, ABC):
    """c and w at time 0. depends_on_x: whether they vary across the body.

    `values` takes points x, y (n,) in the coordinates of the sheet, with the lengths of the body along
    y and across, and returns c and w, (n,) each. Lengths that a start is given are in units of length.
    """

    depends_on_x: bool = False
    sizes: ClassVar[tuple[str, ...]] = ()

    def scaled(self, factor: float) -> Self:
        """The same with all its lengths, the fields `sizes`, times a factor."""
        return replace(self, **{n: factor * getattr(self, n) for n in self.sizes})  # type: ignore

    @abstractmethod
    def values(self, x: Array, y: Array, length: float, width: float) -> tuple[Array, Array]:
        """c and w at points of the body."""


@dataclass(frozen=True)
class RationalStart(Start):
    """c = s²/(1 + s²), w = 0, with s = (y - y_0)/scale: the start of the paper (section 3.2).

    origin: y_0 as a fraction of the length of the body, from its centre: -0.5 is the rear end, from
    which a phase wave runs towards +y; at 0 the start is mirror symmetric and so is all that follows.
    scale: unit of length in which the paper's s is measured.

    >>> import numpy as np
    >>> from fem_check.excitable import RationalStart
    >>> y = np.array([-0.5, 0.0, 0.5])
    >>> print(RationalStart().values(0 * y, y, length=1.0, width=0.5)[0])
    [0.  0.2 0.5]
    """

    origin: float = -0.5
    scale: float = 1.0
    sizes = ("scale",)

    def __post_init__(self) -> None:
        validation.real("origin", self.origin)
        validation.positive("scale", self.scale)

    def values(self, x: Array, y: Array, length: float, width: float) -> tuple[Array, Array]:
        """See `Start`."""
        square = ((y - self.origin * length) / self.scale) ** 2
        return square / (1 + square), np.zeros_like(y)


@dataclass(frozen=True)
class UniformStart(Start):
    """c and w the same everywhere; (0, 0) is the state of rest."""

    c: float = 0.0
    w: float = 0.0

    def __post_init__(self) -> None:
        validation.real("c", self.c)
        validation.real("w", self.w)

    def values(self, x: Array, y: Array, length: float, width: float) -> tuple[Array, Array]:
        """See `Start`."""
        return np.full_like(y, self.c), np.full_like(y, self.w)


@dataclass(frozen=True)
class BumpStart(Start):
    """At rest but for c = height exp(-(distance/radius)²) around a point; a pulse runs from it.

    position: (x, y) of the point as fractions of width and length, from the centre; x = None for a bump
    all across the body.
    """

    height: float = 1.0
    radius: float = 0.1
    position: tuple[float | None, float] = (None, -0.5)
    sizes = ("radius",)

    def __post_init__(self) -> None:
        validation.real("height", self.height)
        validation.positive("radius", self.radius)
        x, y = self.position
        x = None if x is None else validation.real("position[0]", x)
        object.__setattr__(self, "position", (x, validation.real("position[1]", y)))

    @property
    def depends_on_x(self) -> bool:  # type: ignore[override]
        """Whether the bump is around a point, not a line across."""
        return self.position[0] is not None

    def values(self, x: Array, y: Array, length: float, width: float) -> tuple[Array, Array]:
        """See `Start`."""
        across, along = self.position
        square = (y - along * length) ** 2
        if across is not None:
            square = square + (x - across * width) ** 2
        return self.height * np.exp(-square / self.radius**2), np.zeros_like(y)


@dataclass(frozen=True)
class CrossedStart(Start):
    """c rises across and w along the body, so that the phase winds round the centre: a spiral forms.

    c: from -c_size to c_size over a smooth step of that width around x = 0; w likewise around y = 0.
    """

    c_size: float = 0.5
    w_size: float = 0.1
    step: float = 0.1
    depends_on_x = True
    sizes = ("step",)

    def __post_init__(self) -> None:
        for name in ("c_size", "w_size"):
            validation.real(name, getattr(self, name))
        validation.positive("step", self.step)

    def values(self, x: Array, y: Array, length: float, width: float) -> tuple[Array, Array]:
        """See `Start`."""
        return self.c_size * np.tanh(x / self.step), self.w_size * np.tanh(y / self.step)


@dataclass(frozen=True)
class Pacing(Value):
    """A stimulus that repeats: strength exp(-(distance/reach)²) p(t/period) is added to dc/dt.

    distance: along y from the rear end of the body (from the front end if `front`). p rises to 1 once
    per period for a time of about `duration`, p = exp(-(sin(pi t/period - pi/4)/width)²) with width =
    pi duration/(2 period), which is analytic.
    """

    period: float
    strength: float = 0.3
    duration: float = 8.0
    reach: float = 0.1
    front: bool = False

    def scaled(self, factor: float) -> "Pacing":
        """The same with its reach times a factor."""
        return replace(self, reach=factor * self.reach)

    def __post_init__(self) -> None:
        for name in ("period", "duration", "reach"):
            validation.positive(name, getattr(self, name))
        validation.real("strength", self.strength)
        object.__setattr__(self, "front", validation.flag("front", self.front))
        if self.duration > self.period / 2:
            raise ValueError(
                f"duration = {self.duration:g}: must be at most half of the period, {self.period / 2:g}"
            )

    def profile(self, y: Array, length: float) -> Array:
        """Strength of the stimulus at points of the body."""
        end = length / 2 if self.front else -length / 2
        return np.asarray(self.strength * np.exp(-(((y - end) / self.reach) ** 2)))

    def course(self, t: float | Array) -> Array:
        """p at times."""
        return np.asarray(np.exp(-((np.sin(self._angle(t)) / self._width) ** 2)))

    def change(self, t: float | Array) -> Array:
        """dp/dt at times."""
        angle = self._angle(t)
        slope = -np.sin(2 * angle) / self._width**2 * math.pi / self.period
        return np.asarray(slope * self.course(t))

    @property
    def _width(self) -> float:
        return math.pi * self.duration / (2 * self.period)

    def _angle(self, t: float | Array) -> Array:
        return np.asarray(math.pi * np.asarray(t) / self.period - math.pi / 4)

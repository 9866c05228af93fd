"""Friction that differs from place to place: maps of mu on the body or on the ground.

A map multiplies the coefficient of a law, and hence its potential, at each point: at the material point
(x, y) of the undeformed sheet for a map fixed to the body, at the place on the ground for one fixed to
that. "Static" maps stay as they are; "kinetic" ones, on the body, also change with the wave, as feet
that grip in turn do.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.functions import callable_with
from linear_theory.common.shown import Value
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.wrapped import Wrapped

Array = NDArray[np.float64]

REPEATS = 1e-9
"""Relative difference up to which a kinetic map is the same after a period."""


EDGE_CELLS = (-2.0, -1.0, 0.0, 1.0, 2.0)
"""Ends of the cells across the edge of a patch, in its width: beyond, the step is complete to 3e-4."""

PATCHES = "must be a list of (x_min, x_max, y_min, y_max, mu) with x_min < x_max, y_min < y_max, mu > 0"


class FixedTo(StrEnum):
    """What the axes of a law, or a map of friction, move with."""

    BODY = "body"
    GROUND = "ground"

    @classmethod
    def named(cls, value: object) -> "FixedTo":
        """That of a name. Raises ValueError for another one."""
        return cls(validation.choice("fixed_to", value, tuple(cls)))


class FrictionMap(Value, ABC):
    """mu(x, y), or mu(x, y, t), over the mu of a law.

    fixed_to: what x and y belong to. kinetic: whether it depends on t, with the period of the wave.
    mirrored: whether mu(-x, y) = mu(x, y), which is not assumed otherwise.
    """

    fixed_to: FixedTo
    kinetic: bool = False
    mirrored: bool = False

    @abstractmethod
    def mu(self, x: Array, y: Array, t: ArrayLike) -> Array:
        """Its values, unchecked."""

    @property
    def creases(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """x and y of lines to cut cells along, so that the map is smooth on each; empty if unknown."""
        return (), ()

    def values(self, x: ArrayLike, y: ArrayLike, t: ArrayLike = 0.0) -> Array:
        """At points and times that broadcast.

        Raises ValueError, naming the map, unless it gives a number for each, > 0, and with the place of
        one that is not.
        """
        x, y = np.asarray(x, float), np.asarray(y, float)
        shape = np.broadcast_shapes(x.shape, y.shape, np.shape(t) if self.kinetic else ())
        try:
            given = validation.real_array("mu", self.mu(x, y, t))
        except Exception as problem:  # whatever a given function may raise
            words = (
                str(problem) if type(problem) is ValueError else f"{type(problem).__name__}: {problem}"
            )
            raise ValueError(f"map = {validation.shown(self)}: must give mu > 0; {words}") from problem
        try:
            found = np.broadcast_to(given, shape)
        except ValueError:
            raise ValueError(
                f"map = {validation.shown(self)}: gives mu of shape {given.shape}, must be one that "
                f"broadcasts to that of x and y, {shape}"
            ) from None
        if found.size and found.min() <= 0:
            worst = np.unravel_index(found.argmin(), found.shape)
            at_x, at_y = (np.broadcast_to(p, found.shape)[worst] for p in (x, y))
            raise ValueError(
                f"map = {validation.shown(self)}: mu = {found[worst]:.4g} at x = {at_x:.4g}, y = "
                f"{at_y:.4g}; must be > 0 everywhere"
            )
        return found

    def check_period(self, period: float, x: Array, y: Array) -> None:
        """Raise ValueError for a kinetic map that is not the same one period of the wave later."""
        if not self.kinetic:
            return
        for t in (0.13 * period, 0.61 * period):
            now, later = self.values(x, y, t), self.values(x, y, t + period)
            if abs(later - now).max() > REPEATS * now.max():
                raise ValueError(
                    f"map = {validation.shown(self)}: must be the same after the period of the wave, "
                    f"{period:g}, and differs by {abs(later - now).max():.2g} at t = {t:.3g}"
                )


@dataclass(frozen=True)
class Patches(FrictionMap):
    """Rectangular patches with soft edges.

    patches: of (x_min, x_max, y_min, y_max, mu) each, lengths; later ones lie over earlier ones.
    outside: mu elsewhere. edge: length over which mu changes, > 0. fixed_to: "body" or "ground".
    Raises ValueError for a patch without area and for a mu or an edge that is not positive.

    >>> from linear_theory import Coulomb, Mapped, Patches, Sheet, SineWave, crawl_speed
    >>> rear = Patches([(-1, 1, -1, -0.25, 3.0)], edge=0.02)
    >>> found = crawl_speed(Sheet(), SineWave(), 0.1, friction=Mapped(Coulomb(), rear), rtol=1e-2)
    >>> print(f"V = {found.mean:.3f} L/T")
    V = 0.013 L/T
    """

    patches: tuple[tuple[float, ...], ...]
    edge: float
    outside: float = 1.0
    fixed_to: FixedTo = FixedTo.BODY

    def __init__(
        self,
        patches: Sequence[Sequence[float]],
        edge: float,
        outside: float = 1.0,
        fixed_to: FixedTo | str = FixedTo.BODY,
    ) -> None:
        checked = tuple(_patch(i, patch) for i, patch in enumerate(_listed(patches)))
        object.__setattr__(self, "patches", checked)
        for name, value in {"edge": edge, "outside": outside}.items():
            object.__setattr__(self, name, validation.positive(name, value))
        object.__setattr__(self, "fixed_to", FixedTo.named(fixed_to))

    @property
    def mirrored(self) -> bool:  # type: ignore[override]
        """Whether each patch is its own mirror image."""
        return all(patch[0] == -patch[1] for patch in self.patches)

    @property
    def creases(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """See FrictionMap."""
        steps = [self.edge * k for k in EDGE_CELLS]
        sides = zip(*(patch[:4] for patch in self.patches), strict=True)
        x_min, x_max, y_min, y_max = sides if self.patches else ((),) * 4
        return tuple(
            tuple(sorted({end + step for end in ends for step in steps}))
            for ends in ((*x_min, *x_max), (*y_min, *y_max))
        )  # type: ignore[return-value]

    def mu(self, x: Array, y: Array, t: ArrayLike) -> Array:
        """See FrictionMap."""
        found = np.full(np.broadcast_shapes(x.shape, y.shape), self.outside)
        for x_min, x_max, y_min, y_max, mu in self.patches:
            inside = self._between(x, x_min, x_max) * self._between(y, y_min, y_max)
            found = found + (mu - found) * inside
        return found

    def _between(self, place: Array, low: float, high: float) -> Array:
        """1 inside, 0 outside."""
        first, last = (np.tanh(2 * (place - end) / self.edge) for end in (low, high))
        return np.asarray((first - last) / 2)


@dataclass(frozen=True)
class GivenMap(FrictionMap):
    """Any function mu(x, y), or mu(x, y, t) if it is kinetic, of arrays that broadcast.

    fixed_to: "body" or "ground", the latter for maps that are not kinetic. mirrored: whether mu(-x, y)
    = mu(x, y), which halves the work for symmetric waves. A kinetic map has the period of the wave.
    creases: x and y of lines, such as those on which it jumps, that theory cuts its cells along;
    without them such a map converges slowly, and errors say so.
    Raises ValueError for no function of those arguments and for flags that are not bool; and where it
    is used, naming the map, if the function raises or its shape is wrong, and with the place unless
    mu > 0.

    >>> import numpy as np
    >>> from linear_theory import GivenMap
    >>> feet = GivenMap(lambda x, y, t: 1 + 0.5 * np.sin(2 * np.pi * (y - t)), kinetic=True)
    >>> print(feet.values(0.0, [0.0, 0.25], 0.0))
    [1.  1.5]
    """

    function: Callable[..., Any]
    fixed_to: FixedTo = FixedTo.BODY
    kinetic: bool = False
    mirrored: bool = False
    creases: tuple[tuple[float, ...], tuple[float, ...]] = ((), ())

    def __post_init__(self) -> None:
        for name in ("kinetic", "mirrored"):
            object.__setattr__(self, name, validation.flag(name, getattr(self, name)))
        signature, count = ("(x, y, t)", 3) if self.kinetic else ("(x, y)", 2)
        hint = "as the map is kinetic" if self.kinetic else "and t if kinetic = True"
        callable_with("function", self.function, signature, count, hint)
        object.__setattr__(self, "fixed_to", FixedTo.named(self.fixed_to))
        object.__setattr__(self, "creases", _lines(self.creases))
        if self.kinetic and self.fixed_to is FixedTo.GROUND:
            raise ValueError("kinetic = True: must be False for a map that is fixed to the ground")

    def mu(self, x: Array, y: Array, t: ArrayLike) -> Array:
        """See FrictionMap."""
        return np.asarray(self.function(x, y, t) if self.kinetic else self.function(x, y))


def _lines(creases: Any) -> tuple[tuple[float, ...], ...]:
    """x and y of lines, checked."""
    if not _is_list(creases) or len(creases) != len("xy") or not all(map(_is_list, creases)):
        raise ValueError(
            f"creases = {validation.shown(creases)}: must be two lists of numbers, x and y"
        )
    places = (validation.real_array("creases", list(one)) for one in creases)
    return tuple(tuple(np.ravel(one).tolist()) for one in places)


def _is_list(value: Any) -> bool:
    """Whether it is a list of any kind, no text."""
    if isinstance(value, np.ndarray):
        return value.ndim > 0
    return isinstance(value, Sequence) and not isinstance(value, str | bytes)


def _listed(patches: Any) -> Any:
    """The patches, if they are a list of any kind."""
    if not _is_list(patches):
        raise ValueError(f"patches = {validation.shown(patches)}: {PATCHES}")
    return patches


def _patch(number: int, patch: Sequence[float]) -> tuple[float, ...]:
    name = f"patches[{number}]"
    found = validation.real_array(name, patch)
    if found.shape != (5,):
        raise ValueError(f"{name} = {validation.shown(patch)}: must be x_min, x_max, y_min, y_max, mu")
    if not (found[0] < found[1] and found[2] < found[3]):
        raise ValueError(f"{name} = {validation.shown(patch)}: must have x_min < x_max, y_min < y_max")
    if not found[4] > 0:
        raise ValueError(f"{name} = {validation.shown(patch)}: mu must be > 0")
    return tuple(found.tolist())


@dataclass(frozen=True)
class Mapped(Wrapped):
    """A law whose coefficient differs from place to place by a map.

    law: any law but a mapped one, or one on the lower face, which is around the mapped one instead;
    map: `Patches` or a `GivenMap`. Raises ValueError for anything else.
    Its methods are those of the law, as where the map is 1.

    >>> from linear_theory import Coulomb, Directional, Mapped, Patches
    >>> rear = Patches([(-0.3, 0.3, -0.5, 0.0, 2.0)], edge=0.02)
    >>> print(Mapped(Directional(0.5, 1.5, form=Coulomb()), rear).words)
    dry friction times 0.5 forward, 1.5 backward, 1 sideways, fixed to the body, times a map on the body
    """

    map: FrictionMap  # type: ignore[misc]  # None of laws without one, in their class
    name: ClassVar[str] = "mapped"

    def __post_init__(self) -> None:
        validation.instance("law", self.law, FrictionLaw)  # type: ignore[type-abstract]
        validation.instance("map", self.map, FrictionMap)  # type: ignore[type-abstract]
        if self.law.map is not None:
            raise ValueError(f"law = {validation.shown(self.law)}: must be a law without a map")
        if self.law.on_lower_face:
            raise ValueError(
                f"law = {validation.shown(self.law)}: must be a law on the mid-surface; write "
                "OnLowerFace(Mapped(law, map))"
            )

    @property
    def mirrored(self) -> bool:
        """See FrictionLaw; law and map."""
        return self.law.mirrored and self.map.mirrored

    @property
    def reversible(self) -> bool:
        """See FrictionLaw; not if the map is kinetic, as the other half of the period has another."""
        return self.law.reversible and not self.map.kinetic

    @property
    def words(self) -> str:
        """See FrictionLaw."""
        return f"{self.law.words}, times a map on the {self.map.fixed_to}"

    @property
    def details(self) -> str:
        """See FrictionLaw."""
        return ", ".join(filter(None, [self.law.details, f"with a map on the {self.map.fixed_to}"]))

    def around(self, law: FrictionLaw) -> "Mapped":
        """See Wrapped."""
        return Mapped(law, self.map)

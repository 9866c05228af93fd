"""Friction with a direction: easy forward, hard backward, as of bristles, scales and ratchets.

In the axes of the law, s sideways and n forward, slip v has the gauge

    phi(v) = [(m_s v_s)^2 + (m_n v_n)^2]^(1/2),    m_n = forward for v_n >= 0, else backward,

which is convex, of degree 1, and has a gradient everywhere but at rest; dry friction is that gradient.
The forces it can exert fill two half ellipses with the axis `sideways` in common. With the potential
E(r) of an isotropic law, E(phi(v)) is the potential here: on either side of v_n = 0 it is that of the
isotropic law at the velocity (m_s v_s, m_n v_n), which gives force, tangent and differences.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.pairs import PAIRS, pairs_among
from linear_theory.friction.isotropic import Isotropic, IsotropicResponse, norm
from linear_theory.friction.law import ALL, FrictionLaw, Response
from linear_theory.friction.laws import Coulomb
from linear_theory.friction.maps import FixedTo

Array = NDArray[np.float64]

NEAR_REST = 1e-6
"""Least speed on the way, relative to those at its ends, below which forces turn so far that their
difference does not cancel."""

EXTREME = 1e50
"""Bound of the coefficients and of their inverses, so that their squares are numbers."""


@dataclass(frozen=True)
class Directional(FrictionLaw):
    """Friction with one coefficient against forward slip, one against backward and one sideways.

    forward, backward, sideways: > 0, in units of mu; sideways is the mean of the others unless given.
    Slip is towards `heading`, radians anticlockwise from +y, where it is forward. Equal coefficients
    forward and backward give an ellipse of friction. form: a law of the size r of the slip, such as
    `Coulomb()`, `Tanh(v0)` or `Viscous()`: along an axis with the coefficient m the force is m (dry), m
    tanh(m v/v0), m v (viscous). fixed_to: "body" for axes that turn with the sheet as a whole (bristles
    under it), "ground" for those of the ground (fur, grass). Raises ValueError for values out of range.

    >>> import numpy as np
    >>> from linear_theory import Directional, SineWave, line_balance
    >>> law = Directional(forward=0.5, backward=1.5)
    >>> print(law.force(np.array([[0.0, 0.0, 0.2], [0.1, -0.1, 0.0]])))  # forward, backward, sideways
    [[ 0.   0.   1. ]
     [ 0.5 -1.5  0. ]]
    >>> speed = line_balance(SineWave(), alpha=0.1, friction=law)
    >>> print(f"V = {speed.mean:.7f} L/T")
    V = 0.0752137 L/T
    """

    forward: float
    backward: float
    sideways: float | None = None
    heading: float = 0.0
    fixed_to: FixedTo = FixedTo.BODY
    form: Isotropic = field(default_factory=Coulomb)
    name: ClassVar[str] = "directional"

    def __post_init__(self) -> None:
        for name in ("forward", "backward"):
            self._set(name, _coefficient(name, getattr(self, name)))
        sideways = (self.forward + self.backward) / 2 if self.sideways is None else self.sideways
        self._set("sideways", _coefficient("sideways", sideways))
        heading = validation.real("heading", self.heading)
        if abs(heading) > math.pi:
            raise ValueError(f"heading = {heading:g}: must be from -pi to pi, radians")
        self._set("heading", heading)
        self._set("fixed_to", FixedTo.named(self.fixed_to))
        validation.instance("form", self.form, Isotropic)  # type: ignore[type-abstract]

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)

    @property
    def even(self) -> bool:
        """See FrictionLaw."""
        return self.mirrored and self.reversible

    @property
    def mirrored(self) -> bool:
        """See FrictionLaw."""
        return self.heading == 0 or self._is_isotropic

    @property
    def reversible(self) -> bool:
        """See FrictionLaw."""
        return self.forward == self.backward

    @property
    def _is_isotropic(self) -> bool:
        return self.forward == self.backward == self.sideways

    @property
    def crease(self) -> tuple[float, float] | None:
        """See FrictionLaw."""
        return None if self.reversible else (-math.sin(self.heading), math.cos(self.heading))

    @property
    def follows_body(self) -> bool:
        """See FrictionLaw."""
        return self.fixed_to is FixedTo.BODY and not self._is_isotropic

    @property
    def follows_ground(self) -> bool:
        """See FrictionLaw."""
        return self.fixed_to is FixedTo.GROUND and not self._is_isotropic

    @property
    def opposite(self) -> "Directional":
        """See FrictionLaw."""
        return replace(self, forward=self.backward, backward=self.forward)

    @property
    def width(self) -> float:
        """See FrictionLaw."""
        return self.form.width / max(self.factors)

    @property
    def words(self) -> str:
        """See FrictionLaw."""
        return f"{self.form.words} times {self.details}"

    @property
    def details(self) -> str:
        """See FrictionLaw."""
        turned = f", heading {math.degrees(self.heading):.4g} deg" if self.heading else ""
        along = f"{self.forward:g} forward, {self.backward:g} backward"
        return f"{along}, {self.sideways:g} sideways{turned}, fixed to the {self.fixed_to}"

    @property
    def formula(self) -> str:
        """See FrictionLaw."""
        return f"{self.form.formula} with a direction"

    @cached_property
    def factors(self) -> tuple[float, float, float]:
        """m of sideways, forward and backward slip, by which velocities are multiplied.

        Roots of the coefficients for viscous friction, whose force is of degree 1 in v.
        """
        assert self.sideways is not None
        given = (self.sideways, self.forward, self.backward)
        return given if self.form.limited else tuple(math.sqrt(m) for m in given)  # type: ignore[return-value]

    @property
    def limits(self) -> tuple[float, float]:
        """See FrictionLaw."""
        if not self.form.limited:
            return math.inf, math.inf
        return 1 / self._polar(-1.0), 1 / self._polar(1.0)

    def creep(self, force: float) -> float:
        """See FrictionLaw."""
        share = self._polar(force)
        return self.form.speed_at(share) * share / force if force else 0.0

    def speed_at(self, share: float) -> float:
        """See FrictionLaw."""
        return self.creep(share)

    def _polar(self, force: float) -> float:
        """The smallest factor of the set of forces whose multiple contains a force along y."""
        sideways, forward, backward = self.factors
        along = force * math.cos(self.heading)
        return math.hypot(
            force * math.sin(self.heading) / sideways, along / (forward if along >= 0 else backward)
        )

    def scaled(self, factor: float) -> "Directional":
        """See FrictionLaw."""
        return replace(self, form=self.form.scaled(factor))  # type: ignore[arg-type]

    def gauge(self, v: Array) -> Array:
        """phi of velocities (components, ...), in their unit."""
        return norm(self.at(v).stretched)

    def potential(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.form.potential(self.at(v).stretched)

    def force(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.at(v).force

    def tangent(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.at(v).tangent

    def force_difference(self, v: Array, change: Array, step: float) -> Array:
        """See FrictionLaw."""
        return self.at(v).moved(change, step)[1]

    def at(self, v: Array, kept: slice = ALL) -> "DirectionalResponse":
        """See FrictionLaw."""
        return DirectionalResponse(self, v, kept)

    @cached_property
    def _turn(self) -> tuple[float, float] | None:
        """Cosine and sine of the heading; None along y."""
        return None if self.heading == 0 else (math.cos(self.heading), math.sin(self.heading))

    def in_axes(self, v: Array) -> Array:
        """Vectors (components, ...) in the axes of the law."""
        if self._turn is None:
            return v
        cosine, sine = self._turn
        x, y = self._plane(v)
        return np.stack([cosine * x + sine * y, cosine * y - sine * x, *v[2:]])

    def out_of_axes(self, v: Array) -> Array:
        """The inverse of `in_axes`."""
        if self._turn is None:
            return v
        cosine, sine = self._turn
        x, y = self._plane(v)
        return np.stack([cosine * x - sine * y, cosine * y + sine * x, *v[2:]])

    def _plane(self, v: Array) -> Array:
        if len(v) == 1:
            raise ValueError(f"heading = {self.heading:g}: must be 0 on a line, which has no sides")
        return v[:2]


class DirectionalResponse(Response):
    """See Response; solved by an isotropic law at `stretched` velocities."""

    law: Directional

    @cached_property
    def axial(self) -> Array:
        """v in the axes of the law."""
        return self.law.in_axes(self.v)

    @cached_property
    def factors(self) -> list[float | Array]:
        """m of each component."""
        sideways, forward, backward = self.law.factors
        count = len(self.v)
        ahead = self.axial[-1 if count == 1 else 1]
        own: float | Array = forward
        if forward != backward:
            own = np.where(ahead < 0, backward, forward)
        return [own] if count == 1 else [sideways, own, *[sideways] * (count - 2)]

    @cached_property
    def stretched(self) -> Array:
        """(m_s v_s, m_n v_n)."""
        return self.stretch(self.axial)

    def stretch(self, v: Array) -> Array:
        """Vectors in the axes of the law times m, component by component."""
        return _times(self.factors, v)

    @cached_property
    def inner(self) -> IsotropicResponse:
        """The isotropic law there."""
        return self.law.form.at(self.stretched, ALL if self.law.heading else self.kept)

    def _forces(self, inner: Array) -> Array:
        """Of forces of the isotropic law, kept components, those of this law."""
        if self.law.heading == 0:
            return _times(self.factors[self.kept], inner)
        return self.law.out_of_axes(self.stretch(inner))[self.kept]

    @cached_property
    def force(self) -> Array:
        """See FrictionLaw."""
        return self._forces(self.inner.force)

    @cached_property
    def tangent(self) -> Array:
        """See FrictionLaw."""
        inner, count = self.inner.tangent, len(self.v)
        kept = self.factors if self.law.heading else self.factors[self.kept]
        found = _times([kept[c] * kept[d] for c, d in zip(*PAIRS[len(kept)], strict=True)], inner)
        if self.law.heading == 0:
            return found
        return _turned(found, count, *self.law._turn)[pairs_among(count, self.kept)]  # type: ignore[misc]

    def moved(self, change: Array, step: float) -> "tuple[DirectionalResponse, Array]":
        """See Response.

        Where v crosses v_n = 0 on its way the difference is that of the two parts of the way.
        """
        after = self.law.at(self.v + step * change, self.kept)
        with np.errstate(all="ignore"):  # where it crosses, below
            way = self.stretch(self.law.in_axes(change))
            found = self._forces(self.inner.difference(after.inner, way, step))
        ends = self.factors[0 if len(self.v) == 1 else 1], after.factors[0 if len(self.v) == 1 else 1]
        crossing = np.broadcast_to(np.not_equal(*ends), self.v.shape[1:])
        if crossing.any():
            found[:, crossing] = self._crossing(change[:, crossing], step, crossing)
        return after, found

    def _crossing(self, change: Array, step: float, where: NDArray[np.bool_]) -> Array:
        """Differences of the forces of points that change sides, (kept components, points)."""
        law, start = self.law, self.v[:, where]
        end = start + step * change
        direct = (law.at(end, self.kept).force - law.at(start, self.kept).force) / step
        if len(start) == 1:  # through rest
            return direct
        before, way = law.in_axes(start), law.in_axes(change)
        share = np.clip(-before[1] / (step * way[1]), 0.0, 1.0)
        middle = before + share * step * way
        middle[1] = 0.0
        total = 0.0
        sides = law.at(start), law.at(end)
        for side, first, last, part in (
            (sides[0], before, middle, share),
            (sides[1], middle, before + step * way, 1 - share),
        ):
            length = np.where(part == 0, 1.0, part) * step
            ends = (law.form.at(side.stretch(point)) for point in (first, last))
            one, other = ends
            inner = one.difference(other, side.stretch(way), length)
            total = total + part * np.where(part == 0, 0.0, side.stretch(inner))
        split = law.out_of_axes(np.asarray(total))[self.kept]
        speeds = [norm(v) for v in (before, middle, before + step * way)]
        return np.where(speeds[1] < NEAR_REST * (speeds[0] + speeds[2]), direct, split)


def _times(factors: Sequence[float | Array], values: Array) -> Array:
    """Values (n, ...) times a factor each; np.stack of the products takes twice as long."""
    found = np.empty_like(values)
    for factor, value, out in zip(factors, values, found, strict=True):
        np.multiply(value, factor, out=out)
    return found


def _turned(tangent: Array, count: int, cosine: float, sine: float) -> Array:
    """Tensors (pairs, ...) from axes turned by an angle to those of x and y."""
    turn = np.eye(count)
    turn[:2, :2] = [[cosine, -sine], [sine, cosine]]
    first, second = PAIRS[count]
    full = np.empty((count, count, *tangent.shape[1:]))
    full[first, second] = full[second, first] = tangent
    return np.asarray(np.einsum("ac,cd...,bd->ab...", turn, full, turn)[first, second])


def _coefficient(name: str, value: object) -> float:
    number = validation.positive(name, value)
    if not 1 / EXTREME <= number <= EXTREME:
        raise ValueError(f"{name} = {number:g}: must be from {1 / EXTREME:g} to {EXTREME:g}")
    return number

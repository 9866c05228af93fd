"""Laws of friction that do not depend on direction: the force f(|v|) is opposite to the velocity."""

from abc import abstractmethod
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.pairs import PAIRS
from linear_theory.friction.law import ALL, FrictionLaw, Response

Array = NDArray[np.float64]

TINY = 1e-150
"""Replaces a speed of 0, at which v/|v| is any direction and is taken as 0."""


class Isotropic(FrictionLaw):
    """A law that is given by functions of the speed r = |v| >= 0.

    The force is f(r) v/r; its tangent is f'(r) along v and f(r)/r across. A law of one's own is a
    frozen dataclass with `energy`, `size`, `slope` and `rise`, functions of arrays r, and the `width`,
    `scaled` and `speed_at` of a `FrictionLaw`. Where a scene takes it in they are compared with each
    other. Raises ValueError there, naming the one that is wrong and its numbers.

    >>> import dataclasses
    >>> import numpy as np
    >>> from linear_theory import Contact, Isotropic
    >>> @dataclasses.dataclass(frozen=True)
    ... class Soft(Isotropic):  # f = r/(r^2 + w^2)^(1/2)
    ...     width: float = 0.1
    ...     name = "soft"
    ...
    ...     def energy(self, r):
    ...         return np.hypot(r, self.width) - self.width
    ...
    ...     def size(self, r):
    ...         return r / np.hypot(r, self.width)
    ...
    ...     def slope(self, r):
    ...         return self.width**2 / np.hypot(r, self.width) ** 3
    ...
    ...     def rise(self, before, after, change, step):
    ...         r, s = before.speed, after.speed
    ...         p, q = np.hypot(r, self.width), np.hypot(s, self.width)
    ...         return self.width**2 * change * (r + s) / (p * q * (s * p + r * q))
    ...
    ...     def scaled(self, factor):
    ...         return Soft(self.width / factor)
    ...
    ...     def speed_at(self, share):
    ...         return self.width * share / (1 - share**2) ** 0.5
    >>> law = Contact(friction=Soft(0.3)).friction
    >>> print(law.force(np.array([[0.0], [0.4]])).ravel())
    [0.  0.8]
    """

    @property
    def even(self) -> bool:
        """Always."""
        return True

    @abstractmethod
    def energy(self, r: Array) -> Array:
        """Integral of f from 0 to r."""

    @abstractmethod
    def size(self, r: Array) -> Array:
        """f(r)."""

    @abstractmethod
    def slope(self, r: Array) -> Array:
        """f'(r)."""

    @abstractmethod
    def rise(
        self,
        before: "IsotropicResponse",
        after: "IsotropicResponse",
        change: Array,
        step: float | Array,
    ) -> Array:
        """[f(r') - f(r)]/step without cancellation, for r' = r + step change after and r before."""

    def potential(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.energy(norm(v))

    def force(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.at(v).force

    def tangent(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.at(v).tangent

    def dissipation(self, v: Array) -> Array:
        """See FrictionLaw: f(r) r, a third of the work of force times velocity."""
        r = norm(v)
        return self.size(r) * r

    def force_difference(self, v: Array, change: Array, step: float) -> Array:
        """See FrictionLaw; of dry friction for velocities that are not 0."""
        return self.at(v).moved(change, step)[1]

    def at(self, v: Array, kept: slice = ALL) -> "IsotropicResponse":
        """See FrictionLaw."""
        return IsotropicResponse(self, v, kept)


class IsotropicResponse(Response):
    """See Response."""

    law: Isotropic

    @cached_property
    def speed(self) -> Array:
        """|v|, at least TINY."""
        return np.maximum(norm(self.v), TINY)

    @cached_property
    def direction(self) -> Array:
        """v/|v|, the kept components; 0 at rest."""
        return np.sign(self.v) if len(self.v) == 1 else self.v[self.kept] / self.speed

    @cached_property
    def size(self) -> Array:
        """f(|v|)."""
        return self.law.size(self.speed)

    @cached_property
    def across(self) -> Array:
        """f(|v|)/|v|."""
        return np.asarray(self.size / self.speed)

    @cached_property
    def force(self) -> Array:
        """See FrictionLaw."""
        return np.asarray(self.size * self.direction)

    @cached_property
    def tangent(self) -> Array:
        """See FrictionLaw."""
        along = self.law.slope(self.speed)
        if len(self.v) == 1:
            return along[None]
        excess, n = along - self.across, self.direction
        rows = []
        for c, d in zip(*PAIRS[len(n)], strict=True):
            entry = n[c] * n[d]
            entry *= excess
            if c == d:
                entry += self.across
            rows.append(entry)
        return np.stack(rows)

    def moved(self, change: Array, step: float) -> "tuple[IsotropicResponse, Array]":
        """See Response.

        f' n' - f n = (f' - f) n + f' (n' - n) with n = v/|v|, and |v'| - |v| = step * `drift`.
        """
        after = self.law.at(self.v + step * change, self.kept)
        return after, self.difference(after, change, step)

    def difference(self, after: "IsotropicResponse", change: Array, step: float | Array) -> Array:
        """(force after - force)/step for the law at v + step change, `after`."""
        middle = (self.v + after.v) / (self.speed + after.speed)
        drift = (middle * change).sum(0)
        rise = self.law.rise(self, after, drift, step)
        turn = change[self.kept] - drift * self.direction
        return np.asarray(rise * self.direction + after.across * turn)


def norm(v: Array) -> Array:
    """|v| of vectors (components, ...); np.hypot takes ten times as long."""
    if len(v) == 1:
        return np.asarray(abs(v[0]))
    square: Any = v[0] * v[0]
    for component in v[1:]:
        square += component * component
    return np.asarray(np.sqrt(square))

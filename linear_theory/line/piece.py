"""The stretch of a material element of a one-dimensional body, and the weight (normal load) on it.

Growth gives an element the strain e = alpha c, and the growth law its stretch s(e). The weight on the
element is w = s^p:

    p = 1   on a line, whose load is counted per current length,
    p = 2   on a narrow strip that grows in both directions, whose load is counted per current area,
    p = 0   where weight is conserved.

Everything else about a body at finite strain follows from s and w. This module computes differences
from a strain e_0 without cancellation: w/w_0 - 1 and those of `growth.laws`.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.friction.load import Load
from linear_theory.growth.laws import GrowthLaw, growth_law

Array = NDArray[np.float64]

EXTREME = 100.0
"""Bound of |e| for exp(e), which has none of its own: with e_0 at one end and e at the other, s w/w_0
is e^600, still a double."""

BODIES = {"line": 1, "strip": 2}
"""Powers p of the stretch by which length or area, and hence the load, grows."""


@dataclass(frozen=True)
class Piece:
    """Stretch and weight of a body whose elements have strains `start` + x.

    power: p of the weight s^p.
    """

    law: GrowthLaw
    power: int
    start: float = 0.0

    @classmethod
    def of(cls, law: GrowthLaw | str, load: Load | str, body: str) -> "Piece":
        """The element of a "line" or a "strip". Raises ValueError for unknown names."""
        law, conserved = growth_law(law), Load.named(load) is Load.MATERIAL
        power = BODIES[validation.choice("body", body, BODIES)]
        return cls(law, 0 if conserved else power)

    @property
    def curvature(self) -> float:
        """s_2 in s = 1 + e + s_2 e^2 + ..."""
        return float(self.law.coefficient(2))

    @property
    def extreme(self) -> float:
        """Bound of |e| in addition to those of the law."""
        return EXTREME if math.isinf(self.law.lowest) else math.inf

    def about(self, start: float) -> "Piece":
        """The same element, with differences from the strain `start`."""
        return replace(self, start=start)

    def slope(self, x: ArrayLike) -> Array:
        """ds/de at start + x."""
        return self.law.slope(self.start + np.asarray(x, float))

    def bend(self, x: Array) -> Array:
        """(s - s_0 - s_1 x)/x^2."""
        return self.law.bend(np.asarray(self.start), x)

    def rise(self, x: Array) -> Array:
        """s - s_0."""
        return x * (self.slope(0.0) + x * self.bend(x))

    def gain(self, x: Array) -> Array:
        """w/w_0 - 1, with the sign of x."""
        if self.power == 0:
            return np.zeros_like(x)
        part = self.rise(x) / self.law.stretch(np.asarray(self.start))
        return part if self.power == 1 else part * (2 + part)

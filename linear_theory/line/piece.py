"""The stretch of a piece of a body on a line, and the weight that then rests on it.

Growth gives a piece the strain e = alpha c, and the growth law its stretch s(e). The weight on it is
w = s^p:

    p = 1   on a line, whose load is counted per current length,
    p = 2   on a narrow strip that grows in both directions, whose load is counted per current area,
    p = 0   where weight is conserved.

All else about a body at finite strain follows from s and w. What is asked for here are differences from
a strain e_0, free of cancellation: w/w_0 - 1 and those of `growth.laws`.
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
"""Bound of |e| for a stretch without one, exp(e): with e_0 at one end and e at the other, s w/w_0 is
e^600, still a double."""

BODIES = {"line": 1, "strip": 2}
"""Powers of the stretch by which length or area, and with it the load, grows."""


@dataclass(frozen=True)
class Piece:
    """Stretch and weight of a body whose pieces have strains `start` + x.

    power: p of the weight s^p.
    """

    law: GrowthLaw
    power: int
    start: float = 0.0

    @classmethod
    def of(cls, law: GrowthLaw | str, load: Load | str, body: str) -> "Piece":
        """Of a "line" or a "strip"; raises ValueError for names that do not exist."""
        law, conserved = growth_law(law), Load.named(load) is Load.MATERIAL
        power = BODIES[validation.choice("body", body, BODIES)]
        return cls(law, 0 if conserved else power)

    @property
    def curvature(self) -> float:
        """s_2 of s = 1 + e + s_2 e^2 + ..."""
        return float(self.law.coefficient(2))

    @property
    def extreme(self) -> float:
        """Bound of |e| beyond those of the law."""
        return EXTREME if math.isinf(self.law.lowest) else math.inf

    def about(self, start: float) -> "Piece":
        """The same, with differences from that strain."""
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
        """w/w_0 - 1, of the sign of x."""
        if self.power == 0:
            return np.zeros_like(x)
        part = self.rise(x) / self.law.stretch(np.asarray(self.start))
        return part if self.power == 1 else part * (2 + part)

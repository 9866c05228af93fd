"""How growth stretches a piece of the body, and the weight that then rests on it.

Growth gives a piece the strain e = alpha c, and the growth law its stretch s(e): exp(e), 1 + e or
sqrt(1 + 2 e), alike to first order only. The weight on it is w = s^p:

    p = 1   on a line, whose load is counted per current length,
    p = 2   on a narrow strip that grows in both directions, whose load is counted per current area,
    p = 0   where weight is conserved.

All else about a body at finite strain follows from s and w. Speeds of a sine wave are of order
alpha^2 although stretches are of order alpha: what is asked for here are differences from a strain
e_0, free of cancellation,

    s(e_0 + x) = s_0 + s_1 x + x^2 bend(x),    w/w_0 - 1.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from math import comb, factorial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.friction.law import LOADS

Array = NDArray[np.float64]

EXTREME = 100.0
"""Bound of |e| for exp(e): with e_0 at one end and e at the other, s w/w_0 is e^600, still a double."""

SERIES_TERMS = 19
"""Of exp(x) - 1 - x over x^2 for |x| < 1: the first one left out is 1/21! = 2e-20."""


class StretchLaw(NamedTuple):
    """A stretch s(e): in words, as s(e), its slope s_1(e), bend(e_0, x), and the open range of e.

    coefficient: of e^k in s, exact.
    """

    words: str
    stretch: Callable[[Array], Array]
    slope: Callable[[Array], Array]
    bend: Callable[[Array, Array], Array]
    coefficient: Callable[[int], Fraction]
    lowest: float
    highest: float


def _exp_bend(start: Array, x: Array) -> Array:
    """exp(start) (exp(x) - 1 - x)/x^2."""
    near = abs(x) < 1
    small, large = np.where(near, x, 0.0), np.where(near, 1.0, x)
    series = np.zeros_like(small)
    for k in range(SERIES_TERMS + 1, 1, -1):
        series = (series * small + 1) / k  # 1/2! + x/3! + ... = (1 + (x/3)(1 + ...))/2
    return np.exp(start) * np.where(near, series, (np.expm1(large) - large) / large**2)


def _metric_bend(start: Array, x: Array) -> Array:
    root = np.sqrt(1 + 2 * start)
    return np.asarray(-2 / (root * (root + np.sqrt(1 + 2 * (start + x))) ** 2))


def _root_coefficient(order: int) -> Fraction:
    """Of e^order in (1 + 2 e)^(1/2)."""
    return Fraction((-1) ** (order + 1) * comb(2 * order, order), 2**order * (2 * order - 1))


GROWTH_LAWS = {
    "exp": StretchLaw(
        "exp(alpha c)",
        np.exp,
        np.exp,
        _exp_bend,
        lambda k: Fraction(1, factorial(k)),
        -EXTREME,
        EXTREME,
    ),
    "linear": StretchLaw(
        "1 + alpha c",
        lambda e: 1 + e,
        np.ones_like,
        lambda start, x: np.zeros_like(x),
        lambda k: Fraction(k < 2),
        -1.0,
        np.inf,
    ),
    "metric": StretchLaw(
        "(1 + 2 alpha c)^(1/2)",
        lambda e: np.sqrt(1 + 2 * e),
        lambda e: 1 / np.sqrt(1 + 2 * e),
        _metric_bend,
        _root_coefficient,
        -0.5,
        np.inf,
    ),
}

BODIES = {"line": 1, "strip": 2}
"""Powers of the stretch by which length or area, and with it the load, grows."""


@dataclass(frozen=True)
class Growth:
    """Stretch and weight of a body whose pieces have strains `start` + x.

    growth_law: key of GROWTH_LAWS; power: p of the weight s^p.
    """

    growth_law: str
    power: int
    start: float = 0.0

    @classmethod
    def of(cls, growth_law: str, load: str, body: str) -> "Growth":
        """From names; raises ValueError for those that do not exist."""
        validation.choice("growth_law", growth_law, GROWTH_LAWS)
        grows = validation.choice("load", load, LOADS) != "material"
        power = BODIES[validation.choice("body", body, BODIES)]
        return cls(growth_law, power if grows else 0)

    @property
    def law(self) -> StretchLaw:
        """The stretch as a function of the strain."""
        return GROWTH_LAWS[self.growth_law]

    @property
    def curvature(self) -> float:
        """s_2 of s = 1 + e + s_2 e^2 + ..."""
        return float(self.law.coefficient(2))

    def about(self, start: float) -> "Growth":
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

    def misplaced(self, strain: Array, noise: float = 0.0) -> int | None:
        """Flat index of the worst strain that is out of range, or within `noise` of it, if any."""
        if strain.min() <= self.law.lowest + noise:
            return int(strain.argmin())
        if strain.max() >= self.law.highest - noise:
            return int(strain.argmax())
        return None

    def refusal(self, alpha: float, strain: float, place: str) -> ValueError:
        """What to raise where a piece would have that strain, alpha c."""
        bound = self.law.lowest if strain < 0 else self.law.highest
        limit = f"{'<' if alpha > 0 else '>'} {alpha * bound / strain:.6g}"
        return ValueError(
            f"alpha = {alpha:g}: alpha c = {strain:g} at {place} is not within {bound:g}, the limit of "
            f"the stretch {self.law.words}; must be {limit}"
        )

"""Growth laws: the stretch s(e) for a growth strain e = alpha c, and the admissible range of e.

    exp       s = exp(e)             metric g = s^2 = exp(2 e), as in eq. 4 of the paper
    linear    s = 1 + e              g = (1 + e)^2, as for the line of eq. 5
    metric    s = (1 + 2 e)^(1/2)    g = 1 + 2 e

They agree to first order in e. Speeds of a sine wave are of order alpha^2 although stretches are of
order alpha: differences from the stretch at a strain e_0 are computed without cancellation,

    s(e_0 + x) = s_0 + s_1 x + x^2 bend(x).

A new law is a class with these functions; everything else is derived from them.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from fractions import Fraction
from math import comb, factorial, inf
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]

SERIES_TERMS = 19
"""Terms of the series of (exp(x) - 1 - x)/x^2 for |x| < 1: the first neglected is 1/21! = 2e-20."""


class GrowthLaw(Value, ABC):
    """A stretch s(e): Exp, Linear, Metric, or a user-defined class.

    name: short name; words: the formula; lowest, highest: open range of e.
    Raises ValueError in `check`, for a strain beyond this range.

    >>> import numpy as np
    >>> from linear_theory import Exp, GrowthLaw, Linear, Metric
    >>> for law in (Exp(), Linear(), Metric()):
    ...     print(f"{law.words}: {law.stretch(np.array(0.25)):.4f}", isinstance(law, GrowthLaw))
    exp(alpha c): 1.2840 True
    1 + alpha c: 1.2500 True
    (1 + 2 alpha c)^(1/2): 1.2247 True
    """

    name: ClassVar[str]
    words: ClassVar[str]
    lowest: ClassVar[float]
    highest: ClassVar[float] = inf

    def __str__(self) -> str:
        return self.name

    @abstractmethod
    def stretch(self, e: Array) -> Array:
        """s(e)."""

    @abstractmethod
    def slope(self, e: Array) -> Array:
        """ds/de."""

    @abstractmethod
    def bend(self, start: Array, x: Array) -> Array:
        """[s(start + x) - s(start) - s_1 x]/x^2, without cancellation."""

    @abstractmethod
    def strain(self, gain: float) -> float:
        """e at which lengths grow by the fraction `gain`, s(e) = 1 + gain."""

    @abstractmethod
    def metric(self, e: Array) -> Array:
        """g = s^2 of the rest metric g A (eq. 4)."""

    @abstractmethod
    def coefficient(self, order: int) -> Fraction:
        """Coefficient of e^order in s, exact."""

    @property
    def square(self) -> float:
        """k in (g - 1)/2 = e + k e^2 + ..."""
        return float(self.coefficient(2) + Fraction(1, 2))

    def bounds(self, extreme: float = inf) -> tuple[float, float]:
        """Open range of e, within +-extreme."""
        return max(self.lowest, -extreme), min(self.highest, extreme)

    def misplaced(self, strain: Array, noise: float = 0.0, extreme: float = inf) -> int | None:
        """Flat index of the worst strain out of bounds or within `noise` of them; None if none is."""
        lowest, highest = self.bounds(extreme)
        if strain.min() <= lowest + noise:
            return int(strain.argmin())
        if strain.max() >= highest - noise:
            return int(strain.argmax())
        return None

    def refusal(self, alpha: float, strain: float, place: str = "", extreme: float = inf) -> ValueError:
        """The error for a growth strain alpha c out of range."""
        bound = self.bounds(extreme)[strain >= 0]
        limit = f"{'<' if alpha > 0 else '>'} {alpha * bound / strain:.6g}"
        at = f" at {place}" if place else ""
        return ValueError(
            f"alpha = {alpha:g}: alpha c = {strain:g}{at} is not within {bound:g}, the limit of "
            f"the stretch {self.words}; must be {limit}"
        )

    def check(self, alpha: float, growth: ArrayLike) -> None:
        """Raise ValueError where growth c (any shape) has a strain alpha c out of range."""
        strain = np.asarray(alpha * np.asarray(growth, float))
        worst = self.misplaced(strain) if strain.size else None
        if worst is not None:
            raise self.refusal(alpha, float(strain.flat[worst]))


@dataclass(frozen=True)
class Exp(GrowthLaw):
    """s = exp(e)."""

    name: ClassVar[str] = "exp"
    words: ClassVar[str] = "exp(alpha c)"
    lowest: ClassVar[float] = -inf

    def stretch(self, e: Array) -> Array:
        """See GrowthLaw."""
        return np.exp(e)

    def slope(self, e: Array) -> Array:
        """See GrowthLaw."""
        return np.exp(e)

    def bend(self, start: Array, x: Array) -> Array:
        """exp(start) (exp(x) - 1 - x)/x^2."""
        near = abs(x) < 1
        small, large = np.where(near, x, 0.0), np.where(near, 1.0, x)
        series = np.zeros_like(small)
        for k in range(SERIES_TERMS + 1, 1, -1):
            series = (series * small + 1) / k  # 1/2! + x/3! + ... = (1 + (x/3)(1 + ...))/2
        return np.exp(start) * np.where(near, series, (np.expm1(large) - large) / large**2)

    def strain(self, gain: float) -> float:
        """See GrowthLaw."""
        return float(np.log1p(gain))

    def metric(self, e: Array) -> Array:
        """See GrowthLaw."""
        return np.exp(2 * e)

    def coefficient(self, order: int) -> Fraction:
        """See GrowthLaw."""
        return Fraction(1, factorial(order))


@dataclass(frozen=True)
class Linear(GrowthLaw):
    """s = 1 + e."""

    name: ClassVar[str] = "linear"
    words: ClassVar[str] = "1 + alpha c"
    lowest: ClassVar[float] = -1.0

    def stretch(self, e: Array) -> Array:
        """See GrowthLaw."""
        return 1 + e

    def slope(self, e: Array) -> Array:
        """See GrowthLaw."""
        return np.ones_like(e)

    def bend(self, start: Array, x: Array) -> Array:
        """See GrowthLaw."""
        return np.zeros_like(x)

    def strain(self, gain: float) -> float:
        """See GrowthLaw."""
        return gain

    def metric(self, e: Array) -> Array:
        """See GrowthLaw."""
        return (1 + e) ** 2

    def coefficient(self, order: int) -> Fraction:
        """See GrowthLaw."""
        return Fraction(order < 2)


@dataclass(frozen=True)
class Metric(GrowthLaw):
    """s = (1 + 2 e)^(1/2)."""

    name: ClassVar[str] = "metric"
    words: ClassVar[str] = "(1 + 2 alpha c)^(1/2)"
    lowest: ClassVar[float] = -0.5

    def stretch(self, e: Array) -> Array:
        """See GrowthLaw."""
        return np.sqrt(1 + 2 * e)

    def slope(self, e: Array) -> Array:
        """See GrowthLaw."""
        return 1 / np.sqrt(1 + 2 * e)

    def bend(self, start: Array, x: Array) -> Array:
        """See GrowthLaw."""
        root = np.sqrt(1 + 2 * start)
        return np.asarray(-2 / (root * (root + np.sqrt(1 + 2 * (start + x))) ** 2))

    def strain(self, gain: float) -> float:
        """See GrowthLaw."""
        return gain + gain**2 / 2

    def metric(self, e: Array) -> Array:
        """See GrowthLaw."""
        return 1 + 2 * e

    def coefficient(self, order: int) -> Fraction:
        """See GrowthLaw."""
        return Fraction((-1) ** (order + 1) * comb(2 * order, order), 2**order * (2 * order - 1))


GROWTH_LAWS: dict[str, GrowthLaw] = {law.name: law for law in (Exp(), Linear(), Metric())}


def growth_law(law: object, name: str = "growth_law") -> GrowthLaw:
    """A law, or the law named "exp", "linear" or "metric". Raises ValueError for anything else."""
    if isinstance(law, GrowthLaw):
        return law
    return GROWTH_LAWS[validation.choice(name, law, GROWTH_LAWS)]

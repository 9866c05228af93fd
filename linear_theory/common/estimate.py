"""A number and its error."""

import math
from typing import NamedTuple

from linear_theory.common.shown import Value, with_error


class _Estimate(NamedTuple):
    value: float
    error: float


class Estimate(Value, _Estimate):
    """A number and its estimated numerical error, absolute.

    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> found = crawl_speed(Sheet(), SineWave(), alpha=0.25, rtol=1e-2).estimate
    >>> print(f"{found.value:.2f}", found.error < 1e-2 * found.value)
    0.11 True
    >>> print(found._replace(error=0.002))
    Estimate(0.1059 ± 0.0020)
    """

    def over(self, other: "Estimate") -> "Estimate":
        """The quotient of two numbers >= 0, with the largest error that theirs allow.

        Infinite where the other one is 0 or not known to be anything else; NaN for 0/0.

        >>> from linear_theory import Estimate
        >>> print(Estimate(1.0, 0.1).over(Estimate(0.5, 0.1)).error.__round__(6))
        0.75
        >>> print(Estimate(1.0, 0.1).over(Estimate(0.0, 0.1)).value)
        inf
        """
        (value, error), (divisor, doubt) = self, other
        if math.isnan(value) or math.isnan(divisor):
            return Estimate(math.nan, math.nan)
        if divisor <= doubt:
            nothing = value <= error
            return Estimate(math.nan if nothing else math.inf, doubt and math.inf)
        found = value / divisor
        return Estimate(found, (value + error) / (divisor - doubt) - found)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._call()})"

    def _call(self) -> str:
        """In rows of results: no call, which would hide how many digits are known."""
        return with_error(self.value, self.error)

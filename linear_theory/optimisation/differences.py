"""The gradient of an objective that has none of its own, by differences, with its error.

Central differences over 2 h have the error e/h from an error e of the value, and h^2 f'''/6 of their
own. With f''' of the size of the value over a range of 1, the best h is about (3 e/|f|)^(1/3). A third
of the difference to the same over 4 h is the second error, to leading order; the first is added to it.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.problem import Evaluation, Region

Array = NDArray[np.float64]

SHORTEST, LONGEST = 1e-4, 0.05
"""Of the range of an unknown."""

SAFETY = 2.0
"""On the error of a difference, of which the leading term alone is known."""


class Differences:
    """An objective from its value alone. careful: whether to estimate the error of the gradient, for
    twice as many values; NaN otherwise."""

    def __init__(
        self, value: Callable[[Array], Estimate], region: Region, careful: bool = False
    ) -> None:
        self._value, self._region, self._careful = value, region, careful

    def __call__(self, point: Array) -> Evaluation:
        """See Objective."""
        here = self._value(point)
        size = max(abs(here.value), here.error, 1e-300)
        step = min(max((3 * here.error / size) ** (1 / 3), SHORTEST), LONGEST)
        slopes = [self._slope(point, place, step, here) for place in range(point.size)]
        gradient, doubt = np.array(slopes).T
        return Evaluation(here.value, here.error, gradient, doubt)

    def _slope(self, point: Array, place: int, step: float, here: Estimate) -> tuple[float, float]:
        """Derivative by one unknown, and its error."""
        low, high = self._region.low[place], self._region.high[place]
        if low + 2 * step > point[place] or point[place] > high - 2 * step:
            return self._from_one_side(point, place, step, here)
        near = self._central(point, place, step)
        if not self._careful:
            return near, float("nan")
        wide = self._central(point, place, 2 * step)
        return near, SAFETY * abs(wide - near) / 3 + here.error / step

    def _central(self, point: Array, place: int, step: float) -> float:
        move = step * np.eye(point.size)[place]
        return (self._value(point + move).value - self._value(point - move).value) / (2 * step)

    def _from_one_side(
        self, point: Array, place: int, step: float, here: Estimate
    ) -> tuple[float, float]:
        """Through three points, towards the farther bound."""
        room = self._region.high[place] - point[place], point[place] - self._region.low[place]
        move = (step if room[0] >= room[1] else -step) * np.eye(point.size)[place]
        one, two = self._value(point + move).value, self._value(point + 2 * move).value
        slope = (4 * one - two - 3 * here.value) / (2 * move[place])
        if not self._careful:
            return slope, float("nan")
        four = self._value(point + 4 * move).value
        wide = (4 * two - four - 3 * here.value) / (4 * move[place])
        return slope, SAFETY * abs(wide - slope) / 3 + 4 * here.error / step

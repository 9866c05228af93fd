"""A direction in the space of scenes, along which a derivative is taken."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.maps import FrictionMap
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]
Function = Callable[[ArrayLike, ArrayLike, ArrayLike], Array]

SAME = 1e-11
"""Difference of dc(t + T/2) and -dc(t), over the largest |dc|, below which they are the same."""


class GrowthChange(NamedTuple):
    """dc and its rate as functions of x, y, t that broadcast, per unit of a parameter.

    across: whether they depend on x. waves: on the sheet, of the shortest wave along; 0 if unknown.
    """

    value: Function
    rate: Function
    across: bool = False
    waves: float = 0.0

    @classmethod
    def between(cls, ahead: Drive, behind: Drive, apart: float) -> "GrowthChange":
        """By a central difference of two drives."""

        def difference(name: str) -> Function:
            def at(x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
                return np.asarray((getattr(ahead, name)(x, y, t) - getattr(behind, name)(x, y, t)) / apart)

            return at

        return cls(difference("value"), difference("rate"), ahead.depends_on_x or behind.depends_on_x)

    def changes_sign(self, x: Array, y: Array, times: Array, period: float) -> bool:
        """Whether dc(t + T/2) = -dc(t), at points x (X,), y (Y,) and times (T,)."""
        x, t = x[:, None], times[:, None, None]
        now, later = self.value(x, y, t), self.value(x, y, t + period / 2)
        return bool(abs(now + later).max() <= SAME * abs(now).max())


class Replaced(NamedTuple):
    """Two laws or maps of friction on either side of the own one, and what their number differs by."""

    ahead: FrictionLaw | FrictionMap
    behind: FrictionLaw | FrictionMap
    apart: float


@dataclass(frozen=True)
class Direction:
    """What a parameter changes in a scene, per unit of it.

    growth: c; alpha: the growth coupling; slip, period, width: the logarithms of the slip speed, of the
    period and of the width of the sheet; poisson: Poisson's ratio; law, map: friction.
    """

    growth: GrowthChange | None = None
    alpha: float = 0.0
    slip: float = 0.0
    period: float = 0.0
    width: float = 0.0
    poisson: float = 0.0
    law: Replaced | None = None
    map: Replaced | None = None

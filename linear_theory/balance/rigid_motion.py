"""The rigid motion that a balance finds, and the units in which it is found."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.units import power_of_two
from linear_theory.motion.motion import Motion

Array = NDArray[np.float64]

NO_WORKS = np.zeros((0, 3))


class RigidMotion(NamedTuple):
    """q = leading + alpha remainder per unit alpha, (times, 3) each: V_x, V_y, Omega.

    rest: (times,), the share of the points that move slower than 1e-6 of the mean speed;
    fastest: the largest speed against the ground, per unit alpha; works: (times, 3), rates of work per
    unit |alpha|, see `Balance.works`.
    """

    leading: Array
    remainder: Array
    rest: Array
    fastest: float
    works: Array = NO_WORKS

    def joined(self, more: "RigidMotion", added: NDArray[np.bool_]) -> "RigidMotion":
        """Motions merged in time order: `more` at the times `added`; times are the last axis of
        rest."""
        axis, known = self.rest.ndim - 1, self.rest.shape[-1]
        order = np.empty(added.size, int)
        order[~added] = np.arange(known)
        order[added] = known + np.arange(more.rest.shape[-1])
        leading, remainder, rest, works = (
            np.take(np.concatenate([a, b], axis), order, axis)
            for a, b in zip((*self[:3], self.works), (*more[:3], more.works), strict=True)
        )
        return RigidMotion(leading, remainder, rest, max(self.fastest, more.fastest), works)


class Units(NamedTuple):
    """Of speeds, arms and areas (the load of a cell): powers of two, so that nothing is rounded."""

    speed: float
    length: float
    area: float

    @classmethod
    def of(cls, motion: Motion) -> "Units":
        """Those in which the largest values of a motion lie between 1 and 2."""
        values = motion.velocity, motion.arms, motion.area
        return cls(*(power_of_two(float(abs(v).max(initial=0.0))) for v in values))

    @property
    def motion(self) -> Array:
        """Of V_x, V_y, Omega, (3,)."""
        return np.array([self.speed, self.speed, self.speed / self.length])

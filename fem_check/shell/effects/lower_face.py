"""Points at a depth below the mid-surface, and what a potential of their positions p does to the sheet.

With p = x - d n, the unit normal n and the dual base a^c the variations are (see `koiter`)

    dn      = - a^c (n . da_c)
    d1 d2 n = - a^c (d1 n . d2 a_c) - d1 a^c (n . d2 a_c)
            = a^d [(a^c . d1 a_d)(n . d2 a_c) + (a^c . d2 a_d)(n . d1 a_c)]
              - n a^cd (n . d1 a_c)(n . d2 a_d),

so that a potential of p with gradient f and Hessian T has, with respect to x, x_1, x_2, the gradient
(f, d f^1 n, d f^2 n), f^c = f . a^c, and a Hessian of two parts: T between the changes of p, and minus
d f . d1 d2 n.
"""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.point_state import PointState, dot
from fem_check.shell.kinematics.region import Entries
from linear_theory.common.pairs import PAIRS, outer

Array = NDArray[np.float64]


class LowerFace:
    """The points at `depth` (length) below the mid-surface of a state."""

    entries: ClassVar[Entries] = (0, 1, 2)

    def __init__(self, state: PointState, depth: float) -> None:
        self.state, self.depth = state, depth

    @property
    def position(self) -> Array:
        """p, (3, points)."""
        return np.asarray(self.state.position - self.depth * self.state.normal)

    def moved(self, change: Array) -> Array:
        """Change of p, (3, points), to first order in changes of x, x_1, x_2, (3, 3, points)."""
        tilt = dot(change[1:], self.state.normal)
        return np.asarray(change[0] + self.depth * (tilt[:, None] * self.state.dual).sum(0))

    def gradient(self, force: Array) -> Array:
        """With respect to x, x_1, x_2, (3, 3, points); force (3, points): with respect to p."""
        out = np.empty((3, *force.shape))
        out[0] = force
        out[1:] = self.depth * self._raised(force)[:, None] * self.state.normal
        return out

    def hessian(self, force: Array, stiffness: Array) -> Array:
        """With respect to x, x_1, x_2, (3, 3, pairs, points); stiffness (pairs, points): of p."""
        first, second = PAIRS[3]
        whole = np.empty((3, 3, stiffness.shape[-1]))
        whole[first, second] = whole[second, first] = stiffness
        by_dual = [dot(whole, dual) for dual in self.state.dual]  # T a^c
        out = np.empty((3, 3, *stiffness.shape))
        out[0, 0] = stiffness
        normal, depth = self.state.normal, self.depth
        for c, row in enumerate(by_dual, start=1):
            out[0, c], out[c, 0] = depth * outer(row, normal), depth * outer(normal, row)
            for d, dual in enumerate(self.state.dual, start=1):
                out[c, d] = depth**2 * dot(row, dual) * outer(normal, normal)
        out[1:, 1:] += self._turning(force)
        return out

    def _turning(self, force: Array) -> Array:
        """-depth force . d1 d2 n, (2, 2, pairs, points)."""
        normal, dual = self.state.normal, self.state.dual
        raised, along = self._raised(force), dot(force, normal)
        a11, a22, a12 = self.state.inverse_metric
        inverse = ((a11, a12), (a12, a22))
        twice = outer(normal, normal)
        out = np.empty((2, 2, *twice.shape))
        for c in range(2):
            for d in range(2):
                # d1 a_c with n and d2 a_d with a^c, times f^d, and the other way round
                mixed = raised[c] * outer(dual[d], normal) + raised[d] * outer(normal, dual[c])
                out[c, d] = -self.depth * (mixed - along * inverse[c][d] * twice)
        return out

    def _raised(self, force: Array) -> Array:
        """f^c = f . a^c, (2, points)."""
        return dot(self.state.dual, force)

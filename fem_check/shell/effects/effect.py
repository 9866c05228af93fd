"""What every effect offers, and the small tensor products that they share.

An effect is a potential that is a sum over points of a density of the position and its derivatives.
It states which derivatives (`entries`) it reads and gives, at every point, its value, its gradient and
its Hessian with respect to them. Sums over elements and unknowns are made once for all effects.

The Hessian is symmetric in (entry, component); stored are the blocks of the component pairs c <= d,
in the order of `PAIRS`: block [k, l, (c, d)] belongs to component c of entry k and d of entry l.
"""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries

Array = NDArray[np.float64]

PAIRS = {2: ((0, 0, 1), (0, 1, 1)), 3: ((0, 0, 0, 1, 1, 2), (0, 1, 2, 1, 2, 2))}
"""Component pairs c <= d for 2 and 3 components, as index arrays (c's, d's)."""

_FIRST = {k: np.array(v[0]) for k, v in PAIRS.items()}
_SECOND = {k: np.array(v[1]) for k, v in PAIRS.items()}


class Effect(Protocol):
    """A potential given point by point. Energies are in force times length."""

    @property
    def entries(self) -> Entries:
        """Which of x, x_1, x_2, x_11, x_22, x_12 (0 ... 5) it reads."""

    @property
    def reads_rest(self) -> bool:
        """Whether it needs a rest state."""

    def energy(self, state: PointState) -> Array:
        """Energy of each point, (points,)."""

    def gradient(self, state: PointState) -> Array:
        """Derivative by the entries, (entries, components, points)."""

    def hessian(self, state: PointState) -> Array | None:
        """Second derivative, (entries, entries, component pairs, points); None if it vanishes."""

    def check(self, components: int, effects: "Sequence[Effect]", step: Step | None) -> None:
        """Raise ValueError where the scene lacks what the effect needs or contradicts it."""


class NoConditions:
    """For effects that every scene of any number of components can have."""

    def check(self, components: int, effects: "Sequence[Effect]", step: Step | None) -> None:
        """Nothing to complain of."""


def outer(u: Array, v: Array) -> Array:
    """u_c v_d for the pairs c <= d: (..., components, points) -> (..., pairs, points)."""
    count = u.shape[-2]
    return np.asarray(u[..., _FIRST[count], :] * v[..., _SECOND[count], :])


def identity(components: int) -> Array:
    """delta_cd for the pairs c <= d, (pairs, 1)."""
    first, second = PAIRS[components]
    return np.equal(first, second).astype(float)[:, None]

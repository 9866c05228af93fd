"""The adjoint of the friction balance of a cycle: how V_y changes with the motion at every point.

As `linear_theory.gradient.adjoint`, for the loads and places of a nonlinear sheet: with the multipliers
lambda of H lambda = -g and the virtual motion r = sum_j lambda_j R_j, V_y changes by

    dJ = int load (D r) . dv + (f + s e_y) . r dload + ...,

s the slope; the dots stand for the arms of turning, in w = v + ... + Omega (-y, x) and in the moment.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.channels import AREA
from linear_theory.common.pairs import product
from linear_theory.gradient.adjoint import AdjointBalance, LawChange, _State
from linear_theory.gradient.leaves import gathered, local_coordinates, point_weights
from linear_theory.gradient.quantity import ALONG
from linear_theory.motion.cells import Graded

Array = NDArray[np.float64]


class PointWeights(NamedTuple):
    """Derivatives of V_y at times (T,) by values at the Gauss points of cells.

    velocity, place: (2, T, cells, n, n); load: (T, cells, n, n), by the normal load there. By numbers:
    slip (T,), the logarithm of all velocities in the law; laws (laws, T), those of `LawChange`.
    flat (T,): whether there is a motion that friction does not resist.
    """

    velocity: Array
    place: Array
    load: Array
    slip: Array
    laws: Array
    flat: NDArray[np.bool_]


class CycleAdjoint(AdjointBalance):
    """A balance of absolute velocities and loads whose motion is known, and its derivatives."""

    def by_points(self, q: Array, laws: Sequence[LawChange] = ()) -> PointWeights:
        """The derivatives of V_y at the motion q (times, 3); cells are frozen."""
        unknowns = self._unknowns(q)
        leaves, where, shares = self._leaves_and_shares(unknowns)
        at = _Points(self, leaves, unknowns, 0.0, shares)  # the load is in the area, and not expanded
        points, numbers = at.by_points(laws)
        count, cells, n, _ = self._values.shape[1:]
        found = gathered(leaves, where, points, count * cells).reshape(-1, count, cells, n, n)
        units = self._units
        return PointWeights(
            velocity=found[:2] / units.speed,
            place=found[3:] / units.length,
            load=found[2] / units.area,
            slip=numbers[0],
            laws=numbers[1:],
            flat=at.flat,
        )

    def _leaves_and_shares(self, q: Array) -> tuple[Graded, Array, Array]:
        """As `_leaves`, and what the parts of cut cells multiply the area by, (leaves, n, n)."""
        channels, count, cells, n, _ = self._values.shape
        place = np.broadcast_to(local_coordinates(n)[:, None], (2, count * cells, n, n))
        flat = self._values.reshape(channels, count * cells, n, n)
        whole = np.concatenate([flat, place, flat[AREA : AREA + 1]])
        whole[AREA] = 1.0
        leaves = self._refined(
            whole,
            np.arange(count * cells),
            lambda values, owners: [self._moved(values, q[owners // cells])],
            self._stages[-1][0],
        )
        values, where = leaves.values[:channels], leaves.values[channels:-1]
        shares = values[AREA].copy()
        values[AREA] *= leaves.values[-1]
        return leaves._replace(values=values), where, shares


@dataclass(frozen=True)
class _Points(_State):
    """The points of all leaves in a motion q; shares: see `CycleAdjoint`."""

    shares: Array

    def by_points(self, laws: Sequence[LawChange]) -> tuple[Array, Array]:
        """By velocity, load and place at the points, (5, leaves, n, n), and by numbers."""
        own, w, load = self.balance, self.slip, self.load
        multipliers = self._multipliers(ALONG, 0.0)[self.times]
        virtual = own._moved(np.zeros_like(w), multipliers, self.leaves.values)
        velocity = load * product(self.law.tangent, virtual)
        force = self.law.force.copy()
        force[1] += own._slope
        weights = self.shares * point_weights(self.leaves, w.shape[-1])
        by_load = weights * (force * virtual).sum(0)
        place = np.zeros_like(velocity)
        if multipliers.shape[1] > 1:  # the sheet may turn
            turn, lever = (part[:, 2, None, None] for part in (self.q[self.times], multipliers))
            pull = velocity * turn + load * force * lever
            place = np.stack([pull[1], -pull[0]])
        numbers = [(velocity * w).sum(0)]
        numbers += [load * (law.force(w, own._units.speed) * virtual).sum(0) for law in laws]
        return np.concatenate([velocity, by_load[None], place]), self.totals(np.stack(numbers))

"""The adjoint of the friction balance: how V changes with velocity and load at every point.

The balance G_j(q; v, e) = int (1 + alpha e) f(w) . R_j dA = 0, w = v + sum_j q_j R_j (see
`balance.balance`), is the optimality condition of a convex function of q, whose Hessian is
H_jk = int (1 + alpha e) R_j . D(w) R_k dA, D the tangent of the law. A quantity J = g . q + k p, with p
the rate of work of friction int (1 + alpha e) f . w dA, changes by

    dJ = int psi_v . dv + psi_e de dA,
    psi_v = (1 + alpha e) (D r + k f),      psi_e = alpha f . r,      r = sum_j lambda_j R_j + k w,
    H lambda = -g - k dp/dq:

one linear solve of three unknowns at most, whatever the number of parameters. A change df of the law
itself adds int (1 + alpha e) df . r dA, and one of alpha in the load int e f . r dA.

D is of order 1/|w| for dry friction, integrable in the plane: the cells are graded as for the balance,
and frozen, so that these are the exact derivatives of the sums over their points.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.balance import Balance
from linear_theory.balance.channels import AREA, ARMS, RATE
from linear_theory.common.pairs import pairs_among, product
from linear_theory.friction.law import FrictionLaw, Response
from linear_theory.gradient.leaves import gathered, local_coordinates, point_weights
from linear_theory.gradient.quantity import Quantity
from linear_theory.motion.cells import Graded, gauss

Array = NDArray[np.float64]

SINGULAR = 1e-10
"""Least over mean stiffness of friction; below, nothing resists a motion, and V has a kink."""


class LawChange(NamedTuple):
    """The derivative of a law by one of its numbers, by a central difference.

    ahead, behind: the laws for velocities per unit |alpha|; apart: the difference of that number;
    mirrored: whether to take the part alone that is mirror symmetric in x.
    """

    ahead: FrictionLaw
    behind: FrictionLaw
    apart: float
    mirrored: bool = False

    def force(self, v: Array, unit: float) -> Array:
        """What the force changes by per unit of the number, at velocities v in that unit."""
        ahead, behind = self.ahead.scaled(unit), self.behind.scaled(unit)
        found = (ahead.force(v) - behind.force(v)) / self.apart
        if self.mirrored:
            mirror = np.reshape([-1.0, 1.0], (2, *(1,) * (v.ndim - 1)))
            found = (found + mirror * self._replace(mirrored=False).force(mirror * v, unit)) / 2
        return np.asarray(found)


class Weights(NamedTuple):
    """Derivatives of quantities (k,) at times (T,).

    By values at the Gauss points of whole cells: velocity (k, 2, T, cells, n, n), load: by e, (k, T,
    cells, n, n), and area: by the logarithm of the area, as of a map, None unless asked for.
    By numbers, (k, T): alpha, that of the load alone; slip, the logarithm of all velocities in the law;
    arms, the logarithm of x in the arms of turning; laws (laws, k, T), those of `LawChange`.
    flat (T,): whether there is a motion that friction does not resist.
    """

    velocity: Array
    load: Array
    area: Array | None
    alpha: Array
    slip: Array
    arms: Array
    laws: Array
    flat: NDArray[np.bool_]


class AdjointBalance(Balance):
    """A balance whose motion is known, and the derivatives of that motion."""

    def polished(self, q: Array, alpha: float) -> Array:
        """(times, 3): a motion after one more Newton step, with the load 1 + alpha e."""
        start = self._unknowns(q)
        return self._full(start + self._step(self._whole if alpha else self._plain, start))

    def weights(
        self,
        q: Array,
        alpha: float,
        quantities: Sequence[Quantity],
        laws: Sequence[LawChange] = (),
        maps: bool = False,
    ) -> Weights:
        """The derivatives at the motion q (times, 3); alpha: of the load 1 + alpha e.

        laws: by the numbers of which derivatives are asked for; maps: whether those by the area are.
        """
        unknowns = self._unknowns(q)
        leaves, place = self._leaves(unknowns)
        at = _State(self, leaves, unknowns, alpha)
        found = [at.derivatives(one, laws, maps) for one in quantities]
        points = np.stack([one[0] for one in found])
        (count, channels), shape = points.shape[:2], self._values.shape[1:]
        flat = points.reshape(-1, *points.shape[2:])
        moved = gathered(leaves, place, flat, shape[0] * shape[1]).reshape(count, channels, *shape)
        alphas, slips, arms, *others = np.stack([one[1] for one in found], 1)
        return Weights(
            velocity=moved[:, :2] / self._units.speed,
            load=moved[:, 2],
            area=moved[:, 3] if maps else None,
            alpha=alphas,
            slip=slips,
            arms=arms,
            laws=np.array(others).reshape(-1, count, shape[0]),
            flat=at.flat,
        )

    def resting(self, q: Array, slower: float) -> Array:
        """(times,): share of the sheet whose speed is below a share of the root mean square of v^."""
        w, area = self._moved(self._values, self._unknowns(q)), self._values[AREA]
        weights = area * np.multiply.outer(*(gauss(w.shape[-1]).weights,) * 2)
        slow = np.hypot(*w) < slower * self._scale
        return np.asarray((weights * slow).sum((1, 2, 3)) / weights.sum((1, 2, 3)))

    def _leaves(self, q: Array) -> tuple[Graded, Array]:
        """Cells of the balance at a motion, owned by whole cells of all times, and where in them.

        The second is local coordinates of their points, (2, leaves, n, n).
        """
        channels, count, cells, n, _ = self._values.shape
        halvings, _ = self._stages[-1]
        place = np.broadcast_to(local_coordinates(n)[:, None], (2, count * cells, n, n))
        flat = self._values.reshape(channels, count * cells, n, n)
        leaves = self._refined(
            np.concatenate([flat, place]),
            np.arange(count * cells),
            lambda values, owners: [self._moved(values, q[owners // cells])],
            halvings,
        )
        return leaves._replace(values=leaves.values[:channels]), leaves.values[channels:]


@dataclass(frozen=True)
class _State:
    """The points of all leaves in a motion q (times, unknowns)."""

    balance: AdjointBalance
    leaves: Graded
    q: Array
    alpha: float

    @cached_property
    def times(self) -> NDArray[np.int64]:
        """Of each leaf."""
        return self.leaves.owners // self.balance._values.shape[2]

    @cached_property
    def slip(self) -> Array:
        """w, (2, ...)."""
        return self.balance._moved(self.leaves.values, self.q[self.times])

    @cached_property
    def law(self) -> Response:
        """The law there, all components."""
        return self.balance._law.at(self.slip)

    @cached_property
    def area(self) -> Array:
        """Area of the points, with the weights of the quadrature."""
        return self.leaves.values[AREA] * point_weights(self.leaves, self.slip.shape[-1])

    @cached_property
    def load(self) -> Array:
        """(1 + alpha e) dA."""
        return np.asarray(self.area * (1 + self.alpha * self.leaves.values[RATE]))

    @cached_property
    def stiffness(self) -> Array:
        """H, (times, J, J)."""
        own = self.balance
        tangent = self.law.tangent[pairs_among(2, own._kept)]
        rows = self.totals(self.load * np.stack(own._between(tangent, self.leaves.values)))
        count = self.q.shape[1]
        return rows.T.reshape(-1, count, count)

    @cached_property
    def flat(self) -> NDArray[np.bool_]:
        """At which times friction does not resist some motion, (times,)."""
        xx, _, yy = self.law.tangent
        mean = self.totals((self.load * (xx + yy))[None])[0]
        return np.asarray(np.linalg.eigvalsh(self.stiffness)[:, 0] <= SINGULAR * mean)

    def totals(self, values: Array) -> Array:
        """Sums of (k, leaves, n, n) over the points of each time, (k, times)."""
        count = len(self.q)
        return np.stack([np.bincount(self.times, one, count) for one in values.sum((-1, -2))])

    def derivatives(
        self, quantity: Quantity, laws: Sequence[LawChange], maps: bool
    ) -> tuple[Array, Array]:
        """By values at points, (3 or 4, leaves, n, n), and by numbers, (3 + laws, times)."""
        own, w, f, load = self.balance, self.slip, self.law.force, self.load
        work = quantity.work * own._units.area * own._units.speed / own._rest
        multipliers = self._multipliers(quantity, work)[self.times]
        virtual = own._moved(np.zeros_like(w), multipliers, self.leaves.values)
        if work:
            virtual += work * w
        stiff, pull = product(self.law.tangent, virtual), (f * virtual).sum(0)
        velocity = load * (stiff + work * f if work else stiff)
        numbers = [self.area * self.leaves.values[RATE] * pull, load * (stiff * w).sum(0)]
        numbers.append(self._by_arms(velocity, multipliers))
        numbers += [load * (law.force(w, own._units.speed) * virtual).sum(0) for law in laws]
        points = [*velocity, self.alpha * self.area * pull, *([load * pull] if maps else [])]
        return np.stack(points), self.totals(np.stack(numbers))

    def _multipliers(self, quantity: Quantity, work: float) -> Array:
        """lambda, (times, J); work: the unit of the rate of work."""
        own = self.balance
        slope = own._unknowns(np.atleast_2d(quantity.rigid) * own._units.motion**2)
        slope = np.broadcast_to(slope, self.q.shape)
        if work:
            force = product(self.law.tangent, self.slip)[own._kept]
            slope = (
                slope
                + work * self.totals(self.load * np.stack(own._along(force, self.leaves.values))).T
            )
        found = np.linalg.pinv(self.stiffness, rcond=SINGULAR, hermitian=True) @ slope[:, :, None]
        return np.asarray(-found[:, :, 0])

    def _by_arms(self, velocity: Array, multipliers: Array) -> Array:
        """By the logarithm of x in the rotation (-y, x); 0 for motions that do not turn."""
        if len(multipliers[0]) == 1:
            return np.zeros_like(self.load)
        x = self.leaves.values[ARMS][0]
        turn, virtual = (part[:, 2, None, None] for part in (self.q[self.times], multipliers))
        return np.asarray(x * (velocity[1] * turn + self.load * self.law.force[1] * virtual))

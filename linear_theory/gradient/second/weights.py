"""What the balance of second order weighs the deformation with, as moments at every time.

With (alpha, beta) in the ratio r = beta/alpha, 0 for a planar sheet, the balance for small a,

    velocity v_1 + a (v_2 + r^2 v_b),      load 1 + a (e + r p),

has the solution q = q_0 + a q_1 + ... for a of either sign, and the adjoint of that balance gives the
weights of velocity and load in dq(a) (`gradient.adjoint`). V = alpha <q_0> + alpha^2 <q_1> changes by
the parts of dq(a) that are even and odd in a.

The balance is that of half a sheet, whose motion is mirror symmetric in x. A change of the deformation
that is not has no effect on V at first order: moments of fields without that symmetry are left out.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import BATCH
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.common.progress import track
from linear_theory.friction.law import FrictionLaw
from linear_theory.gradient.adjoint import AdjointBalance, LawChange
from linear_theory.gradient.moments import moments
from linear_theory.gradient.quantity import Quantity
from linear_theory.speed.expansion import Coefficients

Array = NDArray[np.float64]

NEWTON_STEPS = 3
"""From q_0 + a q_1."""


class TimeWeights(NamedTuple):
    """Of quantities (k,) at both signs of a and times (T,).

    velocity (k, 2, T, 2, i, j), load (k, 2, T, i, j): moments of weights against p_i p_j; slip (k, 2,
    T), laws (laws, k, 2, T): derivatives by the logarithm of all velocities in the law, and by its
    numbers; size: a; flat: whether friction does not resist some motion at some time.
    """

    times: Array
    velocity: Array
    load: Array
    slip: Array
    laws: Array
    size: float
    flat: bool

    @property
    def sizes(self) -> Array:
        """a of both signs, (2, 1)."""
        return np.array([[self.size], [-self.size]])

    def on_velocity(self, polynomials: Array) -> Array:
        """Weights times velocities (n, 2, degrees x, degrees y), (k, 2, T, n)."""
        return _products(self.velocity, polynomials)

    def on_load(self, polynomials: Array) -> Array:
        """Weights times loads (n, degrees x, degrees y), (k, 2, T, n)."""
        return _products(self.load, polynomials)

    def some(self, which: slice | NDArray[np.int64]) -> "TimeWeights":
        """At some of the times."""
        return self._replace(
            times=self.times[which],
            velocity=self.velocity[:, :, which],
            load=self.load[:, :, which],
            slip=self.slip[:, :, which],
            laws=self.laws[:, :, :, which],
        )

    def reversed(self, time: float) -> "TimeWeights":
        """At the times t_0 - t, where V(t_0 - t) = V(t) as c(-y, t_0 - t) = c(y, t)."""
        odd = (-1.0) ** np.arange(self.velocity.shape[-1])
        across = np.reshape([-1.0, 1.0], (2, 1, 1))
        load = self.load * (-1.0) ** np.arange(self.load.shape[-1])
        return self._replace(times=time - self.times, velocity=self.velocity * across * odd, load=load)

    def minus(self, other: "TimeWeights") -> "TimeWeights":
        """Differences to others at the same times."""
        return self._replace(
            velocity=self.velocity - other.velocity,
            load=self.load - other.load,
            slip=self.slip - other.slip,
            laws=self.laws - other.laws,
        )


def _products(moments: Array, polynomials: Array) -> Array:
    across, along = polynomials.shape[-2:]
    own = moments[..., :across, :along]
    flat = polynomials.reshape(len(polynomials), -1)
    return np.asarray(own.reshape(*own.shape[:3], -1) @ flat.T)


def orders(values: Array, size: float) -> Array:
    """Parts of values (..., 2, T) at both signs of a that are even, and odd over a, (..., 2, T)."""
    ahead, behind = values[..., 0, :], values[..., 1, :]
    return np.stack([(ahead + behind) / 2, (ahead - behind) / (2 * size)], -2)


class Asked(NamedTuple):
    """law: for speeds per unit alpha; counts: of the moments, across and along; size: a."""

    law: FrictionLaw
    quantities: Sequence[Quantity]
    laws: Sequence[LawChange]
    counts: tuple[int, int]
    size: float


def time_weights(crawl: Coefficients, times: Array, motion: RigidMotion, asked: Asked) -> TimeWeights:
    """At times (T,), near whose balance the motion is."""
    size = max(BATCH // crawl.points, 1)
    parts = []
    for some in track("adjoint of the friction balance", range(0, times.size, size)):
        which = slice(some, some + size)
        near = motion.leading[which], motion.remainder[which]
        parts.append(_batch(crawl, times[which], near, asked))
    return TimeWeights(
        times=times,
        velocity=np.concatenate([part.velocity for part in parts], 2),
        load=np.concatenate([part.load for part in parts], 2),
        slip=np.concatenate([part.slip for part in parts], 2),
        laws=np.concatenate([part.laws for part in parts], 3),
        size=parts[0].size,
        flat=any(part.flat for part in parts),
    )


def _batch(crawl: Coefficients, times: Array, near: tuple[Array, Array], asked: Asked) -> TimeWeights:
    """At a few times."""
    here, law = crawl._motion(times), asked.law
    rate, steps = crawl._rate(times, here), crawl.resolution
    size: float = asked.size
    found = []
    assert here.second is not None
    for a in (size, -size):
        moving = replace(here, velocity=here.velocity + a * here.second, second=None)
        balance = AdjointBalance(
            moving, rate, a, law, steps.halvings, steps.tolerance, rest=here.whole_area, joint=True
        )
        q = near[0] + a * near[1]
        for _ in range(NEWTON_STEPS):
            q = balance.polished(q, a)
        found.append(balance.weights(q, a, asked.quantities, asked.laws))
    velocity = np.stack([moments(crawl, one.velocity, asked.counts, None) for one in found], 1)
    load = np.stack([moments(crawl, one.load, asked.counts, None) for one in found], 1)
    velocity[:, :, 0, ..., 0::2, :] = velocity[:, :, 1, ..., 1::2, :] = load[..., 1::2, :] = 0.0
    return TimeWeights(
        times=times,
        velocity=np.moveaxis(velocity, 2, 3),
        load=load,
        slip=np.stack([one.slip for one in found], 1),
        laws=np.stack([one.laws for one in found], 2),
        size=size,
        flat=any(bool(one.flat.any()) for one in found),
    )

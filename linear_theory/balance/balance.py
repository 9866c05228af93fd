"""The rigid motion of a sheet whose shape moves in a known way: friction is balanced (eqs 7, 11).

With velocities per unit alpha, v = alpha v^, V = alpha q, and the load 1 + alpha e, the balance is

    integral (1 + alpha e) f(w) . R_j dA = 0,      w = v^ + sum_j q_j R_j,

f the force of the law of friction, R_j the rigid velocities: (0, 1) for motions that are mirror
symmetric in x, else (1, 0), (0, 1) and the rotation (-y, x), x and y counted from the centre of mass.
It is where the convex function int (1 + alpha e) F(w) dA, F the potential of f, is least. On a slope
the load itself pulls, by `slope` times itself along -y: slope (0, 1) joins f.

For small alpha the mean of q is much smaller than q(t). Hence q = q_0 + alpha q_1: q_0 balances the
load 1, and q_1 solves what is left, divided by alpha, with the difference quotient of f written
without cancellation. A velocity of second order, v = alpha v^ + alpha^2 v_2, joins q_1, and so does
that a sheet displaced by alpha u turns about its centre with R_2 = (-y - alpha u_y, x + alpha u_x).

Where the mean of q is not small, as for pulses and for friction with a direction, nothing cancels: q is
then found as one (`joint`), from integrals with one stagnation point and one crease in place of two,
and q_1 is what differs from q_0.

All of this is solved in units in which speeds, arms and areas are of order 1 (`Units`), a rotation by
the speed that it gives the ends of the sheet: tolerances have the same meaning in any unit of length
and time.
"""

from collections.abc import Callable
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.channels import AREA, ARMS, RATE, VELOCITY, moment
from linear_theory.balance.newton import damped_newton, guarded_newton
from linear_theory.balance.rigid_motion import RigidMotion, Units
from linear_theory.friction.isotropic import norm
from linear_theory.friction.law import ALL, FrictionLaw
from linear_theory.motion.cells import Graded, Integers, graded
from linear_theory.motion.creases import cut
from linear_theory.motion.motion import Motion

Array = NDArray[np.float64]

LINEAR = 1e-8
"""Size of alpha up to which q_1 is the zero of a linear function."""

Integrand = Callable[[Array, Integers], Array]
Velocities = Callable[[Array, Integers], list[Array]]
Residual = Callable[..., tuple[Array, Array]]

_COARSE_HALVINGS = 8
_MARGIN = 1.5  # mean over variation of w on a cell, above which Gauss quadrature sees it as smooth
_MOST_ASIDE = 5  # halvings of a cell that a crease leaves by a side; the error falls like 8^-k
_NEAR = 0.3  # after a Newton step s the error is some s^2 over the speed of the sheet: 10 would do
_REST = 1e-6  # speeds below this share of the mean speed count as rest
_TURNING = 1e-12  # the same for a whole sheet, where a reciprocal motion turns, but for rounding
_VISCOUS = 1e150  # a width as good as infinite, whose square is a number
_ALONG = (1,)  # rigid velocities of a mirror-symmetric motion; 0, 1 translations, 2 rotation
_ALL = (0, 1, 2)


class Balance:
    """Friction on a sheet in a given motion.

    motion: velocities per unit alpha at T times; rate: e of the load, (T, cells, n, n); alpha: growth
    coupling, not 0; law: for speeds per unit |alpha|; halvings: how often a cell is halved towards
    points at rest; tolerance: of q, relative to the root mean square of v^. slope: tan(incline)/mu of
    ground that rises towards +y, in (-1, 1), for loads that are not expanded in alpha (rate = 0). rest:
    load of the undeformed sheet, for such loads; by default the area. work_halvings: of cells,
    for works. joint: to find q as one, for motions without terms of second order and |alpha| >
    `LINEAR`; q_1 then has the error of q over alpha.
    """

    def __init__(
        self,
        motion: Motion,
        rate: Array,
        alpha: float,
        law: FrictionLaw,
        halvings: int = 30,
        tolerance: float = 1e-10,
        slope: float = 0.0,
        rest: float | None = None,
        work_halvings: int = 0,
        joint: bool = False,
    ) -> None:
        self._rest = motion.whole_area if rest is None else rest
        self._work_halvings = work_halvings
        units = self._units = Units.of(motion)
        self._alpha, self._law, self._slope = alpha, law.scaled(units.speed), slope
        self._modes = _ALONG if motion.mirrored else _ALL
        self._kept = slice(1, 2) if motion.mirrored else ALL
        area = np.broadcast_to(motion.area / units.area, rate.shape)
        channels = [*motion.velocity / units.speed, area, rate]
        if not motion.mirrored:
            channels += [np.broadcast_to(p, rate.shape) for p in motion.arms / units.length]
        self._second = slice(0, 0) if motion.second is None else slice(len(channels), len(channels) + 2)
        if motion.second is not None:
            channels += [*motion.second / units.speed]
        displacement = None if motion.mirrored else motion.displacement
        self._joint = joint and motion.second is None and displacement is None
        self._shift = slice(0, 0) if displacement is None else slice(len(channels), len(channels) + 2)
        if displacement is not None:
            channels += [*displacement / units.length]
        self._values = np.stack(channels)
        self._scale = float(np.sqrt(np.mean(self._values[VELOCITY] ** 2))) or 1.0
        self._stages = [(halvings, tolerance)]
        if halvings > 2 * _COARSE_HALVINGS:
            self._stages.insert(0, (_COARSE_HALVINGS, 1e-2))

    def solve(self, guess: RigidMotion | None = None) -> RigidMotion:
        """Balance friction at all times, from a guess if there is one.

        Raises NotConvergedError if an iteration stalls.
        """
        starts = (None, None) if guess is None else map(self._unknowns, guess[:2])
        first, second = starts
        leading = self._zero(self._plain, np.zeros((1, 1)), 1.0, first)
        remainder = np.zeros_like(leading)
        if self._has_second:  # else nothing remains
            remainder = self._remaining(leading, second)
        change = self._change(self._values, leading, remainder)
        speed = norm(self._moved(self._values, leading) + self._alpha * change)
        rest = np.mean(speed < _REST * self._scale, axis=(1, 2, 3))
        own = abs(self._values[VELOCITY]).max(axis=(0, 2, 3, 4))
        still = own <= _TURNING * self._scale
        rest[still] = 0.0  # all is at rest, no part of it sticks
        fastest = 0.0 if not own.any() and not self._slope else self._units.speed * float(speed.max())
        works = self.works(leading, remainder)
        return RigidMotion(self._full(leading), self._full(remainder), rest, fastest, works)

    def correction(self, leading: Array, remainder: Array) -> RigidMotion:
        """One Newton step from a motion (times, 3) that was found with other cells, and its works."""
        first, second = self._unknowns(leading), self._unknowns(remainder)
        step = self._step(self._plain, first)
        if self._joint:
            more = (self._step(self._whole, first + self._alpha * second) - step) / self._alpha
        else:
            more = self._step(partial(self._remainder, first), second)
        still, works = np.zeros(len(leading)), self.works(first, second)
        return RigidMotion(self._full(step), self._full(more), still, 0.0, works)

    def works(self, leading: Array, remainder: Array) -> Array:
        """Rates of work of unknowns (times, J) per unit |alpha| and load at rest, (times, 3), speeds.

        Of friction p_0, p_1 in p_0 + alpha p_1 = int (1 + alpha e) f(w) . w dA, p_0 that of the motion
        of first order under the load 1; and, on a slope, that at which the load rises, int w_y dA.
        At points at rest the integrand has a kink and no more: few halvings will do, or none.
        """
        law, alpha, found = self._law, self._alpha, self._work_cells(leading)
        values, q = found.values, leading[found.owners]
        w = self._moved(values, q)
        first = law.dissipation(w)
        more, lift = np.zeros_like(first), w[1] if self._slope else np.zeros_like(first)
        if self._has_second:
            after = law.dissipation(w + alpha * self._change(values, q, remainder[found.owners]))
            more = ((1 + alpha * values[RATE]) * after - first) / alpha
        sums = found.integrals(values[AREA] * np.stack([first, more, lift])).T
        return np.asarray(sums * (self._units.area * self._units.speed / self._rest))

    def _work_cells(self, leading: Array) -> Graded:
        """Cells of all times, halved a few times towards points at rest if so asked."""
        channels, count, cells, n, _ = self._values.shape
        flat = self._values.reshape(channels, count * cells, n, n)
        owners = np.repeat(np.arange(count), cells)
        if not self._work_halvings:
            return Graded(flat, owners, np.ones(owners.size))
        corners = np.array([0, n // 2, n - 1])

        def roughness(values: Array, owners: Integers) -> tuple[NDArray[np.bool_], Integers]:
            sample = values[:, :, corners[:, None], corners]
            return self._roughness(self._moved(sample, leading[owners])[None])

        return graded(flat, owners, roughness, self._work_halvings)

    @cached_property
    def _has_second(self) -> bool:
        """Whether anything is of second order: loads, velocities, displacements."""
        return any(np.any(self._values[i]) for i in (RATE, self._second, self._shift))

    def _remaining(self, leading: Array, start: Array | None) -> Array:
        """q_1, (times, unknowns)."""
        if self._joint:
            guess = leading if start is None else leading + self._alpha * start
            return (self._zero(self._whole, np.zeros((1, 1)), 1.0, guess) - leading) / self._alpha
        residual = partial(self._remainder, leading)
        if abs(self._alpha) <= LINEAR:
            return self._step(residual, np.zeros_like(leading))
        return self._zero(residual, leading, self._alpha, start)

    def _step(self, residual: Residual, q: Array) -> Array:
        """One Newton step from q, (times, unknowns), with the finest cells."""
        value, slope = residual(q, np.arange(len(q)), halvings=self._stages[-1][0])
        try:
            step = np.linalg.solve(slope, value[:, :, None])
        except np.linalg.LinAlgError:  # dry friction of a motion along one line: no stiffness along it
            step = np.linalg.pinv(slope, hermitian=True) @ value[:, :, None]
        return np.asarray(-step[:, :, 0])

    def _zero(self, residual: Residual, offset: Array, unit: float, start: Array | None) -> Array:
        """q (times, unknowns) of residual 0; without a start, first roughly with few halvings."""
        q = np.zeros((self._values.shape[1], len(self._modes))) if start is None else start
        low, high = self._bracket()
        ends = np.sort([(low - offset) / unit, (high - offset) / unit], axis=0)[:, :, 0]
        for halvings, tolerance in self._stages if start is None else self._stages[-1:]:
            xtol = tolerance * self._scale
            near = _NEAR * np.sqrt(xtol * self._scale)
            if len(self._modes) == 1:
                q = _single(residual, halvings, q, ends, xtol, near)
            else:
                q = damped_newton(partial(residual, halvings=halvings), q, xtol, near)
        return q

    def _bracket(self) -> tuple[Array, Array]:
        """Bounds of q, (times, 1): friction cannot balance where all of the sheet slips one way."""
        along = self._values[1].reshape(self._values.shape[1], -1)
        margin = 0.1 * np.ptp(along, axis=1) + self._scale  # the polynomials exceed these values
        if self._slope:  # at which friction carries the weight down the slope
            margin = margin + abs(self._law.creep(-self._slope))
        return (-along.max(1) - margin)[:, None], (-along.min(1) + margin)[:, None]

    def _plain(self, q: Array, times: Integers, halvings: int) -> tuple[Array, Array]:
        """Residual and slope of the balance for the load 1."""
        return self._loaded(0.0, q, times, halvings)

    def _whole(self, q: Array, times: Integers, halvings: int) -> tuple[Array, Array]:
        """The same for the load 1 + alpha e."""
        return self._loaded(self._alpha, q, times, halvings)

    def _loaded(self, alpha: float, q: Array, times: Integers, halvings: int) -> tuple[Array, Array]:
        def integrand(values: Array, owners: Integers) -> Array:
            met = self._law.at(self._moved(values, q[owners]), self._kept)
            force = met.force
            if self._slope:
                force = np.stack([*force[:-1], force[-1] + self._slope])
            load = values[AREA] if alpha == 0 else values[AREA] * (1 + alpha * values[RATE])
            return load * np.stack(self._along(force, values) + self._between(met.tangent, values))

        def motion(values: Array, owners: Integers) -> list[Array]:
            return [self._moved(values, q[owners])]

        return self._integrate(times, integrand, motion, halvings)

    def _remainder(
        self, leading: Array, q: Array, times: Integers, halvings: int
    ) -> tuple[Array, Array]:
        """What is left of the balance with the load 1 + alpha e, divided by alpha, and its slope."""
        first, alpha = leading[times], self._alpha

        def integrand(values: Array, owners: Integers) -> Array:
            before = self._law.at(self._moved(values, first[owners]), self._kept)
            change = self._change(values, first[owners], q[owners])
            after, difference = before.moved(change, alpha)
            rate = values[RATE]
            forces = self._along(difference + rate * after.force, values)
            if self._shift.stop:
                forces[-1] += moment(values[self._shift], before.force)
            tangent = (1 + alpha * rate) * after.tangent
            return values[AREA] * np.stack(forces + self._between(tangent, values))

        def motion(values: Array, owners: Integers) -> list[Array]:
            before = first[owners]
            slow = self._moved(values, before)
            if abs(alpha) <= LINEAR:
                return [slow]
            change = self._change(values, before, q[owners])
            return [slow, slow + alpha * change]

        return self._integrate(times, integrand, motion, halvings)

    def _integrate(
        self, times: Integers, integrand: Integrand, motion: Velocities, halvings: int
    ) -> tuple[Array, Array]:
        """Gradients (times, J) and Hessians (times, J, J); motion: the velocities that matter."""
        values = self._values[:, times]
        channels, count, cells, n, _ = values.shape
        owners = np.repeat(np.arange(count), cells)
        flat = values.reshape(channels, count * cells, n, n)
        cells_now = self._refined(flat, owners, motion, halvings)
        sums = cells_now.integrals(integrand(cells_now.values, cells_now.owners))
        unknowns = len(self._modes)
        return sums[:unknowns].T, sums[unknowns:].T.reshape(count, unknowns, unknowns)

    def _refined(self, values: Array, owners: Integers, motion: Velocities, halvings: int) -> Graded:
        """Cells (channels, cells, n, n) halved towards points at rest and cut along creases."""
        order = values.shape[-1]
        sample = np.array([0, order // 2, order - 1])

        def roughness(values: Array, owners: Integers) -> tuple[NDArray[np.bool_], Integers]:
            velocities = motion(values[:, :, sample[:, None], sample], owners)
            return self._roughness(np.stack(velocities))

        cells_now = graded(values, owners, roughness, halvings)
        for crease in self._creases(motion):
            cells_now = cut(cells_now, crease, AREA, min(halvings // 4, _MOST_ASIDE))
        return cells_now

    def _creases(self, motion: Velocities) -> list[Callable[[Array, Integers], Array]]:
        """Functions that vanish where the tangent of the law jumps, for each of the velocities."""
        normal = self._law.crease
        if normal is None:
            return []
        count = len(motion(self._values[:, 0, :1], np.zeros(1, int)))

        def level(k: int, values: Array, owners: Integers) -> Array:
            v = motion(values, owners)[k]
            return np.asarray(normal[0] * v[0] + normal[1] * v[1])

        return [partial(level, k) for k in range(count)]

    def _moved(self, values: Array, q: Array, at: Array | None = None) -> Array:
        """Velocity against the ground, (2, ...), of points that move with values[:2]; q (..., J)."""
        spread = q.T.reshape(len(self._modes), -1, *(1,) * (values.ndim - 2))
        if len(self._modes) == 1:
            return np.stack([values[0], values[1] + spread[0]])
        x, y = (values if at is None else at)[ARMS]
        return np.stack([values[0] + spread[0] - y * spread[2], values[1] + spread[1] + x * spread[2]])

    def _change(self, values: Array, leading: Array, q: Array) -> Array:
        """What a rigid motion q of second order, v_2 and u add to w/alpha, (2, ...)."""
        still = np.zeros_like(values[VELOCITY]) if self._second.stop == 0 else values[self._second]
        if self._shift.stop:
            still = self._moved(still, leading * [0.0, 0.0, 1.0], self._arms(values))
        return self._moved(still, q, values)

    def _arms(self, values: Array) -> Array:
        """The values with u in the place of x, y."""
        return np.concatenate([values[: ARMS.start], values[self._shift]])

    def _along(self, force: Array, values: Array) -> list[Array]:
        """force . R of the rigid velocities R; force: the kept components."""
        return [*force] if len(force) == 1 else [*force, moment(values[ARMS], force)]

    def _between(self, tangent: Array, values: Array) -> list[Array]:
        """R . tangent . R' of the rigid velocities, row by row; tangent: yy, or xx, xy, yy."""
        if len(tangent) == 1:
            return [*tangent]
        (xx, xy, yy), arms = tangent, values[ARMS]
        turn = [moment(arms, row) for row in ((xx, xy), (xy, yy))]
        return [xx, xy, turn[0], xy, yy, turn[1], *turn, moment(arms, turn)]

    def _roughness(self, w: Array) -> tuple[NDArray[np.bool_], Integers]:
        """Cells on which w/|w| may turn for one of several w, and the axis along which it varies more.

        w: (velocities, 2, cells, 3, 3), at corners, middles of edges and centre.
        """
        centre = w[..., 1:2, 1:2]
        spread = ((w - centre) ** 2).sum(1).max(axis=(-2, -1))
        size = (centre**2).sum(1)[..., 0, 0]
        # tanh(r/s)/r is smooth up to r = i pi s/2
        rough = size + (np.pi / 2 * min(self._law.width, _VISCOUS)) ** 2 < _MARGIN**2 * spread
        across = ((w[..., 2, 1] - w[..., 0, 1]) ** 2).sum(1)
        along = ((w[..., 1, 2] - w[..., 1, 0]) ** 2).sum(1)
        which = rough.argmax(0), np.arange(w.shape[2])
        return rough.any(0), np.where(across[which] > along[which], 0, 1)

    def _unknowns(self, motion: Array) -> Array:
        """Of V_x, V_y, Omega (times, 3) those that are solved for, in units of their own."""
        return np.asarray((motion / self._units.motion)[:, list(self._modes)])

    def _full(self, q: NDArray[np.floating]) -> Array:
        """(times, 3): V_x, V_y, Omega."""
        full = np.zeros((q.shape[0], 3))
        full[:, list(self._modes)] = q
        return full * self._units.motion


def _single(
    residual: Residual, halvings: int, q: Array, ends: Array, xtol: float, near: float
) -> Array:
    """The zero for motions along y alone."""

    def function(x: Array, which: Integers) -> tuple[Array, Array]:
        value, slope = residual(x[:, None], which, halvings=halvings)
        return value[:, 0], slope[:, 0, 0]

    low, high = ends
    return guarded_newton(function, np.clip(q[:, 0], low, high), low, high, xtol, near)[:, None]

"""The transpose of a motion of shapes: from weights of velocities, places and loads to those of states.

`CycleMotion.at` makes them from the states of all phases: interpolation in time, shape functions, load,
lower face, frame of the body. Each step is transposed here, in the reverse order.
"""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.gradient.friction import PointWeights
from fem_check.shell.cycle.motion import CycleMotion
from fem_check.shell.cycle.shapes import harmonics, time_factors
from fem_check.shell.effects.ground import Ground
from fem_check.shell.kinematics.region import Region
from linear_theory.friction.load import Load

Array = NDArray[np.float64]

ENTRIES = (0, 1, 2)


@dataclass(eq=False)
class MotionAdjoint:
    """Of a motion; rules: how many weighted sums over times are taken at once.

    The sums are kept by harmonics of the shapes: `jets` (rules, 2K + 1, entries, components, points)
    and `moments` (rules, 2K + 1, 4) of the frame.
    """

    motion: CycleMotion
    rules: int
    jets: Array = field(init=False)
    moments: Array = field(init=False)

    def __post_init__(self) -> None:
        own = self.motion._jets
        self.jets = np.zeros((self.rules, *own.shape))
        self.moments = np.zeros((self.rules, len(own), 4))

    def add(self, times: Array, at: PointWeights, rule: Array) -> None:
        """Add the weights at times (T,), each times its factors in the rules (rules, T)."""
        motion, count = self.motion, times.size
        values, slopes = time_factors(times, motion.shapes.scene.period, motion._highest)
        jet, rate = (np.tensordot(f, motion._jets, 1).transpose(1, 2, 0, 3) for f in (values, slopes))
        by_jet, by_rate = np.zeros_like(jet), np.zeros_like(rate)
        velocity, place = (part.reshape(2, count, -1) for part in (at.velocity, at.place))
        face = _Face.of(jet, rate) if motion.depth or motion.load is Load.CURRENT else None
        seen, moving = jet[0, :2], rate[0, :2]
        if face is not None and motion.depth:
            seen = seen - motion.depth * face.normal[:2]
            moving = moving - motion.depth * face.turning[:2]
        by_place, by_velocity, by_values, by_slopes = _unframed(
            motion, values, slopes, (seen, moving), (place, velocity)
        )
        by_jet[0, :2], by_rate[0, :2] = by_place, by_velocity
        load = self._by_load(times, at)
        if face is not None:
            area = load * motion.region.weights.ravel() if motion.load is Load.CURRENT else None
            face.add(by_jet, by_rate, area, motion.depth, by_place, by_velocity)
        if motion.load is Load.GROUND:
            ground = motion.shapes.model.find(Ground)
            area = motion._grown_area(times) if ground.load is Load.GROWN else motion.region.measure
            by_jet[0, 2] += load * 2 * ground.stiffness * np.minimum(jet[0, 2], 0) * area
        for own, weights in ((values, by_jet), (slopes, by_rate)):
            factors = rule[:, :, None] * own  # (rules, T, 2K + 1)
            flat = weights.swapaxes(1, 2).swapaxes(0, 1).reshape(count, -1)
            self.jets += (factors.swapaxes(1, 2) @ flat).reshape(self.jets.shape)
        for own, four in ((values, by_values), (slopes, by_slopes)):
            self.moments += (rule[:, :, None] * own).swapaxes(1, 2) @ four.T

    def by_grown_area(self, times: Array, at: PointWeights) -> Array | None:
        """Of the areas that grow with c at those times, (T, points); None if the load has none."""
        motion, load = self.motion, self._by_load(times, at)
        if motion.load is Load.GROWN:
            return load * motion.region.measure
        if motion.load is not Load.GROUND or motion.shapes.model.find(Ground).load is not Load.GROWN:
            return None
        values, _ = time_factors(times, motion.shapes.scene.period, motion._highest)
        z = values @ motion._jets[:, 0, 2]
        stiffness = motion.shapes.model.find(Ground).stiffness
        return np.asarray(load * stiffness * np.minimum(z, 0) ** 2 * motion.region.measure)

    def by_states(self) -> Array:
        """Derivatives by the states, (rules, phases, size)."""
        motion = self.motion
        sheet, count = motion.shapes.discretisation, len(motion.shapes.states)
        found = np.stack(
            [[_onto(motion.region, part, sheet.size) for part in each] for each in self.jets]
        )
        found += self.moments @ self._by_moments
        back = harmonics(np.eye(count)).T  # states to harmonics, transposed
        return np.asarray(back @ found)

    def _by_load(self, times: Array, at: PointWeights) -> Array:
        """By the normal load without the map of friction, (T, points)."""
        load = at.load.reshape(times.size, -1)
        if self.motion.map is None:
            return load
        x, y = self.motion.region.reference[0, :2]
        return np.asarray(load * self.motion.map.values(x, y, times[:, None]))

    @cached_property
    def _by_moments(self) -> Array:
        """The means that define the frame (see `heading.moments`) as rows on the states, (4, size)."""
        sheet = self.motion.shapes.discretisation
        region = sheet.interior
        mass = region.measure / region.measure.sum()
        rows = []
        for parts in ([(0, 0, 1)], [(0, 1, 1)], [(1, 0, 1), (2, 1, 1)], [(1, 1, 1), (2, 0, -1)]):
            density = np.zeros((3, sheet.components, region.size))
            for entry, component, sign in parts:
                density[entry, component] = sign * mass
            rows.append(_onto(region, density, sheet.size))
        return np.stack(rows)


def _onto(region: Region, density: Array, size: int) -> Array:
    """The transpose of `Region.displacement`: (entries, components, points) onto unknowns (size,)."""
    out = np.zeros((size // region.components, region.components))
    dofs = region.dofs.ravel()
    for component, part in enumerate(region.integral(density, ENTRIES)):
        out[:, component] = np.bincount(dofs, part.ravel(), len(out))
    return out.ravel()


def _unframed(
    motion: CycleMotion,
    values: Array,
    slopes: Array,
    seen: tuple[Array, Array],
    weights: tuple[Array, Array],
) -> tuple[Array, Array, Array, Array]:
    """The transpose of `BodyFrame.seen`: by places, velocities, and the frame's means and their rates.

    seen, weights: places and velocities (2, T, points) before it, and their weights after it.
    """
    frame = motion._frame.moments
    x, y, a, b = (values @ frame).T[:, :, None]
    x_rate, y_rate, a_rate, b_rate = (slopes @ frame).T[:, :, None]
    square = a**2 + b**2
    c, s, spin = a / np.sqrt(square), b / np.sqrt(square), (a * b_rate - b * a_rate) / square
    (to_x, to_y), (of_x, of_y) = weights
    x, y = seen[0][0] - x, seen[0][1] - y
    v_x, v_y = seen[1][0] - x_rate + spin * y, seen[1][1] - y_rate - spin * x
    by_vx, by_vy = c * of_x - s * of_y, s * of_x + c * of_y
    by_spin = (by_vx * y - by_vy * x).sum(-1, keepdims=True)
    turned = to_x * (c * y - s * x) - to_y * (s * y + c * x)
    turned = turned + of_x * (c * v_y - s * v_x) - of_y * (s * v_y + c * v_x)
    by_angle = turned.sum(-1, keepdims=True)
    by_x, by_y = c * to_x - s * to_y - spin * by_vy, s * to_x + c * to_y + spin * by_vx
    means = [
        -by_x.sum(-1, keepdims=True),
        -by_y.sum(-1, keepdims=True),
        (-b * by_angle + (b_rate - 2 * spin * a) * by_spin) / square,
        (a * by_angle - (a_rate + 2 * spin * b) * by_spin) / square,
    ]
    rates = [
        -by_vx.sum(-1, keepdims=True),
        -by_vy.sum(-1, keepdims=True),
        -b * by_spin / square,
        a * by_spin / square,
    ]
    by_means, by_rates = (np.stack(part)[..., 0] for part in (means, rates))
    return np.stack([by_x, by_y]), np.stack([by_vx, by_vy]), by_means, by_rates


@dataclass(frozen=True)
class _Face:
    """Tangents a, b of the sheet with their rates, (3, T, points), and what is made of them."""

    a: Array
    b: Array
    a_rate: Array
    b_rate: Array

    @classmethod
    def of(cls, jet: Array, rate: Array) -> "_Face":
        """From (entries, components, T, points); in the plane the third component is 0."""
        return cls(*(_in_space(part) for part in (jet[1], jet[2], rate[1], rate[2])))

    @cached_property
    def director(self) -> Array:
        """a x b."""
        return np.cross(self.a, self.b, axis=0)

    @cached_property
    def size(self) -> Array:
        """Its length."""
        return np.linalg.norm(self.director, axis=0)

    @cached_property
    def normal(self) -> Array:
        """Its direction n."""
        return np.asarray(self.director / self.size)

    @cached_property
    def rate(self) -> Array:
        """Of the director."""
        return np.cross(self.a_rate, self.b, axis=0) + np.cross(self.a, self.b_rate, axis=0)

    @cached_property
    def turning(self) -> Array:
        """The rate of n."""
        return np.asarray((self.rate - (self.rate * self.normal).sum(0) * self.normal) / self.size)

    def add(
        self,
        by_jet: Array,
        by_rate: Array,
        area: Array | None,
        depth: float,
        place: Array,
        velocity: Array,
    ) -> None:
        """Add what weights of |a x b| (T, points), and of places and velocities (2, T, points) on the
        face of that depth, are by the tangents and their rates."""
        n, count = self.normal, by_jet.shape[1]
        director = 0.0 * n if area is None else area * n
        if depth:
            by_n, by_turning = (-depth * _in_space(part) for part in (place, velocity))
            along, turned = (self.rate * n).sum(0), (by_turning * n).sum(0)
            by_rate_of = (by_turning - turned * n) / self.size
            by_n = by_n - (along * by_turning + turned * self.rate) / self.size
            director = director + (by_n - (by_n * n).sum(0) * n) / self.size
            director = director - (self.turning * by_turning).sum(0) / self.size * n
            by_jet[1] += np.cross(self.b_rate, by_rate_of, axis=0)[:count]
            by_jet[2] += np.cross(by_rate_of, self.a_rate, axis=0)[:count]
            by_rate[1] += np.cross(self.b, by_rate_of, axis=0)[:count]
            by_rate[2] += np.cross(by_rate_of, self.a, axis=0)[:count]
        by_jet[1] += np.cross(self.b, director, axis=0)[:count]
        by_jet[2] += np.cross(director, self.a, axis=0)[:count]


def _in_space(part: Any) -> Array:
    """(2 or 3, ...) with the third component 0."""
    if len(part) == 3:
        return np.asarray(part)
    return np.concatenate([part, np.zeros_like(part[:1])])

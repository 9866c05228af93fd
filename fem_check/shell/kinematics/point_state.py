"""The deformed sheet at quadrature points, in the form read by effects.

All quantities are computed on first use: effects that a scene does not name cost nothing.
Points are the last axis, so that every operation runs over contiguous memory.
"""

from collections.abc import Callable
from copy import copy
from functools import cached_property, wraps
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries, Region
from fem_check.shell.kinematics.rest_state import RestState
from linear_theory.friction.load import Load

Array = NDArray[np.float64]
Method = TypeVar("Method", bound=Callable[[Any, "PointState"], Any])


def once_per_state(method: Method) -> Method:
    """A method of an effect, method(state), evaluated once for each state: later calls return the same.

    For what energy, gradient and Hessian share; the callers must not change the arrays.
    """

    @wraps(method)
    def found(self: Any, state: "PointState") -> Any:
        key = (method, id(self))
        if key not in state.found:
            # The effect is kept with its result so that its id cannot be reused for another one.
            state.found[key] = self, method(self, state)
        return state.found[key][1]

    return found  # type: ignore[return-value]


def dot(u: Array, v: Array) -> Array:
    """Sum over components of (..., components, points) vectors; einsum and sum are slower here."""
    out = u[..., 0, :] * v[..., 0, :]
    for c in range(1, u.shape[-2]):
        out += u[..., c, :] * v[..., c, :]
    return np.asarray(out)


def cross(u: Array, v: Array) -> Array:
    """Vector product of (3, points) vectors."""
    out = np.empty_like(u)
    for c, d, e in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(u[d], v[e], out=out[c])
        out[c] -= u[e] * v[d]
    return out


STILL = Step()


class PointState:
    """Position jet, rest state and time step at the points of some elements of a region.

    u: displacement unknowns. entries: derivatives of the position to be read. part: slice of elements.
    rest, step: at the points of that part; in statics the step holds nothing fixed.
    """

    def __init__(
        self,
        region: Region,
        u: Array,
        entries: Entries,
        rest: RestState | None = None,
        step: Step | None = None,
        part: slice = slice(None),
    ) -> None:
        points = region.points(part)
        self.region, self.part, self._points = region, part, points
        self._rest, self.step = rest, STILL if step is None else step
        self._jet, self._row = region.position(u, entries, part), entries.index
        self.found: dict[Any, Any] = {}

    def under(self, rest: RestState | None) -> "PointState":
        """The same positions with another rest state; what is known of the shape is kept."""
        other = copy(self)
        other._rest, other.found = rest, {}
        return other

    @property
    def components(self) -> int:
        """2 in the plane, 3 in space."""
        return self.region.components

    @property
    def rest(self) -> RestState:
        """Rest state of these points."""
        if self._rest is None:
            raise ValueError("rest = None: must be given for an effect that reads it")
        return self._rest

    @property
    def position(self) -> Array:
        """x, (components, points)."""
        return np.asarray(self._jet[self._row(0)])

    def tangent(self, entry: int) -> Array:
        """a_1 or a_2 alone, (components, points)."""
        return np.asarray(self._jet[self._row(entry)])

    @cached_property
    def tangents(self) -> Array:
        """a_1, a_2: (2, components, points)."""
        return self._rows(1, 2)

    @cached_property
    def second(self) -> Array:
        """x_11, x_22, x_12: (3, 3, points)."""
        return self._rows(3, 3)

    def _rows(self, first: int, count: int) -> Array:
        """Entries from `first` on, (count, components, points); entries are in ascending order."""
        start = self._row(first)
        return np.asarray(self._jet[start : start + count])

    @cached_property
    def measure(self) -> Array:
        """Weight times undeformed area (length on an edge, 1 for a point), (points,)."""
        return self.region.measure[self._points]

    @cached_property
    def metric(self) -> Array:
        """a_11, a_22, a_12: (3, points)."""
        tangents = self.tangents
        out = np.empty((3, tangents.shape[-1]))
        out[:2], out[2] = dot(tangents, tangents), dot(tangents[0], tangents[1])
        return out

    @cached_property
    def director(self) -> Array:
        """a_1 x a_2, (3, points), or its only component in the plane, (1, points)."""
        first, second = self.tangents
        if self.components == 2:
            return np.asarray(first[:1] * second[1:] - first[1:] * second[:1])
        return cross(first, second)

    @cached_property
    def jacobian(self) -> Array:
        """|a_1 x a_2|, area per parameter area, (points,)."""
        return np.sqrt(dot(self.director, self.director))

    @cached_property
    def area(self) -> Array:
        """Quadrature weight times current area, (points,)."""
        return self.region.weights.ravel()[self._points] * self.jacobian

    def area_of(self, load: Load) -> Array:
        """Quadrature weight times the reference area of a load, (points,)."""
        if load is Load.MATERIAL:
            return self.measure
        if load is Load.GROWN:
            return self.rest.grown_area
        return self.step.counted

    @cached_property
    def normal(self) -> Array:
        """Unit normal n, (3, points)."""
        return np.asarray(self.director / self.jacobian)

    @cached_property
    def inverse_metric(self) -> Array:
        """a^11, a^22, a^12: (3, points)."""
        a11, a22, a12 = self.metric
        out = np.empty_like(self.metric)
        out[0], out[1], out[2] = a22, a11, -a12
        out /= self.jacobian**2
        return out

    @cached_property
    def dual(self) -> Array:
        """a^1, a^2 with a^c . a_d = delta_cd, (2, components, points)."""
        i11, i22, i12 = self.inverse_metric
        first, second = self.tangents
        out = i12 * self.tangents[::-1]
        out[0] += i11 * first
        out[1] += i22 * second
        return np.asarray(out)

    @cached_property
    def curvature(self) -> Array:
        """b_11, b_22, b_12 = n . x_ab, (3, points)."""
        return dot(self.second, self.normal)

    @cached_property
    def christoffel(self) -> Array:
        """Gamma^c_ab = a^c . x_ab, (2, 3, points) with ab = 11, 22, 12."""
        return dot(self.dual[:, None], self.second)

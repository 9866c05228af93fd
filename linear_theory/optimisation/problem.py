"""What an optimiser asks: an objective with its gradient and their errors, and the region of points.

Objectives are made large. Unknowns are scaled, so that a change by 1 is about the whole of what is
allowed: gradients and curvatures of different unknowns can be compared.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]


ROUNDING = 1e-12
"""By which an equality may be missed: points are scaled to 1."""


class Unusable(SheetcrawlError, ValueError):
    """A point at which the objective has no value, as its level of theory does not hold there."""


@dataclass(frozen=True)
class Evaluation(Shown):
    """An objective at a point, with its gradient (unknowns,).

    error: of the value, absolute; doubt (unknowns,): of the gradient. kink: why there is no gradient
    here but from one side, in words; empty if there is.
    """

    value: float
    error: float
    gradient: Array
    doubt: Array
    kink: str = ""


class Objective(Protocol):
    """Raises `Unusable`, saying why, where there is no value."""

    def __call__(self, point: Array, /) -> Evaluation:
        """At a point (unknowns,)."""
        ...


class Constraint(Protocol):
    """Numbers that must be <= 0."""

    @property
    def name(self) -> str:
        """For people: what must not be more than what."""
        ...

    def excess(self, point: Array) -> Array:
        """(rows,), to be <= 0."""
        ...

    def slopes(self, point: Array) -> Array:
        """Its derivatives, (rows, unknowns)."""
        ...

    def curvature(self, multipliers: Array) -> Array:
        """Second derivatives of multipliers (rows,) times the excess, (unknowns, unknowns)."""
        ...


@dataclass(frozen=True, eq=False)
class Linear(Shown):
    """matrix (rows, unknowns) times the point, at most `most` (rows,).

    equal: neither more nor less, but for ROUNDING; every row is then there twice, with both signs.
    """

    name: str
    matrix: Array
    most: Array
    equal: bool = False

    def excess(self, point: Array) -> Array:
        """See Constraint."""
        over = np.asarray(self.matrix @ point - self.most)
        return np.concatenate([over, -over]) - ROUNDING if self.equal else over

    def slopes(self, point: Array) -> Array:
        """See Constraint."""
        return np.vstack([self.matrix, -self.matrix]) if self.equal else self.matrix

    def curvature(self, multipliers: Array) -> Array:
        """None."""
        return np.zeros((self.matrix.shape[1],) * 2)


@dataclass(frozen=True, eq=False)
class Ball(Shown):
    """The sum of weights (unknowns,) >= 0 times squares, at most `most` > 0, over `most`."""

    name: str
    weights: Array
    most: float

    def excess(self, point: Array) -> Array:
        """See Constraint."""
        return np.array([self.weights @ point**2 / self.most - 1.0])

    def slopes(self, point: Array) -> Array:
        """See Constraint."""
        return (2 * self.weights * point / self.most)[None]

    def curvature(self, multipliers: Array) -> Array:
        """See Constraint."""
        return np.diag(2 * self.weights / self.most) * multipliers[0]


class Limited(Protocol):
    """A `Constraint` of one row on a number that has an error; `linear_theory.optimisation.limits`."""

    @property
    def name(self) -> str:
        """See Constraint."""
        ...

    def excess(self, point: Array) -> Array:
        """See Constraint, (1,)."""
        ...

    def slopes(self, point: Array) -> Array:
        """See Constraint, (1, unknowns)."""
        ...

    def doubt(self, point: Array) -> Array:
        """Errors of the slopes, (unknowns,)."""
        ...

    def kink(self, point: Array) -> str:
        """Why there are slopes from one side only, in words; empty if not."""
        ...


@dataclass(frozen=True, eq=False)
class Region(Shown):
    """Points with low <= point <= high, (unknowns,) each, that meet the constraints.

    centre: a point inside, from which every other one can be seen: on the way to it no constraint is
    left that was met. spread: how far starts lie from it, (unknowns,). limits: further ones on numbers
    that are computed with an error, which the centre need not meet. Raises ValueError, naming it, for a
    constraint that the centre does not meet, and for bounds that are not in order.
    """

    low: Array
    high: Array
    centre: Array
    spread: Array
    constraints: tuple[Constraint, ...] = ()
    limits: tuple["Limited", ...] = ()

    def __post_init__(self) -> None:
        if not np.all(self.low < self.high):
            place = int(np.argmin(self.high - self.low))
            raise ValueError(
                f"bounds of unknown {place}: {self.low[place]:g} must be < {self.high[place]:g}"
            )
        for constraint in self.constraints:
            if constraint.excess(self.centre).max() > 0:
                raise ValueError(f"constraints: no point meets {constraint.name!r} within the bounds")

    @property
    def unknowns(self) -> int:
        """How many."""
        return self.low.size

    def excess(self, point: Array) -> float:
        """The most by which bounds and constraints are missed; <= 0 if all are met."""
        bounds = max(float((self.low - point).max()), float((point - self.high).max()))
        return max([bounds, *(float(one.excess(point).max()) for one in self.constraints)])

    def towards_centre(self, point: Array, allowed: float = 0.0) -> Array:
        """The point itself if it is inside, else the farthest one inside on the way to the centre."""
        if self.excess(point) <= allowed:
            return point
        for one in self.constraints:
            if isinstance(one, Linear) and one.equal:
                point = point - np.linalg.pinv(one.matrix) @ (one.matrix @ point - one.most)
        inside, outside = 0.0, 1.0
        for _ in range(50):
            middle = (inside + outside) / 2
            good = self.excess(self.centre + middle * (point - self.centre)) <= allowed
            inside, outside = (middle, outside) if good else (inside, middle)
        return np.asarray(self.centre + inside * (point - self.centre))

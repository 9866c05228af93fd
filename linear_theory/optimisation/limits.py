"""Limits on numbers that are computed with an error, and the worst or the mean of several objectives.

The largest value of the smallest of several objectives V_i is that of a new unknown t,

    max t   with   t - V_i(x) <= 0,

whose constraints are smooth where the V_i are (the epigraph form). Their multipliers are the weights of
the V_i in the gradient of the worst one, and sum to 1.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.optimisation.problem import Evaluation, Objective

Array = NDArray[np.float64]

REMEMBERED = 64
"""Points whose evaluations are kept."""


@dataclass(frozen=True, eq=False)
class Limit(Shown):
    """sign times (a number less a bound), over a scale > 0, must be <= 0.

    sign: 1 for "at most", -1 for "at least". of: the number with its gradient; value: it alone, if that
    costs less.
    """

    name: str
    of: Objective
    bound: float
    sign: float
    scale: float
    value: Callable[[Array], float] | None = None
    _known: dict[Any, Evaluation] = field(default_factory=dict, repr=False)
    _nearest: list[float] = field(default_factory=list, repr=False)

    def excess(self, point: Array) -> Array:
        """See Constraint; remembers the number that was nearest to the bound, or within it."""
        number = self.value(point) if self.value is not None else self._at(point).value
        if not self._nearest or self.sign * (number - self._nearest[0]) < 0:
            self._nearest[:] = [number]
        return np.array([self.sign * (number - self.bound) / self.scale])

    def slopes(self, point: Array) -> Array:
        """See Constraint."""
        return (self.sign * self._at(point).gradient / self.scale)[None]

    def doubt(self, point: Array) -> Array:
        """See Limited."""
        return self._at(point).doubt / self.scale

    def kink(self, point: Array) -> str:
        """See Limited."""
        return self._at(point).kink

    @property
    def nearest(self) -> float:
        """The number at the point that came closest; NaN if there was none."""
        return self._nearest[0] if self._nearest else float("nan")

    def tighter(self, by: float) -> "Limit":
        """With a bound that is stricter by so many scales; the same number under the same name."""
        return replace(self, bound=self.bound - self.sign * self.scale * by)

    def _at(self, point: Array) -> Evaluation:
        key = point.tobytes()
        if key not in self._known:
            if len(self._known) >= REMEMBERED:
                self._known.pop(next(iter(self._known)))
            self._known[key] = self.of(np.array(point))
        return self._known[key]


@dataclass(frozen=True, eq=False)
class Worst(Shown):
    """The smallest of several objectives, an objective with kinks; names: of them, for people."""

    members: Sequence[Objective]
    names: Sequence[str]

    def __call__(self, point: Array) -> Evaluation:
        """See Objective; with the gradient of the smallest one."""
        return min((one(point) for one in self.members), key=lambda found: found.value)

    def lifted(self, scale: float) -> list[Limit]:
        """t - V_i/scale <= 0 at points (unknowns + 1,) with t as the last one."""
        return [
            Limit(name, _Above(member, scale), 0.0, 1.0, 1.0)
            for member, name in zip(self.members, self.names, strict=True)
        ]


@dataclass(frozen=True)
class _Above:
    """t less a member over the scale."""

    member: Objective
    scale: float

    def __call__(self, point: Array) -> Evaluation:
        found, scale = self.member(point[:-1]), self.scale
        return Evaluation(
            float(point[-1]) - found.value / scale,
            found.error / scale,
            np.append(-found.gradient / scale, 1.0),
            np.append(found.doubt / scale, 0.0),
            found.kink,
        )


@dataclass(frozen=True, eq=False)
class Mean(Shown):
    """The sum of weights times objectives."""

    members: Sequence[Objective]
    weights: Sequence[float]

    def __call__(self, point: Array) -> Evaluation:
        """See Objective."""
        found, weights = [one(point) for one in self.members], np.array(self.weights)
        return Evaluation(
            float(weights @ [one.value for one in found]),
            float(weights @ [one.error for one in found]),
            weights @ np.array([one.gradient for one in found]),
            weights @ np.array([one.doubt for one in found]),
            "; ".join(dict.fromkeys(one.kink for one in found if one.kink)),
        )


class Beside:
    """A constraint or a limit at points with further unknowns, `more`, behind its own."""

    def __init__(self, inner: Any, more: int = 1) -> None:
        self._inner, self._more = inner, more
        self.name: str = inner.name
        self.equal: bool = getattr(inner, "equal", False)

    def excess(self, point: Array) -> Array:
        """See Constraint."""
        return np.asarray(self._inner.excess(point[: -self._more]))

    def slopes(self, point: Array) -> Array:
        """See Constraint."""
        found = self._inner.slopes(point[: -self._more])
        return np.hstack([found, np.zeros((found.shape[0], self._more))])

    def curvature(self, multipliers: Array) -> Array:
        """See Constraint."""
        return np.pad(self._inner.curvature(multipliers), (0, self._more))

    def doubt(self, point: Array) -> Array:
        """See Limited."""
        return np.pad(self._inner.doubt(point[: -self._more]), (0, self._more))

    def kink(self, point: Array) -> str:
        """See Limited."""
        return str(self._inner.kink(point[: -self._more]))

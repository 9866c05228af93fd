"""Gradients by an adjoint: of small-strain theory, of second order, and of the cycle of shapes.

A gradient there costs about as much as the speed, for any number of unknowns. It is asked for by the
names of the unknowns, of fields as in scene files, of harmonics "wave.cosine.0" for cos phi and so on.
"""

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.optimisation.objectives import CostOfTransport, Objective
from fem_check.optimisation.unknowns import Unknowns
from fem_check.shell.cycle.gradient import cycle_gradient
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.gradient import (
    Gradient,
    MotionGradient,
    motion_gradient,
    parameters,
    speed_gradient,
)
from linear_theory.gradient.second.speed import check_second
from linear_theory.optimisation.problem import Evaluation, Unusable
from linear_theory.scene.level import THEORY
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

SMALL = 1e-4
"""Change of an unknown over which the number of a field is differentiated: its scenes cost nothing."""


NUMBERS = (
    *("growth.alpha", "growth.curvature_coupling", "gravity.weight", "ground.stiffness"),
    *("sheet.width", "sheet.poisson", "sheet.thickness"),
)
"""Of a sheet that bends. One that changes with a field other than its own, as the weight of a given
density does with the thickness, leaves derivatives to differences."""

ASIDE = 0.37
"""Of the bounds, where the scene must have a gradient, too: unknowns may break symmetries."""

SAME = 1e-9
"""Relative change of a number that is none."""


class Way(NamedTuple):
    """How a level is differentiated: gradients of the speed, and of all numbers of a motion, if any.

    check: raises ValueError for a scene that has none.
    """

    speed: Callable[..., Gradient]
    motion: Callable[..., MotionGradient] | None = None
    check: Callable[[Scene], None] = lambda scene: None


WAYS: Mapping[str, Way] = {
    "first order": Way(speed_gradient, motion_gradient, THEORY.require),
    "second order": Way(
        partial(speed_gradient, order=2), partial(motion_gradient, order=2), check_second
    ),
    "cycle": Way(cycle_gradient),
}
"""Of the levels that have an adjoint."""

REMEMBERED = 32
"""Gradients of the last points."""


class Found(NamedTuple):
    """Gradients of the numbers of one motion; power: None where it was not asked for; cost: likewise,
    or where it is infinite."""

    speed: Gradient
    power: Gradient | None = None
    cost: Gradient | None = None


@dataclass
class Solves:
    """The gradients of the last points, for all who ask for numbers of the same motions.

    with_power: whether any of them asks for the power.
    """

    with_power: bool = False
    known: dict[bytes, Found] = dataclasses.field(default_factory=dict)

    def at(self, point: Array, work: Callable[[], Found]) -> Found:
        """Those known of a point, or those of the work."""
        key = point.tobytes()
        if key not in self.known:
            while len(self.known) >= REMEMBERED:
                self.known.pop(next(iter(self.known)))
            self.known[key] = work()
        return self.known[key]


class Adjoint:
    """The objective of unknowns and its gradient; rtol: of the speed."""

    def __init__(
        self, unknowns: Unknowns, objective: Objective, way: Way, rtol: float, solves: Solves
    ) -> None:
        self._unknowns, self._objective, self._rtol = unknowns, objective, rtol
        self._way, self._solves = way, solves
        self._names = unknowns.names
        self._parameters = parameters(self._names)
        region = unknowns.region
        aside = region.low + ASIDE * (region.high - region.low)
        for point in (region.centre, region.towards_centre(aside)):
            way.check(unknowns.scene_at(point))
        self._check()

    @classmethod
    def of(
        cls,
        unknowns: Unknowns,
        objective: Objective,
        rtol: float,
        level: str = "first order",
        solves: Solves | None = None,
    ) -> "Adjoint | None":
        """None where there is no gradient of these unknowns, of this objective, or at this level."""
        way, solves = WAYS.get(level), solves or Solves(objective.with_power)
        if way is None or unknowns.scene.alpha == 0 or not objective.differentiable:
            return None
        if objective.with_power and way.motion is None:
            return None
        try:
            return cls(unknowns, objective, way, rtol, solves)
        except (ValueError, Unusable):
            return None  # a field that it does not know

    def _check(self) -> None:
        """Raise ValueError where there is no derivative, or where a field changes more than itself.

        As the thickness does where the weight follows from a density, or growth from two layers.
        """
        unknowns = self._unknowns
        for one in self._parameters:
            one.direction(unknowns.scene)
        if unknowns.scene.planar:
            return
        centre, numbers = unknowns.region.centre, parameters(NUMBERS)
        for place, field in enumerate(unknowns.fields):
            move = SMALL * np.eye(centre.size)[place]
            ends = [unknowns.scene_at(centre + sign * move) for sign in (1, -1)]
            others = [one for one in numbers if one.name != field.name]
            if not all(math.isclose(*map(one.value, ends), rel_tol=SAME) for one in others):
                raise ValueError(f"over = {field.name!r}: changes more of the scene than itself")

    def __call__(self, point: Array) -> Evaluation:
        """See `linear_theory.optimisation.problem.Objective`."""
        scene, objective = self._unknowns.scene_at(point), self._objective
        try:
            found = self._solves.at(point, lambda: self._found(scene))
        except (SheetcrawlError, ValueError, ArithmeticError) as problem:
            raise Unusable(" ".join(str(problem).split())) from None
        speed = found.speed.speed
        if speed.beyond_reach:
            raise Unusable(speed.beyond_reach)
        value: Estimate = objective.of(speed, scene)
        values, errors = self._slopes(found, scene)
        chain = self._chain(point)
        gradient = chain * values
        if by_period := objective.slopes(speed, scene).period:
            gradient = gradient + by_period * self._periods(point)
        doubt, kinks = abs(chain) * errors, "; ".join(found.speed.kinks)
        return Evaluation(
            objective.sign * value.value, value.error, objective.sign * gradient, doubt, kinks
        )

    def _found(self, scene: Scene) -> Found:
        """By one solve, of what is asked for by any who share it."""
        way, asked = self._way, {"over": self._names, "rtol": self._rtol}
        if self._solves.with_power and way.motion is not None:
            return Found(*way.motion(scene, **asked))
        return Found(way.speed(scene, **asked))

    def _slopes(self, found: Found, scene: Scene) -> tuple[Array, Array]:
        """Derivatives of the number by the parameters, and their errors, at a fixed period."""
        if isinstance(self._objective, CostOfTransport):  # its distance may be across, too
            if found.cost is None:
                raise Unusable("cost of transport: the sheet gets nowhere, or its error is not known")
            return found.cost.values, found.cost.errors
        slopes = self._objective.slopes(found.speed.speed, scene)
        values, errors = slopes.speed * found.speed.values, abs(slopes.speed) * found.speed.errors
        if slopes.power and found.power is not None:
            values = values + slopes.power * found.power.values
            errors = errors + abs(slopes.power) * found.power.errors
        return values, errors

    def _periods(self, point: Array) -> Array:
        """Derivatives of the period by the unknowns."""
        ends = [
            [self._unknowns.scene_at(point + sign * move).period for sign in (1, -1)]
            for move in SMALL * np.eye(point.size)[: len(self._unknowns.fields)]
        ]
        found = np.zeros(point.size)
        found[: len(ends)] = [(one - other) / (2 * SMALL) for one, other in ends]
        return found

    def _chain(self, point: Array) -> Array:
        """Derivatives of the parameters by the unknowns."""
        unknowns, found = self._unknowns, []
        for place in range(len(unknowns.fields)):
            move, parameter = SMALL * np.eye(point.size)[place], self._parameters[place]
            one, other = (unknowns.scene_at(point + sign * move) for sign in (1, -1))
            found.append((parameter.value(one) - parameter.value(other)) / (2 * SMALL))
        harmonics = unknowns.harmonics
        waves = [] if harmonics is None else [harmonics.unit] * harmonics.unknowns
        return np.array(found + waves)

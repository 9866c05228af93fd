"""Gradients by an adjoint: of small-strain theory, of second order, and of the cycle of shapes.

A gradient there costs about as much as the speed, for any number of unknowns. It is asked for by the
names of the unknowns, of fields as in scene files, of harmonics "wave.cosine.0" for cos phi and so on.
"""

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.optimisation.objectives import CostOfTransport, Objective
from fem_check.optimisation.unknowns import Unknowns
from fem_check.shell.cycle.gradient import cycle_gradient
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.gradient import Gradient, cost_gradient, parameters, speed_gradient
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
    """How a level is differentiated: gradients of speed and, if any, of cost.

    check: raises ValueError for a scene that has none.
    """

    speed: Callable[..., Gradient]
    cost: Callable[..., Gradient] | None = None
    check: Callable[[Scene], None] = lambda scene: None


WAYS: Mapping[str, Way] = {
    "first order": Way(speed_gradient, cost_gradient, THEORY.require),
    "second order": Way(
        partial(speed_gradient, order=2), partial(cost_gradient, order=2), check_second
    ),
    "cycle": Way(cycle_gradient),
}
"""Of the levels that have an adjoint."""


class Adjoint:
    """The objective of unknowns and its gradient; work: by which; rtol: of the speed."""

    def __init__(self, unknowns: Unknowns, objective: Objective, way: Way, rtol: float) -> None:
        self._unknowns, self._objective, self._rtol = unknowns, objective, rtol
        self._is_cost = isinstance(objective, CostOfTransport)
        self._work = way.cost if self._is_cost else way.speed
        harmonics = unknowns.harmonics
        waves = [] if harmonics is None else [_renamed(name) for name in harmonics.names]
        self._names = [*(field.name for field in unknowns.fields), *waves]
        self._parameters = parameters(self._names)
        region = unknowns.region
        aside = region.low + ASIDE * (region.high - region.low)
        for point in (region.centre, region.towards_centre(aside)):
            way.check(unknowns.scene_at(point))
        self._check()

    @classmethod
    def of(
        cls, unknowns: Unknowns, objective: Objective, rtol: float, level: str = "first order"
    ) -> "Adjoint | None":
        """None where there is no gradient of these unknowns, of this objective, or at this level."""
        way, is_cost = WAYS.get(level), isinstance(objective, CostOfTransport)
        if way is None or unknowns.scene.alpha == 0:
            return None
        if (way.cost if is_cost else objective.slope(unknowns.scene)) is None:
            return None
        try:
            return cls(unknowns, objective, way, rtol)
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
        scene = self._unknowns.scene_at(point)
        assert self._work is not None
        try:
            found = self._work(scene, self._names, rtol=self._rtol)
        except (SheetcrawlError, ValueError, ArithmeticError) as problem:
            raise Unusable(" ".join(str(problem).split())) from None
        if found.speed.beyond_reach:
            raise Unusable(found.speed.beyond_reach)
        value: Estimate = self._objective.of(found.speed, scene)
        factor = 1.0 if self._is_cost else self._objective.slope(scene) or 0.0
        chain = self._objective.sign * factor * self._chain(point)
        return Evaluation(
            self._objective.sign * value.value,
            value.error,
            chain * found.values,
            abs(chain) * found.errors,
            "; ".join(found.kinks),
        )

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


def _renamed(name: str) -> str:
    """A harmonic as the gradient calls it: "wave.cosine.0" for "wave.cosine[1]"."""
    table, bracket, number = name.partition("[")
    return f"{table}.{int(number.rstrip(']')) - 1}" if bracket else name

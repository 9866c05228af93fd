"""Gradients by an adjoint: of small-strain theory, and of second order for sheets that bend, by the
package `linear_theory.gradient` if it is there.

A gradient there costs about as much as the speed, for any number of unknowns. It is asked for by the
names of the unknowns, of fields as in scene files, of harmonics "wave.cosine.0" for cos phi and so on.
"""

import math
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from fem_check.optimisation.objectives import CostOfTransport, Objective
from fem_check.optimisation.unknowns import Unknowns
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.problem import Evaluation, Unusable
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]

PACKAGE = "linear_theory.gradient"

ORDERS = {"first order": 1, "second order": 2}
"""The levels whose speeds it differentiates, and their orders; the second of sheets that bend alone."""

NUMBERS = (
    *("growth.alpha", "growth.curvature_coupling", "gravity.weight", "ground.stiffness"),
    *("sheet.width", "sheet.poisson", "sheet.thickness"),
)
"""Of a sheet that bends. One that changes with a field other than its own, as the weight of a given
density does with the thickness, leaves derivatives to differences."""

SMALL = 1e-4
"""Change of an unknown over which the number of a field is differentiated: its scenes cost nothing."""


SAME = 1e-9
"""Relative change of a number that is none."""


class Gradient(Protocol):
    """What is asked of a gradient: the speed, derivatives by name, their errors, and kinks in words."""

    speed: CrawlSpeed
    values: Array
    errors: Array
    kinks: tuple[str, ...]


class Adjoint:
    """The objective of unknowns and its gradient; rtol: of the speed; order: of the theory."""

    def __init__(self, unknowns: Unknowns, objective: Objective, rtol: float, order: int = 1) -> None:
        self._unknowns, self._objective = unknowns, objective
        self._asked = {"rtol": rtol, "order": order} if order > 1 else {"rtol": rtol}
        self._package: Any = import_module(PACKAGE)
        harmonics = unknowns.harmonics
        waves = [] if harmonics is None else [_renamed(name) for name in harmonics.names]
        self._names = [*(field.name for field in unknowns.fields), *waves]
        self._parameters = self._package.parameters(self._names)

    @classmethod
    def of(
        cls, unknowns: Unknowns, objective: Objective, rtol: float, level: str = "first order"
    ) -> "Adjoint | None":
        """None where there is no gradient of these unknowns, of this objective, or at this level."""
        order = ORDERS.get(level)
        if order is None or (order > 1) == unknowns.scene.planar:
            return None
        known = isinstance(objective, CostOfTransport) or objective.slope(unknowns.scene) is not None
        if not known or unknowns.scene.alpha == 0 or find_spec(PACKAGE) is None:
            return None
        try:
            found = cls(unknowns, objective, rtol, order)
            return found if order == 1 or found._changes_one_by_one() else None
        except (ValueError, Unusable):
            return None  # a field that it does not know

    def __call__(self, point: Array) -> Evaluation:
        """See `linear_theory.optimisation.problem.Objective`."""
        scene = self._unknowns.scene_at(point)
        is_cost = isinstance(self._objective, CostOfTransport)
        work: Callable[..., Gradient] = getattr(
            self._package, "cost_gradient" if is_cost else "speed_gradient"
        )
        try:
            found = work(scene, self._names, **self._asked)
        except (SheetcrawlError, ValueError, ArithmeticError) as problem:
            raise Unusable(" ".join(str(problem).split())) from None
        if found.speed.beyond_reach:
            raise Unusable(found.speed.beyond_reach)
        value: Estimate = self._objective.of(found.speed, scene)
        factor = 1.0 if is_cost else self._objective.slope(scene) or 0.0
        chain = self._objective.sign * factor * self._chain(point)
        return Evaluation(
            self._objective.sign * value.value,
            value.error,
            chain * found.values,
            abs(chain) * found.errors,
            "; ".join(found.kinks),
        )

    def _changes_one_by_one(self) -> bool:
        """Whether each field changes no other number of the scene than its own."""
        unknowns, numbers = self._unknowns, self._package.parameters(NUMBERS)
        centre = unknowns.region.centre
        for place, field in enumerate(unknowns.fields):
            move = SMALL * np.eye(centre.size)[place]
            ends = [unknowns.scene_at(centre + sign * move) for sign in (1, -1)]
            others = [one for one in numbers if one.name != field.name]
            if not all(math.isclose(*map(one.value, ends), rel_tol=SAME) for one in others):
                return False
        return True

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

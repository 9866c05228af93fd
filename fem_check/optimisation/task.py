"""The whole of what is optimised: one or several regimes, the region of the unknowns, and limits."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from fem_check.optimisation.adjoint import Solves
from fem_check.optimisation.asked import Asked
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.options.constraints import Side, sides_of, sums_of
from fem_check.optimisation.options.robust import WORST, Robust
from fem_check.optimisation.unknowns import Unknowns
from fem_check.optimisation.values import Question, unheard
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.limits import Limit, Mean, Worst
from linear_theory.optimisation.problem import Constraint, Evaluation, Linear, Region, Unusable
from linear_theory.optimisation.problem import Objective as OfPoints

Array = NDArray[np.float64]

MET = 1e-9
"""By which the centre of a region may miss a sum that it was brought to."""

INSIDE = 1e-6
"""How far it is brought into an inequality, where there is room."""


@dataclass(frozen=True)
class Task:
    """What is to be best. questions: of every regime, one alone where there are none; names: of them;
    sides: limits on numbers of the answers, in every regime."""

    unknowns: Unknowns
    region: Region
    questions: tuple[Question, ...]
    names: tuple[str, ...]
    robust: Robust | None
    sides: tuple[Side, ...]

    @classmethod
    def of(cls, asked: Asked, kept: Kept, watched: Callable[[float], None] = unheard) -> "Task":
        """watched: hears of every value of the objective. Raises ValueError, by name, for constraints
        that nothing meets."""
        unknowns, objective, constraints = asked.unknowns, asked.objective, asked.constraints
        parts = asked.regimes or [("", unknowns)]
        sides = tuple(sides_of(constraints, unknowns.units))
        powers = any(one.with_power for one in (objective, *(side.quantity for side in sides)))
        questions = tuple(
            Question(
                *(one, asked.settings, objective, kept, f"{place} " if asked.regimes else ""),
                watched=watched,
                solves=Solves(powers),
            )
            for place, (_, one) in enumerate(parts)
        )
        region = region_of(unknowns, sums_of(constraints, unknowns))
        return cls(unknowns, region, questions, tuple(name for name, _ in parts), asked.robust, sides)

    @property
    def first(self) -> Question:
        """Of the first regime."""
        return self.questions[0]

    def joined(self, members: list[OfPoints]) -> OfPoints:
        """One objective of those of the regimes."""
        if self.robust is None:
            return members[0]
        if self.robust.by == WORST:
            return Worst(members, self.names)
        return Mean(members, self.robust.of_each(len(members)))

    def stages(self) -> list[OfPoints]:
        """Objectives to climb, one after the other; the last of a regime that has fewer stays."""
        found = [question.stages() for question in self.questions]
        return [
            self.joined([_at(stages, number) for stages in found])
            for number in range(self.count(found))
        ]

    @staticmethod
    def count(stages: list[list[OfPoints]]) -> int:
        """Of the regime that has most."""
        return max(map(len, stages))

    def truth(self) -> OfPoints:
        """The objective itself, without a gradient."""
        return self.joined([question.truth() for question in self.questions])

    def proof(self, stage: int) -> OfPoints:
        """What the certificate is of."""
        return self.joined([_proof(question, stage) for question in self.questions])

    def limits(self) -> list[tuple[Limit, ...]]:
        """At each stage, and at last on the numbers themselves; none without any."""
        if not self.sides:
            return []
        count = self.count([question.stages() for question in self.questions])
        return [*map(self._limits_at, range(count)), self._limits(lambda question: question.truth())]

    def _limits_at(self, stage: int) -> tuple[Limit, ...]:
        return self._limits(lambda question: _at(question.stages(), stage))

    def proven(self, stage: int, tighter: Array | None = None) -> Region:
        """The region of the certificate, with the limits at a stage, their slopes with errors.

        tighter (limits,): by how much they were tightened there, over their scales.
        """
        found = self._limits(lambda question: _proof(question, stage))
        if tighter is not None:
            found = tuple(one.tighter(by) for one, by in zip(found, tighter.tolist(), strict=True))
        return replace(self.region, limits=found)

    def _limits(self, of: Callable[[Question], OfPoints]) -> tuple[Limit, ...]:
        found = []
        for name, question in zip(self.names, self.questions, strict=True):
            for side in self.sides:
                asked = question.also(side.quantity, side.key)
                where = f"{side.name} with {name}" if name else side.name
                found.append(_limit(where, side, asked, of(asked)))
        return tuple(found)

    def measured(self, point: Array) -> dict[str, Estimate]:
        """The bounded numbers at a point, by the name of their limit."""
        found = {}
        for name, question in zip(self.names, self.questions, strict=True):
            for side in self.sides:
                value = question.also(side.quantity, side.key).value(point)
                where = f"{side.name} with {name}" if name else side.name
                found[where] = Estimate(side.quantity.sign * value.value, value.error)
        return found

    def value(self, each: list[Estimate]) -> Estimate:
        """The objective of those of the regimes."""
        if self.robust is None:
            return each[0]
        if self.robust.by == WORST:
            sign = self.first.objective.sign
            return min(each, key=lambda one: sign * one.value)
        weights = np.array(self.robust.of_each(len(each)))
        values, errors = np.array(each).T
        return Estimate(float(weights @ values), float(weights @ errors))

    def has_curvature(self) -> bool:
        """Whether second derivatives are worth their gradients."""
        return all(question.has_curvature() for question in self.questions)


def _at(stages: list[OfPoints], number: int) -> OfPoints:
    return stages[min(number, len(stages) - 1)]


def _proof(question: Question, stage: int) -> OfPoints:
    return question.proof(min(stage, len(question.stages()) - 1))


def _limit(name: str, side: Side, question: Question, of: OfPoints) -> Limit:
    """On the number itself, without the sign that makes it an objective."""
    sign = question.objective.sign

    def number(point: Array) -> Evaluation:
        found = of(point)
        if sign > 0:
            return found
        return replace(found, value=-found.value, gradient=-found.gradient)

    scale = abs(side.bound) or 1.0
    cheap = None
    if not question.has_line_gradient and question.by_adjoint() is None:
        cheap = lambda point: sign * question.value(point).value  # noqa: E731
    return Limit(name, number, side.bound, side.sign, scale, cheap)


def region_of(unknowns: Unknowns, sums: list[Linear]) -> Region:
    """With sums of fields, and a centre that meets them. Raises ValueError, by name, if none does."""
    region = unknowns.region
    if not sums:
        return region
    constraints = (*region.constraints, *sums)
    centre = _centre(region, constraints)
    for one in sums:
        if float(one.excess(centre).max()) > 0:
            raise ValueError(f"constraints: {one.name}: no point meets it within the bounds")
    return replace(region, centre=centre, constraints=constraints)


def _centre(region: Region, constraints: tuple[Constraint, ...]) -> Array:
    """The nearest point to the centre that meets all, a little inside where there is room."""
    rules: list[dict[str, Any]] = []
    for one in constraints:
        if getattr(one, "equal", False):
            rules.append({"type": "eq", "fun": lambda p, one=one: one.matrix @ p - one.most})
        else:
            rules.append({"type": "ineq", "fun": lambda p, one=one: -one.excess(p) - INSIDE})
    bounds = list(zip(region.low, region.high, strict=True))
    found = minimize(
        lambda p: (float((p - region.centre) @ (p - region.centre)), 2 * (p - region.centre)),
        *(region.centre,),
        method="SLSQP",
        jac=True,
        bounds=bounds,
        constraints=rules,
        options={"ftol": 1e-14},
    ).x
    for one in constraints:
        if isinstance(one, Linear) and one.equal:
            found = found - np.linalg.pinv(one.matrix) @ (one.matrix @ found - one.most)
    return np.asarray(np.clip(found, region.low, region.high))


def known(question: Question, scene: Any) -> Estimate | None:
    """The objective of a scene by the level of a question; None where it has none."""
    try:
        return question.objective.of(question.answer(scene).speed, scene)
    except Unusable:
        return None


def finite(values: list[Estimate | None]) -> list[Estimate] | None:
    """All of them, or None."""
    found = [one for one in values if one is not None and not math.isnan(one.value)]
    return found if len(found) == len(values) else None

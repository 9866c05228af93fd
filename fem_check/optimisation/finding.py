"""From a task to its optimum: the climbs, the certificate, and what is told of the best scene."""

import contextlib
import math
import time
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.ways import way_of
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.options.searching import Searching
from fem_check.optimisation.result import Check, Limited, Optimum, Regime, Scale, Start
from fem_check.optimisation.task import Task, finite, known
from fem_check.optimisation.values import Question
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.certificate import Certificate, certificate
from linear_theory.optimisation.limits import Limit, Worst
from linear_theory.optimisation.problem import Unusable
from linear_theory.optimisation.search import Climbed, climb

Array = NDArray[np.float64]

LADDER = ("strip", "first order", "second order", "cycle", "stepped")
"""Levels, each checked by the next one that represents the scene."""

ROUNDING = 1e-12
"""Of values, relative."""


class NothingFound(SheetcrawlError):
    """No start has led to a scene with an answer that keeps to all constraints; says why not."""


class Telling(Protocol):
    """Hears of the climbs."""

    def at(self, start: int, stages: int) -> None:
        """A new start."""

    def done(self, stages: int) -> None:
        """So many stages of it."""


def found(
    task: Task, points: list[Array], searching: Searching, telling: Telling, begin: float
) -> Optimum:
    """From those points; begin: time at which the work began. Raises NothingFound."""
    stages, limits, climbs, how = task.stages(), task.limits(), [], searching.how
    for place, point in enumerate(points):
        telling.at(place, len(stages))
        climbs.append(climb(stages, task.truth(), task.region, point, how, telling.done, limits))
    best = max(climbs, key=lambda one: one.value)
    if best.found is None:
        raise NothingFound(_nothing(task, points[0], limits))
    proof = certificate(
        task.proof(best.stage),
        task.proven(best.stage, best.tighter),
        best.point,
        task.unknowns.names,
        task.has_curvature(),
    )
    return _optimum(task, best, climbs, proof, searching.check, begin)


def _optimum(
    task: Task, best: Climbed, climbs: list[Climbed], proof: Certificate, check: bool, begin: float
) -> Optimum:
    assert best.found is not None
    unknowns, objective, sign = task.unknowns, task.first.objective, task.first.objective.sign
    value = Estimate(sign * best.found.value, best.found.error)
    ends = tuple(_end(one, sign) for one in climbs)
    regimes = _regimes(task, best.point)
    worst = max(range(len(regimes)), key=lambda k: -sign * regimes[k].value.value) if regimes else 0
    leading = task.questions[worst]
    slopes = _gradient(task, best, proof) / unknowns.slopes(best.point)
    return Optimum(
        scene=unknowns.scene_at(best.point),
        values=unknowns.values(best.point),
        objective=objective,
        answer=leading.answer(leading.unknowns.scene_at(best.point)),
        value=value,
        start=_start(task, task.questions),
        certificate=proof,
        rounding=abs(proof.value - best.found.value),
        sensitivities=dict(zip(unknowns.names, (sign * slopes).tolist(), strict=True)),
        starts=ends,
        check=_check(task, best.point) if check else None,
        answers=task.first.kept.fresh,
        seconds=time.perf_counter() - begin,
        units=unknowns.units,
        field_units={field.name: field.axis.unit for field in unknowns.fields},
        scale=Scale.of(objective, value, [one.first for one in ends]),
        without_effect=_without_effect(task, best.point, value, proof),
        outside=unknowns.outside,
        slopes=tuple(unknowns.slopes(best.point).tolist()),
        limits=_limits(task, best.point, proof),
        regimes=regimes,
        by="" if task.robust is None else task.robust.by,
    )


def _gradient(task: Task, best: Climbed, proof: Certificate) -> Array:
    """Of the objective; of the worst of several the sum with the multipliers as weights."""
    objective = task.proof(best.stage)
    if not isinstance(objective, Worst):
        return objective(best.point).gradient
    weights = np.array([proof.pushes.get(name, 0.0) for name in objective.names])
    if not weights.any():
        return objective(best.point).gradient
    gradients = np.array([one(best.point).gradient for one in objective.members])
    return np.asarray(weights / weights.sum() @ gradients)


def _regimes(task: Task, point: Array) -> tuple[Regime, ...]:
    if task.robust is None:
        return ()
    found = []
    for name, question in zip(task.names, task.questions, strict=True):
        value = question.value(point)
        scene = question.unknowns.scene_at(point)
        found.append(Regime(name, Estimate(question.objective.sign * value.value, value.error), scene))
    return tuple(found)


def _limits(task: Task, point: Array, proof: Certificate) -> tuple[Limited, ...]:
    """Numbers of the answer with their bounds, and what moving a bound that holds brings."""
    values, sign, found = task.measured(point), task.first.objective.sign, []
    for limit, side in zip(task.proven(0).limits, task.sides * len(task.questions), strict=True):
        size, value = abs(side.bound) or 1.0, values[limit.name]
        brings = sign * side.sign * proof.pushes.get(limit.name, 0.0) / size
        beyond = max(side.sign * (value.value - side.bound) / size, 0.0)
        found.append(Limited(limit.name, value, side.bound, brings, side.quantity.unit, beyond))
    return tuple(found)


def _nothing(task: Task, point: Array, limits: list[tuple[Limit, ...]]) -> str:
    """Why there is no value at the end of any start."""
    sides = task.sides * len(task.questions)
    for limit, side in zip(limits[0], sides, strict=True) if limits else ():
        if limit.sign * (limit.nearest - limit.bound) > 0:
            near = side.measured(limit.nearest)
            return f"constraints: {limit.name}: no start meets it; the nearest that was found is {near}"
    if limits and all(not math.isnan(limit.nearest) for limit in limits[0]):
        names = ", ".join(limit.name for limit in limits[0])
        return f"constraints: {names}: no start meets all of them at once"
    return f"no start has an answer; the first: {_why(task, point)}"


def _why(task: Task, point: Array) -> str:
    try:
        for question in task.questions:
            question.value(point)
        task.measured(point)
    except Unusable as problem:
        return str(problem)
    return "it has one, but no neighbour of it"


def _without_effect(task: Task, point: Array, value: Estimate, proof: Certificate) -> tuple[str, ...]:
    """Fields that no bound holds, and at both of whose bounds the objective is the same."""
    found, truth, here = [], task.truth(), task.first.objective.sign * value.value
    for place, field in enumerate(task.unknowns.fields):
        ends = [np.where(np.arange(point.size) == place, share, point) for share in (0.0, 1.0)]
        if any(held.endswith(f" bound of {field.name}") for held in proof.held):
            continue
        limits = [one for one in task.proven(0).limits if one.name in proof.pushes]
        if any(one.slopes(point)[0][place] for one in limits):
            continue
        with contextlib.suppress(Unusable):
            doubt = value.error + ROUNDING * abs(here)
            if all(abs(one.value - here) <= one.error + doubt for one in map(truth, ends)):
                found.append(field.name)
    return tuple(found)


def _end(one: Climbed, sign: float) -> Start:
    value = math.nan if one.found is None else sign * one.found.value
    return Start(sign * one.first, value, one.words, one.evaluations, one.seconds)


def _start(task: Task, questions: tuple[Question, ...]) -> Estimate | None:
    """The objective of the scene as it is given, in every regime; None where it has none."""
    values = finite([known(question, question.unknowns.scene) for question in questions])
    return None if values is None else task.value(values)


def _check(task: Task, point: Array) -> Check | None:
    """By the next level that represents the scene in every regime."""
    scenes = [question.unknowns.scene_at(point) for question in task.questions]
    for level in LADDER[LADDER.index(task.first.settings.level) + 1 :]:
        try:
            for scene in scenes:
                way_of(scene, level)
        except ValueError:
            continue
        higher = tuple(
            Question(one.unknowns, RunSettings(level, RTOL), one.objective, Kept(None, None))
            for one in task.questions
        )
        try:
            each = [
                one.objective.of(one.answer(scene).speed, scene)
                for one, scene in zip(higher, scenes, strict=True)
            ]
        except Unusable as problem:
            return Check(level, None, None, str(problem))
        return Check(level, task.value(each), _start(task, higher))
    return None

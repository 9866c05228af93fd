"""From a scene and what may change to the best one."""

import contextlib
import math
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.solving import solve
from fem_check.choice.ways import ANSWERS, way_of
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.objectives import Objective, objective_of
from fem_check.optimisation.result import Check, Optimum, Scale, Start
from fem_check.optimisation.unknowns import Unknowns
from fem_check.optimisation.values import Question
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.common.progress import Progress, Report, reporting
from linear_theory.common.threads import one_blas_thread
from linear_theory.optimisation.certificate import Certificate, certificate
from linear_theory.optimisation.problem import Unusable
from linear_theory.optimisation.search import Ascent, Climbed, climb
from linear_theory.optimisation.starts import starts as starting_points
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

LADDER = ("strip", "first order", "second order", "cycle", "stepped")
"""Levels, each checked by the next one that represents the scene."""

FINE = 1e-3
"""Relative tolerance of the answers of a search."""


ROUNDING = 1e-12
"""Of values, relative."""


class NothingFound(SheetcrawlError):
    """No start has led to a scene with an answer; says why not."""


def optimise(
    scene: Scene,
    over: Mapping[str, Any],
    objective: Any = "speed",
    *,
    level: str = "auto",
    rtol: float = FINE,
    starts: int = 4,
    seed: int = 0,
    how: Ascent | None = None,
    check: bool = True,
    file: str | Path | None = None,
    progress: bool | Report | None = None,
) -> Optimum:
    """The best scene between bounds, with a certificate.

    over: fields by their names in scene files, each between two bounds, (low, high) or a `Between`, and
    "wave": `Harmonics`, the profile of a travelling wave of given size. objective: "speed" (towards
    +y), "speed towards -y", "distance per period", "cost of transport" (small), or a function of the
    `CrawlSpeed`, to be large. level: by which the speeds are found, as in `solve`; "auto" is the one
    that answers the scene as given. rtol: of these speeds. starts: climbs, the first from the scene
    itself, the others from a Sobol sequence by that seed. how: an `Ascent`. check: whether the next
    higher level is asked, too. file: keeps all answers, and the same call goes on from it.

    The gradient is the closed one of a strip at that level, of speeds by a travelling wave,
    growth.alpha and wave.period, else by adjoints or differences. Dry friction on a strip is smoothed in stages
    (see `values`).

    Raises ValueError, before any work, for what is no field, no objective, no level; `NothingFound`
    where no start has an answer, as beyond the reach of the level; KeyboardInterrupt, saying what the
    file has kept.

    >>> from fem_check import Harmonics, optimise
    >>> from linear_theory import Scene, Sheet, TravellingWave
    >>> scene = Scene(Sheet(), TravellingWave([1.0, 0.2], [0.0, 0.0]), alpha=0.1)
    >>> found = optimise(scene, {"wave": Harmonics(2, largest=1.0)}, level="strip", starts=2)
    >>> print(f"V = {found.value.value:.3f} L/T, {found.converged}, {found.agreed} of 2 starts")
    V = 0.053 L/T, True, 2 of 2 starts
    """
    scene = validation.instance("scene", scene, Scene)
    settings = RunSettings(level, rtol)
    unknowns = Unknowns(scene, over)
    return search(
        unknowns,
        objective_of(objective),
        settings,
        starts,
        seed,
        how,
        check,
        file,
        progress,
    )


@one_blas_thread
def search(
    unknowns: Unknowns,
    objective: Objective,
    settings: RunSettings,
    starts: int,
    seed: int,
    how: Ascent | None,
    check: bool,
    file: str | Path | None = None,
    progress: bool | Report | None = None,
    again: str = "the same call",
) -> Optimum:
    """`optimise` of unknowns; again: what is said to go on with after an interruption."""
    begin, report = time.perf_counter(), reporting(progress)
    how = Ascent() if how is None else validation.instance("how", how, Ascent)
    check = validation.flag("check", check)
    points = _starts(unknowns, starts, validation.integer("seed", seed, 0))
    path = None if file is None else _path(file)
    settings = _with_level(unknowns.scene, settings)
    asked = {
        "unknowns": unknowns.definition(),
        "objective": objective.to_dict(),
        "settings": settings.to_dict(),
    }
    with Kept(path, asked) as kept:
        question = Question(unknowns, settings, objective, kept)
        telling = _Telling(report, kept, len(points), begin)
        try:
            return _found(question, points, how, check, telling, begin)
        except KeyboardInterrupt:
            if path is None:
                raise KeyboardInterrupt("interrupted; nothing is kept without file=...") from None
            words = f"interrupted; {kept.count} answers are in {path}; {again} goes on with them"
            raise KeyboardInterrupt(words) from None


def _path(file: object) -> Path:
    if not isinstance(file, str | Path) or not str(file):
        raise ValueError(f"file = {validation.shown(file)}: must be the name of a file")
    return Path(file)


def _with_level(scene: Scene, settings: RunSettings) -> RunSettings:
    """With the level that answers the scene, in place of "auto". Raises ValueError for none."""
    level = validation.choice("level", settings.level, ANSWERS)
    if level in ("auto", "predict"):
        way = way_of(scene, level)
        level = solve(scene, level, RTOL).level if way == "predict" else way
    else:
        way_of(scene, level)
    return RunSettings(level, settings.rtol, settings.periods, settings.steps)


def _starts(unknowns: Unknowns, count: int, seed: int) -> list[Array]:
    """The scene as given, where it says all, and others."""
    present = unknowns.present
    known = np.where(np.isnan(present), unknowns.region.centre, present)
    inside = np.clip(known, unknowns.region.low, unknowns.region.high)
    return starting_points(unknowns.region, count, seed, inside)


class _Telling:
    """Reports after each answer."""

    def __init__(self, report: Report | None, kept: Kept, starts: int, begin: float) -> None:
        self._report, self._kept, self._starts, self._begin = report, kept, starts, begin
        self._start = self._stages = self._done = 0
        if report is not None:
            kept.told = self._tell

    def at(self, start: int, stages: int) -> None:
        """A new start."""
        self._start, self._stages, self._done = start, stages, 0

    def done(self, stages: int) -> None:
        """So many stages of it."""
        self._done = stages

    def _tell(self) -> None:
        assert self._report is not None
        share = (self._start + self._done / max(self._stages, 1)) / self._starts
        words = (
            f"start {min(self._start + 1, self._starts)} of {self._starts}, {self._kept.count} answers"
        )
        self._report(Progress(words, min(share, 1.0), time.perf_counter() - self._begin, math.nan))


def _found(
    question: Question,
    points: list[Array],
    how: Ascent,
    check: bool,
    telling: _Telling,
    begin: float,
) -> Optimum:
    unknowns, objective = question.unknowns, question.objective
    stages, truth, climbs = question.stages(), question.truth(), []
    for number, point in enumerate(points):
        telling.at(number, len(stages))
        climbs.append(climb(stages, truth, unknowns.region, point, how, telling.done))
    best = max(climbs, key=lambda one: one.value)
    if best.found is None:
        raise NothingFound(f"no start has an answer; the first: {_why(question, points[0])}")
    proof = _certificate(question, best)
    scene, sign = unknowns.scene_at(best.point), objective.sign
    value = Estimate(sign * best.found.value, best.found.error)
    slopes = question.proof(best.stage)(best.point).gradient / unknowns.slopes(best.point)
    ends = tuple(_end(one, sign) for one in climbs)
    return Optimum(
        scene=scene,
        values=unknowns.values(best.point),
        objective=objective,
        answer=question.answer(scene),
        value=value,
        start=_of(question, unknowns.scene),
        certificate=proof,
        rounding=abs(proof.value - best.found.value),
        sensitivities=dict(zip(unknowns.names, (sign * slopes).tolist(), strict=True)),
        starts=ends,
        check=_check(question, scene) if check else None,
        answers=question.kept.fresh,
        seconds=time.perf_counter() - begin,
        units=unknowns.units,
        field_units={field.name: field.axis.unit for field in unknowns.fields},
        scale=Scale.of(objective, value, [one.first for one in ends]),
        without_effect=_without_effect(question, best.point, value, proof),
        outside=unknowns.outside,
    )


def _without_effect(
    question: Question, point: Array, value: Estimate, proof: Certificate
) -> tuple[str, ...]:
    """Fields that no bound holds, and at both of whose bounds the objective is the same."""
    found = []
    for place, field in enumerate(question.unknowns.fields):
        ends = [np.where(np.arange(point.size) == place, share, point) for share in (0.0, 1.0)]
        if any(held.endswith(f" bound of {field.name}") for held in proof.held):
            continue
        with contextlib.suppress(Unusable):
            others = [question.value(end) for end in ends]
            here = question.objective.sign * value.value
            doubt = value.error + ROUNDING * abs(here)
            if all(abs(one.value - here) <= one.error + doubt for one in others):
                found.append(field.name)
    return tuple(found)


def _certificate(question: Question, best: Climbed) -> Certificate:
    unknowns = question.unknowns
    return certificate(
        question.proof(best.stage),
        unknowns.region,
        best.point,
        unknowns.names,
        question.has_curvature(),
    )


def _why(question: Question, point: Array) -> str:
    try:
        question.value(point)
    except Unusable as problem:
        return str(problem)
    return "it has one, but no neighbour of it"


def _end(one: Climbed, sign: float) -> Start:
    value = math.nan if one.found is None else sign * one.found.value
    return Start(sign * one.first, value, one.words, one.evaluations, one.seconds)


def _of(question: Question, scene: Scene) -> Estimate | None:
    """The objective of a scene; None where it has none."""
    try:
        return question.objective.of(question.answer(scene).speed, scene)
    except Unusable:
        return None


def _check(question: Question, scene: Scene) -> Check | None:
    """By the next level that represents the scene."""
    for level in LADDER[LADDER.index(question.settings.level) + 1 :]:
        try:
            way_of(scene, level)
        except ValueError:
            continue
        higher = Question(
            question.unknowns, RunSettings(level, RTOL), question.objective, Kept(None, None)
        )
        try:
            best = question.objective.of(higher.answer(scene).speed, scene)
        except Unusable as problem:
            return Check(level, None, None, str(problem))
        return Check(level, best, _of(higher, question.unknowns.scene))
    return None

"""From a scene and what may change to the best one."""

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
from fem_check.optimisation.finding import NothingFound as NothingFound
from fem_check.optimisation.finding import found
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.objectives import OBJECTIVES, Objective, objective_of
from fem_check.optimisation.options.constraints import Bound, checked
from fem_check.optimisation.options.robust import Robust, unknowns_of
from fem_check.optimisation.result import Optimum
from fem_check.optimisation.task import Task
from fem_check.optimisation.unknowns import Unknowns
from linear_theory.common import validation
from linear_theory.common.progress import Progress, Report, reporting
from linear_theory.common.threads import one_blas_thread
from linear_theory.identity import content_key
from linear_theory.optimisation.search import Ascent
from linear_theory.optimisation.starts import starts as starting_points
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

FINE = 1e-3
"""Relative tolerance of the answers of a search."""


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
    constraints: Mapping[str, Any] | None = None,
    robust: Robust | None = None,
) -> Optimum:
    """The best scene between bounds, with a certificate.

    over: fields by their names in scene files, each between two bounds, (low, high) or a `Between`, and
    "wave": `Harmonics`, the profile of a travelling wave of given size. objective: "speed" (towards
    +y), "speed towards -y", "distance per period", "cost of transport" (small), or a function of the
    `CrawlSpeed`, to be large. level: by which the speeds are found, as in `solve`; "auto" is the one
    that answers the scene as given. rtol: of these speeds. starts: climbs, the first from the scene
    itself, the others from a Sobol sequence by that seed. how: an `Ascent`. check: whether the next
    higher level is asked, too. file: keeps all answers, and the same call goes on from it;
    functions are known again by their code and what that reads.
    constraints: `Bound`s by name, of numbers of the answer or sums of fields, which the best scene must
    keep to. robust: a `Robust`, several regimes over which the objective is the worst or the mean.

    The gradient is the closed one of a strip at that level, of speeds by a travelling wave,
    growth.alpha and wave.period, else by adjoints or differences. Dry friction
    on a strip is smoothed in stages (see `values`).

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
        constraints=constraints,
        robust=robust if robust is None else validation.instance("robust", robust, Robust),
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
    constraints: Mapping[str, Any] | None = None,
    robust: Robust | None = None,
) -> Optimum:
    """`optimise` of unknowns; again: what is said to go on with after an interruption."""
    begin, report = time.perf_counter(), reporting(progress)
    how = Ascent() if how is None else validation.instance("how", how, Ascent)
    check = validation.flag("check", check)
    path = None if file is None else _path(file)
    constraints = checked(constraints)
    regimes = (
        [] if robust is None else unknowns_of(robust, unknowns.scene, unknowns.over, unknowns.base)
    )
    settings = _with_level(unknowns.scene, settings)
    for name, one in regimes:
        _check_regime(name, one.scene, settings.level)
    asked = {
        "unknowns": unknowns.definition(),
        "objective": objective.to_dict(),
        "settings": settings.to_dict(),
        "constraints": {name: bound.definition() for name, bound in constraints.items()},
        "robust": None if robust is None else robust.definition(),
        "regimes": [[name, one.definition()] for name, one in regimes],
    }
    if path is not None:
        asked |= _functions(objective, constraints)
    with Kept(path, asked) as kept:
        task = Task.of(unknowns, regimes, objective, settings, constraints, robust, kept)
        points = _starts(task, starts, validation.integer("seed", seed, 0))
        telling = _Telling(report, kept, len(points), begin)
        try:
            return found(task, points, how, check, telling, begin)
        except KeyboardInterrupt:
            if path is None:
                raise KeyboardInterrupt("interrupted; nothing is kept without file=...") from None
            answers = "1 answer is" if kept.count == 1 else f"{kept.count} answers are"
            words = f"interrupted; {answers} in {path}; {again} goes on with them"
            raise KeyboardInterrupt(words) from None


def _functions(objective: Objective, constraints: Mapping[str, Bound]) -> dict[str, Any]:
    """Keys of the functions in a question, whose names say nothing of what they compute.

    Raises Unidentifiable, a ValueError, for a function whose answers cannot be known again.
    """
    functions: dict[str, Any] = {
        f"constraints: {name}": bound.of for name, bound in constraints.items() if callable(bound.of)
    }
    if objective not in OBJECTIVES.values():
        functions["objective"] = objective
    keys = {name: content_key(one, name) for name, one in functions.items()}
    return {"functions": keys} if keys else {}


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


def _check_regime(name: str, scene: Scene, level: str) -> None:
    """Raise ValueError where the level does not represent a regime."""
    try:
        way_of(scene, level)
    except ValueError as problem:
        raise ValueError(f"regimes: {name}: {problem}") from None


def _starts(task: Task, count: int, seed: int) -> list[Array]:
    """The scene as given, where it says all, and others."""
    present, region = task.unknowns.present, task.region
    known = np.where(np.isnan(present), region.centre, present)
    inside = np.clip(known, region.low, region.high)
    return starting_points(region, count, seed, inside)


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

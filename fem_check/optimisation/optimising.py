"""From a scene and what may change to the best one."""

import math
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.choice.settings import RunSettings
from fem_check.optimisation.asked import Asked
from fem_check.optimisation.finding import NothingFound as NothingFound
from fem_check.optimisation.finding import found
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.objectives import objective_of
from fem_check.optimisation.options.constraints import checked, unit_of
from fem_check.optimisation.options.robust import Robust
from fem_check.optimisation.options.searching import Keeping, Searching
from fem_check.optimisation.result import Optimum
from fem_check.optimisation.task import Task
from fem_check.optimisation.unknowns import Unknowns
from linear_theory.common import validation
from linear_theory.common.progress import Progress, Report, reporting
from linear_theory.common.threads import one_blas_thread
from linear_theory.optimisation.climbing import Ascent
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
    asked = Asked(
        Unknowns(validation.instance("scene", scene, Scene), over),
        objective_of(objective),
        RunSettings(level, rtol),
        checked(constraints),
        robust if robust is None else validation.instance("robust", robust, Robust),
    )
    searching = Searching(starts, seed, Ascent() if how is None else how, check)
    return search(asked, searching, Keeping(None if file is None else _path(file), reporting(progress)))


@one_blas_thread
def search(asked: Asked, searching: Searching, keeping: Keeping) -> Optimum:
    """The answer to a question; see `optimise`."""
    begin, asked = time.perf_counter(), asked.with_level()
    question = asked.definition()
    if keeping.file is not None:
        question |= asked.functions()
    with Kept(keeping.file, question) as kept:
        telling = _Telling(keeping.report, kept, asked, searching.starts, begin)
        task = Task.of(asked, kept, telling.heard)
        points = _starts(task, searching)
        try:
            return found(task, points, searching, telling, begin)
        except KeyboardInterrupt:
            raise KeyboardInterrupt(keeping.interrupted(kept.count)) from None


def _path(file: object) -> Path:
    if not isinstance(file, str | Path) or not str(file):
        raise ValueError(f"file = {validation.shown(file)}: must be the name of a file")
    return Path(file)


def _starts(task: Task, searching: Searching) -> list[Array]:
    """The scene as given, where it says all, and others."""
    present, region = task.unknowns.present, task.region
    known = np.where(np.isnan(present), region.centre, present)
    inside = np.clip(known, region.low, region.high)
    return starting_points(region, searching.starts, searching.seed, inside)


class _Telling:
    """Reports after each answer."""

    def __init__(
        self, report: Report | None, kept: Kept, asked: Asked, starts: int, begin: float
    ) -> None:
        self._report, self._kept, self._starts, self._begin = report, kept, starts, begin
        self._objective, self._value = asked.objective, math.nan
        self._unit = unit_of(asked.objective.unit, asked.unknowns.units) or asked.objective.unit
        self._start = self._stages = self._done = 0
        if report is not None:
            kept.told = self._tell

    def at(self, start: int, stages: int) -> None:
        """A new start."""
        self._start, self._stages, self._done = start, stages, 0

    def done(self, stages: int) -> None:
        """So many stages of it."""
        self._done = stages

    def heard(self, value: float) -> None:
        """The objective at the last point."""
        self._value = value

    def _tell(self) -> None:
        assert self._report is not None
        share = (self._start + self._done / max(self._stages, 1)) / self._starts
        start = min(self._start + 1, self._starts)
        words = f"start {start} of {self._starts}, {self._kept.count} answers"
        if not math.isnan(self._value):
            words += f", {self._objective.name} {self._value:.4g} {self._unit}".rstrip() + " now"
        self._report(Progress(words, min(share, 1.0), time.perf_counter() - self._begin, math.nan))

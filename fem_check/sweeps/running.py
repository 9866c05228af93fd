"""A sweep from its plan to its file; what the file holds already is not asked again."""

import contextlib
import json
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

from fem_check.choice.settings import RunSettings
from fem_check.sweeps.plan import LIMIT, Plan, Refused, plan_of
from fem_check.sweeps.points.designs import Design, Grid
from fem_check.sweeps.records.opening import writing
from fem_check.sweeps.records.record import Record, program
from fem_check.sweeps.records.result import Sweep, kept
from fem_check.sweeps.records.store import Store, StoreError
from fem_check.sweeps.tally import Tally, Telling
from fem_check.sweeps.work import cluster, flight, here
from fem_check.sweeps.work.answering import Answering, Task, record_of
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.progress import Report
from linear_theory.scene.scene import Scene

AGAIN = "the same call"

TOLD = 5
"""Of the reasons why scenes are refused, at the most."""


class RefusedScenes(SheetcrawlError, ValueError):
    """Scenes of a plan that cannot be; its message has a line for each reason."""

    @property
    def mistakes(self) -> tuple[str, ...]:
        """Each with its place, if it has one."""
        return tuple(str(self).splitlines())


def sweep(
    scene: Scene | Sequence[Scene],
    over: Mapping[str, Any] | None = None,
    file: str | Path = "sweep.sqlite",
    *,
    design: Design | None = None,
    level: str = "auto",
    rtol: float | None = 1e-2,
    periods: int = 2,
    steps: int | None = None,
    seconds: float = LIMIT,
    workers: int | None = None,
    scheduler: Any = None,
    retry: bool = False,
    progress: Report | None = None,
) -> Sweep:
    """Answer many scenes on many cores, and keep a record of each in one file.

    over: the fields that differ, by their names in scene files, each with a list of values or a range
    (`fem_check.sweeps.Between`); or a list of scenes instead of one, and no `over`. design: every value
    with every other (`Grid`, the default), `Paired` lists, `Random` or `LatinHypercube` points. level:
    "auto", the cheapest way that represents the scene, or one by name: "predict", "cycle", "stepped",
    or "strip", "first order", "second order" of `predict`; rtol, periods, steps: as there. seconds:
    after which a scene is given up.

    file: an SQLite database, which is made, or goes on: what it holds is not computed again, after an
    interruption neither. A scene that fails has a record with the reason; retry: try those again.
    workers: processes, as many as cores unless given; 1 works in this process, without Dask. scheduler:
    address of a Dask scheduler, or a cluster. progress: called with a `Progress`.

    Raises ValueError, before any work, for a field that is not there, for scenes that cannot be, and
    for a file or a scheduler that cannot be used; ModuleNotFoundError without Dask; `SheetcrawlError`
    where the file can no longer be written or the scheduler is lost; KeyboardInterrupt, saying what is
    kept.

    >>> import tempfile
    >>> from fem_check import Scene, sweep
    >>> from linear_theory import Sheet, SineWave
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = sweep(
    ...         scene,
    ...         over={"growth.alpha": [0.05, 0.1], "sheet.width": [0.25, 0.5]},
    ...         file=f"{folder}/speeds.sqlite",
    ...         rtol=0.1,
    ...         workers=1,
    ...     )
    >>> print(found.size, found.counts)
    4 {'answered': 4}
    """
    settings = RunSettings(level, rtol, periods, steps)
    plan = plan_of(scene, over, design or Grid(), settings, seconds)
    return run(plan, file, workers=workers, scheduler=scheduler, retry=retry, progress=progress)


def run(
    plan: Plan,
    file: str | Path,
    *,
    workers: int | None = None,
    scheduler: Any = None,
    retry: bool = False,
    progress: Report | None = None,
    again: str = AGAIN,
    answering: Answering = record_of,
) -> Sweep:
    """Answer the scenes of a plan that its file has no record of; see `sweep`.

    again: what is said to go on with after an interruption. answering: the work itself.
    """
    path, count = Path(file), workers_of(workers)
    if scheduler is not None or count > 1:
        cluster.require_dask()
    with writing(path) as store:
        number = _begun(store, plan, progress)
        if retry:
            store.forget_failures(number)
        tally = Tally(store.counts(number), progress)
        with _kept(tally, path, again):
            _answer(store, number, plan, tally, Means(count, scheduler, answering))
    return kept(path, plan.key())


class Means(NamedTuple):
    """By what the work is done."""

    workers: int
    scheduler: Any
    answering: Answering


def workers_of(workers: int | None) -> int:
    """As many as this process may use cores, unless given."""
    if workers is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return validation.integer("workers", workers, 1)


def _begun(store: Store, plan: Plan, progress: Report | None) -> int:
    """The number of the sweep in the file, with all its points checked and kept, if it is new."""
    number = store.sweep(plan.key())
    if number is not None:
        return number
    about = {
        "key": plan.key(),
        "size": plan.size,
        "definition": json.dumps(plan.definition()),
        "axes": json.dumps([[axis.path, axis.unit] for axis in plan.axes]),
        "units": json.dumps(plan.units and [plan.units.length, plan.units.time]),
        "program": program(),
        "begun": datetime.now(UTC).isoformat(timespec="seconds"),
    }
    return store.begin(about, _checked(plan, progress))


def _checked(plan: Plan, progress: Report | None) -> Iterator[tuple[int, str, Sequence[Any]]]:
    """Place, key and point of all scenes. Raises RefusedScenes, after the last, for some."""
    reasons: dict[str, int] = {}
    tell = Telling(progress)
    for place, point in enumerate(plan.points()):
        try:
            key = plan.question(point).key()
        except Refused as refused:
            for where, words in refused.found:
                said = plan.told(where, words)
                reasons[said] = reasons.get(said, 0) + 1
        else:
            yield place, key, point
        tell("scenes checked", place + 1, plan.size)
    if reasons:
        raise RefusedScenes(_told(reasons, plan.size))


def _told(reasons: Mapping[str, int], size: int) -> str:
    lines = [f"{words} ({count} of {size} scenes)" for words, count in reasons.items()]
    more = [f"and {len(lines) - TOLD} more reasons"] if len(lines) > TOLD else []
    return "\n".join([*lines[:TOLD], *more])


def _answer(store: Store, number: int, plan: Plan, tally: Tally, means: Means) -> None:
    """All scenes that are open."""
    if not tally.open:
        return
    tasks = (_task(plan, key, point) for key, point in store.open_points(number))
    with contextlib.ExitStack() as held:
        found: Iterable[Record | None]
        if means.scheduler is None and min(means.workers, tally.open) == 1:
            found = here.records(tasks, means.answering)
        else:
            client = held.enter_context(
                cluster.connected(min(means.workers, tally.open), means.scheduler)
            )
            found = held.enter_context(
                contextlib.closing(flight.records(client, tasks, means.answering))
            )
        tally.tell()
        for record in found:
            if record is not None:
                _check_version(record)
                store.keep(record)
                tally.count(record)
            tally.tell()


def _task(plan: Plan, key: str, point: Sequence[Any]) -> Task:
    question = plan.question(point)
    if question.key() != key:
        raise SheetcrawlError(
            "this program reads a scene of the sweep differently than the one that began it; begin "
            "it again in another file"
        )
    return Task(key, question, plan.seconds)


def _check_version(record: Record) -> None:
    if record.program != program():
        raise cluster.WrongWorkers(
            f"the worker {record.worker} has sheetcrawl {record.program}, this is {program()}"
        )


@contextlib.contextmanager
def _kept(tally: Tally, path: Path, again: str) -> Iterator[None]:
    """Say, with what has stopped the sweep, what is kept and how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"interrupted; {tally.words(path)}: {again}") from None
    except (StoreError, cluster.LostScheduler, cluster.WrongWorkers) as stopped:
        raise type(stopped)(f"{stopped}; {tally.words(path)}: {again}") from None

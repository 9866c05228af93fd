"""Optimisation files: a scene, what may change between which bounds, and what is to be best, as TOML.

scene = "hydrogel.toml"            # or its tables here, [scene.sheet], [scene.wave], ...

[over]
growth.swelling = { low = "5 %", high = "10 %" }

[harmonics]                        # of the wave, if they are to change
count = 5
largest = 1.0

[optimise]                         # all of it may be left out
objective = "cost of transport"
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field as Limits
from pydantic import ValidationError

from fem_check.choice.settings import RunSettings
from fem_check.files.fields import Natural, Table
from fem_check.files.mistakes import Mistakes, nearest
from fem_check.files.reading import data_of, text_of
from fem_check.optimisation.objectives import OBJECTIVES
from fem_check.optimisation.optimising import FINE, search
from fem_check.optimisation.over import WAVE, Field, Harmonics
from fem_check.optimisation.result import Optimum
from fem_check.optimisation.unknowns import Unknowns
from fem_check.sweeps.sweep_file import base_of, between, flattened
from linear_theory.common.progress import Report
from linear_theory.optimisation.search import Ascent

PARTS = ("scene", "over", "harmonics", "optimise")


class HarmonicsTable(Table):
    """The profile of a travelling wave of given size."""

    count: Natural
    """Harmonics."""
    largest: Annotated[float, Limits(gt=0)] | None = None
    """Of |c|."""
    mean_square: Annotated[float, Limits(gt=0)] | None = None
    """Of c, instead."""
    mean: bool = True
    """Whether the mean of c may differ from 0."""


class OptimiseTable(Table):
    """What is to be best, and how it is searched for."""

    objective: Literal["speed", "speed towards -y", "distance per period", "cost of transport"] = (
        "speed"
    )
    """To be large; cost of transport: to be small."""
    level: (
        Literal["auto", "predict", "cycle", "stepped", "strip", "first order", "second order"] | None
    ) = None
    """Instead of that of the scene."""
    rtol: Annotated[float, Limits(gt=0, lt=1)] = FINE
    """Of the speeds."""
    starts: Annotated[int, Limits(ge=1)] = 4
    """Climbs."""
    seed: Annotated[int, Limits(ge=0)] = 0
    """Of the points at random."""
    method: Literal["SLSQP", "trust-constr"] = "SLSQP"
    """Of scipy."""
    check: bool = True
    """Whether the next higher level is asked for the best scene and the given one."""


@dataclass(frozen=True)
class OptimiseFile:
    """What an optimisation file says."""

    unknowns: Unknowns
    settings: RunSettings
    table: OptimiseTable

    def run(self, file: Path | None, progress: Report | None, again: str) -> Optimum:
        """Search; see `optimising.search`."""
        table = self.table
        return search(
            *(self.unknowns, OBJECTIVES[table.objective], self.settings, table.starts, table.seed),
            how=Ascent(table.method),
            check=table.check,
            file=file,
            progress=progress,
            again=again,
        )


def read(path: str | Path) -> OptimiseFile:
    """The optimisation of a file.

    Raises SceneFileError, a ValueError, whose `mistakes` are all that is wrong in it or in the scene
    file that it names, each with its line, table and key.
    """
    path = Path(path)
    return parsed(text_of(path), path)


def parsed(text: str, path: Path) -> OptimiseFile:
    """The same of the text of a file; the scene file that it names is looked for beside `path`."""
    data, mistakes = data_of(text, path), Mistakes()
    for name in data:
        if name not in PARTS:
            mistakes.add((name,), f"is not a table of an optimisation; {nearest(name, PARTS)}")
    table = _table("optimise", OptimiseTable, data.get("optimise", {}), mistakes)
    over = _over(data, mistakes)
    if "scene" not in data:
        mistakes.add(
            (), "scene: must be given, the name of a scene file or its tables, [scene.sheet] ..."
        )
    if mistakes or table is None:
        raise mistakes.error(path, text)
    base = base_of(data["scene"], text, path)
    run = replace(base.file.run, steps=None, rtol=table.rtol)
    settings = run if table.level is None else replace(run, level=table.level)
    unknowns = None
    with mistakes.under("over"):
        unknowns = Unknowns(base.file.scene, over, base)
    if unknowns is None:
        raise mistakes.error(path, text)
    return OptimiseFile(unknowns, settings, table)


def _table(name: str, kind: type[Any], given: Any, mistakes: Mistakes) -> Any:
    """A table of that kind; None for the mistakes."""
    if not isinstance(given, Mapping):
        mistakes.add((name,), f"is {given!r}: must be a table, [{name}] in a line of its own")
        return None
    try:
        return kind.model_validate(given)
    except ValidationError as problem:
        mistakes.add_refused(name, problem, kind)
        return None


def _over(data: Mapping[str, Any], mistakes: Mistakes) -> dict[str, Any]:
    """What may change: fields between bounds, and harmonics."""
    found: dict[str, Any] = {}
    given = data.get("over", {})
    if not isinstance(given, Mapping) or not (given or "harmonics" in data):
        words = "must be given, with fields such as growth.alpha = { low = 0.1, high = 0.2 }"
        mistakes.add(("over",), words)
        return found
    for path, value in flattened(given):
        bounds = between(value, path, mistakes) if isinstance(value, Mapping) else value
        if bounds is not None:
            place = ("over", *path.split("."))
            try:
                Field.of(path, bounds)
            except ValueError as problem:
                words = str(problem).removeprefix("over: ").replace(f"{path!r}: ", f"{path}: ", 1)
                mistakes.add_words(place, f"[over] {words}")
            found[path] = bounds
    if "harmonics" in data:
        table = _table("harmonics", HarmonicsTable, data["harmonics"], mistakes)
        if table is not None:
            with mistakes.under("harmonics"):
                found[WAVE] = Harmonics(table.count, table.largest, table.mean_square, table.mean)
    return found

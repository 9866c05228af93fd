"""Optimisation files: a scene, what may change between which bounds, and what is to be best, as TOML.

scene = "hydrogel.toml"            # or its tables here, [scene.sheet], [scene.wave], ...

[over]
growth.swelling = { low = "5 %", high = "10 %" }

[harmonics]                        # of the wave, if they are to change
count = 5
largest = 1.0

[constraints]                      # may be left out, too
speed = { at_least = "0.1 mm/s" }

[robust]                           # likewise: over several regimes, the worst or the mean
by = "worst"
[robust.over]
friction.law = ["dry", "viscous"]

[optimise]                         # all of it may be left out
objective = "cost of transport"
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fem_check.files.mistakes import Mistakes, nearest
from fem_check.files.reading import check_no_scene, data_of, text_of
from fem_check.optimisation.asked import Asked
from fem_check.optimisation.objectives import OBJECTIVES
from fem_check.optimisation.optimising import FINE, search
from fem_check.optimisation.options.constraints import Bound, checked, sides_of, sums_of
from fem_check.optimisation.options.robust import Robust
from fem_check.optimisation.options.searching import Keeping, Searching
from fem_check.optimisation.options.tables import (
    BoundTable,
    HarmonicsTable,
    OptimiseTable,
    RobustTable,
)
from fem_check.optimisation.over import WAVE, Field, Harmonics
from fem_check.optimisation.result import Optimum
from fem_check.optimisation.task import region_of
from fem_check.optimisation.unknowns import Unknowns
from fem_check.sweeps.sweep_file import base_of, between, flattened
from linear_theory.common import validation
from linear_theory.common.progress import Report
from linear_theory.optimisation.climbing import Ascent

PARTS = ("scene", "over", "harmonics", "constraints", "robust", "optimise")


@dataclass(frozen=True)
class OptimiseFile:
    """What an optimisation file says; scene_file: that it names, if any."""

    asked: Asked
    searching: Searching
    scene_file: Path | None = None

    @property
    def unknowns(self) -> Unknowns:
        """Of the question."""
        return self.asked.unknowns

    def run(self, file: Path | None, report: Report | None, again: str) -> Optimum:
        """Search; see `optimising.search`."""
        return search(self.asked, self.searching, Keeping(file, report, again))


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
    check_no_scene(data, path, "optimise")
    for name in data:
        if name not in PARTS:
            mistakes.add((name,), f"is not a table of an optimisation; {nearest(name, PARTS)}")
    table = _table("optimise", OptimiseTable, data.get("optimise", {}), mistakes)
    over = _over(data, mistakes)
    constraints, robust = _constraints(data, mistakes), _robust(data, mistakes)
    rtol, searching = FINE, Searching()
    with mistakes.under("optimise"):
        if table is not None:
            searching = Searching(table.starts, table.seed, Ascent(table.method), table.check)
        if table is not None and table.rtol is not None:
            rtol = validation.tolerance(table.rtol.into("dimensionless"))
    if "scene" not in data:
        mistakes.add(
            (), "scene: must be given, the name of a scene file or its tables, [scene.sheet] ..."
        )
    if mistakes or table is None:
        raise mistakes.error(path, text)
    base = base_of(data["scene"], text, path)
    run = replace(base.file.run, steps=None, rtol=rtol)
    settings = run if table.level is None else replace(run, level=table.level)
    try:
        unknowns = Unknowns(base.file.scene, over, base)
    except ValueError as problem:
        words = str(problem).removeprefix("over: ")
        name = words.partition(":")[0]
        mistakes.add_words(("over", *(name.split(".") if name in over else ())), f"[over] {words}")
        raise mistakes.error(path, text) from None
    _check_constraints(unknowns, constraints, mistakes)
    asked = Asked(unknowns, OBJECTIVES[table.objective], settings, constraints, robust)
    with mistakes.under("robust"):
        _ = asked.regimes  # what is no regime is told here
        _check_growth(asked, mistakes)
    if mistakes:
        raise mistakes.error(path, text)
    named = path.parent / data["scene"] if isinstance(data["scene"], str) else None
    return OptimiseFile(asked, searching, named)


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


def _constraints(data: Mapping[str, Any], mistakes: Mistakes) -> dict[str, Bound]:
    """Bounds by name."""
    found: dict[str, Bound] = {}
    given = data.get("constraints", {})
    if not isinstance(given, Mapping):
        mistakes.add(("constraints",), f"is {given!r}: must be a table, [constraints]")
        return found
    for name, bounds in given.items():
        inner, table = Mistakes(), None
        try:
            table = BoundTable.model_validate(bounds)
        except ValidationError as problem:
            inner.add_refused(name, problem, BoundTable)
        with inner.under():
            if table is not None:
                of = None if table.of is None else dict(flattened(table.of))
                bound = Bound(table.at_most, table.at_least, table.exactly, of)
                found |= checked({name: bound})
        for _, words in inner.found:
            said = words.removeprefix("constraints: ")
            mistakes.add_words(("constraints", name), f"[constraints] {_named(name, said)}")
    return found


def _named(name: str, words: str) -> str:
    """What is wrong with a bound, beginning with the name that it is given under."""
    words = words.removeprefix(f"[{name}] ")
    return words if words.startswith((name, f"'{name}'")) else f"{name}: {words}"


def _check_constraints(
    unknowns: Unknowns, constraints: Mapping[str, Bound], mistakes: Mistakes
) -> None:
    """What is wrong with units, with names of fields, and with what nothing can meet."""
    for name, bound in constraints.items():
        inner = Mistakes()
        with inner.under():
            sides_of({name: bound}, unknowns.units)
            region_of(unknowns, sums_of({name: bound}, unknowns))
        for _, words in inner.found:
            said = words.removeprefix("constraints: ")
            mistakes.add_words(("constraints", name), f"[constraints] {_named(name, said)}")


def _check_growth(asked: Asked, mistakes: Mistakes) -> None:
    """What is wrong with a scene that nothing can move."""
    try:
        asked.check_growth()
    except ValueError as problem:
        words = str(problem).removeprefix("growth.")
        mistakes.add_words(("scene", "growth", "alpha"), f"[scene.growth] {words}")


def _robust(data: Mapping[str, Any], mistakes: Mistakes) -> Robust | None:
    """Regimes; None without."""
    if "robust" not in data:
        return None
    table, found = _table("robust", RobustTable, data["robust"], mistakes), None
    if table is not None:
        regimes: dict[str, Any] = {}
        for path, value in flattened(table.over):
            if isinstance(value, Mapping):
                value = between(value, path, mistakes)
            if value is not None:
                regimes[path] = value
        weights = None if table.weights is None else tuple(table.weights)
        with mistakes.under("robust"):
            found = Robust(regimes, table.by, weights, table.paired)
    return found


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
                words = words.replace("(low, high), or a Between", "{ low = ..., high = ... }")
                mistakes.add_words(place, f"[over] {words}")
            found[path] = bounds
    if "harmonics" in data:
        table = _table("harmonics", HarmonicsTable, data["harmonics"], mistakes)
        if table is not None:
            with mistakes.under("harmonics"):
                found[WAVE] = Harmonics(table.count, table.largest, table.mean_square, table.mean)
    return found

"""Sweep files: a scene, the fields that differ, and how they do, as TOML.

scene = "hydrogel.toml"            # or its tables here, [scene.sheet], [scene.wave], ...

[over]
growth.swelling = ["5 %", "10 %"]
sheet.width = { low = "10 mm", high = "40 mm", count = 4 }

[sweep]                            # all of it may be left out
design = "grid"                    # "paired", "random" or "latin hypercube", with count and seed
time = "10 min"                    # to a scene
"""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import Field, PlainValidator, ValidationError, WithJsonSchema

from fem_check.files.fields import Level, Natural, Table, Time
from fem_check.files.mistakes import Mistakes, nearest
from fem_check.files.reading import check_no_scene, data_of, text_of
from fem_check.sweeps.plan import LIMIT, Varied
from fem_check.sweeps.points.axes import Axis, Between, axis_of
from fem_check.sweeps.points.designs import Design, Grid, LatinHypercube, Paired, Random
from fem_check.sweeps.points.fields import checked
from fem_check.sweeps.variation import Variation

PARTS = ("scene", "over", "sweep")

DESIGNS: dict[str, type[Design]] = {
    "grid": Grid,
    "paired": Paired,
    "random": Random,
    "latin hypercube": LatinHypercube,
}
"""By their names in a file."""


def _end(value: object) -> float | str:
    """A finite number or text; of two kinds pydantic would name both."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise ValueError("must be a finite number, with or without a unit")
    return value


End = Annotated[float | str, PlainValidator(_end), WithJsonSchema({"type": ["number", "string"]})]


class RangeTable(Table):
    """A range of a field: numbers, or text with units."""

    low: End
    """E.g. 0.05 or "10 mm"."""
    high: End
    """Likewise."""
    count: Annotated[int, Field(ge=2)] | None = None
    """Values on a grid, with both ends; random designs need none."""
    spacing: Literal["linear", "log"] = "linear"
    """"log" for equal factors."""


class SweepTable(Table):
    """Which scenes, and how they are answered."""

    design: Literal["grid", "paired", "random", "latin hypercube"] = "grid"
    """Every value with every other, lists side by side, or points at random in the ranges."""
    count: Natural | None = None
    """Scenes of a random design or a Latin hypercube."""
    seed: Annotated[int, Field(ge=0)] | None = None
    """Of the random numbers; 0 unless given."""
    level: Level | None = None
    """Instead of that of the scene."""
    time: Time | None = None
    """After which a scene is given up, e.g. "10 min", which it is unless given; plain in seconds."""


class SweepFile(NamedTuple):
    """What a sweep file says."""

    plan: Varied
    path: Path


def read(path: str | Path) -> SweepFile:
    """The sweep of a file.

    Raises SceneFileError, a ValueError, whose `mistakes` are all that is wrong in it or in the scene
    file that it names, each with its line, table and key.
    """
    path = Path(path)
    text = text_of(path)
    return parsed(text, path)


def parsed(text: str, path: Path) -> SweepFile:
    """The same of the text of a file; the scene file that it names is looked for beside `path`."""
    data = data_of(text, path)
    check_no_scene(data, path, "sweep")
    mistakes = Mistakes()
    for name in data:
        if name not in PARTS:
            mistakes.add((name,), f"is not a table of a sweep; {nearest(name, PARTS)}")
    table = _sweep_table(data.get("sweep", {}), mistakes)
    axes = _axes(data.get("over"), mistakes)
    if "scene" not in data:
        mistakes.add(
            (), "scene: must be given, the name of a scene file or its tables, [scene.sheet] ..."
        )
    if mistakes:
        raise mistakes.error(path, text)
    base = base_of(data["scene"], text, path)
    plan = None
    with mistakes.under("sweep"):
        design = _design(table)
        plan = Varied(base, axes, design, table.level, _seconds(table))
    if plan is None:
        raise mistakes.error(path, text)
    return SweepFile(plan, path)


def base_of(given: Any, text: str, path: Path) -> Variation:
    """The scene: of its own file, or of the tables in this one. Raises SceneFileError."""
    source = (path, text)
    if isinstance(given, str):
        file = path.parent / given
        if file.resolve() == path.resolve():
            mistakes = Mistakes()
            mistakes.add_words(("scene",), f"scene = {given!r}: must not be this file itself")
            raise mistakes.error(path, text)
        said = text_of(file)
        return Variation(data_of(said, file), file, said, source=source)
    mistakes = Mistakes(inside=("scene",))
    if not isinstance(given, Mapping):
        mistakes = Mistakes()
        mistakes.add(("scene",), f"is {given!r}: must be the name of a file, or tables")
        raise mistakes.error(path, text)
    return Variation(given, path, text, mistakes, source=source)


def _sweep_table(given: Any, mistakes: Mistakes) -> SweepTable:
    if not isinstance(given, Mapping):
        mistakes.add(("sweep",), f"is {given!r}: must be a table, [sweep] in a line of its own")
        return SweepTable()
    try:
        return SweepTable.model_validate(given)
    except ValidationError as problem:
        mistakes.add_refused("sweep", problem, SweepTable)
        return SweepTable()


def _design(table: SweepTable) -> Design:
    """Raises ValueError, naming the key, for a count where there is none and the reverse."""
    kind = DESIGNS[table.design]
    if kind in (Grid, Paired):
        for name in ("count", "seed"):
            if getattr(table, name) is not None:
                raise ValueError(f"{name}: must be left out for design = {table.design!r}")
        return kind()
    if table.count is None:
        raise ValueError(f"count: must be given, the number of scenes, for design = {table.design!r}")
    return kind(count=table.count, seed=table.seed or 0)  # type: ignore[call-arg]


def _seconds(table: SweepTable) -> float:
    if table.time is None:
        return LIMIT
    return table.time.into("s")


def _axes(given: Any, mistakes: Mistakes) -> tuple[Axis, ...]:
    """The fields of [over]; dots in their names may be tables of TOML, quoted or not."""
    if not isinstance(given, Mapping) or not given:
        mistakes.add(("over",), "must be given, with fields such as growth.alpha = [0.1, 0.2]")
        return ()
    found = []
    for path, value in flattened(given):
        place = ("over", *path.split("."))
        try:
            checked(path)
        except ValueError as problem:
            mistakes.add_words(place, f"[over] {str(problem).replace(f'{path!r}: ', f'{path}: ', 1)}")
            continue
        range_or_list = between(value, path, mistakes) if isinstance(value, Mapping) else value
        if range_or_list is not None:
            try:
                found.append(axis_of(path, range_or_list))
            except ValueError as problem:
                mistakes.add_words(place, f"[over] {problem}")
    return tuple(found)


def flattened(given: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Dotted paths and what is given; a table with an end of a range is a range."""
    for name, value in given.items():
        if isinstance(value, Mapping) and not {"low", "high"} & value.keys():
            yield from flattened(value, f"{before}{name}.")
        else:
            yield f"{before}{name}", value


def between(given: Mapping[str, Any], path: str, mistakes: Mistakes) -> Between | None:
    """The range of a field; None for the mistakes."""
    try:
        table = RangeTable.model_validate(given)
    except ValidationError as problem:
        inner = Mistakes()
        inner.add_refused(path, problem, RangeTable)
        for _, words in inner.found:
            mistakes.add_words(
                ("over", *path.split(".")), words.replace(f"[{path}]", f"[over] {path}", 1)
            )
        return None
    return Between(table.low, table.high, table.count, table.spacing)

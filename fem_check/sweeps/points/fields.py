"""Fields of a scene by dotted path, named as in scene files: sheet.poisson, growth.alpha, run.rtol."""

import difflib
from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, get_args

from fem_check.files.fields import Table, tables_in
from fem_check.files.mistakes import nearest
from fem_check.files.tables import TABLES
from linear_theory.common import validation

LISTS = ("outline.holes", "wave.samples")
"""What no single value stands for."""

RIVALS = (
    ("growth.alpha", "growth.swelling", "growth.bilayer"),
    ("gravity.weight", "gravity.density"),
    ("run.rtol", "run.steps"),
)
"""Fields of which a scene has one: where a sweep gives it values, those of the others are left out."""


ALIKE = 0.75
"""Likeness of names, as of `difflib`, of which one may be meant by the other."""


@cache
def paths() -> tuple[str, ...]:
    """All of them, table by table.

    >>> from fem_check.sweeps.points.fields import paths
    >>> print(*(path for path in paths() if "bilayer." in path))
    growth.bilayer.growth growth.bilayer.thickness_ratio growth.bilayer.modulus_ratio \
growth.bilayer.side
    """
    return tuple(path for name, kind in TABLES.items() for path in _under(name, kind))


def _under(name: str, kind: type[Table]) -> Iterator[str]:
    for key, field in kind.model_fields.items():
        path = f"{name}.{key}"
        inner = next(tables_in(field.annotation), None)
        if path in LISTS:
            continue
        if inner is None:
            yield path
        else:
            yield from _under(path, inner)


def checked(path: object) -> str:
    """A path that is there. Raises ValueError, with the nearest, for any other."""
    if not isinstance(path, str):
        raise ValueError(f"{validation.shown(path)}: must be a field such as 'growth.alpha'")
    if path not in paths():
        raise ValueError(f"{validation.shown(path)}: is not a field of a scene; {_hint(path)}")
    return path


def _hint(path: str) -> str:
    """Among the keys of its table where that is known, else of one spelled alike, else of all."""
    table, key = path.partition(".")[::2]
    if table in TABLES:
        here = [known for known in paths() if known.startswith(f"{table}.")]
        like = nearest(path, here) if here else ""
        if key and like.startswith("did"):
            return like
        if here and not key:
            return f"must be one of {', '.join(here)}"
    for alike in difflib.get_close_matches(table, TABLES, n=1) if key else ():
        if (there := f"{alike}.{key}") in paths():
            return f"did you mean {there!r}?"
    keys = {known.rpartition(".")[2]: known for known in reversed(paths())}
    name = path.rpartition(".")[2]
    same = [name] if name in keys else [] if key else difflib.get_close_matches(name, keys, 1, ALIKE)
    if same:
        return f"did you mean {keys[same[0]]!r}?"
    return nearest(path, paths()) if key else f"must be one of {', '.join(paths())}"


def takes_whole_numbers(path: str) -> bool:
    """Whether a field takes integers and no other numbers."""
    table, *rest = path.split(".")
    kind: Any = TABLES[table]
    for name in rest[:-1]:
        kind = next(tables_in(kind.model_fields[name].annotation))
    annotation = kind.model_fields[rest[-1]].annotation
    parts = {annotation, *get_args(annotation)}
    return int in parts or any(int in get_args(part) for part in parts)


def with_value(data: Mapping[str, Any], path: str, value: Any) -> dict[str, Any]:
    """The tables of a scene with another value; those that it is not in are the same objects.

    >>> from fem_check.sweeps.points.fields import with_value
    >>> print(with_value({"growth": {"alpha": 0.1}}, "growth.alpha", 0.2))
    {'growth': {'alpha': 0.2}}
    """
    name, _, rest = path.partition(".")
    inner = data.get(name, {})
    if not rest:
        return {**data, name: value}
    return {**data, name: with_value(inner if isinstance(inner, Mapping) else {}, rest, value)}


def without_rivals(data: Mapping[str, Any], path: str) -> Mapping[str, Any]:
    """The tables of a scene without what would contradict a value at that path."""
    for group in RIVALS:
        mine = [name for name in group if path == name or path.startswith(f"{name}.")]
        for rival in group if mine else ():
            table, key = rival.split(".")
            if rival not in mine and key in data.get(table, {}):
                data = {**data, table: {k: v for k, v in data[table].items() if k != key}}
    return data

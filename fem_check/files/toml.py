"""Plain data as TOML: what scene files are written with."""

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from linear_theory.common.validation import shown

LINE = 100
"""Characters, beyond which a list of lists has a line for each."""


def text_of(tables: Mapping[str, Mapping[str, Any]], head: str = "") -> str:
    """Tables of numbers, text, truth values, lists and tables as TOML; head: comment at the top.

    Numbers keep all their digits. Raises ValueError for values that TOML does not have.

    >>> from fem_check.files.toml import text_of
    >>> print(text_of({"sheet": {"length": 1.0}, "bending": {}}))
    [sheet]
    length = 1.0
    <BLANKLINE>
    [bending]
    <BLANKLINE>
    """
    blocks = ["".join(f"# {line}\n" for line in head.splitlines())] if head else []
    for name, table in tables.items():
        blocks += ["\n".join(lines) + "\n" for lines in _blocks(name, table)]
    return "\n".join(blocks)


def _blocks(name: str, table: Mapping[str, Any]) -> Iterator[list[str]]:
    """The lines of a table, then those of the tables in it."""
    own = {key: value for key, value in table.items() if not isinstance(value, Mapping)}
    yield [f"[{name}]", *(f"{key} = {_value(value)}" for key, value in own.items())]
    for key, value in table.items():
        if isinstance(value, Mapping):
            yield from _blocks(f"{name}.{key}", value)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return repr(value)
    if isinstance(value, float):
        return repr(float(value))  # numpy's say their type
    if isinstance(value, str):  # what JSON escapes in its strings, TOML reads; and one character more
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Sequence):
        return _list(value)
    raise ValueError(f"{shown(value)}: must be a number, text or a list, to stand in TOML")


def _list(values: Sequence[Any]) -> str:
    items = [_value(value) for value in values]
    line = f"[{', '.join(items)}]"
    if len(line) <= LINE or not isinstance(values[0], Sequence):
        return line
    return "[\n" + "".join(f"  {item},\n" for item in items) + "]"

"""Tables of measured numbers: the rows of one dataclass, as text that says how it was made."""

import csv
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

Row = TypeVar("Row")


def read_rows(path: Path, kind: type[Row], command: str) -> list[Row]:
    """The rows of a table with a column for each field of the dataclass `kind`, in its types.

    Lines that start with # are remarks. Raises FileNotFoundError, naming the command that makes the
    table, where there is none.
    """
    if not path.exists():
        raise FileNotFoundError(f"{path}: not there; `{command}` makes it")
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    types: dict[str, Any] = {f.name: f.type for f in fields(kind)}  # type: ignore[arg-type]
    return [
        kind(**{name: types[name](text) for name, text in row.items()}) for row in csv.DictReader(lines)
    ]

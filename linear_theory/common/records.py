"""Tables of measured numbers: rows of one dataclass, in a text file that states its origin."""

import csv
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

Row = TypeVar("Row")


def read_rows(path: Path, kind: type[Row], command: str) -> list[Row]:
    """The rows of a table whose columns are the fields of the dataclass `kind`, converted to its types.

    Lines that start with # are comments. Raises FileNotFoundError, naming the command that makes the
    table, if the file does not exist.
    """
    if not path.exists():
        raise FileNotFoundError(f"{path}: does not exist; run `{command}` to make it")
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    types: dict[str, Any] = {f.name: f.type for f in fields(kind)}  # type: ignore[arg-type]
    return [
        kind(**{name: types[name](text) for name, text in row.items()}) for row in csv.DictReader(lines)
    ]

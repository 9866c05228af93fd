"""Writes tables of measured numbers, which `linear_theory.common.records` reads."""

import csv
import io
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from figures.common import output


def write_rows(path: Path, rows: Sequence[Any], command: str, words: str, digits: int) -> Path:
    """Rows of one dataclass as a table, after the command and the words that tell how it was made.

    Floats are rounded to significant digits. Raises ValueError where there is no row.
    """
    if not rows:
        raise ValueError(f"rows of {path.name}: must be one or more")
    names = [field.name for field in fields(rows[0])]
    text = io.StringIO()
    text.write(f"# made by: {command}; {words}\n")
    table = csv.writer(text, lineterminator="\n")
    table.writerow(names)
    for row in rows:
        table.writerow(_text(getattr(row, name), digits) for name in names)
    return output.write_bytes(path, text.getvalue().encode())


def _text(value: Any, digits: int) -> str:
    # Adding zero turns -0.0 into 0.0: which of the two a sum ends in is an accident of its order.
    return f"{value + 0.0:.{digits}g}" if isinstance(value, float) else str(value)

"""Tables as CSV: named columns, and measured numbers, the rows of one dataclass."""

import argparse
import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from figures.common.command import parser
from figures.common.output import DIGITS, rounded, write_bytes
from linear_theory.common.records import read_rows
from linear_theory.common.shown import Value

Row = TypeVar("Row")


@dataclass(frozen=True)
class Table(Value, Generic[Row]):
    """A table of measured numbers, in a file that one command makes and others read.

    path: the file; kind: dataclass of its rows; command: what makes it; words: what else its first line
    says, units above all; digits: significant digits of its floats.
    """

    path: Path
    kind: type[Row]
    command: str
    words: str
    digits: int

    def read(self, path: Path | None = None) -> list[Row]:
        """The rows in `path`, else in its own file.

        Raises FileNotFoundError, naming the command that makes it, where there is none.
        """
        return read_rows(path or self.path, self.kind, self.command)

    def write(self, rows: Sequence[Row], path: Path | None = None) -> Path:
        """Rows, after a line that tells how they were made. Raises ValueError where there is no row."""
        place = path or self.path
        if not rows:
            raise ValueError(f"rows of {place.name}: must be one or more")
        names = [field.name for field in fields(self.kind)]  # type: ignore[arg-type]
        columns = {name: [getattr(row, name) for row in rows] for name in names}
        return write_csv(place, columns, self.digits, f"made by: {self.command}; {self.words}")

    def options(
        self, text: str | None, arguments: Sequence[str] | None, **settings: tuple[Any, str]
    ) -> argparse.Namespace:
        """Of its command: --out and further settings, as in `parser`."""
        return parser(self.command, text, self.path, **settings).parse_args(arguments)


def write_csv(
    path: Path, columns: Mapping[str, ArrayLike], digits: int = DIGITS, remark: str = ""
) -> Path:
    """Write named columns of equal length; floats with `digits` significant digits, NaN as nan.

    remark: a line before all others, after #. Raises ValueError for columns that are not
    one-dimensional, differ in length, or hold anything but real numbers and text.
    """
    arrays = {name: np.asarray(values) for name, values in columns.items()}
    shapes = {name: array.shape for name, array in arrays.items()}
    if len(set(shapes.values())) != 1 or any(len(shape) != 1 for shape in shapes.values()):
        raise ValueError(f"columns of shapes {shapes}: must be one or more, 1D, of one length")
    text = io.StringIO()
    if remark:
        text.write(f"# {remark}\n")
    rows = csv.writer(text, lineterminator="\n")  # the default, CRLF, suits no tool used here
    rows.writerow(arrays)
    rows.writerows(zip(*(_cells(name, a, digits) for name, a in arrays.items()), strict=True))
    return write_bytes(path, text.getvalue().encode())


def _cells(name: str, column: np.ndarray, digits: int) -> list[str]:
    if column.dtype.kind == "f":
        return [rounded(value, digits) for value in column.tolist()]
    if column.dtype.kind in "iuU":
        return [str(value) for value in column.tolist()]
    raise ValueError(f"column {name!r} of dtype {column.dtype}: must be real numbers or text")

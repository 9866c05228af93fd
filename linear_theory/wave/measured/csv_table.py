"""Columns of text files: the delimiter, the names in the first line, decimal points and commas."""

import csv
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation

Array = NDArray[np.float64]
Names = Mapping[str, str]
"""Names of columns for "x" (where c depends on it), "y", "t" and "c"."""

DELIMITERS = {";": "semicolons", "\t": "tabs", ",": "commas"}

UNIT = re.compile(r"\s*[\[(][^\[\]()]*[\])]\s*$")
"""A unit in brackets after a name."""

FACTORS = {"%": 0.01, "percent": 0.01, "per cent": 0.01, "‰": 0.001}
"""Units of a number without a dimension, as of c."""


class _Line(NamedTuple):
    where: str
    text: str

    def cells(self, delimiter: str) -> list[str]:
        """What stands between the delimiters. Raises ValueError for quotes that are not closed."""
        try:
            rows = list(
                csv.reader([self.text], delimiter=delimiter, skipinitialspace=True, strict=True)
            )
        except csv.Error as error:
            raise ValueError(f"{self.where} is no line of a table ({error})") from None
        return [cell.strip() for cell in rows[0]] if rows else []


def csv_columns(path: str | Path, names: Names, delimiter: str | None = None) -> dict[str, Array]:
    """Columns of a text file whose first line names them; lines that start with # are remarks.

    delimiter: None for the one of ; , and tab that makes columns of the first line. Names are found in
    capitals and with a unit in brackets, too; numbers may have decimal commas where the delimiter is
    another. c in per cent or per mille, by such a unit, is converted to a number; lengths and times
    stay in their units. Raises ValueError, naming file and line, for columns that are missing, for
    lines with too many values and for what is no number.
    """
    if delimiter is not None and len(validation.instance("delimiter", delimiter, str)) != 1:
        raise ValueError(f"delimiter = {delimiter!r}: must be one character")
    lines = _lines(path)
    first = next(lines, _Line(str(path), ""))
    delimiter = _delimiter(first, names) if delimiter is None else delimiter
    header = first.cells(delimiter)
    places = _places(header, names)
    _check_header(str(path), header, names, places)
    table = _Table(delimiter, header, {key: at[0] for key, at in places.items() if at})
    rows = [table.numbers(line) for line in lines]
    columns = np.array(rows).reshape(len(rows), len(table.places)).T
    found = dict(zip(table.places, columns, strict=True))
    found["c"] = found["c"] * _factor(header[table.places["c"]])
    return found


def _lines(path: str | Path) -> Iterator[_Line]:
    # Numbers are plain ASCII: a letter of a unit in another encoding does no harm.
    with open(path, newline="", encoding="utf-8-sig", errors="replace") as file:
        for i, line in enumerate(file, 1):
            if line.strip() and not line.startswith("#"):
                yield _Line(f"{path}, line {i}", line.rstrip("\r\n"))


def _delimiter(first: _Line, names: Names) -> str:
    """The one that finds most of the names, or most columns, in the first line."""

    def found(delimiter: str) -> tuple[int, int]:
        header = [cell.strip(' "') for cell in first.text.split(delimiter)]
        return sum(bool(at) for at in _places(header, names).values()), len(header)

    return max(DELIMITERS, key=found)


def _places(header: list[str], names: Names) -> dict[str, list[int]]:
    """Columns with each name: with exactly that, or else in other capitals or with a unit."""
    plain = [_plain(cell) for cell in header]
    return {
        key: [i for i, cell in enumerate(header) if cell == name]
        or [i for i, cell in enumerate(plain) if cell == _plain(name)]
        for key, name in names.items()
    }


def _plain(name: str) -> str:
    return UNIT.sub("", name).strip().casefold()


def _factor(name: str) -> float:
    """By which the values of a column with that name become plain numbers."""
    unit = UNIT.search(name)
    return FACTORS.get(unit[0].strip(" \t[]()"), 1.0) if unit else 1.0


def _check_header(path: str, header: list[str], names: Names, places: dict[str, list[int]]) -> None:
    for key, at in places.items():
        if len(at) > 1:
            raise ValueError(
                f"{path} has several columns {names[key]!r}: {', '.join(header[i] for i in at)}; must "
                "have one"
            )
        if not at and key != "x":
            wanted = ",".join(names[k] for k in "ytc")
            raise ValueError(
                f"{path} has no column {names[key]!r}, but {', '.join(header) or 'none'}: columns must "
                f"be separated by commas, semicolons or tabs and named in the first line, {wanted} "
                f"(and {names['x']}, where c depends on it); rename it there, "
                f"or say {key}='...' in Python"
            )


class _Table:
    """Numbers of the wanted columns, line by line, all with the same decimal mark."""

    def __init__(self, delimiter: str, header: list[str], places: dict[str, int]) -> None:
        self.delimiter, self.header, self.places, self.mark = delimiter, header, places, ""

    def numbers(self, line: _Line) -> list[float]:
        """Raises ValueError for too many values and for what is no number."""
        row = line.cells(self.delimiter)
        if any(row[len(self.header) :]):
            hint = "" if self.delimiter != "," else "; with decimal commas, separate them by semicolons"
            raise ValueError(
                f"{line.where} has {len(row)} values, but the first line names {len(self.header)}: "
                f"must be as many{hint}"
            )
        return [self._number(row, at, line.where) for at in self.places.values()]

    def _number(self, row: list[str], place: int, where: str) -> float:
        text = row[place] if place < len(row) else ""
        where = f"{where}, column {self.header[place]!r}"
        try:
            value = float(self._with_point(text, where))
        except ValueError as error:
            if where in str(error):
                raise
            value = np.nan
        if not np.isfinite(value):
            words = repr(text) if text else "nothing"
            raise ValueError(f"{where} has {words}: must be a finite number; leave out lines without c")
        return value

    def _with_point(self, text: str, where: str) -> str:
        """The number with a decimal point. Raises ValueError where other numbers have another mark."""
        mark = "," if "," in text and self.delimiter != "," else "." if "." in text else ""
        if mark and self.mark and mark != self.mark:
            raise ValueError(
                f"{where} has {text!r}, but other numbers have the decimal mark {self.mark!r}: must "
                "be the same in all"
            )
        self.mark = self.mark or mark
        return text.replace(",", ".") if mark == "," else text

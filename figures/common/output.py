"""Files of numbers that are the same bytes for the same input, and progress while they are made."""

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from fem_check.output.files import replacing as replacing
from fem_check.output.progress import Progress as Progress

DIGITS = 9
"""Significant digits written: more than a figure shows, fewer than roundoff can change."""


def write_bytes(path: Path, content: bytes) -> Path:
    """Write `content` to `path`, all or nothing."""
    with replacing(path) as part:
        part.write_bytes(content)
    return path


def write_csv(path: Path, columns: Mapping[str, ArrayLike], digits: int = DIGITS) -> Path:
    """Write named columns of equal length; floats with `digits` significant digits, NaN as nan.

    Raises ValueError for columns that are not one-dimensional, differ in length, or hold
    anything but real numbers and text.
    """
    arrays = {name: np.asarray(values) for name, values in columns.items()}
    shapes = {name: array.shape for name, array in arrays.items()}
    if len(set(shapes.values())) != 1 or any(len(shape) != 1 for shape in shapes.values()):
        raise ValueError(f"columns of shapes {shapes}: must be one or more, 1D, of one length")
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")  # the default, CRLF, suits no tool used here
    rows.writerow(arrays)
    rows.writerows(zip(*(_cells(name, a, digits) for name, a in arrays.items()), strict=True))
    return write_bytes(path, text.getvalue().encode())


def _cells(name: str, column: np.ndarray, digits: int) -> list[str]:
    if column.dtype.kind == "f":
        return [_rounded(value, digits) for value in column.tolist()]
    if column.dtype.kind in "iuU":
        return [str(value) for value in column.tolist()]
    raise ValueError(f"column {name!r} of dtype {column.dtype}: must be real numbers or text")


def _rounded(value: float, digits: int) -> str:
    # Adding zero turns -0.0 into 0.0: which of the two a sum ends in is an accident of its order.
    return f"{value + 0.0:.{digits}g}"


def write_json(path: Path, numbers: Mapping[str, object], digits: int = DIGITS) -> Path:
    """Write the numbers that a figure shows, keys sorted, floats to `digits` significant digits.

    Values are numbers, text, arrays, or mappings and sequences of these. NaN, the mark of what
    is not known, becomes null, since JSON has no NaN. Raises ValueError for an infinite or
    complex number and for keys that are not text.
    """
    plain = _plain(numbers, digits, "numbers")
    text = json.dumps(plain, indent=2, sort_keys=True, ensure_ascii=False, allow_nan=False)
    return write_bytes(path, f"{text}\n".encode())


def _plain(value: object, digits: int, where: str) -> object:
    """`value` in the types that JSON knows; `where` names the place for messages."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    match value:
        case None | bool() | int() | str():
            return value
        case float():
            if math.isinf(value):
                raise ValueError(f"{where} = {value}: must be finite, or NaN for unknown")
            return None if math.isnan(value) else float(_rounded(value, digits))
        case Mapping():
            if not all(isinstance(key, str) for key in value):
                raise ValueError(f"{where} has keys {list(value)}: must be text")
            return {key: _plain(item, digits, f"{where}.{key}") for key, item in value.items()}
        case Sequence():
            return [_plain(item, digits, f"{where}[{i}]") for i, item in enumerate(value)]
    raise ValueError(f"{where} = {value!r}: must be a number, text, or a collection of these")

"""Files that are the same bytes for the same input, and progress while they are made."""

import json
import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np

from fem_check.output.files import replacing as replacing
from fem_check.output.progress import Progress as Progress

Item = TypeVar("Item")

DIGITS = 9
"""Significant digits written: more than a figure shows, fewer than roundoff can change."""


def tracked(label: str, items: Collection[Item]) -> Iterator[Item]:
    """The items one after another, each of which takes about as long; says how far it is."""
    with Progress(label, max(len(items), 1)) as progress:
        for item in items:
            yield item
            progress.advance()


def write_bytes(path: Path, content: bytes) -> Path:
    """Write `content` to `path`, all or nothing."""
    with replacing(path) as part:
        part.write_bytes(content)
    return path


def rounded(value: float, digits: int) -> str:
    """A float as text, to significant digits."""
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
            return None if math.isnan(value) else float(rounded(value, digits))
        case Mapping():
            if not all(isinstance(key, str) for key in value):
                raise ValueError(f"{where} has keys {list(value)}: must be text")
            return {key: _plain(item, digits, f"{where}.{key}") for key, item in value.items()}
        case Sequence():
            return [_plain(item, digits, f"{where}[{i}]") for i, item in enumerate(value)]
    raise ValueError(f"{where} = {value!r}: must be a number, text, or a collection of these")

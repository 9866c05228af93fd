"""Text representation of objects and results: a title and a few lines, with each array on one line.

    CrawlSpeed: mean 0.105903 ± 0.000024 length/time, towards +y, converged
      model_error  0.0219656
      regime       dry, slip ratio 0
      times        80 values, 0.25 ... 1.23958
      ...

Every public class inherits from `Shown`. A dataclass or named tuple shows its fields, any other class
its `_contents`. A `Value` is small and shown as the call that constructs it, if that fits on one line.
No memory address is shown, and output stays short: `to_dict` gives the full content.
"""

import html
import math
import re
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from decimal import ROUND_CEILING, Decimal
from typing import Any

import numpy as np

LINES = 12
"""Maximum number of lines of a repr, including the title."""

WIDTH = 100
"""Maximum length of a line in characters."""

FEW = 4
"""Largest one-dimensional array whose numbers are written out."""

DIGITS = 6

SMALLEST = -7
"""Power of ten of the smallest error written as a decimal fraction."""

MOST_DIGITS = 20
"""Significant digits of a number shown with its error; errors beyond are far below rounding."""

ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")
"""The address in the default repr of an object."""

UNKNOWN = "unknown"
"""Word for NaN, which throughout the package means unknown or not estimated."""


class Shown:
    """Represented by a title and rows, as text and in notebooks; `to_dict` is for programs."""

    def __init_subclass__(cls, **keywords: Any) -> None:
        """Keep this repr in subclasses that are dataclasses, which would generate their own."""
        super().__init_subclass__(**keywords)
        cls.__repr__ = cls.__repr__  # type: ignore[method-assign]

    def _contents(self) -> Mapping[str, Any]:
        """Names and values of the full content."""
        return {name: getattr(self, name) for name in _field_names(self)}

    def _rows(self) -> Mapping[str, Any]:
        """Names and values shown on a line each."""
        hidden = _unshown(self)
        return {name: value for name, value in self._contents().items() if name not in hidden}

    def _title(self) -> str:
        """The first line."""
        return type(self).__name__

    def __repr__(self) -> str:
        rows = _words_of(self)
        widest = max((len(name) for name in rows), default=0)
        spare, lines = LINES - 1 - len(rows), [_cut(self._title())]
        for name, words in rows.items():
            parts = _wrapped(words, WIDTH - widest - 4, 1 + spare)
            spare -= len(parts) - 1
            names = [name, *("" for _ in parts[1:])]
            lines += [f"  {n:<{widest}}  {part}" for n, part in zip(names, parts, strict=True)]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """The representation as an HTML table, for notebooks."""
        left = "style='text-align: left'"
        rows = "".join(
            f"<tr><th {left}>{html.escape(name)}</th><td {left}>{html.escape(words)}</td></tr>"
            for name, words in _words_of(self).items()
        )
        return f"<table><caption {left}>{html.escape(_cut(self._title()))}</caption>{rows}</table>"

    def to_dict(self, arrays: bool = True) -> dict[str, Any]:
        """The full content as plain values that JSON can hold: numbers, text, lists, dicts, None.

        arrays: whether to include arrays, as (nested) lists. "type" is the name of the class. NaN
        (unknown) becomes None, infinity the text "inf" or "-inf", which `float` reads; functions become
        their names.

        >>> from linear_theory import Sheet
        >>> print(Sheet(width=0.25).to_dict())
        {'type': 'Sheet', 'length': 1.0, 'width': 0.25, 'poisson': 0.5, 'thickness': 0.03}
        """
        return {"type": type(self).__name__, **plain(self._contents(), arrays)}


def flat(values: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Plain values, nested, as one row: names joined by dots, entries of lists by their number.

    >>> from linear_theory.common.shown import flat
    >>> print(flat({"alpha": 0.1, "sheet": {"width": 0.5}, "modes": [1, 2], "mesh": None}))
    {'alpha': 0.1, 'sheet.width': 0.5, 'modes.0': 1, 'modes.1': 2, 'mesh': None}
    """
    row: dict[str, Any] = {}
    for key, value in values.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            row |= flat(value, f"{name}.")
        elif isinstance(value, list):
            row |= flat({str(number): item for number, item in enumerate(value)}, f"{name}.")
        else:
            row[name] = str(value) if isinstance(value, str) else value  # without the name of an enum
    return row


class Value(Shown):
    """Represented as a constructor call where that fits on one line, else by title and rows."""

    def __repr__(self) -> str:
        call = self._call()
        return call if len(call) <= WIDTH and not _has_long_parts(self) else super().__repr__()

    def _call(self) -> str:
        arguments = (f"{name}={in_words(v)}" for name, v in self._rows().items())
        return f"{type(self).__name__}({', '.join(arguments)})"


def in_words(value: Any) -> str:
    """A value on one line."""
    if isinstance(value, np.ndarray):
        return _array_in_words(value)
    if isinstance(value, float | np.floating):
        return number(float(value))
    if isinstance(value, Value):
        return value._call()
    if isinstance(value, Shown):
        return value._title()
    if isinstance(value, tuple | list):
        return _sequence_in_words(value)
    if isinstance(value, Mapping):
        return ", ".join(map(in_words, value))
    if isinstance(value, type):
        return value.__name__
    if callable(value):
        return f"function {_name_of(value)}"
    if not _has_own_words(value):
        return f"{type(value).__name__} object"
    return " ".join(ADDRESS.sub("", str(value)).split())


def number(value: float) -> str:
    """A number to six digits; NaN is shown as unknown."""
    return UNKNOWN if math.isnan(value) else f"{value:.{DIGITS}g}"


def with_error(value: float, error: float) -> str:
    """A number and its error, rounded up to two digits, to the same decimal: 0.0983 ± 0.0002."""
    if not (math.isfinite(value) and math.isfinite(error) and error > 0):
        return number(value) + ("" if error == 0 else f" ± {number(error)}")
    given, exact = Decimal(repr(float(value))), Decimal(repr(float(error)))
    unit = exact.adjusted() - 1
    shown = f"{exact.quantize(Decimal(1).scaleb(unit), ROUND_CEILING):{_style(exact, given)}}"
    if given == 0:
        return f"0 ± {shown}"
    if given.adjusted() - unit > MOST_DIGITS:
        return f"{float(value)!r} ± {shown}"
    if _style(exact, given) == "f":
        return f"{given.quantize(Decimal(1).scaleb(unit)):f} ± {shown}"
    return f"{given:.{max(0, given.adjusted() - unit)}e} ± {shown}"


def _style(error: Decimal, value: Decimal) -> str:
    """Format of a decimal fraction where that is short, else of a power of ten."""
    return "f" if error.adjusted() >= SMALLEST and value.adjusted() < DIGITS else "e"


def plain(value: Any, arrays: bool = True) -> Any:
    """A value as in `Shown.to_dict`."""
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist(), arrays)
    if isinstance(value, Shown):
        return value.to_dict(arrays)
    if isinstance(value, Mapping):
        kept = {k: v for k, v in value.items() if arrays or not isinstance(v, np.ndarray)}
        return {str(k): plain(v, arrays) for k, v in kept.items()}
    if isinstance(value, tuple | list):
        return [plain(v, arrays) for v in value]
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, float) and not math.isfinite(value):
        return None if math.isnan(value) else str(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    return in_words(value)


def _unshown(value: Any) -> set[str]:
    return {f.name for f in fields(value) if not f.repr} if is_dataclass(value) else set()


def _field_names(value: Any) -> list[str]:
    """Fields of a dataclass that take part in comparisons."""
    if is_dataclass(value):
        return [f.name for f in fields(value) if f.compare and not f.name.startswith("_")]
    return list(getattr(value, "_fields", ()))


def _words_of(value: Shown) -> dict[str, str]:
    """The rows as text, fewer than LINES; the last one then names the rows omitted."""
    rows = {name: in_words(v) for name, v in value._rows().items()}
    if len(rows) < LINES:
        return rows
    names = list(rows)
    kept = {name: rows[name] for name in names[: LINES - 2]}
    return {**kept, "...": f"and {', '.join(names[LINES - 2 :])}: see to_dict()"}


def _cut(line: str) -> str:
    return line if len(line) <= WIDTH else f"{line[: WIDTH - 4]} ..."


def _wrapped(words: str, width: int, most: int) -> list[str]:
    """The words wrapped to `width`, over `most` lines at most."""
    return textwrap.wrap(words, width, max_lines=most, placeholder=" ...") or [""]


def _has_long_parts(value: Shown) -> bool:
    """Whether a row is an array that is not written out."""
    return any(isinstance(v, np.ndarray) and not _is_written_out(v) for v in value._rows().values())


def _is_written_out(array: np.ndarray[Any, Any]) -> bool:
    return array.ndim <= 1 and array.size <= FEW and array.dtype.kind in "biuf"


def _array_in_words(array: np.ndarray[Any, Any]) -> str:
    if array.ndim == 0:
        return in_words(array.item())
    if _is_written_out(array):
        return _sequence_in_words(array.tolist())
    size = f"{' x '.join(map(str, array.shape))} values"
    if not array.size or array.dtype.kind not in "iuf":
        return size
    known = array[np.isfinite(array)]
    if not known.size:
        return f"{size}, none finite"
    missing = array.size - known.size
    words = f"{size}, {number(float(known.min()))} ... {number(float(known.max()))}"
    return f"{words}, {missing} not finite" if missing else words


def _sequence_in_words(values: Sequence[Any]) -> str:
    if len(values) > 2 * FEW:
        return f"{len(values)} values"
    return f"({', '.join(map(in_words, values))})"


def _name_of(function: Any) -> str:
    return str(getattr(function, "__name__", type(function).__name__))


def _has_own_words(value: Any) -> bool:
    """Whether a value has a repr other than its address."""
    kind: Any = type(value)
    return any(getattr(kind, name) is not getattr(object, name) for name in ("__repr__", "__str__"))

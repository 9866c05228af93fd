"""Content key of a value: equal for equal content, in every process.

Numbers, text, containers, arrays and dataclasses are identified by their values, a sympy expression by
its `srepr`, a function by its compiled code with everything that the code reads (see
`function_content`), any other object by its class and the state with which it would be pickled, and
members of an installed package by their name. Keys do not depend on addresses or on the seed of hashes.
A value without such content is refused.

An object can define a method `identified_by`, whose result is used in place of its state.
"""

import enum
import functools
import struct
import sys
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from linear_theory.common.errors import Unidentifiable
from linear_theory.identity import function_content
from linear_theory.identity.content_writer import Writer
from linear_theory.identity.library import is_library, is_outside, qualified

EXACT = 2**53
"""Largest integer up to which all integers are exact floats."""


def content_key(value: object, what: str = "value") -> str:
    """SHA-256 of the content of a value, 64 hexadecimal digits.

    what: name of the value for messages. Compiled code, and so the key of a function, depends on the
    version of Python. A key describes the present state: it changes with arrays and global names.

    Raises Unidentifiable, a ValueError that names the part and the reason, for values without content
    (generators, files) and for functions that read the clock, random numbers or files, have internal
    state, or look names up at run time.

    >>> from linear_theory.identity import content_key
    >>> scale = 2.0
    >>> content_key(lambda x: scale * x) == content_key(lambda x: scale * x)
    True
    >>> content_key([1, 2.5]) == content_key([1.0, 2.5])
    True
    """
    writer = Writer(_rules)
    writer.add(value, what)
    return writer.digest.hexdigest()


def _rules(writer: Writer, value: Any, where: str) -> None:
    if _add_plain(writer, value, where) or _add_array(writer, value, where):
        return
    if hasattr(type(value), "identified_by"):
        writer.add(type(value), where)
        writer.add(value.identified_by(), where)
    elif _is_expression(value):
        _add_expression(writer, value, where)
    elif isinstance(value, enum.Enum):
        writer.add(type(value), where)
        writer.emit("member", value.name)
    elif not function_content.add(writer, value, where):
        _add_instance(writer, value, where)


def _add_plain(writer: Writer, value: Any, where: str) -> bool:
    """None, numbers, text and containers."""
    kind = type(value)
    if value is None or value is Ellipsis or value is NotImplemented or kind in (bool, np.bool_):
        writer.emit("constant", str(value))
    elif isinstance(value, int | float | np.integer) and not isinstance(value, bool | enum.Enum):
        _add_number(writer, value)
    elif kind is complex:
        writer.emit("complex", struct.pack("<dd", value.real, value.imag))
    elif kind in (str, bytes):
        writer.emit(kind.__name__, value)
    elif kind in (tuple, list) or (isinstance(value, tuple) and hasattr(value, "_fields")):
        writer.each(kind.__name__, value, where)
    elif kind is dict:
        writer.each("keys", value.keys(), where)
        writer.each("values", value.values(), where)
    elif kind in (set, frozenset):
        writer.each(kind.__name__, sorted(content_key(item, where) for item in value), where)
    elif kind in (range, slice):
        writer.each(kind.__name__, (value.start, value.stop, value.step), where)
    else:
        return False
    return True


def _add_number(writer: Writer, value: Any) -> None:
    """A number by value, inside functions also by type."""
    if writer.typed:
        writer.emit("type", type(value).__name__)
    if isinstance(value, float) or abs(int(value)) <= EXACT:
        number = float(value) if writer.typed else float(value) + 0.0  # -0.0 is 0.0
        writer.emit("number", struct.pack("<d", number))
    else:
        writer.emit("integer", str(int(value)))


def _add_array(writer: Writer, value: Any, where: str) -> bool:
    if isinstance(value, np.dtype):
        writer.emit("dtype", repr(np.lib.format.dtype_to_descr(value)))
        return True
    if not isinstance(value, np.ndarray | np.generic):
        return False
    if isinstance(value, np.ma.MaskedArray):
        writer.each("masked", (np.asarray(value.data), np.ma.getmaskarray(value)), where)
        return True
    if type(value) not in (np.ndarray, np.memmap) and not isinstance(value, np.generic):
        raise _refusal(value, where, "arrays of this class may carry more than numbers")
    array = np.asarray(value)
    if array.dtype.hasobject:
        writer.each(f"objects {array.shape}", array.ravel().tolist(), where)
        return True
    writer.emit("array", f"{np.lib.format.dtype_to_descr(array.dtype)!r} {array.shape}")
    writer.emit("data", np.ascontiguousarray(array).tobytes())
    return True


def _is_expression(value: object) -> bool:
    sympy = sys.modules.get("sympy")  # not imported: then there are no expressions, and it is slow
    return sympy is not None and isinstance(value, sympy.Basic | sympy.MatrixBase)


def _add_expression(writer: Writer, value: Any, where: str) -> None:
    import sympy

    if isinstance(value, sympy.Basic) and value.atoms(sympy.Dummy):
        raise _refusal(value, where, "its dummy symbols have no names")
    writer.emit("expression", sympy.srepr(value))


def _add_instance(writer: Writer, value: Any, where: str) -> None:
    """An object by its class and its pickled state; our own dataclasses by their fields."""
    kind = type(value)
    if is_outside(kind.__module__) or hasattr(kind, "__next__"):
        raise _refusal(value, where, "its values are not reproducible")
    if is_dataclass(value) and is_library(kind.__module__):
        writer.emit("instance", qualified(kind))
        writer.named("fields", {f.name: getattr(value, f.name) for f in fields(value)}, where)
        return
    try:
        reduced = value.__reduce_ex__(2)
    except Exception as error:  # classes of the user say in many ways that they have no state
        raise _refusal(value, where, str(error)) from None
    if isinstance(reduced, str):
        raise _refusal(value, where, "it is only a name")
    make, arguments, state, items, pairs = (*reduced, None, None, None)[:5]
    writer.add(make, where)
    writer.each("arguments", arguments, where)
    parts = state if isinstance(state, tuple) else (state,)  # attributes, and slots
    writer.emit("states", str(len(parts)))
    for part in parts:
        if part is None or (isinstance(part, dict) and all(isinstance(name, str) for name in part)):
            writer.named("state", _without_caches(kind, part or {}), where)
        else:
            writer.add(part, where)
    writer.each("items", () if items is None else items, where)
    writer.each("pairs", () if pairs is None else pairs, where)


def _without_caches(kind: type, state: dict[str, Any]) -> dict[str, Any]:
    """Attributes without the results of cached properties, which depend on what was read."""
    if kind is np.vectorize:
        return {name: v for name, v in state.items() if name != "_ufunc"}
    cached = {n for c in kind.__mro__ for n, v in vars(c).items() if _is_cache(v)}
    return {name: v for name, v in state.items() if name not in cached}


def _is_cache(value: object) -> bool:
    return isinstance(value, functools.cached_property)


def _refusal(value: object, where: str, reason: str) -> Unidentifiable:
    return Unidentifiable(
        f"{where} ({type(value).__name__}): cannot be identified by its content: {reason}"
    )

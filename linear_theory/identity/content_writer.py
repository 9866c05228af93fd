"""Writes the content of values into a digest, each part with its kind and length."""

import hashlib
from collections.abc import Callable, Iterable
from typing import Any


class Writer:
    """A digest under way, and what has been met on the way to it.

    rules: writes one value, given this writer, the value and its name for messages. digest: SHA-256.
    typed: whether 1 and 1.0 are different, as the constants of a function are.
    """

    def __init__(self, rules: "Callable[[Writer, Any, str], None]") -> None:
        self.digest = hashlib.sha256()
        self.typed = False
        self._rules = rules
        self._open: list[int] = []
        self._met: dict[int, tuple[int, object]] = {}

    def emit(self, kind: str, data: bytes | str = b"") -> None:
        """One part."""
        raw = data.encode() if isinstance(data, str) else data
        self.digest.update(f"{kind} {len(raw)} ".encode() + raw)

    def add(self, value: Any, where: str) -> None:
        """The content of a value; where: its name in messages. A value inside itself is a number."""
        if id(value) in self._open:
            self.emit("inside", str(self._open.index(id(value))))
            return
        self._open.append(id(value))
        try:
            self._rules(self, value, where)
        finally:
            self._open.pop()

    def each(self, kind: str, values: Iterable[Any], where: str) -> None:
        """Several values in their order."""
        items = list(values)
        self.emit(kind, str(len(items)))
        for k, item in enumerate(items):
            self.add(item, f"{where}[{k}]")

    def named(self, kind: str, values: dict[str, Any], where: str) -> None:
        """Several values by name, sorted."""
        self.emit(kind, str(len(values)))
        for name in sorted(values):
            self.emit("name", name)
            self.add(values[name], f"{where}.{name}")

    def first(self, value: object) -> bool:
        """Whether a function, class or module is met for the first time; else its number is written."""
        known = id(value) in self._met
        if known:
            self.emit("again", str(self._met[id(value)][0]))
        else:  # kept, so that its address is not given to another object
            self._met[id(value)] = len(self._met), value
        return not known

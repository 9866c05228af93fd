"""Writes the content of values to a digest, each part with its kind and length."""

import hashlib
from collections.abc import Callable, Iterable
from typing import Any


class Writer:
    """A digest under construction, and the objects met so far.

    rules: function that writes one value, given this writer, the value and its name for messages.
    digest: SHA-256. typed: whether 1 and 1.0 differ, as among the constants of a function.
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
        """Write the content of a value; where: its name in messages. Recursion becomes a number."""
        if id(value) in self._open:
            self.emit("inside", str(self._open.index(id(value))))
            return
        self._open.append(id(value))
        try:
            self._rules(self, value, where)
        finally:
            self._open.pop()

    def each(self, kind: str, values: Iterable[Any], where: str) -> None:
        """Write several values in order."""
        items = list(values)
        self.emit(kind, str(len(items)))
        for k, item in enumerate(items):
            self.add(item, f"{where}[{k}]")

    def named(self, kind: str, values: dict[str, Any], where: str) -> None:
        """Write several values sorted by name."""
        self.emit(kind, str(len(values)))
        for name in sorted(values):
            self.emit("name", name)
            self.add(values[name], f"{where}.{name}")

    def first(self, value: object) -> bool:
        """Whether a function, class or module is new; if not, its number is written."""
        known = id(value) in self._met
        if known:
            self.emit("again", str(self._met[id(value)][0]))
        else:  # kept, so that its address is not given to another object
            self._met[id(value)] = len(self._met), value
        return not known

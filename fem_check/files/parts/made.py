"""Parts of scenes that take long to make, made once for all scenes that have them in common."""

from collections.abc import Callable
from typing import Any

from fem_check.files.system import System
from linear_theory.sheet.rectangle import Sheet

BY_CONTENT = (Sheet, System)
"""Classes of which equal objects are the same; others, such as tables with arrays, by identity."""


class Made:
    """Of each name the last part that was made, with what it was made of.

    >>> from fem_check.files.parts.made import Made
    >>> made, table = Made(), [1.0]
    >>> print(made.part("wave", (table,), list) is made.part("wave", (table,), list))
    True
    """

    def __init__(self) -> None:
        self._kept: dict[str, tuple[tuple[Any, ...], Any]] = {}

    def keep(self, name: str, made_of: tuple[Any, ...], part: Any) -> Any:
        """Keep what was made of those objects, instead of the part before, and return it."""
        self._kept[name] = made_of, part
        return part

    def part(self, name: str, made_of: tuple[Any, ...], make: Callable[[], Any]) -> Any:
        """What `make` returns, or what it returned for the same objects."""
        if name in self._kept:
            before, part = self._kept[name]
            if len(before) == len(made_of) and all(map(_same, before, made_of)):
                return part
        return self.keep(name, made_of, make())


def _same(one: Any, other: Any) -> bool:
    return one is other or (isinstance(one, BY_CONTENT) and bool(one == other))

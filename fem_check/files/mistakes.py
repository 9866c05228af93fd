"""What is wrong in a scene file: every mistake with its place, all of them at once."""

import difflib
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from fem_check.files.fields import Table, keys_at
from fem_check.files.remedies import NO_NUMBER, NUMBERS, key_meant, number_meant, word_meant
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError

if TYPE_CHECKING:
    from pydantic import ValidationError

Place = tuple[str | int, ...]
"""Names of tables and keys, and places in lists."""

ARGUMENT = re.compile(r"(\w+)(?: = |: |,)")
"""The name at the start of a message of the library."""

HEADER = re.compile(r"\s*\[\[?\s*([^\]#]+?)\s*\]")
KEY = re.compile(r"\s*([\w.\"'-]+)\s*=")


MOST = 20
"""Mistakes of a table that are told; the others are counted."""


class SceneFileError(SheetcrawlError, ValueError):
    """A scene file from which no scene can be made; its message has a line for each mistake."""

    @property
    def mistakes(self) -> tuple[str, ...]:
        """Each with its place in the file."""
        return tuple(str(self).splitlines())


class Mistakes:
    """Collects them while a file is read. inside: the table that holds the scene, if any."""

    def __init__(self, inside: Place = ()) -> None:
        self._found: list[tuple[Place, str, str]] = []
        self._more = 0
        self._inside = inside

    def __bool__(self) -> bool:
        return bool(self._found)

    def add(self, place: Place, words: str) -> None:
        """A mistake at a place; words: what follows the name of the table."""
        self._found.append((place, _table(place), words))

    def add_words(self, place: Place, words: str) -> None:
        """A mistake at a place; words: all that is said of it."""
        self._found.append((place, "", words))

    def add_raised(self, table: Place, words: str) -> None:
        """What was raised by the work on a table; the words may begin with one of its keys."""
        key = ARGUMENT.match(words)
        place = (*table, key[1]) if key and table else table
        self._found.append((place, f"[{'.'.join(map(str, table))}] " if table else "", words))

    def under(self, *place: str | int) -> "Under":
        """Keep a ValueError of what is made of a table, which names its argument."""
        return Under(self, place)

    def add_unknown(self, names: Sequence[str], known: Iterable[str]) -> None:
        """Tables that no scene has."""
        for name in names[:MOST]:
            self.add((name,), f"is not a table of a scene; {nearest(name, known)}")
        self._more += len(names[MOST:])

    def add_refused(self, table: str, problem: "ValidationError", kind: "type[Table]") -> None:
        """All that a table of that kind was refused for."""
        errors = problem.errors(include_url=False)
        self._more += len(errors[MOST:])
        for error in errors[:MOST]:
            place: Place = (table, *error["loc"])
            words = _words(error, keys_at(kind, place[1:-1]), place)
            if error["type"] == "extra_forbidden" and (hint := _owner(table, kind, error["loc"])):
                words = f": is not a key; {hint}"
            self.add(place, f"{_key(place)}{words}")

    @property
    def found(self) -> list[tuple[Place, str]]:
        """The place of each, and what is wrong there, with the name of the table."""
        return [(place, f"{table}{words}") for place, table, words in self._found]

    def error(self, path: Path, text: str) -> SceneFileError:
        """All mistakes of a file with that text, in its order."""
        inside = "".join(f"{name}." for name in self._inside)
        lines = [
            (line_of(text, (*self._inside, *place)), re.sub(r"^\[", f"[{inside}", f"{table}{words}"))
            for place, table, words in self._found
        ]
        lines.sort(key=lambda found: found[0])
        told = [f"{path}{f':{number}' if number else ''}: {words}" for number, words in lines]
        if self._more:
            told.append(f"{path}: has {self._more} more mistakes")
        return SceneFileError("\n".join(told))


class Under:
    """While a table is worked on: a ValueError becomes a mistake of it, and the work goes on."""

    def __init__(self, mistakes: Mistakes, place: Place) -> None:
        self._mistakes, self._place = mistakes, place

    def __enter__(self) -> None:
        pass

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> bool:
        if not isinstance(error, ValueError):
            return False
        self._mistakes.add_raised(self._place, " ".join(str(error).split()))
        return True


def nearest(name: str, known: Iterable[str]) -> str:
    """A hint at what may have been meant."""
    known = tuple(known)
    close = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
    return f"did you mean {close[0]!r}?" if close else f"must be one of {', '.join(known) or 'none'}"


def _owner(table: str, kind: "type[Table]", place: Place) -> str:
    """A hint at the table around it that has this key, if one has."""
    *outer, name = place
    for depth in range(len(outer)):
        if name in keys_at(kind, outer[:depth]):
            return f"it belongs in [{'.'.join(map(str, (table, *outer[:depth])))}], before its tables"
    return ""


def line_of(text: str, place: Place) -> int:
    """The line of a key, of the key or table that it is in, counted from 1; 0 where it is not found."""
    names = [part for part in place if isinstance(part, str)]
    best, found, table = 0, 0, ""
    seen: Counter[str] = Counter()
    for number, line in enumerate(text.splitlines(), start=1):
        header, key = HEADER.match(line), KEY.match(line)
        if header:
            table, key = header[1].replace('"', ""), None
            seen[table] += 1
        elif not key:
            continue
        said = ".".join(filter(None, [table, key[1].strip("\"'") if key else ""])).split(".")
        depth = len(said)
        if said == names[:depth] and depth > best and _is_item(place, table, seen[table]):
            best, found = depth, number
    return found


def _is_item(place: Place, table: str, count: int) -> bool:
    """Whether the place is in that table, the count-th one of its name where they are a list."""
    depth = len(table.split("."))
    return depth >= len(place) or not isinstance(place[depth], int) or place[depth] == count - 1


def _table(place: Place) -> str:
    """The name of the table as the file has it."""
    names = [part for part in place if isinstance(part, str)]
    table = names if len(place) == 1 else _split(place)[0]
    return f"[{'.'.join(map(str, table))}] " if table else ""


def _split(place: Place) -> tuple[Place, Place]:
    """The tables and the key with what is in it."""
    count = next((i for i, part in enumerate(place) if not isinstance(part, str)), len(place))
    return place[: count - 1], place[count - 1 :]


def _key(place: Place) -> str:
    first, *rest = _split(place)[1]
    return str(first) + "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in rest)


def _words(error: Any, keys: Iterable[str], place: Place) -> str:
    """What is wrong with the value of a key, and the value."""
    kind, given = error["type"], validation.shown(error["input"])
    table, name = str(place[0]), str(place[-1])
    if kind == "extra_forbidden":
        meant = key_meant(table, name, error["input"]) if len(place) == 2 else ""
        return f": is not a key; {meant or nearest(name, keys)}"
    if isinstance(error["input"], str) and (kind in NUMBERS or error["msg"].endswith(NO_NUMBER)):
        return f" = {given}: {number_meant(table, name, error['input'])}"
    if kind == "missing":
        return ": must be given"
    if kind == "model_type":
        return f" = {given}: must be a table"
    if kind == "value_error":
        return f" = {given}: {error['ctx']['error']}"
    if kind == "literal_error" and isinstance(error["input"], str):
        hint = nearest(error["input"], re.findall(r"'([^']*)'", error["ctx"]["expected"]))
        hint = word_meant(table, name, error["input"]) or (hint if hint.startswith("did") else "")
        hint = f"; {hint}" if hint else ""
        return f" = {given}: must be {error['ctx']['expected']}{hint}"
    words = re.sub(r"^\w+ should (be|have)", r"must \1", error["msg"])
    return f" = {given}: {words.replace(' after validation', '').replace('greater than 0', '> 0')}"

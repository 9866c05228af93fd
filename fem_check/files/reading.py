"""Scene files are read: TOML, table by table, every mistake named with its place, all at once."""

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fem_check.files.fields import Table
from fem_check.files.mistakes import Mistakes, SceneFileError
from fem_check.files.parts.scene_file import SceneFile, built
from fem_check.files.tables import ALWAYS, REQUIRED, TABLES

PLACE = re.compile(r"(.*?) \(at (?:line (\d+), column (\d+)|(end of document))\)")


BESIDE = {"scene", "over"}
"""Tables of sweeps and optimisations, which no scene has."""

LARGEST = 50_000_000
"""Characters: what is longer is another file by mistake, or has no end."""


def read(path: str | Path) -> SceneFile:
    """The scene of a file, how it is to be answered, and the units of its numbers.

    Raises SceneFileError, a ValueError, whose `mistakes` are all that is wrong in it, each with its
    line, table and key; and where there is no such file, or none that holds TOML.
    """
    path = Path(path)
    return parsed(text_of(path), path)


def parsed(text: str, path: Path) -> SceneFile:
    """The same of the text of a file; files that it names are looked for beside `path`."""
    data = data_of(text, path)
    if others := BESIDE & data.keys():
        raise SceneFileError(
            f"{path}: is no scene but a sweep or an optimisation, as [{min(others)}] says; sheetcrawl "
            "check says which, and what reads it"
        )
    mistakes = Mistakes()
    tables = tables_of(data, mistakes)
    found = built(tables, path, mistakes)
    if found is None or mistakes:
        raise mistakes.error(path, text)
    return found


def check_no_scene(data: Mapping[str, Any], path: Path, command: str) -> None:
    """Raise SceneFileError where the tables are those of a scene alone. command: that reads files."""
    if data.keys() & TABLES.keys() and not BESIDE & data.keys():
        raise SceneFileError(
            f"{path}: is a scene, which sheetcrawl speed and run answer; sheetcrawl new {command} "
            f"writes a file for sheetcrawl {command} that may name it, scene = '{path.name}'"
        )


def data_of(text: str, path: Path) -> dict[str, Any]:
    """The entries of a text in TOML. Raises SceneFileError where it is none."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        raise SceneFileError(_not_toml(path, str(problem))) from None
    except RecursionError:
        raise SceneFileError(f"{path}: is not TOML: its lists are nested too deep") from None


def text_of(path: Path) -> str:
    """What stands in a file. Raises SceneFileError where there is none."""
    try:
        with open(path, encoding="utf-8-sig") as file:  # which editors on Windows begin with a mark
            text = file.read(LARGEST + 1)
        if len(text) <= LARGEST:
            return text
        problem = f"is larger than {LARGEST // 1_000_000} MB, must be a scene file"
    except FileNotFoundError:
        problem = "there is no such file; sheetcrawl new --list shows scenes to start from"
    except IsADirectoryError:
        problem = "is a folder, must be a scene file"
    except UnicodeDecodeError:
        problem = "is not TOML: it is no text in UTF-8"
    except (OSError, ValueError) as error:  # the latter for a name that no file can have
        problem = f"cannot be read: {getattr(error, 'strerror', None) or error}"
    raise SceneFileError(f"{path}: {problem}")


def _not_toml(path: Path, problem: str) -> str:
    """The words of the parser, with the place in front."""
    found = PLACE.fullmatch(problem)
    if found is None:
        return f"{path}: is not TOML: {problem}"
    words, line, column, end = found.groups()
    if end:
        return f"{path}: is not TOML: {words} at its end"
    return f"{path}:{line}: is not TOML: {words} at column {column}"


def tables_of(data: Mapping[str, Any], mistakes: Mistakes) -> dict[str, Table]:
    """Those that are right, each for itself."""
    found = {}
    mistakes.add_unknown([name for name in data if name not in TABLES], TABLES)
    for name, kind in TABLES.items():
        if name not in data and name not in ALWAYS:
            if name in REQUIRED:
                mistakes.add((), f"[{name}]: must be given, with alpha, swelling or bilayer")
            continue
        given = data.get(name, {})
        if not isinstance(given, dict):
            mistakes.add((name,), f"is {given!r}: must be a table, [{name}] in a line of its own")
            continue
        try:
            found[name] = kind.model_validate(given)
        except ValidationError as problem:
            mistakes.add_refused(name, problem, kind)
    return found

"""Scene files to start from, with comments: the files in `scenes`."""

from importlib.resources import files
from pathlib import Path

FOLDER = files("fem_check.files") / "scenes"

FIRST = "paper"
"""It stands at the top of the list."""


def names() -> tuple[str, ...]:
    """Of all scenes.

    >>> from fem_check.files.gallery import names
    >>> print(len(names()), *names()[:3])
    12 paper bumpy excitable
    """
    found = sorted(Path(file.name).stem for file in FOLDER.iterdir() if file.name.endswith(".toml"))
    return FIRST, *(name for name in found if name != FIRST)


def text(name: str) -> str:
    """What stands in the file of a scene. Raises ValueError for a name that is not in the list."""
    if name not in names():
        raise ValueError(f"{name!r}: is not a scene of the gallery; there are {', '.join(names())}")
    return (FOLDER / f"{name}.toml").read_text(encoding="utf-8")


def tables(name: str) -> dict[str, str]:
    """Files that it reads, from the same folder: their names and texts.

    >>> from fem_check.files.gallery import tables
    >>> print(*tables("measured"))
    measured.csv
    """
    kept = (file for file in FOLDER.iterdir() if Path(file.name).stem == name)
    return {f.name: f.read_text(encoding="utf-8") for f in kept if not f.name.endswith(".toml")}


def title(name: str) -> str:
    """Its first line."""
    return text(name).partition("\n")[0].removeprefix("# ")

"""`sheetcrawl optimise`: the best scene between bounds, kept as it is searched for."""

import shlex
import sys
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from fem_check.command.status import MET, MISSED
from fem_check.command.text import printable
from fem_check.command.waiting import Lines
from linear_theory.common.errors import SheetcrawlError

if TYPE_CHECKING:
    from fem_check.optimisation.result import Optimum
    from linear_theory.scene.scene import Scene

KEPT = ".answers.jsonl"
"""Suffix of the file with the answers, unless another name is given."""


def example() -> str:
    """The text of an optimisation file to start from."""
    return (files("fem_check.optimisation") / "example.toml").read_text(encoding="utf-8")


def optimise(path: Path, kept: Path | None, out: Path | None, movie: Path | None = None) -> int:
    """Search for the best scene of a file, print it, write it and film it; the exit status.

    Raises ValueError for mistakes in the file and for what cannot be used, before any work.
    """
    given = {"--kept": kept, "--out": out, "--movie": movie}
    options = [word for name, value in given.items() if value for word in (name, str(value))]
    again = shlex.join(["sheetcrawl", "optimise", str(path), *options])
    file = kept or Path(path.stem + KEPT)
    try:
        return _optimised(path, file, out, movie, again)
    except KeyboardInterrupt as stopped:
        words = f"answers are in {file}; {again} goes on with them"
        if not file.exists():
            words = f"there is no answer yet; {again} begins anew"
        raise KeyboardInterrupt(str(stopped) or f"interrupted; {words}") from None


def _optimised(path: Path, file: Path, out: Path | None, movie: Path | None, again: str) -> int:
    from fem_check.optimisation.optimise_file import read
    from fem_check.output.files import writable

    if out is not None:
        writable(out, (".toml",))
        if out.resolve() == path.resolve():
            raise ValueError(f"--out {out}: is the optimisation file itself; give another name")
    if movie is not None:
        _check_film(movie)
    asked = read(path)
    if out is not None and asked.scene_file is not None and out.resolve() == asked.scene_file.resolve():
        raise ValueError(f"--out {out}: is the scene file of {path}; give another name")
    with Lines() as lines:
        found = asked.run(file, lines.report, again)
    print(printable(f"\n{found}\n  kept in   {file}\n", sys.stdout))
    if out is not None:
        found.scene.to_toml(out)
        print(f"{out} written; next: sheetcrawl speed {out}")
    if movie is not None and not _film(found, asked.unknowns.scene, movie):
        return MISSED
    return MET if found.converged else MISSED


def _check_film(path: Path) -> None:
    """Raises ValueError for a file that cannot be written, before any work."""
    from fem_check.output import writers
    from fem_check.output.files import writable

    writable(path, tuple(writers.WRITERS))
    try:
        writers.require(path.suffix.lower())
    except ModuleNotFoundError as missing:
        raise ValueError(str(missing)) from None


def _film(found: "Optimum", given: "Scene", path: Path) -> bool:
    """Write the film of before and after; whether there is one."""
    from fem_check.optimisation.film import film

    try:
        _, level = film(found, given, path, progress=sys.stderr.isatty())
    except SheetcrawlError as problem:
        print(f"sheetcrawl: {' '.join(str(problem).split())}", file=sys.stderr)
        return False
    print(f"{path} written: as given, and best, by the level {level!r}")
    return True

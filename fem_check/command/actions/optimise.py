"""`sheetcrawl optimise`: the best scene between bounds, kept as it is searched for."""

import shlex
import sys
from importlib.resources import files
from pathlib import Path

from fem_check.command.status import MET, MISSED
from fem_check.command.text import printable
from fem_check.command.waiting import Lines
from linear_theory.common.errors import SheetcrawlError

KEPT = ".answers.jsonl"
"""Suffix of the file with the answers, unless another name is given."""


def example() -> str:
    """The text of an optimisation file to start from."""
    return (files("fem_check.optimisation") / "example.toml").read_text(encoding="utf-8")


def optimise(path: Path, kept: Path | None, out: Path | None) -> int:
    """Search for the best scene of a file, print it and write it; the exit status.

    Raises ValueError for mistakes in the file and for what cannot be used, before any work.
    """
    options = [word for name, v in (("--kept", kept), ("--out", out)) if v for word in (name, str(v))]
    again = shlex.join(["sheetcrawl", "optimise", str(path), *options])
    file = kept or Path(path.stem + KEPT)
    try:
        return _optimised(path, file, out, again)
    except KeyboardInterrupt as stopped:
        words = f"answers are in {file}; {again} goes on with them"
        if not file.exists():
            words = f"there is no answer yet; {again} begins anew"
        raise KeyboardInterrupt(str(stopped) or f"interrupted; {words}") from None


def _optimised(path: Path, file: Path, out: Path | None, again: str) -> int:
    from fem_check.optimisation.optimise_file import read
    from fem_check.output.files import writable

    if out is not None:
        writable(out, (".toml",))
        if out.resolve() == path.resolve():
            raise ValueError(f"--out {out}: is the optimisation file itself; give another name")
    asked = read(path)
    try:
        with Lines() as lines:
            found = asked.run(file, lines.report, again)
    except SheetcrawlError as problem:
        if isinstance(problem, ValueError):
            raise
        print(f"sheetcrawl: {' '.join(str(problem).split())}", file=sys.stderr)
        return MISSED
    print(printable(f"\n{found}\n  kept in   {file}\n", sys.stdout))
    if out is not None:
        found.scene.to_toml(out)
        print(f"{out} written; next: sheetcrawl speed {out}")
    return MET if found.converged else MISSED

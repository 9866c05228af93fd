"""`sheetcrawl sweep`: many scenes on many cores, into one file that goes on and is exported."""

import shlex
import sys
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from fem_check.command.status import MET, MISSED
from fem_check.command.text import printable
from fem_check.command.waiting import Lines, in_words

if TYPE_CHECKING:
    from fem_check.sweeps.cost import Expected
    from fem_check.sweeps.plan import Plan
    from fem_check.sweeps.records.result import Sweep

SUFFIX = ".toml"

KEPT = ".sqlite"
"""Suffix of the file with the records, unless another name is given."""


def example() -> str:
    """The text of a sweep file to start from."""
    return (files("fem_check.sweeps") / "example.toml").read_text(encoding="utf-8")


def sweep(
    path: Path,
    out: Path | None,
    workers: int | None,
    scheduler: str | None,
    dry_run: bool,
    export: list[Path],
    retry: bool,
) -> int:
    """Answer the sweep of a file, or export what a file with records holds; the exit status.

    Raises ValueError for mistakes in the file and for what cannot be used, before any work.
    """
    _check_exports(export)
    if path.suffix != SUFFIX:
        return _show(path, export, dry_run)
    from fem_check.sweeps.sweep_file import read

    plan = read(path).plan
    file = out or Path(path.stem + KEPT)
    if dry_run:
        return _foretell(plan, path, file, workers)
    return _run(plan, path, file, out, workers, scheduler, export, retry)


def _run(
    plan: "Plan",
    path: Path,
    file: Path,
    out: Path | None,
    workers: int | None,
    scheduler: str | None,
    export: list[Path],
    retry: bool,
) -> int:
    from fem_check.sweeps.running import run

    again = _again(path, out, workers, scheduler)
    try:
        with Lines() as lines:
            found = run(
                *(plan, file),
                workers=workers,
                scheduler=scheduler,
                retry=retry,
                progress=lines.report,
                again=again,
            )
    except ModuleNotFoundError as missing:
        raise ValueError(str(missing)) from None
    return _told(found, export)


def _again(path: Path, out: Path | None, workers: int | None, scheduler: str | None) -> str:
    """The command that goes on from where this one was stopped."""
    options = {"--out": out, "--workers": workers, "--scheduler": scheduler}
    said = [word for name, value in options.items() if value is not None for word in (name, str(value))]
    return shlex.join(["sheetcrawl", "sweep", str(path), *said])


def _check_exports(export: list[Path]) -> None:
    """Before any work: that they can be written, and that the packages are there."""
    from fem_check.output.files import writable
    from fem_check.sweeps.records.export import SUFFIXES, require

    for target in export:
        writable(target, SUFFIXES)
        try:
            require(target)
        except ModuleNotFoundError as missing:
            raise ValueError(str(missing)) from None


def _show(path: Path, export: list[Path], dry_run: bool) -> int:
    """What a file with records holds."""
    from fem_check.sweeps.records.result import all_kept

    if dry_run:
        raise ValueError(f"--dry-run: needs a sweep file, NAME{SUFFIX}; {path} holds records")
    found = all_kept(path)
    if export and len(found) != 1:
        raise ValueError(
            f"--export: {path} holds {len(found)} sweeps; name the sweep file, NAME{SUFFIX}, with "
            f"--out {path}"
        )
    statuses = [_told(one, export) for one in found]
    return max(statuses, default=MET)


def _told(found: "Sweep", export: list[Path]) -> int:
    """Print what there is, write what is asked for, and say by the status whether it is all right."""
    written = [found.export(target) for target in export]
    rows = _rows(found)
    if written:
        rows["exported"] = ", ".join(map(str, written))
    _print(rows)
    return MET if found.complete and not found.failed and not found.unconverged else MISSED


def _rows(found: "Sweep") -> dict[str, str]:
    from fem_check.sweeps.records.summary import summary

    told = summary(found)
    rows = {"sweep": _title(found.size, [axis.path for axis in found.axes])}
    missed = f", {told.missed} of them miss their tolerance" if told.missed else ""
    rows["answered"] = f"{told.answered} of {told.scenes}{missed}"
    if told.open:
        rows["open"] = f"{told.open}, the same command goes on with them"
    if told.failures:
        kinds = ", ".join(f"{count} {state}" for state, count in told.failures.items())
        rows["failed"] = f"{kinds}; the first: {told.first_failure}"
    if told.answered:
        rows["speed"] = f"from {told.lowest:.4g} to {told.highest:.4g} {found.unit_of_speed}"
    rows["cost"] = f"{in_words(told.seconds)} of processor time"
    if told.answered:
        rows["cost"] += f", {in_words(told.seconds / told.answered)} a scene"
    rows["kept in"] = str(found.path)
    return rows


def _foretell(plan: "Plan", path: Path, file: Path, workers: int | None) -> int:
    from fem_check.sweeps.cost import expected

    _print(_expected(expected(plan, file, workers), plan, path, file))
    return MET


def _expected(cost: "Expected", plan: "Plan", path: Path, file: Path) -> dict[str, str]:
    basis = f"as {cost.measured} of them have taken" if cost.measured else "at most, to a factor of 5"
    rows = {"sweep": _title(cost.scenes, [axis.path for axis in plan.axes])}
    rows["to do"] = f"{cost.open} of {cost.scenes}" + ("" if cost.open else ": all have a record")
    if cost.open:
        rows["a scene"] = f"about {in_words(cost.each)} on one core, {basis}"
        rows["all"] = f"about {in_words(cost.open * cost.each)} on one core"
        if cost.workers > 1:
            rows["all"] += f", {in_words(cost.seconds)} with {cost.workers} workers"
    rows["file"] = f"{file}, about {max(cost.size / 1e6, 0.1):.1f} MB in the end"
    rows["next"] = f"sheetcrawl sweep {path}"
    return rows


def _title(size: int, paths: list[str]) -> str:
    return f"{size} scenes over {', '.join(paths)}" if paths else f"{size} scenes"


def _print(rows: dict[str, str]) -> None:
    width = max(map(len, rows))
    text = "\n".join(f"  {label:<{width}}  {words}" for label, words in rows.items())
    print(printable(f"\n{text}\n", sys.stdout))

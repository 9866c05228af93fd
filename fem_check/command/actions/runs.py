"""`sheetcrawl run`, `show`, `movie`, `plot` and `paraview`: scenes run to folders."""

import shlex
import sys
import warnings
from pathlib import Path

from fem_check.command.actions.remarks import tell
from fem_check.command.actions.scenes import SUFFIX, answerable
from fem_check.command.status import MET, MISSED
from fem_check.command.text import printable
from fem_check.command.waiting import Waiting
from fem_check.output.files import writable
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError

PICTURES = (".png", ".pdf", ".svg")


def run(path: Path, out: Path | None, resume: bool) -> int:
    """Run a scene file; the exit status.

    Raises ValueError for mistakes in the file and for a folder that cannot be that of this run.
    """
    from fem_check.runs.errors import NotWrittenError
    from fem_check.runs.running import run as to_folder

    file, _ = answerable(path)
    folder = out or _folder(path)
    again = _again(path, out)
    with warnings.catch_warnings(record=True, action="always") as seen, Waiting() as waiting:
        try:
            found = to_folder(
                *(file.scene, folder, file.run, file.units),
                resume=resume,
                progress=waiting.report,
                again=again,
            )
        except ModuleNotFoundError as missing:
            raise ValueError(str(missing)) from None
        except NotWrittenError as problem:
            print(printable(f"\n{problem.block}\n", sys.stdout))
            return _failed(f"{problem}; to go on: {again}")
        except SheetcrawlError as problem:
            if isinstance(problem, ValueError):
                raise
            return _failed(str(problem))
        except OSError as problem:  # of the folder, as on a full disk
            return _failed(f"{problem}; to go on: {again}")
    tell(seen)
    print(printable(f"\n{found.block}\n\n  kept in {folder}: {_contents(folder)}\n", sys.stdout))
    return MET if found.converged else MISSED


def _folder(path: Path) -> Path:
    """Of a scene file in this folder or elsewhere: here, named as the file."""
    if path.suffix != SUFFIX:
        raise ValueError(f"--out: must be given, {str(path)!r} does not end in {SUFFIX}")
    return Path(path.stem)


def _again(path: Path, out: Path | None) -> str:
    """The command that goes on from where this one was stopped."""
    words = ["sheetcrawl", "run", str(path), *([] if out is None else ["--out", str(out)]), "--resume"]
    return shlex.join(words)


def _failed(problem: str) -> int:
    print(f"sheetcrawl: {' '.join(problem.split())}", file=sys.stderr)
    return MISSED


def _contents(folder: Path) -> str:
    return ", ".join(sorted(path.name for path in folder.iterdir() if not path.name.startswith(".")))


def show(folder: Path) -> int:
    """Print the block of a finished run; its exit status is that of the run."""
    from fem_check.runs.finished import finished

    found = finished(folder)
    print(printable(f"\n{found.block}\n", sys.stdout))
    return MET if found.converged else MISSED


def movie(
    folder: Path, file: Path | None, periods: int | None, frames: int, width: int, exaggerate: float
) -> int:
    """Write a film."""
    from fem_check.output.movies import movie as write
    from fem_check.runs.finished import finished
    from fem_check.runs.pictures import PERIODS

    found = finished(folder)
    recording = found.recording
    if periods is None and recording.repeats:
        periods = PERIODS
    try:
        target = write(
            *(recording, file or folder / "motion.gif"),
            periods=periods,
            frames=frames,
            width=width,
            exaggerate=exaggerate,
            units=found.units,
            progress=sys.stderr.isatty(),
        )
    except ModuleNotFoundError as missing:
        raise ValueError(str(missing)) from None
    return _written([target])


def plot(folder: Path, file: Path | None, what: str) -> int:
    """Draw one picture to a file, or all to the folder."""
    from fem_check.runs.finished import finished
    from fem_check.runs.pictures import pictures, save, write_pictures

    found = finished(folder)
    validation.choice("what", what, tuple(pictures(found.recording)))
    if file is None:
        return _written(write_pictures(found.recording, folder, found.units))
    target = writable(file, PICTURES)
    save(found.recording, [target], found.units, what)
    return _written([target])


def paraview(folder: Path, file: Path | None) -> int:
    """Write the motion for ParaView."""
    from fem_check.output.paraview import write_paraview
    from fem_check.runs.finished import finished

    target = writable(file or folder / "motion.xdmf", (".xdmf",))
    try:
        write_paraview(finished(folder).recording, target)
    except ModuleNotFoundError as missing:
        raise ValueError(str(missing)) from None
    return _written([target])


def _written(paths: list[Path]) -> int:
    print("\n".join(f"{path} written" for path in paths))
    return MET

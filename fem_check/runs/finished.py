"""A finished run, read from its folder."""

import hashlib
import json
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from fem_check.answer.units import Units
from fem_check.runs import netcdf
from fem_check.runs.content import mistake
from fem_check.runs.folder import RESULT, TRAJECTORY
from fem_check.runs.recording import Recording
from linear_theory.common.shown import Shown

AGAIN = "run the scene again with --resume (resume = True), which writes what is missing"

SEAL = "checksum"
"""Of a result, by which another digit in it is found. Results of early versions have none."""

ANEW = "delete the folder, or name another one, and run the scene again"


@dataclass(frozen=True, eq=False)
class Finished(Shown):
    """A run that has its answer. result: the content of result.json; folder: where its files are."""

    folder: Path
    result: dict[str, Any] = field(repr=False)

    @property
    def block(self) -> str:
        """The answer in a dozen lines."""
        return str(self.result["block"])

    @property
    def units(self) -> Units | None:
        """In which the answer is told, None for those of the sheet."""
        said = self.result["units"]
        return None if said is None else Units(said["length"], said["time"])

    @property
    def converged(self) -> bool:
        """Whether the tolerance was met, or none was asked for and nothing else is wrong."""
        return bool(self.result["answer"]["converged"])

    @cached_property
    def recording(self) -> Recording:
        """The motion. Raises ValueError where its file is missing, damaged or that of another run."""
        if wrong := self.damage():
            raise ValueError(f"{wrong}; {AGAIN}")
        return netcdf.read(self.folder / TRAJECTORY)

    def damage(self) -> str:
        """What is wrong with the file of the motion, in words; empty if it is that of this run."""
        path = self.folder / TRAJECTORY
        if not path.exists():
            return f"{path}: there is no such file"
        known = self.result.get("files")
        if isinstance(known, dict) and TRAJECTORY in known:
            own = checksum(path) == known[TRAJECTORY]
            return "" if own else f"{path}: is damaged, or that of another run"
        return self._difference(path)  # of a run by a version that kept no checksum

    def _difference(self, path: Path) -> str:
        try:
            kept = netcdf.read(path)
        except ValueError as problem:
            return str(problem)
        return "" if kept.speed.mean == self.result["answer"]["mean"] else f"{path}: is of another run"

    def _title(self) -> str:
        return f"Finished run in {self.folder}"


def finished(folder: str | Path) -> Finished:
    """The run in a folder. Raises ValueError where there is none, or none that is finished."""
    folder = Path(folder)
    path = folder / RESULT
    try:
        result = json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        raise ValueError(f"folder = {str(folder)!r}: {_missing(folder)}") from None
    except (OSError, ValueError, RecursionError) as problem:  # ValueError: no UTF-8, or no JSON
        raise ValueError(f"{path}: cannot be read ({problem}); {ANEW}") from None
    if wrong := mistake(result):
        raise ValueError(f"{path}: is not the result of a run, {wrong}; {ANEW}")
    if SEAL in result and result[SEAL] != seal(result):
        raise ValueError(f"{path}: is damaged, or was changed by hand (checksum); {ANEW}")
    return Finished(folder, result)


def seal(result: dict[str, Any]) -> str:
    """SHA-256 of a result without its seal, however it is spaced and ordered."""
    said = {key: value for key, value in result.items() if key != SEAL}
    return f"sha256:{hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()}"


def checksum(path: Path) -> str:
    """SHA-256 of a file. Raises ValueError where it cannot be read."""
    try:
        with path.open("rb") as file:
            return f"sha256:{hashlib.file_digest(file, 'sha256').hexdigest()}"
    except OSError as problem:
        raise ValueError(f"{path}: cannot be read ({problem.strerror or problem}); {AGAIN}") from None


def _missing(folder: Path) -> str:
    if not folder.exists():
        return "there is no such folder; sheetcrawl run scene.toml makes one"
    if not folder.is_dir():
        return "is a file, must be the folder of a run"
    return f"holds no {RESULT}: no run has ended in it"

"""A finished run, read from its folder."""

import json
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from fem_check.answer.units import Units
from fem_check.runs import netcdf
from fem_check.runs.folder import RESULT, TRAJECTORY
from fem_check.runs.recording import Recording
from linear_theory.common.shown import Shown


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
        """Whether the tolerance was met."""
        return bool(self.result["answer"]["converged"])

    @cached_property
    def recording(self) -> Recording:
        """The motion. Raises ValueError where its file is missing or damaged."""
        path = self.folder / TRAJECTORY
        if not path.exists():
            raise ValueError(f"{path}: there is no such file; run the scene again")
        return netcdf.read(path)

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
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as problem:
        raise ValueError(f"{path}: cannot be read: {problem}") from None
    if not isinstance(result, dict) or not {"block", "units", "answer"} <= result.keys():
        raise ValueError(f"{path}: is not the result of a run")
    return Finished(folder, result)


def _missing(folder: Path) -> str:
    if not folder.exists():
        return "there is no such folder; sheetcrawl run scene.toml makes one"
    if not folder.is_dir():
        return "is a file, must be the folder of a run"
    return f"holds no {RESULT}: no run has ended in it"

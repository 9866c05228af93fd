"""What the file of a sweep holds, as Python reads it."""

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from fem_check.answer.units import Units
from fem_check.sweeps.records import export
from fem_check.sweeps.records.opening import reading
from fem_check.sweeps.records.record import Record, State
from linear_theory.common.shown import Shown


class _AxisName(NamedTuple):
    path: str
    unit: str


class AxisName(Shown, _AxisName):
    """A field that differs, and the unit of its values."""


@dataclass(frozen=True)
class Sweep(Shown):
    """A sweep in its file, finished or not.

    size: scenes of the plan; counts: of different scenes by the state of their records, "open" those
    without one. definition: the plan, as plain data.
    """

    path: Path
    number: int = field(repr=False)
    size: int
    counts: dict[str, int]
    axes: tuple[AxisName, ...]
    units: Units | None
    program: str
    definition: dict[str, Any] = field(repr=False)

    @property
    def complete(self) -> bool:
        """Whether every scene has a record."""
        return "open" not in self.counts

    @property
    def failed(self) -> int:
        """Scenes whose record is a failure."""
        return sum(n for state, n in self.counts.items() if state not in ("open", State.ANSWERED))

    def rows(self) -> Iterator[tuple[tuple[Any, ...], Record | None]]:
        """The values of the axes and the record of every scene, in order; None for open ones."""
        with reading(self.path) as store:
            for point, record in store.rows(self.number):
                yield tuple(point), record

    def failures(self, most: int = 5) -> list[tuple[tuple[Any, ...], Record]]:
        """The first failures with their points."""
        found = []
        for point, record in self.rows():
            if record is not None and record.state != State.ANSWERED:
                found.append((point, record))
                if len(found) == most:
                    break
        return found

    @property
    def unconverged(self) -> int:
        """Answers that miss their tolerance."""
        return sum(record is not None and record.converged is False for _, record in self.rows())

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with a row for every scene; attrs: "units" by column, "definition".

        Raises ModuleNotFoundError, with what to install, without pandas.
        """
        return export.frame(self)

    def to_xarray(self) -> Any:
        """An xarray.Dataset over the fields of a grid, or over `scene` for other designs.

        Dots in the names of fields are underscores. Raises ModuleNotFoundError without xarray.
        """
        return export.dataset(self)

    def export(self, path: str | Path) -> Path:
        """Write .nc, .csv or .parquet, and return the path; the file appears when it is whole.

        Raises ValueError for other suffixes, OSError, and ModuleNotFoundError, with what to install.
        """
        return export.write(self, Path(path))

    @cached_property
    def unit_of_speed(self) -> str:
        """Of mean and errors."""
        return "length/time" if self.units is None else self.units.speed

    def _title(self) -> str:
        return f"Sweep: {self.size} scenes in {self.path}"


def kept(path: str | Path, key: str | None = None) -> Sweep:
    """The sweep in a file, by its key or the only one. Raises ValueError where it is not there."""
    path = Path(path)
    with reading(path) as store:
        sweeps = store.sweeps()
        found = [one for one in sweeps if key in (None, one["key"])]
        if len(found) != 1:
            what = f"{len(found)} sweeps, must be one" if found else "no such sweep"
            raise ValueError(f"file = {str(path)!r}: holds {what}")
        counts = store.counts(found[0]["id"])
    return _sweep(path, found[0], counts)


def all_kept(path: str | Path) -> list[Sweep]:
    """All sweeps in a file, oldest first. Raises ValueError where it is none of sweeps."""
    with reading(Path(path)) as store:
        return [_sweep(Path(path), one, store.counts(one["id"])) for one in store.sweeps()]


def _sweep(path: Path, row: dict[str, Any], counts: dict[str, int]) -> Sweep:
    units = json.loads(row["units"])
    return Sweep(
        path,
        row["id"],
        row["size"],
        counts,
        tuple(AxisName(*axis) for axis in json.loads(row["axes"])),
        None if units is None else Units(*units),
        row["program"],
        json.loads(row["definition"]),
    )

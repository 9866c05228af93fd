"""Sweeps as tables and labelled arrays: CSV, Parquet, netCDF."""

import csv
import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fem_check.output.files import replacing, writable
from fem_check.sweeps.records.record import ENERGY_NUMBERS
from linear_theory.common.extras import optional

if TYPE_CHECKING:
    from fem_check.sweeps.records.result import Sweep

SUFFIXES = (".nc", ".csv", ".parquet")

NUMBERS = (
    *("mean", "error", "numerical_error", "wave_error", "model_error", "slip_ratio"),
    *ENERGY_NUMBERS,
)
SPEEDS = NUMBERS[:5]
TIMES = ("cpu_seconds", "seconds")
WORDS = ("level", "regime", "state", "reason", "warnings", "key")

QUANTITIES = (*NUMBERS, "converged", *TIMES, *WORDS)
"""Fields of a record that are exported; the rest of it stays in the database."""


def write(sweep: "Sweep", path: Path) -> Path:
    """See `Sweep.export`."""
    target = writable(path, SUFFIXES)
    require(target)
    suffix = target.suffix.lower()
    if suffix == ".csv":
        with replacing(target) as part:
            _write_csv(sweep, part)
        return target
    if suffix == ".parquet":
        table = frame(sweep)
        table.attrs = {}  # pandas' writer keeps only what JSON holds
        with replacing(target) as part:
            table.to_parquet(part, engine="pyarrow", index=False)
        return target
    data = dataset(sweep)
    with replacing(target) as part:
        data.to_netcdf(part, engine="scipy", format="NETCDF3_64BIT")
    return target


def require(path: Path) -> None:
    """Raise ModuleNotFoundError, with what to install, without what writes that kind of file."""
    needed = {".nc": ("xarray",), ".parquet": ("pandas", "pyarrow")}
    for package in needed.get(path.suffix.lower(), ()):
        optional(package, "sweep", f"a sweep as {path.suffix.lower()}")


def names(sweep: "Sweep") -> dict[str, str]:
    """Columns and their units; empty for words."""
    units = dict.fromkeys(QUANTITIES, "")
    units |= dict.fromkeys(SPEEDS, sweep.unit_of_speed) | dict.fromkeys(TIMES, "s")
    paths = [axis.path for axis in sweep.axes] or ["scene"]
    own = [axis.unit for axis in sweep.axes] or [""]
    return dict(zip(paths, own, strict=True)) | units


def rows(sweep: "Sweep") -> Iterator[dict[str, Any]]:
    """Of the table, scene by scene; None is what is not known."""
    paths = [axis.path for axis in sweep.axes] or ["scene"]
    for point, record in sweep.rows():
        values = [json.dumps(v) if isinstance(v, list | dict) else v for v in point]
        answer = {name: None if record is None else getattr(record, name) for name in QUANTITIES}
        answer["state"] = answer["state"] or "open"
        yield {**dict(zip(paths, values, strict=True)), **answer}


def frame(sweep: "Sweep") -> Any:
    """See `Sweep.to_dataframe`."""
    pandas = optional("pandas", "sweep", "a sweep as a table")
    units = names(sweep)
    table = pandas.DataFrame(list(rows(sweep)), columns=list(units))
    for name in (*NUMBERS, *TIMES):
        table[name] = table[name].astype(float)
    table["converged"] = table["converged"].astype("boolean")
    table.attrs.update({"units": units, "definition": json.dumps(sweep.definition)})
    return table


def dataset(sweep: "Sweep") -> Any:
    """See `Sweep.to_xarray`."""
    xarray = optional("xarray", "sweep", "a sweep as labelled arrays")
    table, units = list(rows(sweep)), names(sweep)
    paths = [axis.path for axis in sweep.axes]
    grid = _grid(sweep, table)
    dims = tuple(map(_plain, paths)) if grid else ("scene",)
    shape = tuple(map(len, grid.values())) if grid else (len(table),)
    coordinates: dict[str, Any] = {
        _plain(path): ((_plain(path),), _array(values), _about(path, units))
        for path, values in grid.items()
    }
    if not grid:
        coordinates |= {
            _plain(path): (dims, _array([row[path] for row in table]), _about(path, units))
            for path in paths
        }
    variables = {
        name: (dims, _array([row[name] for row in table], name).reshape(shape), _about(name, units))
        for name in QUANTITIES
    }
    attributes = {"program": sweep.program, "definition": json.dumps(sweep.definition)}
    return xarray.Dataset(variables, coords=coordinates, attrs=attributes)


def _grid(sweep: "Sweep", table: list[dict[str, Any]]) -> dict[str, list[Any]]:
    """The values of every field where the scenes are a full grid, in its order; else nothing."""
    if sweep.definition.get("design", {}).get("type") != "Grid":
        return {}
    values = {axis.path: list(dict.fromkeys(row[axis.path] for row in table)) for axis in sweep.axes}
    size = int(np.prod([len(v) for v in values.values()]))
    return values if size == len(table) else {}


def _plain(path: str) -> str:
    """Without dots, by which xarray means parts of dates."""
    return path.replace(".", "_")


def _about(name: str, units: Mapping[str, str]) -> dict[str, str]:
    return {"long_name": name} | ({"units": units[name]} if units[name] else {})


def _array(values: list[Any], name: str = "") -> Any:
    """Numbers as floats, NaN where there is none; words as text."""
    if name in WORDS or (not name and any(isinstance(v, str) for v in values)):
        return np.array(["" if v is None else str(v) for v in values])
    if name == "converged":
        return np.array([-1 if v is None else int(v) for v in values], dtype=np.int8)
    return np.array([np.nan if v is None else v for v in values])


def _write_csv(sweep: "Sweep", path: Path) -> None:
    """Row by row, so that a million scenes need no memory; units stand in the names of the columns."""
    units = names(sweep)
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow([f"{name} [{unit}]" if unit else name for name, unit in units.items()])
        for row in rows(sweep):
            table.writerow(["" if value is None else value for value in row.values()])

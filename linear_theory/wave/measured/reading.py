"""Samples from tables of others: pandas, xarray, netCDF."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.extras import optional

Array = NDArray[np.float64]
Names = Mapping[str, str]
"""Names of columns or dimensions for "x" (where c depends on it), "y", "t" and "c"."""


def frame_columns(frame: Any, names: Names) -> dict[str, Array]:
    """Columns of a table of pandas, or of anything that has `columns` and gives them by name."""
    if not hasattr(frame, "columns"):
        raise ValueError(f"frame = {validation.shown(frame)}: must be a table with named columns")
    present = _there(names, list(map(str, frame.columns)), "frame")
    return {key: validation.real_array(name, frame[name]) for key, name in present.items()}


def array_parts(array: Any, names: Names) -> tuple[dict[str, Array], Array]:
    """Coordinates and values of an xarray.DataArray of c, its dimensions in the order x, y, t."""
    if not (hasattr(array, "dims") and hasattr(array, "coords")):
        raise ValueError(f"array = {validation.shown(array)}: must be an xarray.DataArray")
    dims = [str(name) for name in array.dims]
    wanted = {key: name for key, name in names.items() if key != "c"}
    present = _there(wanted, dims, "array", "dimension")
    if extra := set(dims) - set(present.values()):
        raise ValueError(
            f"array has dimensions {', '.join(dims)}: must be {', '.join(present.values())}; select "
            f"one place of {', '.join(sorted(extra))} with .isel"
        )
    missing = [name for name in present.values() if name not in array.coords]
    if missing:
        raise ValueError(
            f"array has no coordinates for {', '.join(missing)}: give them with .assign_coords"
        )
    ordered = array.transpose(*present.values())
    coordinates = {key: np.asarray(ordered[name].values) for key, name in present.items()}
    return coordinates, np.asarray(ordered.values)


def netcdf_array(path: str | Path, variable: str) -> Any:
    """That variable of a netCDF file, as an xarray.DataArray in memory."""
    xarray = optional("xarray", "tables", "from_netcdf")
    if not Path(path).is_file():
        raise ValueError(f"path = {str(path)!r}: must be a netCDF file, there is none")
    with xarray.open_dataset(path, decode_times=False) as data:
        _there({"c": variable}, list(map(str, data.variables)), str(path), "variable")
        return data[variable].load()


def _there(names: Names, present: Iterable[str], where: str, kind: str = "column") -> dict[str, str]:
    """The names that are present; that of x may be missing. Raises ValueError for others."""
    present = list(present)
    for key, name in names.items():
        if name not in present and key != "x":
            raise ValueError(
                f"{where} has no {kind} {name!r}, but {', '.join(present) or 'none'}: say which one is "
                f"{key}, as {key}='...'"
            )
    return {key: name for key, name in names.items() if name in present}

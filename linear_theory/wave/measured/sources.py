"""Where the samples of a wave come from: tables, labelled arrays, files."""

from pathlib import Path
from typing import Any, Self

from linear_theory.wave.measured import reading
from linear_theory.wave.measured.csv_table import csv_columns


class Sources:
    """Ways to make a wave, which is called with its samples, by the names of columns or dimensions."""

    def __init__(self, *samples: Any, **options: Any) -> None:
        raise NotImplementedError

    @classmethod
    def from_dataframe(
        cls, frame: Any, *, x: str = "x", y: str = "y", t: str = "t", c: str = "c", **options: Any
    ) -> Self:
        """From the columns of a pandas.DataFrame, a sample in each row; x counts where there is one.

        x, y, t, c: names of the columns; options: period, harmonics, degree.
        """
        return cls(*reading.frame_columns(frame, {"x": x, "y": y, "t": t, "c": c}).values(), **options)

    @classmethod
    def from_xarray(
        cls, array: Any, *, x: str = "x", y: str = "y", t: str = "t", **options: Any
    ) -> Self:
        """From an xarray.DataArray of c with dimensions y and t, or x, y and t, and their coordinates.

        x, y, t: names of the dimensions; options: period, harmonics, degree.
        """
        coordinates, values = reading.array_parts(array, {"x": x, "y": y, "t": t})
        return cls(*coordinates.values(), values, **options)

    @classmethod
    def from_netcdf(cls, path: str | Path, *, c: str = "c", **named: Any) -> Self:
        """From the variable `c` of a netCDF file. Needs xarray. named: as for `from_xarray`."""
        return cls.from_xarray(reading.netcdf_array(path, c), **named)

    @classmethod
    def from_csv(
        cls,
        path: str | Path,
        *,
        x: str = "x",
        y: str = "y",
        t: str = "t",
        c: str = "c",
        delimiter: str | None = None,
        **options: Any,
    ) -> Self:
        """From a text file, a sample in each line, whose first line names the columns.

        x, y, t, c: names of the columns, which may stand there in capitals and with units in brackets,
        as c [%], which is converted; x counts where there is one. delimiter: None for the one of
        commas, semicolons and tabs that is there; unless it is a comma, numbers may have decimal
        commas. options: period, harmonics, degree, progress.

        >>> import numpy as np, tempfile, pathlib
        >>> from linear_theory import SampledWave
        >>> rows = [(y, t, np.sin(2 * np.pi * (y - t))) for y in np.linspace(-0.5, 0.5, 20)
        ...         for t in np.arange(10) / 10]
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder, "wave.csv")
        ...     np.savetxt(path, rows, delimiter=",", header="y,t,c", comments="")
        ...     wave = SampledWave.from_csv(path, period=1.0)
        >>> print(wave.harmonics, wave.value(0.0, 0.25, 0.0).round(3))
        1 1.0
        """
        columns = csv_columns(path, {"x": x, "y": y, "t": t, "c": c}, delimiter)
        return cls(*columns.values(), **options)

"""Time series as pandas tables and labelled xarray arrays, with units and long names.

Units are those of the package: one arbitrary unit of length and one of time (see `Scale` for metres
and seconds), radians.
"""

from abc import abstractmethod
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.extras import optional
from linear_theory.common.shown import Shown, plain

LENGTH, TIME, SPEED = "length", "time", "length/time"
RADIANS, SPIN = "rad", "rad/time"
NUMBER = "1"


class Column(NamedTuple):
    """One quantity: its values over the dimensions dims, its long name and its unit ("1" for none)."""

    name: str
    values: NDArray[Any]
    long_name: str
    units: str
    dims: tuple[str, ...] = ("time",)

    @property
    def attributes(self) -> dict[str, str]:
        """Unit and long name by their netCDF names."""
        return {"long_name": self.long_name, "units": self.units}


class Tabular(Shown):
    """A time series that can be exported as a table."""

    @abstractmethod
    def _columns(self) -> Sequence[Column]:
        """Times, and the quantities at each of them."""

    def _fields(self) -> Sequence[Column]:
        """Quantities with further dimensions, and their coordinates, for `to_xarray` alone."""
        return ()

    def to_dataframe(self) -> Any:
        """A pandas.DataFrame with the times as its index and a column for each quantity.

        attrs: "units" and "long_name" of the columns and the index by name, and the scalars that belong
        to the whole result. Raises ModuleNotFoundError, with what to install, without pandas.
        """
        pandas = optional("pandas", "tables", "to_dataframe")
        columns = self._columns()
        times, *rest = columns
        index = pandas.Index(np.array(times.values), name=times.name)
        frame = pandas.DataFrame({c.name: np.array(c.values) for c in rest}, index=index)
        frame.attrs.update(_of_the_whole(self))
        for key in ("units", "long_name"):
            frame.attrs[key] = {c.name: c.attributes[key] for c in columns}
        return frame

    def to_xarray(self) -> Any:
        """An xarray.Dataset over time; units and long_name are attributes of each variable.

        Raises ModuleNotFoundError, with what to install, without xarray.
        """
        xarray = optional("xarray", "tables", "to_xarray")
        columns = [*self._columns(), *self._fields()]
        variables = {c.name: (c.dims, np.array(c.values), c.attributes) for c in columns}
        dimensions = {name for c in columns for name in c.dims}
        coordinates = {name: variables.pop(name) for name in list(variables) if name in dimensions}
        attributes = {k: v for k, v in _of_the_whole(self).items() if v is not None}  # as netCDF can
        return xarray.Dataset(variables, coords=coordinates, attrs=attributes)


def _of_the_whole(result: Shown) -> dict[str, Any]:
    """Scalars and text that belong to the whole result, not to a single time."""
    known = plain(result._contents(), arrays=False)
    simple = {name: v for name, v in known.items() if v is None or isinstance(v, int | float | str)}
    return {name: int(v) if isinstance(v, bool) else v for name, v in simple.items()}

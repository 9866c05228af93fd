"""Uneven ground that was measured: heights on a grid, and the spline through them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from linear_theory.common import validation
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]

DEGREE = 5
"""Of the splines: heights whose second derivatives, which Newton steps see, are smooth, too."""

ORDERS = ((0, 0), (1, 0), (0, 1), (2, 0), (0, 2), (1, 1))
"""Derivatives by x and y of the six rows of a height."""


@dataclass(frozen=True, eq=False)
class HeightMap(Shown):
    """Heights (rows, columns) on a grid around the middle of a sheet, the height of a `Terrain`.

    Columns lie along x, from -width/2 to width/2; rows along y, the first at +length/2, as one looks
    down on it. heights, width, length in units of length. smoothing: root mean square by which the
    ground may pass from the heights, 0 for a spline through all of them. Called with x, y (points,) it
    returns the rows of a height with its derivatives, (6, points). Beyond the grid the ground goes on
    level, at the height that it has at the border.

    Raises ValueError for heights that are not finite or too few, sizes <= 0 and smoothing < 0.

    >>> import numpy as np
    >>> from fem_check import HeightMap
    >>> x, y = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(2, -2, 81))
    >>> hill = HeightMap(0.1 * np.exp(-x**2 - y**2), width=2.0, length=4.0)
    >>> print(hill(np.array([0.0, 0.5]), np.array([0.0, 0.0]))[:2].round(4) + 0.0)  # f, f_x
    [[ 0.1     0.0779]
     [ 0.     -0.0779]]
    """

    heights: Array
    width: float
    length: float
    smoothing: float = 0.0
    exact: ClassVar[bool] = True
    """Whether its derivatives need not be checked: they are those of its polynomials."""

    def __post_init__(self) -> None:
        heights = np.array(validation.real_array("heights", self.heights))
        least = DEGREE + 1
        if heights.ndim != 2 or min(heights.shape) < least:
            raise ValueError(f"heights has shape {heights.shape}: must be ({least}, {least}) or more")
        heights.setflags(write=False)
        object.__setattr__(self, "heights", heights)
        for name in ("width", "length"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))
        if validation.real("smoothing", self.smoothing) < 0:
            raise ValueError(f"smoothing = {self.smoothing:g}: must be >= 0")

    def identified_by(self) -> object:
        """What its content key is made of."""
        return self.heights, self.width, self.length, self.smoothing

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, HeightMap):
            return NotImplemented
        sizes = [(m.width, m.length, m.smoothing) for m in (self, other)]
        return sizes[0] == sizes[1] and np.array_equal(self.heights, other.heights)

    def __hash__(self) -> int:
        return hash((self.heights.tobytes(), self.width, self.length, self.smoothing))

    def __getstate__(self) -> Mapping[str, Any]:
        return {name: v for name, v in self.__dict__.items() if name != "_spline"}

    def __call__(self, x: Array, y: Array) -> Array:
        """f, f_x, f_y, f_xx, f_yy, f_xy, (6, points)."""
        return self._rows_of(x, y, ORDERS)

    jets = __call__

    def values(self, x: Array, y: Array) -> Array:
        """f, (points,)."""
        return self._rows_of(x, y, ORDERS[:1])[0]

    def slopes(self, x: Array, y: Array) -> Array:
        """f_x, f_y, (2, points)."""
        return self._rows_of(x, y, ORDERS[1:3])

    def _rows_of(self, x: Array, y: Array, orders: Sequence[tuple[int, int]]) -> Array:
        """Derivatives by x and y of those orders, (orders, points); 0 across a border once passed."""
        rows = np.stack([self._spline.ev(y, x, dx=by_y, dy=by_x) for by_x, by_y in orders])
        for v, size, axis in ((x, self.width, 0), (y, self.length, 1)):
            across = np.array([order[axis] > 0 for order in orders])
            rows[np.ix_(across, np.abs(v) > size / 2)] = 0.0
        return rows

    @cached_property
    def _spline(self) -> Any:
        rows, columns = self.heights.shape
        y = np.linspace(-self.length / 2, self.length / 2, rows)
        x = np.linspace(-self.width / 2, self.width / 2, columns)
        unit = float(np.ptp(self.heights)) or 1.0  # the spline's own tolerances are absolute
        allowed = self.heights.size * (self.smoothing / unit) ** 2
        spline = RectBivariateSpline(y, x, self.heights[::-1] / unit, kx=DEGREE, ky=DEGREE, s=allowed)
        knots_y, knots_x, coefficients = spline.tck
        spline.tck = knots_y, knots_x, unit * coefficients
        return spline

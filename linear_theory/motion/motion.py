"""The motion of a sheet in the form read by the friction balance: values on polynomial cells.

Every cell is the image of the square [-1, 1]^2 and carries values at order x order Gauss-Legendre
points, that is one polynomial per quantity. These values are all that the friction balance gets from a
deformation (series, Ritz, finite elements, shell); it can refine a cell by interpolation without
evaluating the deformation again.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre
from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


SAME_EDGE = 1e-6
"""Distance of edges of cells, in sizes of the grid, below which they are the same."""


@dataclass(frozen=True)
class Motion(Shown):
    """Values per unit alpha at the Gauss points of all cells, for c cells, n = order and T times.

    position: (2, c, n, n), reference coordinates x, y.
    area: (c, n, n), Jacobian of the map from [-1, 1]^2 (quadrature weights not included); or, for
    motions whose load is known and not expanded in alpha, the load times that Jacobian, (T, c, n, n).
    velocity: (2, T, c, n, n), length per time, in the frame of the mean motion.
    dilation: (T, c, n, n), trace of the strain.
    growth: (T, c, n, n), the wave c.
    mirrored: the cells cover x >= 0 of a motion that is mirror symmetric in x.
    second: (2, T, c, n, n), velocity per unit alpha^2, added to alpha times `velocity`; None in
    first-order theory. displacement: same shape, displacement per unit alpha of the points on which
    friction acts when the sheet turns; None where `position` includes it, or where it does not matter.
    centre: x, y of the centre of mass of the undeformed area, in the coordinates of `position`.
    """

    position: Array
    area: Array
    velocity: Array
    dilation: Array
    growth: Array
    mirrored: bool = False
    second: Array | None = None
    displacement: Array | None = None
    centre: tuple[float, float] = (0.0, 0.0)

    @property
    def whole_area(self) -> float:
        """Integral of `area` over the cells, at the first time."""
        area = self.area.reshape(-1, *self.area.shape[-3:])[0]
        _, weights = gauss_legendre(area.shape[-1])
        return float((area @ weights @ weights).sum())

    @property
    def arms(self) -> Array:
        """Positions from the centre of mass, about which the sheet turns; shape of `position`."""
        return self.position - np.reshape(self.centre, (2, *(1,) * (self.position.ndim - 1)))


@dataclass(frozen=True)
class CellGrid(Shown):
    """Rows and columns of cells on a rectangle; edges ascend; `half`: the columns cover x >= 0 only."""

    x_edges: tuple[float, ...]
    y_edges: tuple[float, ...]
    half: bool

    @classmethod
    def uniform(cls, sheet: Sheet, across: int, along: int, half: bool) -> "CellGrid":
        """Equal cells."""
        left = 0.0 if half else -sheet.width / 2
        x = np.linspace(left, sheet.width / 2, across + 1)
        y = np.linspace(-sheet.length / 2, sheet.length / 2, along + 1)
        return cls(tuple(x.tolist()), tuple(y.tolist()), half)

    @classmethod
    def graded(
        cls, sheet: Sheet, waves: int, density: float, half: bool, across: int = 1
    ) -> "CellGrid":
        """Cells for waves along and across the sheet: `density` per wave, more in the edge layers.

        Across, the layers resolve the first wave.

        Away from an edge the deformation follows the wave alone; near an edge its scale is the smaller
        of the width and the wavelength. The layers double in thickness away from the edge.
        """
        layer = 2 / density * min(sheet.width, sheet.length / waves)
        rows = math.ceil(density * waves)
        y = _graded(sheet.length / 2, layer, sheet.length / rows)
        columns = math.ceil(density * across) if across > 1 else 1
        x = _graded(sheet.width / 2, layer, sheet.width / columns)
        x = np.concatenate([[0.0], x[x > 1e-9 * sheet.width]]) if half else x
        return cls(tuple(x.tolist()), tuple(y.tolist()), half)

    def cut_at(self, x: Iterable[float], y: Iterable[float]) -> "CellGrid":
        """With further edges at these places, so far as they lie within the grid."""
        return CellGrid(_with(self.x_edges, x), _with(self.y_edges, y), self.half)

    def points(self, order: int) -> tuple[Array, Array, Array]:
        """Gauss points x (cells, n, 1), y (cells, 1, n), and Jacobians (cells, n, n)."""
        nodes, _ = gauss_legendre(order)
        left, bottom = np.array(self.x_edges), np.array(self.y_edges)
        column, row = np.divmod(np.arange((left.size - 1) * (bottom.size - 1)), bottom.size - 1)
        dx, dy = np.diff(left)[column], np.diff(bottom)[row]
        x = left[column][:, None] + dx[:, None] * (nodes + 1) / 2
        y = bottom[row][:, None] + dy[:, None] * (nodes + 1) / 2
        area = np.repeat(dx * dy / 4, order * order).reshape(-1, order, order)
        return x[:, :, None], y[:, None, :], area


def _with(edges: tuple[float, ...], more: Iterable[float]) -> tuple[float, ...]:
    """All edges in order, but for further ones that lie upon another or outside."""
    near = SAME_EDGE * (edges[-1] - edges[0])
    found = list(edges)
    for place in more:
        if edges[0] < place < edges[-1] and min(abs(place - one) for one in found) > near:
            found.append(place)
    return tuple(sorted(found))


def _graded(half: float, layer: float, largest: float) -> Array:
    """Edges from -half to half: layers that double from both ends, up to equal cells <= largest."""
    depths = [0.0]
    while layer < largest / 1.5 and depths[-1] + layer < 0.8 * half:
        depths.append(depths[-1] + layer)
        layer *= 2
    inner = half - depths[-1]
    count = 2 * math.ceil(inner / largest - 1e-9)  # even: one edge lies at the middle
    middle = np.linspace(-inner, inner, max(count, 2) + 1)
    ends = half - np.array(depths[:-1])
    return np.concatenate([-ends, middle, ends[::-1]])

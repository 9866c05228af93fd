"""The small-strain deformation of an outline with parameters, on one half of it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.outlines.shapes import Shape, Trapezoid
from fem_check.plane_stress.field import PlaneStressField
from fem_check.plane_stress.solver import PlaneStressSolver
from linear_theory.motion.motion import CellGrid
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]

DEGREE = 4
"""Of the elements."""

GAINS = {True: 2.0, False: 1.0}
"""Of a mesh of half the size on the error: of trapezoids, whose corners are hardly obtuse, and of
polygons with obtuse corners; lower bounds, see `plane_stress.field`."""


class Cells(NamedTuple):
    """Of the coarse mesh: pairs across, and along each side of the polygon."""

    across: int
    along: int


class HalfField(PlaneStressField):
    """That of a mirror-symmetric mesh and wave, whose motion is read on the half x > 0."""

    mirrored = True

    def _on_cells(self, grid: CellGrid, order: int) -> tuple[Array, Array, Array, Array]:
        if self._kept is None or self._kept[0] != order:
            position, area, displacements, dilations = super()._on_cells(grid, order)
            right = position[0].mean((1, 2)) > 0
            values = position[:, right], area[right], displacements[:, :, right], dilations[:, right]
            self._kept = order, values
        return self._kept[1]

    def _for_times(self, t: Array) -> "HalfField":
        cases = self._cases.at(t)
        if cases is self._cases:
            return self
        return HalfField(
            self.sheet, self.wave, self._coarse, self.degree, self._gain, self._solver, cases
        )


def half_field(
    shape: Shape, wave: Wave, poisson: float, cells: Cells, coarse: bool = False
) -> HalfField:
    """The deformation by a wave. coarse: on a mesh of twice the size, to estimate errors."""
    mesh = shape.mesh(*cells)
    sheet = Sheet(shape.length, float(shape.widths().max()), poisson)
    solver = PlaneStressSolver(mesh if coarse else mesh.refined(), DEGREE, poisson)
    return HalfField(sheet, wave, mesh, DEGREE, GAINS[isinstance(shape, Trapezoid)], solver)

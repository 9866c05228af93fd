"""The small-strain deformation of an outline with parameters, on one half of it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from skfem import MeshTri

from fem_check.outlines.shapes import Shape, Trapezoid
from fem_check.plane_stress.field import PlaneStressField
from fem_check.plane_stress.solver import PlaneStressSolver
from linear_theory.deformation.load_cases import load_cases
from linear_theory.motion.motion import CellGrid
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import among
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import drive

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

    @property
    def rectangular(self) -> bool:
        """Taken as no rectangle even if it is one: its neighbours are none, and unlike it may move
        otherwise in the other half of the period."""
        return False

    def _on_cells(self, grid: CellGrid, order: int) -> tuple[Array, Array, Array, Array]:
        if self._kept is None or self._kept[0] != order:
            position, area, displacements, dilations = super()._on_cells(grid, order)
            right = position[0].mean((1, 2)) > 0
            displacements = np.ascontiguousarray(displacements[:, :, right])
            dilations = np.ascontiguousarray(dilations[:, right])
            self._kept = order, (position[:, right], area[right], displacements, dilations)
        return self._kept[1]

    def _for_times(self, t: Array) -> "HalfField":
        cases = self._cases.at(t)
        if cases is self._cases:
            return self
        return HalfField(
            self.sheet, self.wave, self._coarse, self.degree, self._gain, self._solver, cases
        )


class NearField(HalfField):
    """That of an outline next to one whose deformation is known, linearised, for given times alone."""

    def _for_times(self, t: Array) -> "NearField":
        return self


class Setting(NamedTuple):
    """What the deformation depends on beside the outline.

    coarse: whether on a mesh of twice the size, to estimate errors.
    """

    wave: Wave
    poisson: float
    cells: Cells
    coarse: bool = False

    def field(self, shape: Shape) -> HalfField:
        """The deformation."""
        return HalfField(*self._parts(shape))

    def beside(
        self, field: HalfField, times: Array, ahead: Shape, behind: Shape
    ) -> tuple[NearField, NearField]:
        """Deformations of two outlines on either side of that of a known one, at given times.

        With K u = F known, K du = (dF - dK u) for half the differences dF and dK of both: works alone
        are assembled, and the factor of K serves all parameters.
        """
        near, own = field._for_times(times), []
        for shape in (ahead, behind):
            sheet, wave, mesh, degree, gain, solver = self._parts(shape)
            place = among(solver.x, solver.y)
            cases = load_cases(drive(wave, sheet, place)).at(times)
            growths = cases.growths(solver.x, solver.y)
            works = solver.residual(near._solution, growths)
            own.append(((sheet, wave, mesh, degree, gain, solver, cases), works))
        change = near._solver.response((own[0][1] - own[1][1]) / 2)
        one, other = (
            NearField(*parts, parts[5].centred(near._solution + sign * change))
            for sign, (parts, _) in zip((1, -1), own, strict=True)
        )
        return one, other

    def _parts(self, shape: Shape) -> tuple[Sheet, Wave, MeshTri, int, float, PlaneStressSolver]:
        mesh = shape.mesh(*self.cells)
        sheet = Sheet(shape.length, float(shape.widths().max()), self.poisson)
        solver = PlaneStressSolver(mesh if self.coarse else mesh.refined(), DEGREE, self.poisson)
        return sheet, self.wave, mesh, DEGREE, GAINS[isinstance(shape, Trapezoid)], solver

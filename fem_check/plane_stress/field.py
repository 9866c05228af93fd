"""Small-strain deformation of a sheet of any outline, by linear finite elements.

The field has the interface of the series and of the Ritz solution, so that the same friction balance
gives its speed. Its error is estimated from a second solution on a mesh of twice the size.
"""

import math
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from skfem import MeshTri

from fem_check.mesh.checks import check_mesh
from fem_check.mesh.location import TriangleFinder, covering, quadrilateral_points
from fem_check.mesh.outline import Outline
from fem_check.mesh.shown import MeshShown
from fem_check.plane_stress.elements import ELEMENTS
from fem_check.plane_stress.solver import PlaneStressSolver
from linear_theory.common import validation
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.field import LinearField
from linear_theory.deformation.load_cases import SAMPLES, LoadCases, load_cases, mixed_norms
from linear_theory.motion.motion import CellGrid
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave import arguments
from linear_theory.wave.phases import phases
from linear_theory.wave.places import among
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

CELLS_PER_WIDTH = 6
"""Default number of triangles across the width, or per wavelength if that is shorter."""

GAIN = {2: 3.0, 4: 7.0}
"""Lower bound of the ratio of the difference from the mesh of twice the size to the error, for square
corners: halving the mesh divides the error by 7 to 8 (degree 2) or 13 (degree 4, limited by the corner
singularity, u ~ distance**2.74)."""

FALL, NEGLIGIBLE = 2.0, 1e-3
"""Smallest factor by which the part of the growth (L2 fraction) not resolved by polynomials decreases
when smooth growth is refined, 4 or 16 in theory; sqrt(2) at a front. A fraction below the second value
is negligible."""

ROUGH_GAIN = 0.5
"""Replaces GAIN if growth is not resolved: the two meshes then sample a front at unrelated points."""

FLAT = 1e-6  # relative size below which a momentarily vanishing displacement has no relative error


@one_blas_thread
def plane_stress_field(
    outline: Sheet | Outline | MeshTri,
    wave: Wave,
    poisson: float | None = None,
    degree: int = 4,
    size: float | None = None,
) -> "PlaneStressField":
    """Small-strain deformation of a sheet by any wave c(x, y, t), per unit alpha.

    outline: a rectangular `Sheet`, a polygon with holes, or a mesh of triangles in units of length;
    poisson: Poisson ratio, in (-1, 1/2], by default that of the Sheet, else 1/2; degree: of the
    elements, 2 or 4; size: longest side of the triangles (approximate for polygons), units of length; a
    given mesh is refined to this size, at least once.

    Raises ValueError for bad input.

    >>> from fem_check import Outline, plane_stress_field
    >>> from linear_theory import SineWave
    >>> trapezoid = Outline.trapezoid(rear=0.6, front=0.4, length=1.0)
    >>> field = plane_stress_field(trapezoid, SineWave(), size=0.2)
    >>> print(field.error < 1e-3, field.displacement(x=0.1, y=0.2, t=0.3).round(3))  # L per unit alpha
    True [-0.063 -0.135]
    """
    if degree not in tuple(ELEMENTS):
        raise ValueError(f"degree = {validation.shown(degree)}: must be 2 or 4")
    wave = arguments.wave(wave)
    sheet = _sheet(outline, poisson)
    coarse = _coarse_mesh(outline, 2 * _size(sheet, wave, size))
    while isinstance(outline, MeshTri) and size is not None and _longest_side(coarse) > 2 * size:
        coarse = coarse.refined()
    return PlaneStressField(sheet, wave, coarse, degree, _gain(outline, degree))


def _sheet(outline: Sheet | Outline | MeshTri, poisson: float | None) -> Sheet:
    """The rectangle around the outline, with its length and Poisson ratio."""
    if isinstance(outline, Sheet):
        return outline if poisson is None else replace(outline, poisson=poisson)
    if isinstance(outline, MeshTri):
        check_mesh(outline, "outline")
        width, length = np.ptp(outline.p, axis=1)
    elif isinstance(outline, Outline):
        width, length = outline.width, outline.length
    else:
        shown = validation.shown(outline)
        raise ValueError(f"outline = {shown}: must be a Sheet, an Outline or a MeshTri")
    return Sheet(float(length), float(width), 0.5 if poisson is None else poisson)


def _size(sheet: Sheet, wave: Wave, size: float | None) -> float:
    if size is not None:
        return validation.positive("size", size)
    return min(sheet.width, sheet.length / drive(wave, sheet).waves_along) / CELLS_PER_WIDTH


def _coarse_mesh(outline: Sheet | Outline | MeshTri, size: float) -> MeshTri:
    if isinstance(outline, MeshTri):
        return outline
    return (Outline.rectangle(outline) if isinstance(outline, Sheet) else outline).mesh(size)


def _gain(outline: Sheet | Outline | MeshTri, degree: int) -> float:
    """GAIN, but 2 or 1 where obtuse or re-entrant corners, respectively, slow the convergence."""
    if isinstance(outline, MeshTri) or (isinstance(outline, Outline) and outline.largest_angle > np.pi):
        return 1.0
    square = isinstance(outline, Sheet) or outline.largest_angle < 0.51 * np.pi
    return GAIN[degree] if square else 2.0


def _longest_side(mesh: MeshTri) -> float:
    start, end = mesh.p[:, mesh.facets].transpose(1, 0, 2)
    return float(np.linalg.norm(end - start, axis=0).max())


class PlaneStressField(LinearField):
    """Deformation of a sheet by finite elements; returned by `plane_stress_field`.

    sheet: the rectangle around the outline; mesh: the triangles; degree: of the elements.

    >>> import numpy as np
    >>> from fem_check import plane_stress_field
    >>> from linear_theory import Sheet, SineWave, airy_series
    >>> sheet, wave = Sheet(), SineWave()
    >>> field, series = plane_stress_field(sheet, wave), airy_series(sheet, wave, rtol=1e-8)
    >>> u, exact = (f.displacement(0.1, [-0.3, 0.1, 0.4], t=0.3) for f in (field, series))
    >>> print(np.linalg.norm(u - exact) <= field.error * np.linalg.norm(exact), field.error < 1e-3)
    True True
    """

    def __init__(
        self,
        sheet: Sheet,
        wave: Wave,
        coarse: MeshTri,
        degree: int,
        gain: float,
        solver: PlaneStressSolver | None = None,
        cases: LoadCases | None = None,
        solution: Array | None = None,
    ) -> None:
        start = time.perf_counter()
        self.sheet, self.wave, self.degree = sheet, wave, degree
        self._coarse, self._gain = coarse, gain
        self._solver = solver or PlaneStressSolver(coarse.refined(), degree, sheet.poisson)
        self._cases = cases or load_cases(self.drive)
        self._solution = self._solved(self._solver) if solution is None else solution
        self.seconds = time.perf_counter() - start

    def _settings(self) -> Mapping[str, Any]:
        return {"mesh": MeshShown(self.mesh), "degree": self.degree}

    @property
    def mesh(self) -> MeshTri:
        """The triangles."""
        return self._solver.mesh

    @property
    def centre(self) -> tuple[float, float]:
        """x, y of the centre of mass of the outline."""
        x, y = self._solver.centre_and_gyration[0].tolist()
        return x, y

    @property
    def rectangular(self) -> bool:
        """Whether the outline is the rectangle around it, with its centre at the origin."""
        area, length = self._solver.weights.sum(), self.sheet.length
        return math.isclose(area, self.sheet.area) and math.hypot(*self.centre) < 1e-9 * length

    @property
    def gyration(self) -> float:
        """Radius of gyration of the outline about its centre of mass."""
        return self._solver.centre_and_gyration[1]

    def places(self, count: int) -> tuple[Array, Array]:
        """x, y (n,) of about count^2 points in the triangles."""
        every = max(1, self._solver.x.size // count**2)
        return self._solver.x.ravel()[::every], self._solver.y.ravel()[::every]

    def covering(self) -> tuple[Array, NDArray[np.int64]]:
        """Points and triangles of the mesh, refined if it is coarse."""
        return covering(self.mesh)

    @cached_property
    def drive(self) -> Drive:
        """The wave on the body."""
        return drive(self.wave, self.sheet, among(self._solver.x, self._solver.y))

    @cached_property
    @one_blas_thread
    def error(self) -> float:
        """Estimated relative L2 error of the displacement over the sheet at the worst phase."""
        fine, coarse = self._solver, PlaneStressSolver(self._coarse, self.degree, self.sheet.poisson)
        x, y = fine.x.ravel(), fine.y.ravel()
        u = fine.displacements(self._solution, *TriangleFinder(fine.mesh)(x, y))
        rough = coarse.displacements(self._solved(coarse), *TriangleFinder(coarse.mesh)(x, y))
        size, difference = (self._norms(v, fine.weights.ravel()) for v in (u, u - rough))
        if not size.any():
            return 0.0
        resolved = self._missed(fine) <= max(self._missed(coarse) / FALL, NEGLIGIBLE)
        gain = self._gain if resolved else min(self._gain, ROUGH_GAIN)
        return float(np.max(difference / np.maximum(size, FLAT * size.max()))) / gain

    def _missed(self, solver: PlaneStressSolver) -> float:
        """Fraction of the growth that the triangles do not resolve, at the worst sampled phase."""
        times = phases(self.drive.period, SAMPLES)
        cases = self._cases.at(times)
        growths, amplitudes = cases.growths(solver.x, solver.y), cases.amplitudes(times)
        size = mixed_norms(growths * np.sqrt(solver.weights), amplitudes)
        missed = mixed_norms(solver.missed(growths), amplitudes)
        return float(np.max(missed[size > 0] / size[size > 0], initial=0.0))

    def _on_cells(self, grid: CellGrid, order: int) -> tuple[Array, Array, Array, Array]:
        """Points, areas, displacements and dilations of the basis, directly from the elements."""
        key = order  # the cells are those of the mesh, three per triangle
        if self._kept is None or self._kept[0] != key:
            points, jacobian = quadrilateral_points(order)
            local, mapping = points.reshape(2, -1), self.mesh.mapping()
            displacements, strains = self._solver.everywhere(self._solution, local)
            area = np.multiply.outer(abs(mapping.detA), jacobian)
            values = (mapping.F(local), area, displacements, strains[:, 0] + strains[:, 1])
            shape = 3 * self.mesh.t.shape[1], order, order
            position, area, displacements, dilations = (
                v.reshape(*v.shape[:axes], *shape) for v, axes in zip(values, (1, 0, 2, 1), strict=True)
            )
            self._kept = key, (position, area, displacements, dilations)
        return self._kept[1]

    def _solved(self, solver: PlaneStressSolver) -> Array:
        return solver.solve(self._cases.growths(solver.x, solver.y))

    def _norms(self, values: Array, weights: Array) -> Array:
        """L2 norm over the sheet of the superposed fields (cases, 2, n), at the sampled phases."""
        return mixed_norms(values * np.sqrt(weights), self._cases.samples())

    @cached_property
    def _finder(self) -> TriangleFinder:
        return TriangleFinder(self.mesh)

    def _checked(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> tuple[Array, Array, Array]:
        x, y, t = (validation.real_array(name, v) for name, v in (("x", x), ("y", y), ("t", t)))
        return x, y, t

    def _for_times(self, t: Array) -> "PlaneStressField":
        cases = self._cases.at(t)
        if cases is self._cases:
            return self
        return PlaneStressField(
            self.sheet, self.wave, self._coarse, self.degree, self._gain, self._solver, cases
        )

    def _amplitudes(self, t: Array) -> Array:
        return self._cases.amplitudes(t)

    def _amplitude_rates(self, t: Array) -> Array:
        return self._cases.rates(t)

    def _displacements(self, x: Array, y: Array) -> Array:
        x, y = np.broadcast_arrays(x, y)
        values = self._solver.displacements(self._solution, *self._found(x, y))
        return values.reshape(*values.shape[:2], *x.shape)

    def _strains(self, x: Array, y: Array) -> Array:
        x, y = np.broadcast_arrays(x, y)
        values = self._solver.strains(self._solution, *self._found(x, y))
        return values.reshape(*values.shape[:2], *x.shape)

    def _found(self, x: Array, y: Array) -> tuple[NDArray[np.int64], Array]:
        """Triangle and local coordinates of the points. Raises ValueError for points outside."""
        triangle, local = self._finder(x.ravel(), y.ravel())
        if np.any(triangle < 0):
            out = int(np.argmin(triangle))
            raise ValueError(f"x, y = {x.flat[out]:g}, {y.flat[out]:g}: must be inside the outline")
        return triangle, local

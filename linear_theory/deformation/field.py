"""The interface of every linear solution of the sheet: displacement, velocity, strain, stress.

A linear deformation is a sum of fixed fields times functions of time,

    u(x, y, t) = alpha * sum_j amplitude_j(t) basis_j(x, y),

and solvers differ only in the basis and in how they compute it. All quantities are per unit alpha.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.motion.motion import CellGrid, Motion
from linear_theory.sheet import hooke
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

ACROSS, ALONG = 12, 48
"""Cells across and along a rectangle for pictures, enough to show a wave as a smooth curve."""


class LinearField(Shown, ABC):
    """Small-strain deformation of a sheet by a wave, per unit alpha.

    Points x, y (units of length, inside the sheet) and times t broadcast. Vectors have (x, y) and
    symmetric tensors (xx, yy, xy) on the first axis. The displacement has zero mean and zero mean
    rotation over the reference area. `seconds`: time for set-up and solution. `mirrored`: whether the
    motion is mirror symmetric in x. `numbers`: unknowns solved per time step, 0 if one basis serves all
    times.
    """

    sheet: Sheet
    wave: Wave
    seconds: float
    mirrored: bool = False
    numbers: int = 0
    _kept: tuple[object, tuple[Array, Array, Array, Array]] | None = None

    def _settings(self) -> Mapping[str, Any]:
        """Settings of the solver, given or chosen."""
        return {}

    def _rows(self) -> Mapping[str, Any]:
        """All but the error, whose estimate is computed on first use and may take long."""
        known = {"sheet": self.sheet, "wave": self.wave, **self._settings(), "seconds": self.seconds}
        return {**known, "gives": "displacement, velocity, strain, stress at (x, y, t), error"}

    def _contents(self) -> Mapping[str, Any]:
        known = {"sheet": self.sheet, "wave": self.wave, **self._settings()}
        return {**known, "error": self.error, "mirrored": self.mirrored, "seconds": self.seconds}

    @property
    def centre(self) -> tuple[float, float]:
        """x, y of the centre of mass of the undeformed area, units of length; 0, 0 for rectangles.

        The rigid motion of a sheet is that of this point and a rotation about it.
        """
        return 0.0, 0.0

    @property
    def rectangular(self) -> bool:
        """Whether the body is the whole rectangle of `sheet`."""
        return True

    @property
    def gyration(self) -> float:
        """Radius of gyration of the undeformed area about its centre of mass, units of length."""
        return math.hypot(self.sheet.width, self.sheet.length) / math.sqrt(12)

    def places(self, count: int) -> tuple[Array, Array]:
        """x, y (broadcast) of about count^2 points that cover the sheet, at which to check growth."""
        along = np.linspace(-0.5, 0.5, count)
        return self.sheet.width * along[:, None], self.sheet.length * along

    def covering(self) -> tuple[Array, NDArray[np.int64]]:
        """Points (2, n) and triangles (m, 3) that cover the undeformed sheet, fine enough to draw."""
        across, along = np.linspace(-0.5, 0.5, ACROSS + 1), np.linspace(-0.5, 0.5, ALONG + 1)
        x, y = np.meshgrid(self.sheet.width * across, self.sheet.length * along, indexing="ij")
        corner = np.arange(x.size).reshape(x.shape)
        a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
        cells = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
        return np.stack([x.ravel(), y.ravel()]), cells

    @property
    @abstractmethod
    def error(self) -> float:
        """Estimated relative L2 error of the displacement over the sheet at the worst phase."""

    @abstractmethod
    def _amplitudes(self, t: Array) -> Array:
        """Amplitudes of the basis functions at times t, (basis functions, *t.shape)."""

    @abstractmethod
    def _amplitude_rates(self, t: Array) -> Array:
        """Time derivatives of `_amplitudes`."""

    @abstractmethod
    def _displacements(self, x: Array, y: Array) -> Array:
        """Displacement of each basis function, (basis functions, 2, *broadcast(x, y).shape)."""

    @abstractmethod
    def _strains(self, x: Array, y: Array) -> Array:
        """Strain of each basis function, (basis functions, 3, *broadcast(x, y).shape)."""

    @cached_property
    def drive(self) -> Drive:
        """The wave on the body."""
        return drive(self.wave, self.sheet)

    def _for_times(self, t: Array) -> "LinearField":
        """The field whose basis spans the motion at times t; the same one if its basis always does."""
        return self

    @one_blas_thread
    def displacement(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """u, (2, ...), units of length. Raises ValueError for points outside the sheet."""
        x, y, t = self._checked(x, y, t)
        field = self._for_times(t)
        return combine(field._amplitudes(t), field._displacements(x, y))

    @one_blas_thread
    def velocity(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """du/dt in the frame of the mean motion, (2, ...), length per time."""
        x, y, t = self._checked(x, y, t)
        field = self._for_times(t)
        return combine(field._amplitude_rates(t), field._displacements(x, y))

    @one_blas_thread
    def strain(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """(xx, yy, xy) of the total strain, (3, ...), dimensionless."""
        x, y, t = self._checked(x, y, t)
        field = self._for_times(t)
        return combine(field._amplitudes(t), field._strains(x, y))

    def stress(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """(xx, yy, xy) of the stress, (3, ...), units of Young's modulus."""
        strain = self.strain(x, y, t)
        return hooke.stress(strain, self.drive.value(x, y, t), self.sheet.poisson)

    @one_blas_thread
    def motion(self, times: ArrayLike, grid: CellGrid, order: int) -> Motion:
        """The field at the Gauss points of cells, in the form read by the friction balance.

        times (times,); order: points per cell and direction.
        """
        t = validation.real_array("times", times)
        field = self._for_times(t)
        position, area, displacements, dilations = field._on_cells(grid, order)
        growth_time = t.reshape(-1, *(1,) * area.ndim)
        return Motion(
            position=position,
            area=area,
            velocity=np.moveaxis(np.tensordot(field._amplitude_rates(t).T, displacements, 1), 1, 0),
            dilation=np.tensordot(field._amplitudes(t).T, dilations, 1),
            growth=self._growth_at(position, growth_time),
            mirrored=self.mirrored and grid.half,
            centre=self.centre,
        )

    def _growth_at(self, position: Array, times: Array) -> Array:
        """c at points of cells, (times, cells, n, n).

        Where y does not change across cells, as in those of `CellGrid`, and the wave runs along y, one
        x of each will do.
        """
        x, y = position
        if self.drive.depends_on_x or np.any(y != y[:, :1]):
            return self.drive.value(x, y, times)
        some = self.drive.value(x[:, :1], y[:, :1], times)
        return np.broadcast_to(some, (*some.shape[:2], *y.shape[1:]))

    def _on_cells(self, grid: CellGrid, order: int) -> tuple[Array, Array, Array, Array]:
        """Points, areas, displacements and dilations of the basis; cached for batches of times."""
        key = grid, order
        if self._kept is None or self._kept[0] != key:
            x, y, area = grid.points(order)
            strains = self._strains(x, y)
            position = np.stack(np.broadcast_arrays(x, y))
            # contiguous, else the product with the amplitudes copies them for every batch of times
            displacements = np.ascontiguousarray(self._displacements(x, y))
            dilations = np.ascontiguousarray(strains[:, 0] + strains[:, 1])
            self._kept = key, (position, area, displacements, dilations)
        return self._kept[1]

    def _checked(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> tuple[Array, Array, Array]:
        self.sheet.check_inside(x, y)
        return (
            validation.real_array("x", x),
            validation.real_array("y", y),
            validation.real_array("t", t),
        )


def combine(amplitudes: Array, basis: Array) -> Array:
    """Sum over j of amplitudes[j] (times) and basis[j] (components, *points), broadcast."""
    if amplitudes.ndim == 1:
        return np.asarray(np.tensordot(amplitudes, basis, 1))
    missing = max(amplitudes.ndim + 1 - basis.ndim, 0)  # axes of t that the points lack
    basis = basis.reshape(*basis.shape[:2], *(1,) * missing, *basis.shape[2:])
    return np.asarray(sum(a * b for a, b in zip(amplitudes, basis, strict=True)))


def checked_field(value: object) -> LinearField:
    """`value`, which must be a deformation. Raises ValueError otherwise."""
    hint = "use airy_series, ritz_field or fem_check.plane_stress_field"
    return validation.instance("field", value, LinearField, hint)  # type: ignore[type-abstract]

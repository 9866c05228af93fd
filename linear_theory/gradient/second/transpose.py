"""Displacements that are quadratic in the deformation: how a weight of them depends on the load cases.

u_2, or the stretching by a deflection, solves the problem of `ritz` with a source whose fluxes F are
quadratic in fields z = sum_j a_j(t) z_j of the load cases. A weight of u is the work of F on a test
displacement, one more solution with the kept factor (`gradient.elastic`), and its derivative by a_j is

    int Q : F'(z) z_j,      Q : F'(z) e_i = [Q : F(z + e_i) - Q : F(z - e_i)]/2

exactly, Q of the test displacement and e_i the unit of the i-th field.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.plate.basis import derivative
from linear_theory.deformation.plate.stretching import BendingSource
from linear_theory.deformation.ritz import RitzField, legendre
from linear_theory.deformation.second.source import GaussGrid, Source

Array = NDArray[np.float64]


class QuadraticFlux(ABC):
    """Fluxes at Gauss points and what they do work on."""

    grid: GaussGrid

    @property
    @abstractmethod
    def table(self) -> Array:
        """The fields of each load case, c last, (cases, fields, points x, points y)."""

    @abstractmethod
    def fluxes(self, fields: Array) -> Array:
        """(channels, ...) of fields (fields, ...)."""

    @abstractmethod
    def tests(self, z: Array) -> Array:
        """What they do work on, of displacements (n, 2, degree x + 1, degree y + 1) on the basis of
        `ritz`, with the weights of the points, (n, channels, points x, points y)."""

    def by_cases(self, amplitudes: Array, tested: Array) -> Array:
        """Derivatives by the amplitudes of cases.

        amplitudes: (cases, S) at S phases; tested: displacements on which the fluxes of each phase do
        work, (S, n, 2, degree x + 1, degree y + 1). Returns (n, cases, S).
        """
        table = self.table
        flat = table.reshape(len(table), -1)
        found = np.empty((tested.shape[1], *amplitudes.shape))
        for s, (factors, z) in enumerate(zip(amplitudes.T, tested, strict=True)):
            here = np.tensordot(factors, table, 1)
            q, units = self.tests(z), np.eye(len(here))[:, :, None, None]
            slopes = [((self.fluxes(here + e) - self.fluxes(here - e)) / 2 * q).sum(1) for e in units]
            found[:, :, s] = np.stack(slopes, 1).reshape(len(q), -1) @ flat.T
        return found


@dataclass(frozen=True)
class PlaneFlux(QuadraticFlux):
    """The stress P of the displacement u_2."""

    first: RitzField
    source: Source

    @cached_property
    def grid(self) -> GaussGrid:  # type: ignore[override]
        """See QuadraticFlux."""
        return self.source._grid()

    @cached_property
    def table(self) -> Array:
        """du_k/dx_j, then c."""
        slopes = self.source.gradients
        fields = self.grid.values(slopes.reshape(len(slopes), 4, *slopes.shape[-2:]))
        return with_growth(fields, self.grid, self.first)

    def fluxes(self, fields: Array) -> Array:
        """P_kj."""
        slope = fields[:4].reshape(2, 2, *fields.shape[1:])
        return self.source._stress(slope, fields[4]).reshape(4, *fields.shape[1:])

    def tests(self, z: Array) -> Array:
        """See QuadraticFlux; the transpose of `RitzSolver.solve_stress`."""
        sheet, values, slopes = self.first.sheet, legendre.values, legendre.slopes
        by_x = values(slopes(z, 2), 3) * (sheet.length / 2)
        by_y = slopes(values(z, 2), 3) * (sheet.width / 2)
        both = np.stack([by_x, by_y], 2)
        return self.grid.weighted(both.reshape(len(z), 4, *z.shape[-2:]))


@dataclass(frozen=True)
class BendingFlux(QuadraticFlux):
    """The fluxes of the displacement by deflection."""

    first: RitzField
    source: BendingSource

    @cached_property
    def _on_grid(self) -> tuple[GaussGrid, Array]:
        return self.source._on_grid()

    @property
    def grid(self) -> GaussGrid:  # type: ignore[override]
        """See QuadraticFlux."""
        return self._on_grid[0]

    @cached_property
    def table(self) -> Array:
        """w_x, w_y, w_xx, w_yy, w_xy, then c."""
        return with_growth(self._on_grid[1], self.grid, self.first)

    def fluxes(self, fields: Array) -> Array:
        """Those of `BendingSource.fluxes`, (9, ...)."""
        stress, turning = self.source.fluxes(fields[:5], fields[5])
        return np.concatenate([stress, turning.reshape(6, *fields.shape[1:])])

    def tests(self, z: Array) -> Array:
        """See QuadraticFlux; the transpose of `BendingSource._work`."""
        (half_x, half_y), share = self.source._halves, self.source.turning_share
        values, slopes = legendre.values, legendre.slopes
        by_x, by_y = values(slopes(z, 2), 3) * half_y, slopes(values(z, 2), 3) * half_x
        stress = np.stack([by_x[:, 0], by_y[:, 1], by_x[:, 1] + by_y[:, 0]], 1)
        by_xx = share * _curvatures(values(z, 3), 2) * (half_y / half_x)
        by_yy = share * _curvatures(values(z, 2), 3) * (half_x / half_y)
        by_xy = 2 * share * slopes(slopes(z, 2), 3)
        return self.grid.weighted(np.concatenate([stress, by_xx, by_yy, by_xy], 1))


def _curvatures(z: Array, axis: int) -> Array:
    """Legendre coefficients of sum_d z_d phi_d'', along an axis."""
    c = np.moveaxis(legendre.slopes(z, axis), axis, -1)
    return np.moveaxis(c @ derivative(c.shape[-1]).T, -1, axis)


def with_growth(fields: Array, grid: GaussGrid, first: RitzField) -> Array:
    """Fields of load cases (cases, n, ...) at the points, and the growth of each case."""
    sheet = first.sheet
    x, y = grid.x[:, None] * sheet.width / 2, grid.y * sheet.length / 2
    growths = np.broadcast_to(first._cases.growths(x, y), (len(fields), *fields.shape[-2:]))
    return np.concatenate([fields, growths[:, None]], 1)

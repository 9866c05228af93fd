"""What a deflection beta w does in the plane: beta^2 u, the displacement of the mid-surface.

A slope of the sheet stretches it by grad(w) grad(w)/2 (von Karman), and the moments M turn with it:
from db_ab = -w_c dx_c,ab (`koiter`) equilibrium of order beta^2 reads

    int (C : e(u)) : grad(v) = - int (C : grad(w) grad(w)/2) : grad(v) + (D/K) int M_ab w_c v_c,ab,
    M = (1 - nu) K + nu tr(K) I,   K = grad grad w + c I,

C the elasticity of plane stress per thickness, D/(E h) in the place of D/K. The second term is of
relative order (thickness/wavelength)^2. Linear theory needs no more: the ground acts along z, and
displacements in the plane are even in beta. Like the second order in alpha, u is computed harmonic by
harmonic for waves of few harmonics, else at the requested times (see `second.times`).
"""

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.deformation.plate.basis import derivative
from linear_theory.deformation.plate.field import PlateField
from linear_theory.deformation.plate.quadratic import QuadraticSource, bending_moments
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.deformation.second.source import GaussGrid
from linear_theory.deformation.second.times import second_times
from linear_theory.sheet import hooke

Array = NDArray[np.float64]
Pair = tuple[int, int]

COARSER = 0.75
"""Ratio of the degrees of the solution with which u is compared for its error."""


@dataclass(frozen=True, eq=False)
class BendingSource(QuadraticSource):
    """Virtual work on the test functions of `RitzSolver`; of a Ritz degree."""

    degree: Pair

    def _work(self, grid: GaussGrid, w: Array, c: Array) -> Array:
        """(2, degree x + 1, degree y + 1) for w_x, w_y, w_xx, w_yy, w_xy (5, ...) and c at points."""
        stress, turning = self.fluxes(w, c)
        return self._against_first(grid, stress) + self._against_second(grid, turning)

    def fluxes(self, w: Array, c: Array) -> tuple[Array, Array]:
        """-C : grad(w) grad(w)/2 (xx, yy, xy) and M_ab w_c (ab: xx, yy, xy; c: x, y) at points."""
        nu = self.plate.sheet.poisson
        slope, bent = w[:2], w[2:] + np.stack([c, c, np.zeros_like(c)])
        strain = np.stack([slope[0] ** 2, slope[1] ** 2, slope[0] * slope[1]]) / 2
        stress = -hooke.stress(strain, np.zeros_like(c), nu)
        return stress, bending_moments(bent, nu)[:, None] * slope

    def _against_first(self, grid: GaussGrid, stress: Array) -> Array:
        """int P_kj dv_k/dx_j for a symmetric P (xx, yy, xy)."""
        xx, yy, xy = self._cut(grid.moments(stress))
        half_x, half_y = self._halves
        values, slopes = legendre.against_values, legendre.against_slopes
        by_x = values(slopes(np.stack([xx, xy]), 1), 2) * half_y
        by_y = slopes(values(np.stack([xy, yy]), 1), 2) * half_x
        return np.asarray(by_x + by_y)

    def _against_second(self, grid: GaussGrid, turning: Array) -> Array:
        """D/(E h) int M_ab w_c v_c,ab, with the second derivatives of the test functions."""
        half_x, half_y = self._halves
        values, slopes = legendre.against_values, legendre.against_slopes
        xx, yy, xy = self._cut(grid.moments(turning))
        by_xx = values(_against_curvatures(xx, 1), 2) * (half_y / half_x)
        by_yy = _against_curvatures(values(yy, 1), 2) * (half_x / half_y)
        by_xy = 2 * slopes(slopes(xy, 1), 2)
        return np.asarray(self.turning_share * (by_xx + by_yy + by_xy))

    @property
    def turning_share(self) -> float:
        """D/(E h), length^2."""
        sheet = self.plate.sheet
        return sheet.thickness**2 / 12 / (1 - sheet.poisson**2)

    @property
    def _halves(self) -> tuple[float, float]:
        return self.plate.sheet.width / 2, self.plate.sheet.length / 2

    def _cut(self, moments: Array) -> Array:
        return moments[..., : self.degree[0] + 1, : self.degree[1] + 1]

    def _common(self) -> Pair:
        x, y = (max(pair) for pair in zip(self.degree, self.plate.degree, strict=True))
        return x, y

    def _on_grid(self) -> tuple[GaussGrid, Array]:
        """Gauss points of the common degree, and derivatives of w there."""
        table = self.plate.derivative_polynomials()
        more = [c - d for c, d in zip(self._common(), self.plate.degree, strict=True)]
        padded = np.pad(table, ((0, 0), (0, 0), (0, more[0]), (0, more[1])))
        grid = GaussGrid(self.plate.sheet, self._common(), 1.0)
        return grid, grid.values(padded)


def _against_curvatures(moments: Array, axis: int) -> Array:
    """Integrals against phi_d'' = p_{d-1}' from those against p_d (degrees 0, 1, ... along `axis`)."""
    m = np.moveaxis(moments, axis, -1)
    return legendre.against_slopes(np.moveaxis(m @ derivative(m.shape[-1]), -1, axis), axis)


class StretchField:
    """The displacement u of order beta^2 due to a deflection, in the frame of the body.

    error: estimated relative L2 error of its time-dependent part at the worst phase; speed: largest
    root mean square of du/dt over the sheet, length^3 per time.
    """

    def __init__(self, plate: PlateField, degree: Pair | None = None) -> None:
        start = time.perf_counter()
        self.plate, self.sheet, self.drive = plate, plate.sheet, plate.drive
        self.degree = degree or plate.degree
        self._times = second_times(plate.cases)
        self._polynomials = self._solved(self.degree)
        self.seconds = time.perf_counter() - start

    def measured(self) -> "StretchField":
        """The field with `error` and `speed`, from a second solution of lower degrees."""
        low = tuple(ritz_error.odd(COARSER * d - 1) for d in self.degree)
        coarse = self._solved((low[0], low[1]))
        change = self._polynomials.copy()
        change[:, :, : low[0] + 1, : low[1] + 1] -= coarse
        rates = self._times.rates(self._times.phases)
        size = float(mixed_norms(self._polynomials, rates).max(initial=0.0))
        self.error = float(mixed_norms(change, rates).max(initial=0.0)) / size if size else 0.0
        self.speed = size / 2
        return self

    error: float = math.nan
    speed: float = math.nan

    def at(self, t: Array) -> "StretchField":
        """The field whose basis spans the motion at times t."""
        if self._times.serve(t):
            return self
        found = StretchField(self.plate.at(t), self.degree)
        found.error, found.speed = self.error, self.speed
        return found

    def rates(self, t: Array) -> Array:
        """Factors of du/dt, (basis, *t.shape)."""
        return self._times.rates(t)

    def displacements(self, x: Array, y: Array) -> Array:
        """Basis functions at points, (basis, 2, *broadcast(x, y).shape)."""
        local = 2 * x / self.sheet.width, 2 * y / self.sheet.length
        return legendre.evaluate(self._polynomials, *local)

    def _solved(self, degree: Pair) -> Array:
        plate, solver = self.plate, RitzSolver(self.sheet, degree)
        loads = self._times.moments(BendingSource(plate, degree), Amplitudes(plate))
        solution = solver.solve_work(loads, self.drive.mirrored)
        return legendre.values(legendre.values(solution, 2), 3)


@dataclass(frozen=True)
class Amplitudes:
    """The time dependence of the deflection in the form that `SecondTimes.moments` reads."""

    plate: PlateField

    def _amplitudes(self, t: Array) -> Array:
        return self.plate.cases.amplitudes(t)

    def _amplitude_rates(self, t: Array) -> Array:
        return self.plate.cases.rates(t)

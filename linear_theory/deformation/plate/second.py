"""Deflections of second order, alpha beta w_ab + beta^2 w_bb, of a sheet on its ground.

Let w be the deflection per unit beta, u the displacement per unit alpha, K = grad grad w + c I and M(A)
= (1 - nu) A + nu tr(A) I. The energy of order (alpha w^2) of Koiter's sheet, of the ground and of the
weight is alpha times

    int D [m/2 c K : M(K) + K : M(R)] + 1/2 N : grad(w) grad(w) + 1/2 s e w^2,
    R_ab = - u_c,ab w_c + r c^2 delta_ab,

with N = E h C : (e(u) - c I) the forces of the plane, 1 + alpha m c the factor of the energy density (m
as in `Growth.energy_weight`), -b = beta c (1 + alpha r c) the rest curvature (r = 2 for one that counts
by the grown metric, else 0) and 1 + alpha e the area of weight and pressure. Its derivative with
respect to w, with the other sign, is the work that bends w_ab. That of w_bb is k w^2, since the
pressure k (d - w)^2 is not linear.

Mid-surface and load of second order need neither: they matter where the slope of the sheet does, which
is for friction on its lower face.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.deformation.plate.basis import derivative
from linear_theory.deformation.plate.field import PlateField
from linear_theory.deformation.plate.quadratic import QuadraticSource, bending_moments
from linear_theory.deformation.plate.solver import PlateSolver
from linear_theory.deformation.plate.stretching import Amplitudes
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.second.field import SecondOrderField
from linear_theory.deformation.second.source import GaussGrid
from linear_theory.deformation.second.times import second_times
from linear_theory.growth.growth import Growth, Reference
from linear_theory.sheet import hooke

Array = NDArray[np.float64]
Pair = tuple[int, int]

LONGER = 1.35
"""Ratio of the degrees to those of w: products of two waves are half as long."""

COARSER = 0.75
"""Ratio of the degrees of the solution with which the field is compared for its error."""


@dataclass(frozen=True, eq=False)
class DeflectionSource(QuadraticSource):
    """Virtual work on the test functions of a solver, of alpha beta and of beta^2."""

    gradients: Array
    growth: Growth
    solver: PlateSolver

    def _work(self, grid: GaussGrid, fields: Array, c: Array) -> Array:
        """(2, degree x + 1, degree y + 1) for w with its derivatives (6, ...), those of u and c."""
        sheet, ground, nothing = self.plate.sheet, self.plate.foundation, np.zeros_like(c)
        w, slope, bent = fields[0], fields[1:3], fields[3:6] + np.stack([c, c, nothing])
        gradient = fields[6:10].reshape(2, 2, *c.shape)
        second = fields[10:].reshape(2, 3, *c.shape)
        square = (2.0 if self.growth.curvature is Reference.GROWN else 0.0) * c**2
        change = np.stack([square, square, nothing]) - (second * slope[:, None]).sum(0)
        moment = ground.rigidity * bending_moments(bent, sheet.poisson)
        by_growth = ground.rigidity * bending_moments(change, sheet.poisson)
        turning = by_growth + self.growth.energy_weight * c * moment
        strain = np.stack([gradient[0, 0], gradient[1, 1], (gradient[0, 1] + gradient[1, 0]) / 2])
        xx, yy, xy = self._per_stress * hooke.stress(strain, c, sheet.poisson)
        pulled = np.stack([xx * slope[0] + xy * slope[1], xy * slope[0] + yy * slope[1]])
        carried = moment[0] * second[:, 0] + moment[1] * second[:, 1] + 2 * moment[2] * second[:, 2]
        rate = ground.load.rate(strain[0] + strain[1], c)
        cut, solver = self._cut, self.solver
        mixed = solver.against_curvatures(cut(grid.moments(turning)))
        mixed += solver.against_slopes(cut(grid.moments(pulled - carried)))
        mixed += solver.against_values(cut(grid.moments(ground.spring * rate * w)))
        return np.stack([-mixed, solver.against_values(cut(grid.moments(ground.stiffness * w**2)))])

    @property
    def _per_stress(self) -> float:
        """E h over the unit of stress of `hooke`, from D = E h^3/(12 (1 - nu^2))."""
        sheet = self.plate.sheet
        return 12 * (1 - sheet.poisson**2) * self.plate.foundation.rigidity / sheet.thickness**2

    def _cut(self, moments: Array) -> Array:
        across, along = self.solver.degree
        return moments[..., : across + 1, : along + 1]

    def _on_grid(self) -> tuple[GaussGrid, Array]:
        """Gauss points, and w, w_x, w_y, w_xx, w_yy, w_xy, du_k/dx_j, u_k,xx, u_k,yy, u_k,xy there."""
        plate, slopes = self.plate, self.gradients
        by_x = derivative(slopes.shape[-2]) * (2 / plate.sheet.width)
        by_y = derivative(slopes.shape[-1]).T * (2 / plate.sheet.length)
        second = np.stack([by_x @ slopes[:, :, 0], slopes[:, :, 1] @ by_y, by_x @ slopes[:, :, 1]], 2)
        bent = np.concatenate([plate.polynomials[:, None], plate.derivative_polynomials()], 1)
        flat = [part.reshape(len(part), -1, *part.shape[-2:]) for part in (slopes, second)]
        shapes = (bent.shape[-2:], slopes.shape[-2:], [d + 1 for d in self.solver.degree])
        across, along = (max(counts) for counts in zip(*shapes, strict=True))
        grid = GaussGrid(plate.sheet, (across - 1, along - 1), 1.0)
        fields = np.concatenate([_padded(part, (across, along)) for part in (bent, *flat)], 1)
        return grid, grid.values(fields)


def _padded(table: Array, counts: tuple[int, int]) -> Array:
    """Legendre coefficients with zeros up to these counts."""
    more = [count - have for count, have in zip(counts, table.shape[-2:], strict=True)]
    return np.pad(table, (*((0, 0),) * (table.ndim - 2), (0, more[0]), (0, more[1])))


class SecondDeflection:
    """w_ab and w_bb, length^2 and length^3, as slopes and their rates.

    errors: estimated relative L2 errors of the rates of their slopes at the worst phase, (2,); speeds:
    largest root mean squares of these rates over the sheet, (2,), lengths per time.
    """

    def __init__(self, plane: SecondOrderField, plate: PlateField, degree: Pair | None = None) -> None:
        self.plane, self.plate, self.sheet = plane, plate, plate.sheet
        across, along = (ritz_error.odd(LONGER * d) for d in plate.degree)
        self.degree = degree or (across, along)
        self._times = second_times(plate.cases)
        self.slopes = self._slopes(self._solved(self.degree))

    errors: Array = np.full(2, math.nan)
    speeds: Array = np.full(2, math.nan)

    def measured(self) -> "SecondDeflection":
        """The field with `errors` and `speeds`, from a second solution of lower degrees."""
        low = tuple(ritz_error.odd(COARSER * d - 1) for d in self.degree)
        coarse = self._slopes(self._solved((low[0], low[1])))
        change = self.slopes - _padded(coarse, (self.degree[0] + 1, self.degree[1] + 1))
        rates = self._times.rates(self._times.phases)
        sizes, errors = (
            np.array([mixed_norms(part[:, k], rates).max(initial=0.0) for k in range(2)])
            for part in (self.slopes, change)
        )
        self.errors = np.divide(errors, sizes, out=np.zeros(2), where=sizes > 0)
        self.speeds = sizes / 2
        return self

    def at(self, t: Array) -> "SecondDeflection":
        """The field whose basis spans the motion at times t."""
        if self._times.serve(t):
            return self
        found = SecondDeflection(self.plane._for_times(t), self.plate.at(t), self.degree)
        found.errors, found.speeds = self.errors, self.speeds
        return found

    def rates(self, t: Array) -> Array:
        """Time derivatives of the factors of the basis, (basis, *t.shape)."""
        return self._times.rates(t)

    def _solved(self, degree: Pair) -> Array:
        """Legendre coefficients of w_ab and w_bb, (basis, 2, degree x + 1, degree y + 1)."""
        plate, solver = self.plate, PlateSolver(self.sheet, self.plate.foundation, degree)
        gradients = self.plane.first.gradient_polynomials
        source = DeflectionSource(plate, gradients, self.plane.growth, solver)
        loads = self._times.moments(source, Amplitudes(plate))
        found = solver.solve_work(loads.reshape(-1, *loads.shape[-2:]))
        return found.reshape(loads.shape)

    def _slopes(self, polynomials: Array) -> Array:
        """Those of w_x and w_y, (basis, 2, 2, degree x + 1, degree y + 1)."""
        across, along = polynomials.shape[-2:]
        x = derivative(across) * (2 / self.sheet.width) @ polynomials
        y = polynomials @ (derivative(along).T * (2 / self.sheet.length))
        return np.stack([x, y], 2)

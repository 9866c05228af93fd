"""The planar Koiter sheet to second order in the growth coupling: u = alpha u_1 + alpha^2 u_2.

With the Green strain E = e(u) + grad(u)^T grad(u)/2, the growth strain (g - 1) I/2 of the rest metric
g I and the elasticity C of plane stress, the energy of stretching (eq. 1a) is

    1/2 int w (E - (g - 1) I/2) : C : (E - (g - 1) I/2) dA,    w = g^-1 or g^-2,

w = g^-2 from the inverse rest metric in C, times g if the energy density is per grown area. With
(g - 1)/2 = alpha c + alpha^2 k c^2 + ... and w = 1 + alpha m c + ..., equilibrium at order alpha is the
linear theory, int s_1 : grad(v) = 0 with s_1 = C : (e(u_1) - c I), and at order alpha^2

    int (C : e(u_2)) : grad(v) = int P : grad(v),
    P = C : (k c^2 I - grad(u_1)^T grad(u_1)/2) - m c s_1 - grad(u_1) s_1.

u_2 solves the linear problem with another source, quadratic in u_1 and c: a wave with harmonics 1 ... K
in time gives a source with harmonics 0 ... 2K, each solved separately. For a general wave u_2 and its
rate are solved for at the requested times.

At second order the choice of frame matters. As at first order, the frame is that of the body: its
origin is the centre of mass of the undeformed area, its axes rotate such that the mean deformation
gradient F over that area has F_yx = F_xy. These conditions are linear: u_1 and u_2 both have zero mean
and zero mean of (du_y/dx - du_x/dy)/2.
"""

import math
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.deformation.field import LinearField, combine
from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.ritz.field import MOST_NUMBERS, RitzField, shortest_order
from linear_theory.deformation.ritz.solver import RitzSolver, matrix_size
from linear_theory.deformation.second.source import Source
from linear_theory.deformation.second.times import AtTimes, second_times
from linear_theory.growth.growth import Growth
from linear_theory.motion.motion import CellGrid, Motion
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

UNIT = Growth(1.0)
"""Unit growth coupling with the growth law of the paper."""


def second_order_field(
    sheet: Sheet, wave: Wave, growth: Growth = UNIT, rtol: float = 1e-4
) -> "SecondOrderField":
    """Deformation to second order in alpha, with polynomial degrees chosen for rtol.

    rtol: bound of the estimated relative L2 errors of u_1 and u_2 over the sheet at the worst phases.
    growth: its law and energy area are used (see the module docstring), its alpha is not.
    Raises ValueError for bad input, and NotConvergedError, with the best field, if rtol requires a
    degree that needs more memory than is available.
    """
    start, rtol = time.perf_counter(), validation.tolerance(rtol)
    driven = drive(wave, sheet).fine
    # the waves of u_2 are half as long
    degree = ritz_error.first_degrees(sheet, 2 * shortest_order(driven), rtol)
    best = None
    while True:
        if matrix_size(degree) > MOST_NUMBERS:
            raise NotConvergedError(
                f"rtol = {rtol:g}: requires degrees {degree} or more, too many for the memory", best
            )
        best = SecondOrderField(RitzField(driven, RitzSolver(sheet, degree)), growth)
        tails = np.maximum(best.first.tails, best.second_tails)
        if np.hypot(*tails) <= rtol:
            best.seconds = time.perf_counter() - start
            return best
        aliased = max(best.first.aliased, best.second_aliased)
        degree = ritz_error.raised_degrees(degree, (float(tails[0]), float(tails[1])), aliased, rtol)


class SecondOrderField(LinearField):
    """u_1 as a linear field, and u_2 from the same elastic problem with the source given above.

    The methods of LinearField give u_1, per unit alpha, in the frame of the body. first: u_1.
    """

    def __init__(self, first: RitzField, growth: Growth = UNIT) -> None:
        start = time.perf_counter()
        self.first, self.sheet, self.wave = first, first.sheet, first.wave
        self.drive: Drive = first.drive
        self.growth, self.mirrored = growth, first.mirrored
        self.numbers = 2 * first.numbers
        self._times = second_times(first._cases)
        square, weight = growth.law.square, growth.energy_weight
        self._source = Source(self.drive, first.gradient_polynomials, square, weight)
        self._moments = self._times.moments(self._source, first)
        self._solution = self._solve(self._moments)
        self._kept_second: tuple[object, Array] | None = None
        self.seconds = first.seconds + time.perf_counter() - start

    def _settings(self) -> Mapping[str, Any]:
        names = {"growth_law": self.growth.law.name, "area": self.growth.energy_area}
        return {"degree": self.first.degree, **names}

    @property
    def error(self) -> float:
        """Estimated relative L2 error of u_1 over the sheet at the worst phase."""
        return self.first.error

    @property
    def second_error(self) -> float:
        """Estimated relative L2 error of the time-dependent part of u_2 at the worst phase."""
        return float(np.hypot(*self.second_tails)) + ritz_error.ROUNDOFF

    @cached_property
    def second_tails(self) -> tuple[float, float]:
        """The parts of `second_error` due to too low degrees across and along the sheet."""
        resolving = ritz_error.resolving_degrees(self.sheet, 2 * shortest_order(self.drive))
        aliased = self._aliased / math.sqrt(2)  # half of the square each: both degrees add points
        tails = ritz_error.relative_tails(
            self._polynomials,
            (aliased, aliased),
            self._times.rates(self._times.phases),
            resolving,
            self.sheet.poisson,
        )
        return float(tails[0].max(initial=0.0)), float(tails[1].max(initial=0.0))

    @property
    def second_aliased(self) -> float:
        """The part of `second_error` due to too few Gauss points for the source."""
        rates = self._times.rates(self._times.phases)
        return float(ritz_error.relative(self._aliased, self._polynomials, rates).max(initial=0.0))

    @cached_property
    def second_speed(self) -> float:
        """Root mean square of du_2/dt over the sheet at the worst phase, length per time."""
        return float(mixed_norms(self._polynomials, self._times.rates(self._times.phases)).max() / 2)

    def second_displacement(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """u_2, (2, ...), length. Raises ValueError for points outside the sheet."""
        x, y, t = self._checked(x, y, t)
        field = self._for_times(t)
        return combine(field._times.factors(t), field._seconds_at(x, y))

    def second_velocity(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """du_2/dt in the frame of the body, (2, ...), length per time."""
        x, y, t = self._checked(x, y, t)
        field = self._for_times(t)
        return combine(field._times.rates(t), field._seconds_at(x, y))

    def motion(self, times: ArrayLike, grid: CellGrid, order: int) -> Motion:
        """As `LinearField.motion`, with du_2/dt as `second` and, if the sheet may turn, u_1."""
        t = validation.real_array("times", times)
        field = self._for_times(t)
        first = super(SecondOrderField, field).motion(t, grid, order)
        if field._kept_second is None or field._kept_second[0] != (grid, order):
            x, y, _ = grid.points(order)
            field._kept_second = (grid, order), field._seconds_at(x, y)
        second = _at_times(field._times.rates(t), field._kept_second[1])
        if first.mirrored:
            return replace(first, second=second)
        displacements = field._on_cells(grid, order)[2]
        return replace(
            first, second=second, displacement=_at_times(field._amplitudes(t), displacements)
        )

    def _for_times(self, t: Array) -> "SecondOrderField":
        if self._times.serve(t):
            return self
        return SecondOrderField(self.first._for_times(t), self.growth)

    def _solve(self, moments: Array) -> Array:
        """u_2 for the moments of a source, (basis, 2, degree x + 1, degree y + 1)."""
        return self.first.solver.solve_stress(moments, self.mirrored)

    @cached_property
    def _aliased(self) -> Array:
        """Error of u_2 from too few Gauss points for the source: twice the change with more points.

        0 for waves of few harmonics, which the points resolve. Measured for fronts and ridges of
        growth: 1.1 to 2.7 times the true error, where that is smaller than u_2.
        """
        if not isinstance(self._times, AtTimes):
            return np.zeros((len(self._solution), 0))
        finer = self._times.moments(replace(self._source, finer=True), self.first)
        change = self._solve(ritz_error.beyond_rounding(finer, self._moments))
        return 2 * legendre.values(legendre.values(change, 2), 3)

    @cached_property
    def _polynomials(self) -> Array:
        """u_2 in orthonormal Legendre polynomials, (basis, 2, degree x + 1, degree y + 1)."""
        return legendre.values(legendre.values(self._solution, 2), 3)

    def _seconds_at(self, x: Array, y: Array) -> Array:
        """Basis functions of u_2 at points, (basis, 2, *broadcast(x, y).shape)."""
        local = 2 * x / self.sheet.width, 2 * y / self.sheet.length
        return legendre.evaluate(self._polynomials, *local)

    def _amplitudes(self, t: Array) -> Array:
        return self.first._amplitudes(t)

    def _amplitude_rates(self, t: Array) -> Array:
        return self.first._amplitude_rates(t)

    def _displacements(self, x: Array, y: Array) -> Array:
        return self.first._displacements(x, y)

    def _strains(self, x: Array, y: Array) -> Array:
        return self.first._strains(x, y)


def _at_times(factors: Array, values: Array) -> Array:
    """(2, times, ...) from factors (basis, times) and values (basis, 2, ...)."""
    return np.moveaxis(np.tensordot(factors.T, values, 1), 1, 0)

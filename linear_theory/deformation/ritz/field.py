"""Legendre-Ritz solution of the growing sheet: polynomial displacements of least elastic energy.

It solves eqs 10 and 14 of the paper (free edges, growth strain c I) without an Airy function: an
independent second solution for the same field, and the only one for waves that depend on x.

The exact solution is singular at the corners (u ~ distance**2.74), so that the error decreases with the
degree p like p**-6.5, after an exponential decrease while the wave and its edge layers are resolved.
"""

import math
import time
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.field import LinearField
from linear_theory.deformation.load_cases import Harmonics, LoadCases, Snapshots, load_cases
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.ritz.moments import gauss_moments
from linear_theory.deformation.ritz.solver import RitzSolver, matrix_size
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave import arguments
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]
Pair = tuple[int, int]

DEFAULT_RTOL = 1e-6
MOST_NUMBERS = 25_000_000  # entries in the matrix of one parity, 200 MB


@one_blas_thread
def ritz_field(
    sheet: Sheet, wave: Wave, degree: int | Pair | None = None, rtol: float | None = None
) -> "RitzField":
    """Small-strain deformation of a rectangular sheet by any wave c(x, y, t), per unit alpha.

    degree: of the polynomials, one number or (across, along), >= 3, rounded up to odd;
    rtol: tolerance for the estimated relative L2 error of the displacement at the worst phase, by which
    the degrees are chosen (1e-6 if neither is given).

    Raises ValueError for bad input, for both arguments together and for a degree that needs more memory
    than is available; raises NotConvergedError, with the best field, if rtol requires such a degree.

    >>> import numpy as np
    >>> from linear_theory import FieldWave, Sheet, ritz_field
    >>> oblique = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), period=1.0)
    >>> field = ritz_field(Sheet(), oblique, rtol=1e-4)
    >>> print(field.error <= 1e-4, field.mirrored)  # not mirror symmetric: it also moves sideways
    True False
    """
    sheet, wave = arguments.sheet(sheet), arguments.wave(wave)
    driven = drive(wave, sheet)
    if degree is None:
        rtol = DEFAULT_RTOL if rtol is None else validation.tolerance(rtol)
        return _with_enough_degrees(driven.fine, rtol)
    if rtol is not None:
        raise ValueError(f"degree = {degree}, rtol = {rtol}: must not both be given")
    return RitzField(driven.fine, RitzSolver(sheet, _checked_degree(degree)))


def _checked_degree(degree: int | Pair) -> Pair:
    pair = (degree, degree) if isinstance(degree, int | np.integer) else tuple(np.atleast_1d(degree))
    if len(pair) != 2:
        raise ValueError(f"degree = {validation.shown(degree)}: must be one integer or (across, along)")
    across, along = (ritz_error.odd(validation.integer("degree", d, 3)) for d in pair)
    if matrix_size((across, along)) > MOST_NUMBERS:
        raise ValueError(
            f"degree = {degree}: must be smaller, its matrix has more than {MOST_NUMBERS} entries"
        )
    return across, along


def _with_enough_degrees(drive: Drive, rtol: float) -> "RitzField":
    """Raise the degrees until the error estimate meets rtol."""
    start, best = time.perf_counter(), None
    degree = ritz_error.first_degrees(drive.sheet, shortest_order(drive), rtol)
    while True:
        if matrix_size(degree) > MOST_NUMBERS:
            raise NotConvergedError(
                f"rtol = {rtol:g}: requires degrees {degree} or more, too many for the memory", best
            )
        best = RitzField(drive, RitzSolver(drive.sheet, degree))
        if best.error <= rtol:
            best.seconds = time.perf_counter() - start
            return best
        degree = ritz_error.raised_degrees(degree, best.tails, best.aliased, rtol)


def shortest_order(drive: Drive) -> int:
    """Largest number of waves on the sheet; 1 if unknown, shorter ones show in the error estimate."""
    return 1 if drive.series is None else int(drive.series.orders[-1])


class RitzField(LinearField):
    """Deformation of a sheet by polynomials of least energy; returned by `ritz_field`.

    The basis functions are the solutions for the wave's load cases. degree: highest degrees
    (across, along).

    >>> from linear_theory import Sheet, SineWave, ritz_field
    >>> field = ritz_field(Sheet(), SineWave(), degree=(15, 21))
    >>> print(field.degree, field.displacement(x=0.1, y=0.2, t=0.3).round(5))  # L per unit alpha
    (15, 21) [-0.06152 -0.11559]
    """

    def __init__(self, drive: Drive, solver: RitzSolver, cases: LoadCases | None = None) -> None:
        start = time.perf_counter()
        self.sheet, self.wave, self.drive = solver.sheet, drive.wave, drive
        self.solver, self.degree = solver, solver.degree
        self._cases = cases or load_cases(drive)
        self.mirrored = drive.mirrored
        if isinstance(self._cases, Snapshots):
            self.numbers = 2 * (self.degree[0] + 1) * (self.degree[1] + 1)
        self._growth = self._moments()
        self._solution = solver.solve(self._growth)
        self.seconds = time.perf_counter() - start

    def _settings(self) -> Mapping[str, Any]:
        return {"degree": self.degree}

    @property
    def error(self) -> float:
        """Estimated relative L2 error of the displacement over the sheet at the worst phase."""
        return float(np.max(np.hypot(*self._tails), initial=0.0)) + ritz_error.ROUNDOFF

    @property
    def aliased(self) -> float:
        """The part of `error` due to too few Gauss points for c; higher degrees have more of them."""
        samples = self._cases.samples()
        return float(ritz_error.relative(self._aliased, self._polynomials, samples).max(initial=0.0))

    @property
    def tails(self) -> tuple[float, float]:
        """The parts of `error` due to too low degrees across and along the sheet."""
        across, along = self._tails.max(axis=1)
        return float(across), float(along)

    @cached_property
    def _tails(self) -> Array:
        across, along = self.degree
        aliased = self._aliased / math.sqrt(2)  # half of the square each: both degrees add points
        missed = (
            _side_by_side(self._growth[:, across + 1 :] * (self.sheet.width / 2 / across), aliased),
            _side_by_side(self._growth[:, :, along + 1 :] * (self.sheet.length / 2 / along), aliased),
        )
        resolving = ritz_error.resolving_degrees(self.sheet, shortest_order(self.drive))
        return ritz_error.relative_tails(
            self._polynomials, missed, self._cases.samples(), resolving, self.sheet.poisson
        )

    @cached_property
    def _aliased(self) -> Array:
        """Error of u from too few Gauss points for c, (cases, ...): twice the change with more points.

        0 for harmonics, whose moments are exact. Measured for fronts, ridges and spikes of growth,
        along, across and oblique: 1.5 to 3.2 times the true error.
        """
        if not isinstance(self._cases, Snapshots):
            return np.zeros((len(self._growth), 0))
        (across, along), count = self._growth.shape[1:], len(self._cases.times)
        finer = self._moments_by((3 * across // 2, 3 * along // 2), self._cases.values)
        more = ritz_error.beyond_rounding(finer[:, :across, :along], self._growth[:count])
        change = self.solver.solve(more)
        twice = 2 * legendre.values(legendre.values(change, 2), 3)
        return np.concatenate([twice, np.zeros_like(twice)])  # rates do not enter the displacement

    def _moments(self) -> Array:
        """Integrals of the growth fields times p_i(x) p_j(y), (cases, i, j); some beyond `degree`."""
        if isinstance(self._cases, Harmonics):
            return self._moments_of_harmonics(self._cases)
        across, along = (degree + degree // 4 + 12 for degree in self.degree)
        return self._moments_by((across, along), self._cases.growths)  # exact for c of degree 3/2 p

    def _moments_by(self, counts: Pair, growths: Callable[[Array, Array], Array]) -> Array:
        """Moments of any growth fields with `counts` Gauss points, (growths, *counts)."""
        return gauss_moments(self.sheet, counts, growths)

    def _moments_of_harmonics(self, cases: Harmonics) -> Array:
        orders = cases.series.orders
        count = max(
            self.degree[1] + 1, ritz_error.resolving_degrees(self.sheet, int(orders[-1]))[1] + 9
        )
        cosine, sine = legendre.wave_moments(count, orders)
        moments = np.zeros((2 * len(orders) + bool(cases.series.mean), self.degree[0] + 1, count))
        moments[: 2 * len(orders), 0] = np.sqrt(2) * np.concatenate([cosine, sine])
        moments[2 * len(orders) :, 0, 0] = 2  # growth 1 for the mean of c
        return moments

    @cached_property
    def _polynomials(self) -> Array:
        """Displacement in orthonormal Legendre polynomials, (cases, 2, degree x + 1, degree y + 1)."""
        return legendre.values(legendre.values(self._solution, 2), 3)

    @cached_property
    def gradient_polynomials(self) -> Array:
        """du_k/dx_j of each load case in orthonormal Legendre polynomials of 2x/W and 2y/L.

        (cases, k, j, degree x + 1, degree y + 1).
        """
        by_x = legendre.values(legendre.slopes(self._solution, 2), 3) / (self.sheet.width / 2)
        by_y = legendre.slopes(legendre.values(self._solution, 2), 3) / (self.sheet.length / 2)
        return np.stack([by_x, by_y], 2)

    @cached_property
    def _strain_polynomials(self) -> Array:
        """Strain in orthonormal Legendre polynomials, (cases, 3, degree x + 1, degree y + 1)."""
        slope = self.gradient_polynomials
        mixed = (slope[:, 0, 1] + slope[:, 1, 0]) / 2
        return np.stack([slope[:, 0, 0], slope[:, 1, 1], mixed], 1)

    def _for_times(self, t: Array) -> "RitzField":
        cases = self._cases.at(t)
        return self if cases is self._cases else RitzField(self.drive, self.solver, cases)

    def _amplitudes(self, t: Array) -> Array:
        return self._cases.amplitudes(t)

    def _amplitude_rates(self, t: Array) -> Array:
        return self._cases.rates(t)

    def _displacements(self, x: Array, y: Array) -> Array:
        return legendre.evaluate(self._polynomials, *self._local(x, y))

    def _strains(self, x: Array, y: Array) -> Array:
        return legendre.evaluate(self._strain_polynomials, *self._local(x, y))

    def _local(self, x: Array, y: Array) -> tuple[Array, Array]:
        return 2 * x / self.sheet.width, 2 * y / self.sheet.length


def _side_by_side(one: Array, other: Array) -> Array:
    """Two arrays of the same cases, flattened and concatenated, (cases, numbers)."""
    return np.concatenate([part.reshape(len(one), -1) for part in (one, other)], axis=1)

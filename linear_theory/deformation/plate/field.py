"""Deflection and pressure of a sheet on its ground, to first order in the curvature coupling.

On a ground that is linearised about the depth at which it carries the weight, the deflection beta w
obeys D lap^2 w + s w = -D (1 + nu) lap c with free edges, whose conditions contain c too (see
`PlateSolver`), and the pressure is rho g (1 + beta p), p = -s w/(rho g). The growth of the sheet in its
plane does not deflect it as long as weight and pressure count per the same area.
"""

import math
import time
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.field import combine
from linear_theory.deformation.load_cases import Harmonics, LoadCases, load_cases, mixed_norms
from linear_theory.deformation.plate.basis import derivative
from linear_theory.deformation.plate.foundation import Foundation
from linear_theory.deformation.plate.solver import PlateSolver
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.ritz.moments import gauss_moments
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave import arguments
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]
Pair = tuple[int, int]

FINER = 1.35
"""Ratio of the degrees of two solutions, whose difference is the error of the coarser one."""

MOST_UNKNOWNS = 2500
"""Largest number of unknowns of one parity, a matrix of 50 MB."""

POINTS = 41
"""Points per direction at which the largest deflection is sought."""

REFINED = 2
"""How often its phase is sought more finely for a wave that is no Fourier series."""


@one_blas_thread
def plate_field(sheet: Sheet, wave: Wave, ground: Foundation, rtol: float = 1e-4) -> "PlateField":
    """Deflection of a rectangular sheet on its ground by any wave, per unit curvature coupling.

    rtol: tolerance for the estimated relative L2 error of the deflection at the worst phase, by which
    the polynomial degrees are chosen. Raises ValueError for bad input and NotConvergedError, with the
    best field, where rtol requires more memory than is available.

    >>> from linear_theory import Sheet, SineWave
    >>> from linear_theory.deformation.plate import Foundation, plate_field
    >>> paper = Foundation(rigidity=3e-6, weight=2.5e-4, stiffness=0.5)
    >>> field = plate_field(Sheet(), SineWave(), paper, rtol=1e-4)
    >>> print(field.error <= 1e-4, f"lifts off at beta = {field.lift_off():.2f}/L")
    True lifts off at beta = 0.52/L
    """
    sheet, wave, rtol = arguments.sheet(sheet), arguments.wave(wave), validation.tolerance(rtol)
    start, driven = time.perf_counter(), drive(wave, sheet).fine
    cases = load_cases(driven)
    degree = first_degrees(sheet, ground, driven, rtol)
    best = PlateField(driven, ground, degree, cases)
    while True:
        finer = _raised(degree)
        if (finer[0] // 2 + 1) * (finer[1] // 2 + 1) > MOST_UNKNOWNS:
            raise NotConvergedError(
                f"rtol = {rtol:g}: requires degrees {finer} or more, too many for the memory", best
            )
        better = PlateField(driven, ground, finer, cases)
        better.error = better.distance(best)
        degree, best = finer, better
        if best.error <= rtol:
            best.seconds = time.perf_counter() - start
            return best


def first_degrees(sheet: Sheet, ground: Foundation, driven: Drive, rtol: float) -> Pair:
    """Degrees (across, along) that resolve waves and edge layers, rather low than high."""
    across, along = driven.short_waves
    layer = min(sheet.width, sheet.length / along, ground.layer)
    corner = 2.0 + 0.35 * -math.log10(rtol)
    x, y = (corner * math.sqrt(side / layer) for side in (sheet.width, sheet.length))
    waves = math.pi * (across if across > 1 else 0)
    return ritz_error.odd(waves + x), ritz_error.odd(math.pi * along + y)


def _raised(degree: Pair) -> Pair:
    across, along = (ritz_error.odd(max(FINER * d, d + 2)) for d in degree)
    return across, along


class PlateField(Shown):
    """Deflection w and pressure p of a sheet on its ground, per unit curvature coupling beta.

    degree: highest degrees (across, along). error: estimated relative L2 error of w at the worst phase,
    the difference to lower degrees; NaN if not compared. seconds: time for set-up and solution.
    """

    error: float = math.nan

    def __init__(
        self,
        drive: Drive,
        ground: Foundation,
        degree: Pair,
        cases: LoadCases | None = None,
        solver: PlateSolver | None = None,
    ) -> None:
        start = time.perf_counter()
        self.sheet, self.drive, self.foundation, self.degree = drive.sheet, drive, ground, degree
        self.cases = cases or load_cases(drive)
        counts = tuple(d + d // 4 + 12 for d in degree)
        self._solver = solver or PlateSolver(self.sheet, ground, degree)
        self.polynomials = self._solver.solve(
            gauss_moments(self.sheet, (counts[0], counts[1]), self.cases.growths)
        )
        self.seconds = time.perf_counter() - start

    def _contents(self) -> Mapping[str, Any]:
        known = {"sheet": self.sheet, "foundation": self.foundation, "degree": self.degree}
        return {**known, "error": self.error, "seconds": self.seconds}

    def deflection(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """w, (...), length^2. Raises ValueError for points outside the sheet."""
        self.sheet.check_inside(x, y)
        x, y, t = (validation.real_array(n, v) for n, v in {"x": x, "y": y, "t": t}.items())
        field = self.at(t)
        return combine(field.cases.amplitudes(t), field.deflections(x, y)[:, None])[0]

    def pressure(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """p, (...), length: the pressure is rho g (1 + beta p)."""
        return -self.deflection(x, y, t) * self.pressing

    @property
    def pressing(self) -> float:
        """s/(rho g), 1/length."""
        return self.foundation.spring / self.foundation.weight

    def at(self, t: Array) -> "PlateField":
        """The field whose cases serve the times t."""
        cases = self.cases.at(t)
        if cases is self.cases:
            return self
        found = PlateField(self.drive, self.foundation, self.degree, cases, self._solver)
        found.error = self.error
        return found

    def deflections(self, x: Array, y: Array) -> Array:
        """w of each load case, (cases, *broadcast(x, y).shape)."""
        local = 2 * x / self.sheet.width, 2 * y / self.sheet.length
        return legendre.evaluate(self.polynomials[:, None], *local)[:, 0]

    def derivative_polynomials(self) -> Array:
        """Legendre coefficients of w_x, w_y, w_xx, w_yy, w_xy, (cases, 5, degrees x, degrees y)."""
        by_x = derivative(self.degree[0] + 1) * (2 / self.sheet.width)
        by_y = derivative(self.degree[1] + 1).T * (2 / self.sheet.length)
        x, y = by_x @ self.polynomials, self.polynomials @ by_y
        return np.stack([x, y, by_x @ x, y @ by_y, x @ by_y], 1)

    def lift_off(self, sign: float = 1.0) -> float:
        """The beta of that sign at which the pressure vanishes at some point and time, 1/length.

        Infinite where it never does. Sought on a grid of points, with edges, and of phases, which is
        refined about the worst one.
        """
        sign, times = math.copysign(1.0, sign), self._phases()
        step = float(times[1] - times[0])
        heights = self._highest(sign, times)
        largest = float(heights.max())
        for _ in range(0 if isinstance(self.cases, Harmonics) else REFINED):
            step /= 4
            times = (times[heights.argmax()] + step * np.arange(-3, 4)) % self.drive.period
            heights = self._highest(sign, times)
            largest = max(largest, float(heights.max()))
        return math.copysign(1 / (self.pressing * largest) if largest > 0 else math.inf, sign)

    def _highest(self, sign: float, times: Array) -> Array:
        """The largest of w or -w on the sheet at each time, (times,)."""
        x, y = (s * np.linspace(-0.5, 0.5, POINTS) for s in (self.sheet.width, self.sheet.length))
        field = self.at(times)
        w = np.tensordot(field.cases.amplitudes(times).T, field.deflections(x[:, None], y), 1)
        return np.asarray((sign * w).max((1, 2)))

    def distance(self, other: "PlateField") -> float:
        """Relative L2 distance to a field of lower degrees, at the worst phase."""
        change = self.polynomials.copy()
        change[:, : other.degree[0] + 1, : other.degree[1] + 1] -= other.polynomials
        samples = self.cases.samples()
        size, norms = mixed_norms(self.polynomials, samples), mixed_norms(change, samples)
        largest = size.max(initial=0.0)
        return float(norms.max(initial=0.0) / largest) if largest else 0.0

    def _phases(self) -> Array:
        if isinstance(self.cases, Harmonics):
            return np.linspace(0, self.drive.period, 8 * len(self.cases.series.orders) + 56, False)
        return self.cases.times

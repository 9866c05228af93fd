"""The planar Koiter sheet to second order in the growth coupling: u = alpha u_1 + alpha^2 u_2.

With the Green strain E = e(u) + grad(u)^T grad(u)/2, the growth strain (g - 1) I/2 of the rest metric
g I and the elasticity C of plane stress, the energy of stretching (eq. 1a) is

    1/2 int w (E - (g - 1) I/2) : C : (E - (g - 1) I/2) dA,    w = g^-1 or g^-2,

w = g^-2 from the inverse rest metric in C, times g where energy is counted per grown area. With
(g - 1)/2 = alpha c + alpha^2 k c^2 + ... and w = 1 + alpha m c + ..., equilibrium at order alpha is the
linear theory, int s_1 : grad(v) = 0 with s_1 = C : (e(u_1) - c I), and at order alpha^2

    int (C : e(u_2)) : grad(v) = int P : grad(v),
    P = C : (k c^2 I - grad(u_1)^T grad(u_1)/2) - m c s_1 - grad(u_1) s_1.

u_2 solves the linear problem with another source, quadratic in u_1 and c: a wave with harmonics 1 ... K
in time makes one with 0 ... 2K, each of which is solved for apart.
"""

import time
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory import hooke, validation
from linear_theory.errors import NotConvergedError
from linear_theory.field import LinearField, Wave, combine
from linear_theory.load_cases import mixed_norms
from linear_theory.motion import CellGrid, Motion
from linear_theory.ritz import error as ritz_error
from linear_theory.ritz import legendre
from linear_theory.ritz.field import MOST_NUMBERS, RitzField
from linear_theory.ritz.solver import RitzSolver, matrix_size
from linear_theory.sheet import Sheet
from linear_theory.waves import TravellingWave

Array = NDArray[np.float64]

GROWTH_LAWS = {"exp": 1.0, "linear": 0.5, "metric": 0.0}
"""k by law: g = exp(2 alpha c), (1 + alpha c)^2, 1 + 2 alpha c."""

AREAS = {"grown": -2.0, "undeformed": -4.0}
"""m by the area in which the energy is counted: sqrt(det abar) or that of the undeformed sheet."""

SAMPLES = 16
"""Phases at which the error of u_2 is estimated, per period of its highest harmonic."""

EXTRA_POINTS = 6
"""Gauss points beyond those that polynomials need: c^2 and c s_1 are sines of y."""


def second_order_field(
    sheet: Sheet, wave: Wave, growth_law: str = "exp", area: str = "grown", rtol: float = 1e-4
) -> "SecondOrderField":
    """Deformation to second order, with polynomials of degrees chosen for rtol.

    rtol: bounds the estimated relative L2 errors of u_1 and u_2 over the sheet at their worst phases.
    growth_law: "exp", "linear", "metric"; area: "grown", "undeformed"; see the module's head.
    Raises ValueError for bad input, and NotConvergedError, with the best field, where rtol needs a
    degree that does not fit in memory.
    """
    start, rtol = time.perf_counter(), validation.tolerance(rtol)
    if not isinstance(wave, TravellingWave):
        raise ValueError(f"wave = {wave!r}: must be a TravellingWave at second order")
    # u_2 has waves half as long
    degree = ritz_error.first_degrees(sheet, 2 * int(wave.orders[-1]), rtol)
    best = None
    while True:
        if matrix_size(degree) > MOST_NUMBERS:
            raise NotConvergedError(f"rtol = {rtol:g}: would need degrees {degree} or more", best)
        best = SecondOrderField(RitzField(wave, RitzSolver(sheet, degree)), growth_law, area)
        tails = np.maximum(best.first.tails, best.second_tails)
        if np.hypot(*tails) <= rtol:
            best.seconds = time.perf_counter() - start
            return best
        degree = ritz_error.raised_degrees(degree, (float(tails[0]), float(tails[1])), rtol)


class SecondOrderField(LinearField):
    """u_1 as a linear field, and u_2, the same elastic problem with the source of the module's head.

    What a LinearField offers is of first order, per unit alpha. first: u_1, whose wave does not depend
    on x. Raises ValueError for other waves and unknown names.
    """

    wave: TravellingWave

    def __init__(self, first: RitzField, growth_law: str = "exp", area: str = "grown") -> None:
        start = time.perf_counter()
        if not isinstance(first.wave, TravellingWave):
            raise ValueError(f"wave = {first.wave!r}: must be a TravellingWave at second order")
        validation.choice("growth_law", growth_law, GROWTH_LAWS)
        validation.choice("area", area, AREAS)
        self.first, self.sheet, self.wave, self.mirrored = first, first.sheet, first.wave, True
        self._square, self._weight = GROWTH_LAWS[growth_law], AREAS[area]
        self._solution = first.solver.solve_stress(self._in_time(self._sources()))
        self._kept_second: tuple[object, Array] | None = None
        self.seconds = first.seconds + time.perf_counter() - start

    @property
    def error(self) -> float:
        """Estimated relative L2 error of u_1 over the sheet at the worst phase."""
        return self.first.error

    @property
    def second_error(self) -> float:
        """Estimated relative L2 error of u_2, of its part that depends on time, likewise."""
        return float(np.hypot(*self.second_tails)) + ritz_error.ROUNDOFF

    @cached_property
    def second_tails(self) -> tuple[float, float]:
        """The parts of `second_error` that higher degrees across and along would take away."""
        order = 2 * int(self.wave.orders[-1])
        resolving = ritz_error.resolving_degrees(self.sheet, order)
        nothing = np.zeros((len(self._solution), 0))
        tails = ritz_error.relative_tails(
            self._polynomials,
            (nothing, nothing),
            self._rates(self._phases),
            resolving,
            self.sheet.poisson,
        )
        return float(tails[0].max(initial=0.0)), float(tails[1].max(initial=0.0))

    @cached_property
    def second_speed(self) -> float:
        """Root mean square of du_2/dt over the sheet at the worst phase, length per time."""
        return float(mixed_norms(self._polynomials, self._rates(self._phases)).max() / 2)

    def second_displacement(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """u_2, (2, ...), length. Raises ValueError for points outside the sheet."""
        x, y, t = self._checked(x, y, t)
        return combine(self._factors(t), self._seconds_at(x, y))

    def second_velocity(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """du_2/dt in the frame of the mean motion, (2, ...), length per time."""
        x, y, t = self._checked(x, y, t)
        return combine(self._rates(t), self._seconds_at(x, y))

    def motion(self, times: ArrayLike, grid: CellGrid, order: int) -> Motion:
        """As `LinearField.motion`, with `second` du_2/dt."""
        t = validation.real_array("times", times)
        if self._kept_second is None or self._kept_second[0] != (grid, order):
            x, y, _ = grid.points(order)
            self._kept_second = (grid, order), self._seconds_at(x, y)
        second = np.tensordot(self._rates(t).T, self._kept_second[1], 1)
        return replace(super().motion(t, grid, order), second=np.moveaxis(second, 1, 0))

    @property
    def _harmonics(self) -> NDArray[np.int64]:
        """Harmonics of u_2 in time that depend on it; even ones only if c(t + T/2) = -c(t)."""
        wave = self.wave
        step = 2 if wave.is_half_period_antisymmetric else 1
        return np.arange(step, 2 * int(wave.harmonics[-1]) + 1, step)

    @property
    def _phases(self) -> Array:
        count = SAMPLES * int(self._harmonics[-1])
        return np.linspace(0, self.wave.period, count, endpoint=False)

    def _factors(self, t: Array) -> Array:
        """Of u_2: 1, cosines, sines, (basis, *t.shape)."""
        angle = np.multiply.outer(2 * np.pi / self.wave.period * self._harmonics, t)
        return np.concatenate([np.ones((1, *t.shape)), np.cos(angle), np.sin(angle)])

    def _rates(self, t: Array) -> Array:
        """Time derivatives of `_factors`."""
        frequency = 2 * np.pi / self.wave.period * self._harmonics
        angle = np.multiply.outer(frequency, t)
        frequency = frequency.reshape(-1, *(1,) * t.ndim)
        parts = [np.zeros((1, *t.shape)), -frequency * np.sin(angle), frequency * np.cos(angle)]
        return np.concatenate(parts)

    def _in_time(self, samples: Array) -> Array:
        """Fourier coefficients that go with `_factors` of samples at equidistant phases."""
        spectrum = np.fft.rfft(samples, axis=0) / len(samples)
        some = spectrum[self._harmonics]
        return np.concatenate([spectrum[:1].real, 2 * some.real, -2 * some.imag])

    def _sources(self) -> Array:
        """Moments of P at 4K + 1 phases, which tell harmonics up to 2K apart; as in `solve_stress`."""
        count = 4 * int(self.wave.harmonics[-1]) + 1
        times = np.linspace(0, self.wave.period, count, endpoint=False)
        points = [3 * degree // 2 + 2 + EXTRA_POINTS for degree in self.first.degree]
        (x, weight_x), (y, weight_y) = (legendre.gauss(n) for n in points)
        across, along = (
            legendre.orthonormal(degree + 1, at)
            for degree, at in zip(self.first.degree, (x, y), strict=True)
        )
        gradients = across @ self.first.gradient_polynomials @ along.T
        growth = self.wave.value(0.0, y * self.sheet.length / 2, times[:, None], self.sheet.length)
        amplitudes = self.first._amplitudes(times)
        sources = [
            self._source(np.tensordot(a, gradients, 1), np.broadcast_to(c, gradients.shape[-2:]))
            for a, c in zip(amplitudes.T, growth, strict=True)
        ]
        moments = (across * weight_x[:, None]).T @ np.stack(sources) @ (along * weight_y[:, None])
        return np.asarray(moments)

    def _source(self, slope: Array, growth: Array) -> Array:
        """P_kj from du_k/dx_j (2, 2, ...) and c (...) of first order."""
        poisson = self.sheet.poisson
        strain = np.stack([slope[0, 0], slope[1, 1], (slope[0, 1] + slope[1, 0]) / 2])
        stress = _matrix(hooke.stress(strain, growth, poisson))
        square = np.einsum("kiab,kjab->ijab", slope, slope) / 2
        square = np.stack([square[0, 0], square[1, 1], square[0, 1]])
        resting = -_matrix(hooke.stress(square, self._square * growth**2, poisson))
        turned = np.einsum("kiab,ijab->kjab", slope, stress)
        return np.asarray(resting - self._weight * growth * stress - turned)

    @cached_property
    def _polynomials(self) -> Array:
        """u_2 in orthonormal Legendre polynomials, (basis, 2, degree x + 1, degree y + 1)."""
        return legendre.values(legendre.values(self._solution, 2), 3)

    def _seconds_at(self, x: Array, y: Array) -> Array:
        """u_2 of each factor of time, (basis, 2, *broadcast(x, y).shape)."""
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


def _matrix(tensor: Array) -> Array:
    """(2, 2, ...) from (xx, yy, xy)."""
    xx, yy, xy = tensor
    return np.stack([np.stack([xx, xy]), np.stack([xy, yy])])

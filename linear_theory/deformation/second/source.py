"""The source of the second-order displacement u_2: a stress P quadratic in u_1 and c.

    P(z) = C : (k c^2 I - grad(u_1)^T grad(u_1)/2) - m c s_1 - grad(u_1) s_1,    z = (grad(u_1), c),

with s_1 = C : (e(u_1) - c I), k from the growth law and m from the area measure: see `second_field`.
As P is quadratic, a central difference with any step h gives its rate exactly:

    dP/dt = [P(z + h dz/dt) - P(z - h dz/dt)]/(2 h).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.ritz import legendre
from linear_theory.sheet import hooke
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

EXTRA_POINTS = 6
"""Gauss points beyond those for polynomials, since c^2 and c s_1 are sines in y."""

TIMES_AT_ONCE = 16
"""Times whose fields are found in one product; few enough for the cache."""


@dataclass(frozen=True, eq=False)
class Source:
    """The stress P of a sheet under a wave, from the gradients of u_1.

    gradients: (cases, k, j, degree x + 1, degree y + 1), du_k/dx_j of the load cases in orthonormal
    Legendre polynomials; square, weight: k and m; finer: whether to use 1.5 times as many points.
    """

    drive: Drive
    gradients: Array
    square: float
    weight: float
    finer: bool = False

    def moments(self, times: Array, amplitudes: Array) -> Array:
        """Integrals of P_kj p_i p_j over [-1, 1]^2 at times (T,), (T, 2, 2, degrees x, degrees y).

        amplitudes: of the load cases, (cases, T).
        """
        grid = self._grid()
        growths = grid.growth(self.drive.value, times)
        slopes = grid.values(self.gradients)
        stresses = [
            self._stress(slope, c)
            for slope, c in zip(at_each_time(amplitudes, slopes), growths, strict=True)
        ]
        return grid.moments(np.stack(stresses))

    def moment_rates(self, times: Array, amplitudes: Array, rates: Array) -> Array:
        """Time derivatives of `moments`; rates: of the amplitudes."""
        grid = self._grid()
        step = self.drive.period / (2 * np.pi)  # makes both terms of z + h dz/dt of equal size
        growths = grid.growth(self.drive.value, times)
        changes = step * grid.growth(self.drive.rate, times)
        slopes = grid.values(self.gradients)
        ahead, behind = (
            np.stack(
                [
                    self._stress(slope, c)
                    for slope, c in zip(
                        at_each_time(amplitudes + sign * step * rates, slopes),
                        growths + sign * changes,
                        strict=True,
                    )
                ]
            )
            for sign in (1, -1)
        )
        return grid.moments((ahead - behind) / (2 * step))

    def _stress(self, slope: Array, growth: Array) -> Array:
        """The stress P_kj for gradients du_k/dx_j (2, 2, ...) and growth c (...)."""
        poisson = self.drive.sheet.poisson
        strain = np.stack([slope[0, 0], slope[1, 1], (slope[0, 1] + slope[1, 0]) / 2])
        stress = _matrix(hooke.stress(strain, growth, poisson))
        square = np.einsum("kiab,kjab->ijab", slope, slope) / 2
        square = np.stack([square[0, 0], square[1, 1], square[0, 1]])
        resting = -_matrix(hooke.stress(square, self.square * growth**2, poisson))
        turned = np.einsum("kiab,ijab->kjab", slope, stress)
        return np.asarray(resting - self.weight * growth * stress - turned)

    def _grid(self) -> "GaussGrid":
        across, along = self.gradients.shape[-2:]
        return GaussGrid(self.drive.sheet, (across - 1, along - 1), 1.5 if self.finer else 1.0)


class GaussGrid:
    """Gauss points for products of three polynomials of these degrees (across, along), times `more`."""

    def __init__(self, sheet: Sheet, degree: tuple[int, int], more: float) -> None:
        self.sheet = sheet
        counts = [int(more * (3 * d // 2 + 2 + EXTRA_POINTS)) for d in degree]
        (self.x, self._weight_x), (self.y, self._weight_y) = (gauss_legendre(n) for n in counts)
        self._across, self._along = (
            legendre.orthonormal(d + 1, at) for d, at in zip(degree, (self.x, self.y), strict=True)
        )

    def growth(self, function: Callable[..., Array], times: Array) -> Array:
        """c or its rate, (T, points x, points y)."""
        x, y = self.x[:, None] * self.sheet.width / 2, self.y * self.sheet.length / 2
        return function(x, y, times[:, None, None])

    def values(self, coefficients: Array) -> Array:
        """Values of polynomials (..., degree x + 1, degree y + 1) at the points."""
        return np.asarray(self._across @ coefficients @ self._along.T)

    def moments(self, values: Array) -> Array:
        """Integrals of values at the points times p_i(x) p_j(y)."""
        across, along = self._weighted
        return np.asarray(across.T @ values @ along)

    def weighted(self, coefficients: Array) -> Array:
        """Values of polynomials times the weights of the points: the transpose of `moments`."""
        across, along = self._weighted
        nx, ny = coefficients.shape[-2:]
        return np.asarray(across[:, :nx] @ coefficients @ along[:, :ny].T)

    @property
    def _weighted(self) -> tuple[Array, Array]:
        return self._across * self._weight_x[:, None], self._along * self._weight_y[:, None]


def at_each_time(amplitudes: Array, fields: Array) -> Iterator[Array]:
    """Fields of load cases (cases, ...) with amplitudes (cases, T), time by time.

    One product for several times reads the fields once for all of them.
    """
    flat = fields.reshape(len(fields), -1)
    for start in range(0, amplitudes.shape[1], TIMES_AT_ONCE):
        for values in amplitudes[:, start : start + TIMES_AT_ONCE].T @ flat:
            yield values.reshape(fields.shape[1:])


def _matrix(tensor: Array) -> Array:
    """The matrix (2, 2, ...) of a symmetric tensor (xx, yy, xy)."""
    xx, yy, xy = tensor
    return np.stack([np.stack([xx, xy]), np.stack([xy, yy])])

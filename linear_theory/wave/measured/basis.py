"""Functions that a measured wave is fitted by: harmonics in time times Legendre polynomials in space.

    c = sum over k, i, j of a_kij f_k(2 pi t/T) p_i(x) p_j(y),   f = 1, cos, sin, cos 2, sin 2, ...

The polynomials are those of the box of the samples, of mean square 1 over it.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.shown import Value
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]
Range = tuple[float, float]


@dataclass(frozen=True)
class Basis(Value):
    """harmonics in time, degree (across, along) of polynomials over the ranges of x and y."""

    period: float
    harmonics: int
    degree: tuple[int, int]
    across: Range
    along: Range

    @classmethod
    def over(cls, samples: Samples, period: float, harmonics: int, degree: tuple[int, int]) -> "Basis":
        """On the box that the samples fill."""
        across = (-1.0, 1.0) if samples.x is None else _range(samples.x)
        return cls(period, harmonics, degree, across, _range(samples.y))

    def but(self, harmonics: int, degree: tuple[int, int]) -> "Basis":
        """The same with other numbers of functions."""
        return replace(self, harmonics=harmonics, degree=degree)

    def lasting(self, period: float) -> "Basis":
        """The same with another period."""
        return replace(self, period=period)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Functions of time, of x and of y."""
        return 2 * self.harmonics + 1, self.degree[0] + 1, self.degree[1] + 1

    @property
    def size(self) -> int:
        """Functions in all."""
        return int(np.prod(self.shape))

    def times(self, t: ArrayLike) -> Array:
        """Factors of time, (*t.shape, 2 harmonics + 1)."""
        return _harmonics(self._angle(t), self.harmonics)

    def time_rates(self, t: ArrayLike) -> Array:
        """Their time derivatives."""
        angle, rates = self._angle(t), np.zeros((*np.shape(t), 2 * self.harmonics + 1))
        for k in range(1, self.harmonics + 1):
            rates[..., 2 * k - 1] = -k * np.sin(k * angle)
            rates[..., 2 * k] = k * np.cos(k * angle)
        return 2 * np.pi / self.period * rates

    def polynomials(self, x: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
        """Factors of x (*x.shape, degree + 1) and of y, likewise."""
        return _legendre(x, self.across, self.degree[0]), _legendre(y, self.along, self.degree[1])

    def factors(self, samples: Samples) -> tuple[Array, Array, Array]:
        """Of time, x and y at samples, (n, functions) each."""
        x = np.zeros(samples.size) if samples.x is None else samples.x
        return self.times(samples.t), *self.polynomials(x, samples.y)

    def columns(self, samples: Samples) -> Array:
        """All functions at samples, (n, size), in the order of `shape`."""
        return np.einsum("nk,ni,nj->nkij", *self.factors(samples)).reshape(samples.size, -1)

    def embed(self, coefficients: Array, larger: "Basis") -> Array:
        """Coefficients (*shape) as those of a basis with more functions."""
        found = np.zeros(larger.shape)
        found[tuple(slice(n) for n in self.shape)] = coefficients
        return found

    def _angle(self, t: ArrayLike) -> Array:
        return np.asarray(2 * np.pi / self.period * np.asarray(t, float))


def _range(values: Array) -> Range:
    return float(values.min()), float(values.max())


def _legendre(values: ArrayLike, within: Range, degree: int) -> Array:
    """Orthonormal Legendre polynomials on a range, (*values.shape, degree + 1), by their recursion."""
    low, high = within
    local = (2 * np.asarray(values, float) - low - high) / (high - low)
    found = np.ones((degree + 1, *local.shape))
    if degree > 0:
        found[1] = local
    for k in range(2, degree + 1):
        found[k] = ((2 * k - 1) * local * found[k - 1] - (k - 1) * found[k - 2]) / k
    return np.asarray(np.moveaxis(found, 0, -1) * np.sqrt(2 * np.arange(degree + 1) + 1))


def _harmonics(angle: Array, count: int) -> Array:
    found = np.ones((*angle.shape, 2 * count + 1))
    for k in range(1, count + 1):
        found[..., 2 * k - 1], found[..., 2 * k] = np.cos(k * angle), np.sin(k * angle)
    return found

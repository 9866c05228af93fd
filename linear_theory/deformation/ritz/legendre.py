"""Polynomials on [-1, 1] for the Ritz method: integrated Legendre polynomials.

With p_d the orthonormal Legendre polynomials, the basis is phi_0 = p_0 and phi_d = integral of
p_{d-1}, that is

    phi_d = s_d p_d - s_{d-1} p_{d-2},   s_d = 1/sqrt((2d - 1)(2d + 1)),  s_0 = 1,  p_{-1} = 0.

Its slopes p_{d-1} are orthonormal and its values couple next neighbours only, so that products of
two of them make a banded, well-conditioned matrix, where the p_d themselves would fill it. A family
holds the `count` polynomials of one parity, degrees parity, parity + 2, .... A 1D matrix is kept as
its non-zero diagonals {offset: entries}, entries[k] = A[k, k + offset], zero where that is outside.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Diagonals = dict[int, Array]


@lru_cache(maxsize=64)
def _scales(count: int) -> Array:
    """s_0 ... s_{count-1}."""
    d = np.arange(1, count)
    return _frozen(np.concatenate([[1.0], 1 / np.sqrt((2 * d - 1) * (2 * d + 1))]))


@lru_cache(maxsize=64)
def mass(count: int, parity: int) -> Diagonals:
    """Integrals of phi_d phi_e within a family."""
    d = np.arange(count) * 2 + parity
    s = _scales(2 * count + 2)
    main = s[d] ** 2 + np.where(d >= 2, s[d - 1] ** 2, 0.0)
    upper = -s[d] * s[d + 1]
    upper[-1] = 0
    return {0: main, 1: upper, -1: np.roll(upper, 1)}


@lru_cache(maxsize=64)
def stiffness(count: int, parity: int) -> Diagonals:
    """Integrals of phi_d' phi_e' within a family: one, but for the constant."""
    return {0: np.where(np.arange(count) * 2 + parity > 0, 1.0, 0.0)}


@lru_cache(maxsize=64)
def mixed(count: int, parity: int) -> Diagonals:
    """Integrals of phi_d' phi_e, d in the family of that parity (rows), e in the other one."""
    d = np.arange(count) * 2 + parity
    s = _scales(2 * count + 2)
    before = np.where(d >= 1, s[d - 1], 0.0)
    after = np.where(d >= 1, -s[d], 0.0)
    if parity == 0:
        return {-1: before, 0: after}
    after[-1] = 0
    return {0: before, 1: after}


def transposed(diagonals: Diagonals) -> Diagonals:
    """The transpose of a matrix kept as diagonals."""
    return {-offset: np.roll(entries, offset) for offset, entries in diagonals.items()}


def against_values(moments: Array, axis: int) -> Array:
    """Integrals against phi_d from those against p_d (degrees 0, 1, ... along `axis`)."""
    m = np.moveaxis(moments, axis, -1)
    s = _scales(m.shape[-1] + 1)
    out = m * s[:-1]
    out[..., 2:] -= s[1:-2] * m[..., :-2]
    return np.moveaxis(out, -1, axis)


def against_slopes(moments: Array, axis: int) -> Array:
    """Integrals against phi_d' from those against p_d (degrees 0, 1, ... along `axis`)."""
    m = np.moveaxis(moments, axis, -1)
    out = np.zeros_like(m)
    out[..., 1:] = m[..., :-1]
    return np.moveaxis(out, -1, axis)


def values(coefficients: Array, axis: int) -> Array:
    """Coefficients with respect to p_d of sum_d coefficients[d] phi_d."""
    c = np.moveaxis(coefficients, axis, -1)
    s = _scales(c.shape[-1] + 1)
    out = c * s[:-1]
    out[..., :-2] -= s[1:-2] * c[..., 2:]
    return np.moveaxis(out, -1, axis)


def slopes(coefficients: Array, axis: int) -> Array:
    """Coefficients with respect to p_d of sum_d coefficients[d] phi_d'."""
    c = np.moveaxis(coefficients, axis, -1)
    out = np.zeros_like(c)
    out[..., :-1] = c[..., 1:]
    return np.moveaxis(out, -1, axis)


def wave_moments(count: int, orders: NDArray[np.int64]) -> tuple[Array, Array]:
    """Integrals of cos(pi r y) and sin(pi r y) against p_0 ... p_{count-1}, each (orders, count).

    From the expansion of a plane wave in spherical Bessel functions: exact for every degree and
    order, where a quadrature would have to follow both.
    """
    from scipy.special import spherical_jn  # here: scipy takes long to import

    d = np.arange(count)
    bessel = spherical_jn(d, np.pi * orders[:, None])
    size = np.sqrt(4 * d + 2) * np.where(d // 2 % 2, -1.0, 1.0)
    return size * bessel * (d % 2 == 0), size * bessel * (d % 2)


def orthonormal(count: int, at: Array) -> Array:
    """p_0 ... p_{count-1} at points of [-1, 1], (*at.shape, count)."""
    table = np.polynomial.legendre.legvander(at, count - 1)
    return np.asarray(table * np.sqrt(np.arange(count) + 0.5))


def evaluate(coefficients: Array, x: Array, y: Array) -> Array:
    """Sums of p_i(x) p_j(y) at points of [-1, 1]^2 that broadcast.

    coefficients: (a, b, degrees x, degrees y); returns (a, b, *broadcast(x, y).shape), contiguous.
    Points that form a grid, in whatever order, cost a product of matrices.
    """
    nx, ny = coefficients.shape[2:]
    (xs, column), (ys, row) = (np.unique(v, return_inverse=True) for v in (x, y))
    if xs.size * ys.size <= 4 * np.broadcast(x, y).size:
        grid = orthonormal(nx, xs) @ coefficients @ orthonormal(ny, ys).T
        return np.ascontiguousarray(grid[..., column.reshape(x.shape), row.reshape(y.shape)])
    across = np.tensordot(coefficients, orthonormal(nx, xs), (2, 1))  # (a, b, degrees y, xs)
    along = np.moveaxis(orthonormal(ny, y), -1, 0)
    return np.asarray(np.einsum("abj...,j...->ab...", across[..., column.reshape(x.shape)], along))


def _frozen(array: Array) -> Array:
    array.setflags(write=False)
    return array

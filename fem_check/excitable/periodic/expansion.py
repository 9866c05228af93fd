"""A periodic orbit as a smooth wave: harmonics in time, and polynomials on a line or rectangle."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.periodic.nodal import NodalWave
from fem_check.excitable.periodic.orbit import Orbit
from fem_check.excitable.space import Space
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.polynomial import PolynomialWave

Array = NDArray[np.float64]

SAMPLES = 256
"""Times of the period; up to half as many harmonics are kept."""

DEGREES, PER_CELL = 60, 1.5
"""Degree of the polynomials along each side, at most and per element."""

DROPPED = 0.02
"""Of the tolerance of c: coefficients that add up to less are left out at the end of the series."""


class Resolution(NamedTuple):
    """Harmonics in time, degrees of polynomials across and along."""

    harmonics: int
    across: int
    along: int


def smooth_wave(
    orbit: Orbit, rtol: float, resolution: Resolution | None = None
) -> tuple[PolynomialWave | NodalWave, Resolution]:
    """The wave of an orbit, and its resolution; by default as much as it needs for rtol."""
    space, body = orbit.system.space, orbit.system.body
    c = orbit.states(SAMPLES)[:, : space.size]
    harmonics = _harmonics(c, orbit)
    if not isinstance(body, Sheet):
        count = resolution.harmonics if resolution else _needed(harmonics, rtol)
        kept = harmonics[: 2 * count + 1]
        basis = Basis(orbit.period, count, (0, 0), (-1.0, 1.0), (-1.0, 1.0))
        return NodalWave(space, basis, kept), Resolution(count, 0, 0)
    full = _projected(harmonics, space, body)
    if resolution is None:
        resolution = Resolution(_needed(full, rtol), *(_last(full, axis, rtol) for axis in (1, 2)))
    return _polynomial(orbit, full, resolution), resolution


def _polynomial(orbit: Orbit, full: Array, resolution: Resolution) -> PolynomialWave:
    """The series cut, or filled up with zeros, to a resolution."""
    body = orbit.system.body
    shape = 2 * resolution.harmonics + 1, resolution.across + 1, resolution.along + 1
    kept = np.zeros(shape)
    common = tuple(slice(min(pair)) for pair in zip(shape, full.shape, strict=True))
    kept[common] = full[common]
    sides = ((-size / 2, size / 2) for size in (body.width, body.length))
    basis = Basis(orbit.period, resolution.harmonics, (resolution.across, resolution.along), *sides)
    slack = (1e-9 * body.width, 1e-9 * body.length)
    return PolynomialWave(basis, kept, slack)


def _harmonics(c: Array, orbit: Orbit) -> Array:
    """Coefficients of 1, cos, sin, cos 2, ... at the nodes, (SAMPLES - 1, n), for t = 0 at time 0."""
    terms = np.fft.rfft(c, axis=0)[: len(c) // 2] / len(c)
    orders = np.arange(len(terms))[:, None]
    terms = terms * np.exp(-2j * np.pi * orders * orbit.start / orbit.period)
    found = np.empty((2 * len(terms) - 1, c.shape[1]))
    found[0], found[1::2], found[2::2] = terms[0].real, 2 * terms[1:].real, -2 * terms[1:].imag
    return found


def _needed(coefficients: Array, rtol: float) -> int:
    """The last harmonic that is not faint, 1 at least; axis 0: 1, cos, sin, ..."""
    return max(1, (_last(coefficients, 0, rtol) + 1) // 2)


def _last(coefficients: Array, axis: int, rtol: float) -> int:
    """The last index along an axis of a coefficient that is not faint."""
    others = tuple(i for i in range(coefficients.ndim) if i != axis)
    size = np.sqrt((coefficients**2).sum(axis=others))
    above = np.flatnonzero(
        np.sqrt(np.cumsum(size[::-1] ** 2))[::-1] > DROPPED * rtol * np.hypot.reduce(size)
    )
    return int(above[-1]) if above.size else 0


def _projected(harmonics: Array, space: Space, body: Sheet) -> Array:
    """Coefficients of Legendre polynomials of mean square 1, (harmonics, across + 1, along + 1)."""
    lines = space.mesh.p.shape[0] == 1
    x, across = (np.zeros(1), np.ones((1, 1))) if lines else _rule(body.width, space, 0)
    y, along = _rule(body.length, space, -1)
    nodes, shares = space.weights(x[:, None], y[None])
    values = np.einsum("nij,knij->kij", shares, harmonics[:, nodes])
    return np.einsum("kij,ia,jb->kab", values, across, along)


def _rule(size: float, space: Space, axis: int) -> tuple[Array, Array]:
    """Gauss points of a side, and their weights for each polynomial, (points, degree + 1)."""
    cells = np.unique(np.round(space.mesh.p[axis], 12)).size - 1
    degree = max(1, min(DEGREES, int(PER_CELL * cells)))
    nodes, weights = gauss_legendre(2 * degree)
    polynomials = np.polynomial.legendre.legvander(nodes, degree)
    scaled = polynomials * np.sqrt(2 * np.arange(degree + 1) + 1)
    return size / 2 * nodes, weights[:, None] / 2 * scaled

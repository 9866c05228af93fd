"""Displacement and stress of the terms of the Airy series (eq. 15, appendix A.1), Young modulus 1.

A term of wave number k with barred amplitude a is, with s the coordinate along its trigonometric and
n along its hyperbolic direction, and H the half-length of the sheet in direction n,

    chi = a f(ks)/k^2 (p1 - p0),           f = cos or sin, its sign taken out,
    p0 = cosh(kn)/cosh(kH),                s0 = sinh(kn)/cosh(kH),
    p1 = [kn sinh(kn) - kH coth(kH) cosh(kn)]/cosh(kH),
    q1 = [kn cosh(kn) - kH coth(kH) sinh(kn)]/cosh(kH),

or with cosh <-> sinh and coth -> tanh in the other family (parity -1). With F = -f',

    sigma_nn = a f (p0 - p1),  sigma_ss = a f (p0 + p1),  sigma_sn = a F q1,
    u_s = a F/k [(1 - nu) p0 + (1 + nu) p1],   u_n = a f/k [2 s0 - (1 + nu) q1].

Everything is written with decaying exponentials exp(-k(H -+ n)), so that nothing overflows and the
difference of the two large terms of p1 is never formed.

Beyond the last term the barred amplitudes follow the law a = tail K/number, and the remaining terms
are summed in closed form: with Z = exp(-k_1 [(H - n) + i(S - s)]), S the half-length along s, they
are polylogarithms Li_p(Z) (for odd numbers, their odd parts) less the terms already taken.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import spence

from linear_theory.deformation.airy.system import Family, Pair
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_TINY = 1e-300  # stands for distance 0 at a corner, where the logarithms of two families cancel


class _Profiles(NamedTuple):
    """p0, s0, p1, q1 of every term, each (terms, points n)."""

    p0: Array
    s0: Array
    p1: Array
    q1: Array


@dataclass(frozen=True)
class Terms:
    """One family with its amplitudes, ready to be evaluated.

    side: S, half-length along s; amplitudes: (count, cases), barred; constant: (cases,), K.
    Points in the quarter s, n >= 0: s (Ps,) and n (Pn,), results (cases, Ps, Pn) on their grid, or,
    where `grid` is False, s and n of one shape (P,) and results (cases, P).
    """

    family: Family
    side: float
    amplitudes: Array
    constant: Array

    def displacement(self, s: Array, n: Array, poisson: float, grid: bool) -> tuple[Array, Array]:
        """u_s and u_n."""
        k = self.family.wavenumbers[:, None]

        def along(p: _Profiles) -> Array:
            return np.asarray(((1 - poisson) * p.p0 + (1 + poisson) * p.p1) / k)

        def across(p: _Profiles) -> Array:
            return np.asarray((2 * p.s0 - (1 + poisson) * p.q1) / k)

        cosine, sine = self._trigonometric(s)
        exact, law = self._profiles(n), self._law_profiles(n)
        u_s = self._sum(sine, along(exact), along(law), grid)
        u_n = self._sum(cosine, across(exact), across(law), grid)
        if np.any(self.constant):
            distance, z = self._tail_variable(s, n, grid)
            li1, li2 = self._polylogarithm(1, z), self._polylogarithm(2, z) / self.family.first
            u_s += self._scaled((1 - poisson) * li2.imag - (1 + poisson) * distance * li1.imag)
            u_n += self._scaled(2 * li2.real + (1 + poisson) * distance * li1.real)
        return u_s, u_n

    def stress(self, s: Array, n: Array, grid: bool) -> tuple[Array, Array, Array]:
        """sigma_ss, sigma_nn and sigma_sn."""
        cosine, sine = self._trigonometric(s)
        exact, law = self._profiles(n), self._law_profiles(n)
        plain = self._sum(cosine, exact.p0, law.p0, grid)
        growing = self._sum(cosine, exact.p1, law.p1, grid)
        shear = self._sum(sine, exact.q1, law.q1, grid)
        if np.any(self.constant):
            distance, z = self._tail_variable(s, n, grid)
            li0 = self._polylogarithm(0, z) * (self.family.first * distance)
            plain += self._scaled(self._polylogarithm(1, z).real)
            growing -= self._scaled(li0.real)
            shear -= self._scaled(li0.imag)
        return plain + growing, plain - growing, shear

    def mean_along(self, poisson: float) -> Array:
        """Mean of u_s over the sheet, (cases,): not 0 only where the numbers are odd."""
        if self.family.step == 1:
            return np.zeros(self.constant.size)
        k, numbers, half = self.family.wavenumbers, self.family.numbers, self.family.half
        kept = (np.tanh(k * half) / numbers**3) @ self.amplitudes
        rest = np.pi**4 / 96 - np.sum(numbers**-4)  # sum of 1/s^4 over the odd numbers left out
        total = kept + self.family.tail * self.constant * rest
        return np.asarray(2 * poisson / (self.family.first**3 * self.side * half) * total)

    def _trigonometric(self, s: Array) -> tuple[Array, Array]:
        """Barred f and F: sign f(ks) = cos k(S - s), sign F(ks) = -sin k(S - s)."""
        angle = np.multiply.outer(self.family.wavenumbers, self.side - s)
        return np.cos(angle), -np.sin(angle)

    def _profiles(self, n: Array) -> _Profiles:
        """p0, s0, p1, q1 at the points n."""
        k, half, parity = self.family.wavenumbers[:, None], self.family.half, self.family.parity
        inner, outer = half - n, half + n
        near, far = np.exp(-k * inner), parity * np.exp(-k * outer)
        decay = parity * np.exp(-2 * k * half)
        excess = 2 * half * decay / (1 - decay)  # H (coth kH - 1) or H (tanh kH - 1)
        scale = 1 / (1 + decay)
        p0, s0 = scale * (near + far), scale * (near - far)
        p1 = -k * (scale * (inner * near + outer * far) + excess * p0)
        q1 = -k * (scale * (inner * near - outer * far) + excess * s0)
        return _Profiles(p0, s0, p1, q1)

    def _law_profiles(self, n: Array) -> _Profiles:
        """The same where exp(-kH) is negligible, as it is in the tail: one exponential is left."""
        k, inner = self.family.wavenumbers[:, None], self.family.half - n
        near = np.exp(-k * inner)
        growing = -k * inner * near
        return _Profiles(near, near, growing, growing)

    def _sum(self, wave: Array, exact: Array, law: Array, grid: bool) -> Array:
        """Sum over the terms kept, less what the closed form of the tail law counts again."""
        profile = self.amplitudes.T[:, :, None] * exact
        if np.any(self.constant):
            weight = self.family.tail * self.constant[:, None] / self.family.numbers
            profile -= weight[:, :, None] * law
        if grid:
            return np.asarray(np.matmul(wave.T, profile))
        return np.einsum("tp,ctp->cp", wave, profile)

    def _scaled(self, function: Array) -> Array:
        return np.multiply.outer(self.family.tail * self.constant, function)

    def _tail_variable(self, s: Array, n: Array, grid: bool) -> tuple[Array, Complex]:
        """Distance H - n to the edge, and -log Z."""
        distance = np.maximum(self.family.half - n, _TINY)
        along = np.maximum(self.side - s, _TINY)
        if grid:
            along = along[:, None]
        return distance, self.family.first * (distance + 1j * along)

    def _polylogarithm(self, order: int, z: Complex) -> Complex:
        """Sum of Z^number/number^order over all numbers of the family, Z = exp(-z)."""
        power = np.exp(-z)
        every = self.family.step == 1
        if order == 0:
            return np.asarray(power / -np.expm1(-z if every else -2 * z))
        if order == 1:
            log = -np.log(-np.expm1(-z))
            return log if every else np.asarray((log + np.log1p(power)) / 2)
        dilog = spence(-np.expm1(-z))
        return np.asarray(dilog if every else (dilog - spence(1 + power)) / 2)


def pair_displacement(pair: Pair, sheet: Sheet, x: Array, y: Array, grid: bool) -> Array:
    """(cases, 2, *points): on the grid of x (Px,) and y (Py,), or at the points (x, y), each (P,).

    Points in the quarter x, y >= 0. The mean of u_y is removed.
    """
    along_x, along_y = _terms(pair, sheet)
    nu = sheet.poisson
    first_x, first_y = along_x.displacement(x, y, nu, grid)
    second_y, second_x = (_swapped(u, grid) for u in along_y.displacement(y, x, nu, grid))
    mean = along_y.mean_along(nu).reshape(-1, *(1,) * (first_y.ndim - 1))
    return np.stack([first_x + second_x, first_y + second_y - mean], axis=1)


def pair_stress(pair: Pair, sheet: Sheet, x: Array, y: Array, grid: bool) -> Array:
    """(cases, 3, *points), components (xx, yy, xy); points as in `pair_displacement`."""
    along_x, along_y = _terms(pair, sheet)
    xx, yy, xy = along_x.stress(x, y, grid)
    yy_2, xx_2, xy_2 = (_swapped(s, grid) for s in along_y.stress(y, x, grid))
    return np.stack([xx + xx_2, yy + yy_2, xy + xy_2], axis=1)


def _terms(pair: Pair, sheet: Sheet) -> tuple[Terms, Terms]:
    sides = sheet.width / 2, sheet.length / 2
    first, second = (
        Terms(family, side, amplitudes, pair.constant)
        for family, side, amplitudes in zip(pair.families, sides, pair.amplitudes, strict=True)
    )
    return first, second


def _swapped(values: Array, grid: bool) -> Array:
    return values.swapaxes(-1, -2) if grid else values

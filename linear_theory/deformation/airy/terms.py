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
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.dilogarithm import dilogarithm
from linear_theory.deformation.airy.family import Family
from linear_theory.deformation.airy.system import Solution

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_TINY = 1e-300  # stands for distance 0 at a corner, where the logarithms of two families cancel


class _Profiles(NamedTuple):
    """p0, s0, p1, q1 of every term, each (2, terms, points n)."""

    p0: Array
    s0: Array
    p1: Array
    q1: Array


@dataclass(frozen=True)
class Terms:
    """One family with its amplitudes, ready to be evaluated.

    amplitudes: (2, count, cases), barred; constant: (2, cases), K. Points in the quarter s, n >= 0:
    s (Ps,) and n (Pn,), results (2, cases, Ps, Pn) on their grid, or, where `grid` is False, s and n of
    one shape (P,) and results (2, cases, P).
    """

    family: Family
    amplitudes: Array
    constant: Array

    def displacement(self, s: Array, n: Array, poisson: float, grid: bool) -> tuple[Array, Array]:
        """u_s and u_n."""
        k = self.family.kept.wavenumbers[..., None]
        profiles, (cosine, sine) = self._profiles(n), self._trigonometric(s)
        along = [((1 - poisson) * p.p0 + (1 + poisson) * p.p1) / k for p in profiles]
        across = [(2 * p.s0 - (1 + poisson) * p.q1) / k for p in profiles]
        u_s, u_n = self._sum(sine, along, grid), self._sum(cosine, across, grid)
        if self.has_tail:
            distance, first, z = self._tail_variable(s, n, grid)
            li1, li2 = self._polylogarithm(1, z), self._polylogarithm(2, z) / first
            u_s += self._scaled((1 - poisson) * li2.imag - (1 + poisson) * distance * li1.imag)
            u_n += self._scaled(2 * li2.real + (1 + poisson) * distance * li1.real)
        return u_s, u_n

    def stress(self, s: Array, n: Array, grid: bool) -> tuple[Array, Array, Array]:
        """sigma_ss, sigma_nn and sigma_sn."""
        profiles, (cosine, sine) = self._profiles(n), self._trigonometric(s)
        plain = self._sum(cosine, [p.p0 for p in profiles], grid)
        growing = self._sum(cosine, [p.p1 for p in profiles], grid)
        shear = self._sum(sine, [p.q1 for p in profiles], grid)
        if self.has_tail:
            distance, first, z = self._tail_variable(s, n, grid)
            li0 = self._polylogarithm(0, z) * (first * distance)
            plain += self._scaled(self._polylogarithm(1, z).real)
            growing -= self._scaled(li0.real)
            shear -= self._scaled(li0.imag)
        return plain + growing, plain - growing, shear

    @cached_property
    def has_tail(self) -> bool:
        """Whether anything lies beyond the last term."""
        return bool(np.any(self.constant))

    def mean_of_odd(self, poisson: float) -> Array:
        """Mean of u_s over the sheet for growth odd in y, (cases,), of the family along y: the D-terms.

        All others have none.
        """
        family, numbers = self.family, self.family.kept.numbers[1]
        slope, first, tail = family.slope[1], family.first[1], family.tail[1]
        total = (slope / numbers**3) @ self.amplitudes[1]
        if self.has_tail:
            rest = np.pi**4 / 96 - np.sum(numbers**-4)  # sum of 1/s^4 over the odd numbers left out
            total += tail * self.constant[1] * rest
        return 2 * poisson / (first**3 * family.side / 2 * family.half) * total

    def _trigonometric(self, s: Array) -> tuple[Array, Array]:
        """Barred f and F: sign f(ks) = cos k(S - s), sign F(ks) = -sin k(S - s)."""
        angle = np.multiply.outer(self.family.kept.wavenumbers, self.family.side / 2 - s)
        return np.cos(angle), -np.sin(angle)

    def _profiles(self, n: Array) -> list[_Profiles]:
        """p0, s0, p1, q1 at the points n; where there is a tail, those of its law too."""
        return [self._exact_profiles(n), *([self._law_profiles(n)] if self.has_tail else [])]

    def _exact_profiles(self, n: Array) -> _Profiles:
        minus_k, parity = -self.family.kept.wavenumbers[..., None], self.family.parity[..., None]
        half = self.family.half
        inner, outer = half - n, half + n
        near, far = np.exp(minus_k * inner), parity * np.exp(minus_k * outer)
        growing_near, growing_far = inner * near, outer * far
        decay = parity * np.exp(2 * half * minus_k)
        excess = 2 * half * decay / (1 - decay)  # H (coth kH - 1) or H (tanh kH - 1)
        scale = 1 / (1 + decay)
        p0, s0 = scale * (near + far), scale * (near - far)
        p1 = minus_k * (scale * (growing_near + growing_far) + excess * p0)
        q1 = minus_k * (scale * (growing_near - growing_far) + excess * s0)
        return _Profiles(p0, s0, p1, q1)

    def _law_profiles(self, n: Array) -> _Profiles:
        """Where exp(-kH) is negligible, as it is in the tail: one exponential is left."""
        k, inner = self.family.kept.wavenumbers[..., None], self.family.half - n
        near = np.exp(-k * inner)
        growing = -k * inner * near
        return _Profiles(near, near, growing, growing)

    def _sum(self, wave: Array, profiles: list[Array], grid: bool) -> Array:
        """Sum over the terms kept, less what the closed form of the tail law counts again.

        profiles: one quantity made of `_profiles`, each (2, terms, points n).
        """
        exact, *laws = profiles
        terms = self.amplitudes.swapaxes(1, 2)[..., None] * exact[:, None]
        for law in laws:
            weight = (self.family.tail * self.constant)[..., None] / self.family.kept.numbers[:, None]
            terms -= weight[..., None] * law[:, None]
        if grid:
            return np.matmul(wave.swapaxes(1, 2)[:, None], terms)
        return np.einsum("atp,actp->acp", wave, terms)

    def _scaled(self, function: Array) -> Array:
        weight = self.family.tail * self.constant
        return weight.reshape(*weight.shape, *(1,) * (function.ndim - 1)) * function[:, None]

    def _tail_variable(self, s: Array, n: Array, grid: bool) -> tuple[Array, Array, Complex]:
        """Distance H - n to the edge, k_1 and -log Z."""
        distance = np.maximum(self.family.half - n, _TINY)
        along = np.maximum(self.family.side / 2 - s, _TINY)
        first = self.family.first
        if grid:
            along, first = along[:, None], first[..., None]
        return distance, first, first * (distance + 1j * along)

    def _polylogarithm(self, order: int, z: Complex) -> Complex:
        """Sum of Z^number/number^order over all numbers of the family, Z = exp(-z)."""
        every = self.family.step[:, 0] == 1
        return np.stack([_polylogarithm(order, *both) for both in zip(z, every, strict=True)])


def _polylogarithm(order: int, z: Complex, every: bool) -> Complex:
    """Sum of Z^number/number^order over all numbers or the odd ones, Z = exp(-z)."""
    power = np.exp(-z)
    if order == 0:
        return np.asarray(power / -np.expm1(-z if every else -2 * z))
    if order == 1:
        log = -np.log(-np.expm1(-z))
        return log if every else np.asarray((log + np.log1p(power)) / 2)
    dilog = dilogarithm(z, -np.expm1(-z))
    # of the odd numbers: half of Li_2(Z) - Li_2(-Z); there 0 < Im z <= pi/2
    return dilog if every else (dilog - dilogarithm(z - 1j * np.pi, 1 + power)) / 2


def displacement(solution: Solution, poisson: float, x: Array, y: Array, grid: bool) -> Array:
    """(2, cases, 2, *points): on the grid of x (Px,) and y (Py,), or at the points (x, y), each (P,).

    Points in the quarter x, y >= 0. The mean of u_y is removed.
    """
    along_x, along_y = _terms(solution)
    first_x, first_y = along_x.displacement(x, y, poisson, grid)
    second_y, second_x = (_swapped(u, grid) for u in along_y.displacement(y, x, poisson, grid))
    u = np.stack([first_x + second_x, first_y + second_y], axis=2)
    mean = along_y.mean_of_odd(poisson)
    u[1, :, 1] -= mean.reshape(-1, *(1,) * (u.ndim - 3))
    return u


def stress(solution: Solution, x: Array, y: Array, grid: bool) -> Array:
    """(2, cases, 3, *points), components (xx, yy, xy); points as in `displacement`."""
    along_x, along_y = _terms(solution)
    xx, yy, xy = along_x.stress(x, y, grid)
    yy_2, xx_2, xy_2 = (_swapped(s, grid) for s in along_y.stress(y, x, grid))
    return np.stack([xx + xx_2, yy + yy_2, xy + xy_2], axis=2)


def _terms(solution: Solution) -> tuple[Terms, Terms]:
    along_x, along_y = (
        Terms(family, amplitudes, solution.constant)
        for family, amplitudes in zip(solution.families, solution.amplitudes, strict=True)
    )
    return along_x, along_y


def _swapped(values: Array, grid: bool) -> Array:
    return values.swapaxes(-1, -2) if grid else values

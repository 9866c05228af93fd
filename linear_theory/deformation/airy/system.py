"""The infinite amplitude systems of the Airy series, truncated, with or without their tails.

The stress function of eq. 15 (seed paper, appendix A.1) joins two families of terms. Each term is a
trigonometric function along one side of the sheet times a hyperbolic one across it. Free edges couple
the families. With the signs (-1)^m, (-1)^r, (-1)^((s-1)/2) taken out of the amplitudes ("barred"),
both pairs (A, C: growth even in y; B, D: odd) read, for every wave number k of one family,

    [1 + tau 2kH/sinh 2kH] a_k + sum_q (4/H') k^2 q tanh^tau'(q H') / (k^2 + q^2)^2 b_q = rhs_k,

primes belonging to the other family; tau = +1 where the hyperbolic function is even (cosh), else -1.
The printed system has the factor of the A- and B-equations wrong (E11, E12 in the project's list of
corrections): `printed=True` keeps it.

The amplitudes decay only like K/m, with one common K (Koialovich's law; Meleshko 1995, J. Elast. 39,
p. 1), so a plain truncation is accurate to O(M^-2). Carrying K as one more unknown and summing the
tails is accurate to about O(M^-4).
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.special import (
    inverse_quartic_sum,
    one_minus_x_over_sinh,
    x_over_sinh,
)
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Family:
    """One family of terms of eq. 15.

    count: number of terms kept; first: wave number of number 1; step: 1 for numbers 1, 2, 3, ...,
    2 for 1, 3, 5, ...; half: half the length H of the sheet in the hyperbolic direction;
    parity: +1 for cosh, -1 for sinh; tail: beyond `count`, barred amplitudes are tail * K/number.
    """

    count: int
    first: float
    step: int
    half: float
    parity: int
    tail: float

    @cached_property
    def numbers(self) -> Array:
        """m, r or s, (count,)."""
        return np.arange(1.0, self.step * self.count + 1, self.step)

    @cached_property
    def wavenumbers(self) -> Array:
        """alpha_m, gamma_r or delta_s, (count,), 1/length."""
        return np.asarray(self.first * self.numbers)

    @cached_property
    def signs(self) -> Array:
        """Barred amplitudes are these times the printed ones, (count,)."""
        start = 1.0 if self.step == 2 else -1.0
        return np.asarray(start * (-1.0) ** np.arange(self.count), float)

    @cached_property
    def diagonal(self) -> Array:
        """1 + tau 2kH/sinh(2kH), (count,)."""
        x = 2 * self.half * self.wavenumbers
        return 1 + x_over_sinh(x) if self.parity > 0 else one_minus_x_over_sinh(x)

    @cached_property
    def slope(self) -> Array:
        """tanh^tau(kH), (count,)."""
        t = np.tanh(self.half * self.wavenumbers)
        return t if self.parity > 0 else 1 / t

    def extended(self) -> "Family":
        """The same family with twice as many terms."""
        return Family(2 * self.count, self.first, self.step, self.half, self.parity, self.tail)


@dataclass(frozen=True)
class Pair:
    """Two coupled families and their barred amplitudes: (A, C) or (B, D).

    amplitudes: of the family along x, then of the one along y, each (count, cases);
    constant: K, (cases,); 0 where tails are cut off.
    """

    families: tuple[Family, Family]
    amplitudes: tuple[Array, Array]
    constant: Array

    def without_tail(self) -> "Pair":
        """The same amplitudes, cut off."""
        return replace(self, constant=np.zeros_like(self.constant))


def families(sheet: Sheet, modes: tuple[int, int], parity: int) -> tuple[Family, Family]:
    """The families A and C (parity +1, growth even in y) or B and D (parity -1)."""
    across = Family(modes[0], 2 * np.pi / sheet.width, 1, sheet.length / 2, parity, 1.0)
    if parity > 0:
        return across, Family(modes[1], 2 * np.pi / sheet.length, 1, sheet.width / 2, 1, -1.0)
    return across, Family(modes[1], np.pi / sheet.length, 2, sheet.width / 2, 1, -2.0)


def coupling(wavenumbers: Array, other: Family) -> Array:
    """Coefficients of the other family's amplitudes in the equations of `wavenumbers`."""
    k2 = (wavenumbers * wavenumbers)[:, None]
    q = other.wavenumbers
    total = k2 + q * q
    return k2 / (total * total) * (4 / other.half * q * other.slope)


def printed_coupling(family: Family, other: Family) -> Array:
    """The A- and B-equations as printed: 8/L and tanh(alpha_m L/4) in place of 8/W, tanh(q W/2)."""
    k, q = family.wavenumbers[:, None], other.wavenumbers
    return 4 / family.half * k * k * q * np.tanh(k * other.half) / (k * k + q * q) ** 2


def tail_couplings(rows: list[tuple[Array, Family]]) -> list[Array]:
    """What the tail with K = 1 of a family adds to the equations of wave numbers of the other one.

    rows: pairs of those wave numbers and the family with the tail. Valid where exp(-2kH) is negligible
    beyond its last term, as it is in a balanced truncation.
    """
    spacings = [other.first * other.step for _, other in rows]
    starts = [other.count + (0.5 if other.step == 1 else 0.0) for _, other in rows]
    b = [k / spacing for (k, _), spacing in zip(rows, spacings, strict=True)]
    start = np.repeat(starts, [k.size for k in b])
    sums = np.split(inverse_quartic_sum(np.concatenate(b), start), np.cumsum([k.size for k in b])[:-1])
    return [
        4 / other.half * other.first * other.tail / spacing**4 * (k * k) * total
        for (k, other), spacing, total in zip(rows, spacings, sums, strict=True)
    ]


def solve(families: tuple[Family, Family], load: Array, tail: bool, printed: bool = False) -> Pair:
    """Solve the truncated system of a pair.

    load: barred right-hand sides of the C- or D-equations, (count of that family, cases); those of
    the A- and B-equations are 0. tail: carry K as an unknown. printed: keep the printed A- and
    B-equations. The larger family is eliminated, its own block being diagonal.
    """
    first, second = families
    rows = [coupling(first.wavenumbers, second), coupling(second.wavenumbers, first)]
    if printed:
        rows[0] = printed_coupling(first, second)
    tails: list[Array] | list[None] = [None, None]
    if tail:
        tails = tail_couplings([(first.wavenumbers, second), (second.wavenumbers, first)])
    loads = [np.zeros((first.count, load.shape[1])), load]
    out, kept = (0, 1) if first.count >= second.count else (1, 0)
    found = _eliminate(
        families[out],
        families[kept],
        rows[out],
        rows[kept],
        loads[out],
        loads[kept],
        tails[out],
        tails[kept],
    )
    return Pair(families, (found[out], found[kept]), found[2])


def _eliminate(
    out: Family,
    kept: Family,
    out_rows: Array,
    kept_rows: Array,
    out_load: Array,
    kept_load: Array,
    out_tail: Array | None,
    kept_tail: Array | None,
) -> tuple[Array, Array, Array]:
    """Amplitudes of `out` and `kept`, and K: the Schur complement of the block of `out`."""
    n = kept.count
    size = n if out_tail is None else n + 1
    scaled = np.empty((out.count, size))
    scaled[:, :n] = out_rows
    if out_tail is not None:
        scaled[:, n] = out_tail
    scaled /= out.diagonal[:, None]
    free = out_load / out.diagonal[:, None]
    matrix = np.empty((size, size))
    right = np.empty((size, free.shape[1]))
    np.matmul(kept_rows, -scaled, out=matrix[:n])
    matrix[np.arange(n), np.arange(n)] += kept.diagonal
    right[:n] = kept_load - kept_rows @ free
    if kept_tail is not None:
        matrix[:n, n] += kept_tail
        # K is the mean of what the last amplitudes of the two families say: the leading
        # deviations from the tail law are of opposite sign and cancel
        matrix[n] = -out.numbers[-1] / out.tail * scaled[-1]
        matrix[n, n - 1] += kept.numbers[-1] / kept.tail
        matrix[n, n] -= 2
        right[n] = -out.numbers[-1] / out.tail * free[-1]
    solution = np.linalg.solve(matrix, right)
    constant = np.zeros(free.shape[1]) if kept_tail is None else solution[n]
    return np.asarray(free - scaled @ solution), np.asarray(solution[:n]), np.asarray(constant)

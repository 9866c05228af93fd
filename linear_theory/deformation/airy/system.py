"""The infinite amplitude systems of the Airy series, truncated, with or without their tails.

The stress function of eq. 15 (the paper, appendix A.1) joins two families of terms. Each term is a
trigonometric function along one side of the sheet times a hyperbolic one across it. Free edges couple
the families. With the signs (-1)^m, (-1)^r, (-1)^((s-1)/2) taken out of the amplitudes ("barred"),
both pairs (A, C: growth even in y; B, D: odd) read, for every wave number k of one family,

    [1 + tau 2kH/sinh 2kH] a_k + sum_q (4/H') k^2 q tanh^tau'(q H') / (k^2 + q^2)^2 b_q = rhs_k,

primes belonging to the other family; tau = +1 where the hyperbolic function is even (cosh), else -1.
Both pairs are solved at once, on a first axis of 2: even and odd, as in `family`.

The printed system has the factor of the A- and B-equations wrong (E11, E12 in the project's list of
corrections): `printed=True` keeps it.

The amplitudes decay only like K/m, with one common K (Koialovich's law; Meleshko 1995, J. Elast. 39,
p. 1), so a plain truncation is accurate to O(M^-2). Carrying K as one more unknown and summing the
tails is accurate to about O(M^-4).
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.family import Family
from linear_theory.deformation.airy.special import inverse_quartic_sum

Array = NDArray[np.float64]


class Equations(NamedTuple):
    """The equations of one family, those of the terms kept and then those of the terms beyond.

    other: the family that is coupled to it; load: barred right-hand sides, (2, 2 count, cases); tail:
    what the other family's tail adds with K = 1, (2, 2 count), None where tails are cut off; printed:
    whether the coupling is the printed one.
    """

    family: Family
    other: Family
    load: Array
    tail: Array | None
    printed: bool = False

    def rows(self) -> Array:
        """Coefficients of the other family's amplitudes, of the terms kept, (2, count, other count)."""
        if self.printed:
            return printed_coupling(self.family, self.other)
        return coupling(self.family.kept.wavenumbers, self.other)


@dataclass(frozen=True)
class Solution:
    """The barred amplitudes of both families.

    equations: those of the terms along x, then of those along y; amplitudes: (2, count, cases) each;
    constant: K, (2, cases); 0 where tails are cut off.
    """

    equations: tuple[Equations, Equations]
    amplitudes: tuple[Array, Array]
    constant: Array

    @property
    def families(self) -> tuple[Family, Family]:
        """Along x, along y."""
        along_x, along_y = self.equations
        return along_x.family, along_y.family

    def without_tail(self) -> "Solution":
        """The same amplitudes, cut off."""
        return replace(self, constant=np.zeros_like(self.constant))


def coupling(wavenumbers: Array, other: Family) -> Array:
    """Coefficients of the other family's amplitudes at wave numbers (2, n), (2, n, count)."""
    k2 = (wavenumbers * wavenumbers)[..., None]
    q = other.kept.wavenumbers
    result = k2 + (q * q)[:, None]
    result *= result  # in place: of all arrays these are the largest
    np.divide(k2, result, out=result)
    result *= (4 / other.half * q * other.slope)[:, None]
    return result


def printed_coupling(family: Family, other: Family) -> Array:
    """The A- and B-equations as printed: 8/L and tanh(alpha_m L/4) in place of 8/W, tanh(q W/2)."""
    k, q = family.kept.wavenumbers[..., None], other.kept.wavenumbers[:, None]
    return 4 / family.half * k * k * q * np.tanh(k * other.half) / (k * k + q * q) ** 2


def tail_couplings(families: tuple[Family, Family]) -> tuple[Array, Array]:
    """What a tail with K = 1 adds to the equations of the other family, `Equations.tail` of both.

    Valid where exp(-2kH) is negligible beyond the last term of the tail's family, as it is in a
    balanced truncation. All sums are made in one call: a few take as long as one.
    """
    others = families[1], families[0]
    rows = [family.modes.wavenumbers for family in families]
    count = rows[0].shape[1]
    b = np.concatenate([k / other.spacing for k, other in zip(rows, others, strict=True)], axis=1)
    start = np.empty_like(b)  # in spacings, the first number of the tail is at start + 1/2
    start[:, :count], start[:, count:] = (other.count + 1 / other.step - 0.5 for other in others)
    sums = inverse_quartic_sum(b, start)
    first, second = (
        4 / other.half * other.first * other.tail / other.spacing**4 * (k * k) * total
        for k, other, total in zip(rows, others, (sums[:, :count], sums[:, count:]), strict=True)
    )
    return first, second


def solve(families: tuple[Family, Family], load: Array, tail: bool, printed: bool = False) -> Solution:
    """Solve the truncated systems.

    load: of the C- and D-equations, as in `Equations`; that of the A- and B-equations is 0. tail: carry
    K as an unknown. printed: keep the printed A- and B-equations. The larger family is eliminated, its
    own block being diagonal.
    """
    first, second = families
    tails = tail_couplings(families) if tail else (None, None)
    no_load = np.zeros((2, 2 * first.count, load.shape[2]))
    along_x = Equations(first, second, no_load, tails[0], printed)
    along_y = Equations(second, first, load, tails[1])
    if first.count >= second.count:
        a, c, constant = _eliminate(along_x, along_y)
    else:
        c, a, constant = _eliminate(along_y, along_x)
    return Solution((along_x, along_y), (a, c), constant)


def _eliminate(out: Equations, left: Equations) -> tuple[Array, Array, Array]:
    """Amplitudes of `out` and `left`, and K: the Schur complement of the block of `out`."""
    m, n, cases = out.family.count, left.family.count, left.load.shape[2]
    size = n if out.tail is None else n + 1
    scaled = np.empty((2, m, size))
    scaled[..., :n] = out.rows()
    if out.tail is not None:
        scaled[..., n] = out.tail[:, :m]
    scaled /= out.family.kept.diagonal[..., None]
    free = out.load[:, :m] / out.family.kept.diagonal[..., None]
    left_rows, diagonal = left.rows(), np.arange(n)
    matrix, right = np.empty((2, size, size)), np.empty((2, size, cases))
    np.matmul(left_rows, scaled, out=matrix[:, :n])
    np.negative(matrix[:, :n], out=matrix[:, :n])
    matrix[:, diagonal, diagonal] += left.family.kept.diagonal
    right[:, :n] = left.load[:, :n] - left_rows @ free
    if left.tail is not None:
        matrix[:, :n, n] += left.tail[:, :n]
        # K is the mean of what the last amplitudes of the two families say: the leading
        # deviations from the tail law are of opposite sign and cancel
        of_out, of_left = (e.family.kept.numbers[:, -1:] / e.family.tail for e in (out, left))
        matrix[:, n] = -of_out * scaled[:, -1]
        matrix[:, n, n - 1 : n] += of_left
        matrix[:, n, n] -= 2
        right[:, n] = -of_out * free[:, -1]
    solution = np.linalg.solve(matrix, right)
    constant = np.zeros((2, cases)) if left.tail is None else solution[:, n]
    return free - scaled @ solution, np.asarray(solution[:, :n]), np.asarray(constant)

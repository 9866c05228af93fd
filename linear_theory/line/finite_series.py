"""Power series of the speed of a sine wave at finite strain, with exact coefficients.

With stretch s = sum_k s_k e^k and weight w = s^p of the strain e = alpha sin(phi), `finite` needs means
of powers of the sine, which are rational, and for dry friction the root theta of

    int_0^theta w dphi = (weight of the positive strains - that of the negative ones)/2,

both integrals over a quarter of the period. That is an equation between power series in alpha and theta
with rational coefficients, as the quarter integral of an odd power of the sine is rational; Newton's
method doubles the number of correct coefficients of theta(alpha) in every step.
"""

from fractions import Fraction
from math import comb, factorial
from typing import TYPE_CHECKING

from linear_theory.common import validation
from linear_theory.line.finite import is_dry
from linear_theory.line.piece import Piece

if TYPE_CHECKING:
    from sympy import Rational

Series = list[Fraction]
"""Coefficients of alpha^0, alpha^1, ..., up to the requested order."""


def line_cycle_series(
    order: int,
    growth_law: str = "exp",
    load: str = "current",
    body: str = "line",
    friction: str = "coulomb",
) -> "tuple[Rational, ...]":
    """Exact coefficients (c_0, ..., c_order) of nTV = sum c_k alpha^k, as sympy rationals.

    V is the speed of `line_cycle_speed`, with the same arguments; it is even in alpha. The computing
    time grows faster than the third power of the order: 0.1 s for 20, 1 s for 40.
    Raises ValueError if order is not an integer >= 0 and for unknown names.

    >>> from linear_theory import line_cycle_series
    >>> print(line_cycle_series(4, growth_law="exp"))
    (0, 0, 3/4, 0, -41/576)
    >>> print(line_cycle_series(4, growth_law="linear"))
    (0, 0, 1, 0, -2/3)
    """
    from sympy import Rational  # here: sympy takes longer to import than the rest of the package

    size = validation.integer("order", order, 0) + 1
    growth = Piece.of(growth_law, load, body)
    speed = _dry(size, growth) if is_dry(friction) else _viscous(size, growth)
    return tuple(Rational(c.numerator, c.denominator) for c in speed)


def _dry(size: int, growth: Piece) -> Series:
    stretch = _stretch(size, growth)
    at_rest = _composed([[s] for s in stretch], _shifted(_sine(_median_angle(size, growth))))
    return [a - b for a, b in zip(at_rest, _mean(stretch), strict=True)]


def _viscous(size: int, growth: Piece) -> Series:
    stretch, weight = _stretch(size, growth), _weight(size, growth)
    mean = _quotient(_mean(_product(stretch, weight)), _mean(weight))
    return [a - b for a, b in zip(mean, _mean(stretch), strict=True)]


def _stretch(size: int, growth: Piece) -> Series:
    """Coefficients of s in powers of the strain."""
    return [growth.law.coefficient(k) for k in range(size)]


def _weight(size: int, growth: Piece) -> Series:
    """Coefficients of w = s^p in powers of the strain."""
    weight = _constant(Fraction(1), size)
    for _ in range(growth.power):
        weight = _product(weight, _stretch(size, growth))
    return weight


def _mean(function: Series) -> Series:
    """Mean over the period of a function of the strain alpha sin(phi)."""
    return [c * Fraction(comb(k, k // 2), 2**k) * (k % 2 == 0) for k, c in enumerate(function)]


def _median_angle(size: int, growth: Piece) -> Series:
    """theta(alpha)."""
    weight = _weight(size, growth)
    below = _integrals(weight)
    below[0] = [-c * _odd_quarter(k) for k, c in enumerate(weight)]
    slope = [[m * c for c in row] for m, row in enumerate(below)][1:]
    theta, right = _constant(Fraction(0), size), 1
    while right < size:
        step = _quotient(_composed(below, theta), _composed(slope, theta))
        theta = [a - b for a, b in zip(theta, step, strict=True)]
        right *= 2
    return theta


def _integrals(weight: Series) -> list[Series]:
    """int_0^theta w dphi in powers of theta, each coefficient a series in alpha."""
    size = len(weight)
    rows = [_constant(Fraction(0), size) for _ in range(size)]
    power, sine = _constant(Fraction(1), size), _sine([Fraction(k == 1) for k in range(size)])
    for k, w in enumerate(weight):
        for m in range(1, size):
            rows[m][k] = w * power[m - 1] / m
        power = _product(power, sine)
    return rows


def _odd_quarter(k: int) -> Fraction:
    """Integral of sin(phi)^k over a quarter period if k is odd, else 0."""
    if k % 2 == 0:
        return Fraction(0)
    return Fraction(2 ** (k - 1) * factorial(k // 2) ** 2, factorial(k))


def _sine(angle: Series) -> Series:
    """Sine of a series without constant term."""
    taylor = [Fraction((-1) ** (k // 2) * (k % 2), factorial(k)) for k in range(len(angle))]
    return _composed([[c] for c in taylor], angle)


def _composed(rows: list[Series], x: Series) -> Series:
    """sum_m rows[m] x^m by Horner's rule; rows may be short."""
    total = _constant(Fraction(0), len(x))
    for row in reversed(rows):
        total = _product(total, x)
        for k, c in enumerate(row):
            total[k] += c
    return total


def _constant(value: Fraction, size: int) -> Series:
    return [value] + [Fraction(0)] * (size - 1)


def _shifted(series: Series) -> Series:
    """Times alpha."""
    return [Fraction(0), *series[:-1]]


def _product(a: Series, b: Series) -> Series:
    total = _constant(Fraction(0), len(a))
    others = [(k, c) for k, c in enumerate(b) if c]
    for j, factor in enumerate(a):
        if factor:
            for k, c in others:
                if j + k >= len(a):
                    break
                total[j + k] += factor * c
    return total


def _quotient(a: Series, b: Series) -> Series:
    """a/b for b with a non-zero constant term."""
    quotient: Series = []
    for k, c in enumerate(a):
        known = sum((q * b[k - j] for j, q in enumerate(quotient)), Fraction(0))
        quotient.append((c - known) / b[0])
    return quotient

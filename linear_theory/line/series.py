"""Power series of the speed of a sine wave on a line, with exact coefficients (paper eq. 9).

From theta = alpha cos(theta), nTV = alpha sin(theta), the inversion formula of Lagrange gives

    nTV = sum over odd k of c_(k+1) alpha^(k+1),   c_(k+1) = (1/k) [theta^(k-1)] cos(theta)^(k+1),

the bracket being the coefficient of theta^(k-1). The first terms are
alpha^2 - (2/3) alpha^4 + (4/5) alpha^6 - ...; the paper has -alpha^2.
"""

from fractions import Fraction
from functools import lru_cache
from math import comb, factorial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.line.closed_form import FORMS, line_speed_viscous

if TYPE_CHECKING:
    from sympy import Rational

Array = NDArray[np.float64]

LAPLACE_LIMIT = 0.66274341934918158097474209710925290705
"""Radius of convergence of the series: the root of x exp(sqrt(1 + x^2)) = 1 + sqrt(1 + x^2).

The smallest |alpha| at which theta = alpha cos(theta) has a double root, here alpha = +-i x.
"""

HIGHEST_ORDER = 1000
"""Order beyond which the coefficients exceed the range of doubles."""


def line_series(order: int) -> "tuple[Rational, ...]":
    """Exact coefficients (c_0, ..., c_order) of nTV = sum c_k alpha^k, as sympy rationals.

    Raises ValueError if order is not an integer >= 0.

    >>> from linear_theory import line_series
    >>> print(line_series(6))
    (0, 0, 1, 0, -2/3, 0, 4/5)
    """
    from sympy import Rational  # here: sympy takes longer to import than the rest of the package

    order = validation.integer("order", order, 0)
    return tuple(Rational(c.numerator, c.denominator) for c in map(_coefficient, range(order + 1)))


def line_speed_series(
    alpha: ArrayLike, order: int = 2, count: int = 1, period: float = 1.0, form: str = "corrected"
) -> Array:
    """The series truncated after alpha^order; arguments, units and errors raised as for `line_speed`.

    It converges for |alpha| < LAPLACE_LIMIT only. form="printed" is eq. 9 of the paper,
    -alpha^2/(nT), which ends at order 2. Raises ValueError for an order outside [0, 1000].

    >>> from linear_theory import line_speed, line_speed_series
    >>> print(f"V = {line_speed_series(0.1, order=4):.6f} L/T, exact {line_speed(0.1):.6f} L/T")
    V = 0.009933 L/T, exact 0.009934 L/T
    """
    order = validation.integer("order", order, 0)
    if order > HIGHEST_ORDER:
        raise ValueError(f"order = {order}: must be <= {HIGHEST_ORDER}")
    leading = 2 * line_speed_viscous(alpha, count, period)  # alpha^2/(nT)
    if validation.choice("form", form, FORMS) == "printed":
        if order != 2:
            raise ValueError(f"order = {order}: must be 2, as eq. 9 is printed up to alpha^2")
        return np.asarray(-leading)
    square = np.square(np.asarray(alpha, float))
    total = np.zeros_like(square)
    for k in range(order - order % 2, 1, -2):
        total = total * square + float(_coefficient(k))
    return np.asarray(leading * total)


@lru_cache(maxsize=HIGHEST_ORDER + 1)
def _coefficient(order: int) -> Fraction:
    """c_order by Lagrange's formula.

    cos^n is 2^-n sum_j C(n, j) exp(i (n - 2j) theta); its terms j and n - j are equal.
    """
    if order < 2 or order % 2:
        return Fraction(0)
    n = order
    total = sum(2 * comb(n, j) * (n - 2 * j) ** (n - 2) for j in range(n // 2))
    total += comb(n, n // 2) * (n == 2)
    return Fraction((-1) ** (n // 2 - 1) * total, 2**n * factorial(n - 1))

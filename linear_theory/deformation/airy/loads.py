"""The load cases of the Airy series: growth cos(2 pi r y/L) and sin(2 pi r y/L), r full waves.

A sheet held so that it cannot widen answers growth c(y) with sigma_xx = -c alone (the first two sums
of eq. 15); the amplitudes then free its edges. A growth that is linear in y leaves no stress, so the
odd case may be taken less the line of equal slope at the ends, c~ = sin(a eta) - (-1)^r a eta with
eta = y/L, a = 2 pi r. On the half-wave basis sin(s pi eta) its coefficients decay like s^-4; those of
the sine itself, which is not a member of that basis, like s^-2.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.system import Family
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


def end_slopes(orders: NDArray[np.int64]) -> Array:
    """d/d eta of sin(2 pi r eta) at eta = 1/2, (cases,)."""
    return 2 * np.pi * orders * (-1.0) ** orders


def even_load(across: Family, orders: NDArray[np.int64]) -> Array:
    """Barred right-hand side of the C-equations for unit cos(2 pi r eta), (modes, cases)."""
    return np.asarray((across.numbers[:, None] == orders) * (-1.0) ** orders)


def odd_load(across: Family, orders: NDArray[np.int64], without_line: bool) -> Array:
    """Barred right-hand side of the D-equations for unit sin(2 pi r eta), (modes, cases).

    b_s of appendix A.1, for the sine or for the sine without its line.
    """
    a2 = (2 * np.pi * orders) ** 2
    b2 = (np.pi * across.numbers[:, None]) ** 2
    load = 4 * end_slopes(orders) / (b2 - a2)
    return np.asarray(load * a2 / b2 if without_line else load)


def line_load(across: Family) -> Array:
    """The same for the growth eta, (modes, 1)."""
    return 4 / (np.pi * across.numbers[:, None]) ** 2


def growth(sheet: Sheet, orders: NDArray[np.int64], y: Array) -> Array:
    """c of the cases: cosines, sines; (2 cases, *y.shape)."""
    angle = np.multiply.outer(2 * np.pi * orders / sheet.length, y)
    return np.concatenate([np.cos(angle), np.sin(angle)])


def held_stress(sheet: Sheet, orders: NDArray[np.int64], y: Array, without_line: bool) -> Array:
    """sigma_xx of the held sheet, (2 cases, *y.shape)."""
    stress = -growth(sheet, orders, y)
    if without_line:
        stress[orders.size :] += np.multiply.outer(end_slopes(orders) / sheet.length, y)
    return stress


def held_displacement(
    sheet: Sheet, orders: NDArray[np.int64], x: Array, y: Array, without_line: bool
) -> Array:
    """Displacement of the held sheet and of the free line, (2 cases, 2, *broadcast(x, y).shape).

    Without rotation, and u_y of zero mean.
    """
    nu, cases = sheet.poisson, orders.size
    u = np.zeros((2 * cases, 2, *np.broadcast(x, y).shape))
    k = 2 * np.pi * orders / sheet.length
    angle = np.multiply.outer(k, y)
    k = k.reshape((-1,) + (1,) * np.ndim(y))
    between = (slice(None), *(np.newaxis,) * (u.ndim - 2 - np.ndim(y)))  # y may have fewer axes than x
    u[:cases, 1] = ((1 + nu) * np.sin(angle) / k)[between]
    u[cases:, 1] = (-(1 + nu) * np.cos(angle) / k)[between]
    if without_line:
        slope = end_slopes(orders) / sheet.length
        y2, x2 = y * y - sheet.length**2 / 12, x * x - sheet.width**2 / 12
        u[cases:, 0] = np.multiply.outer(slope, x * y)
        u[cases:, 1] -= np.multiply.outer(slope, (nu * y2 + x2) / 2)
    return u

"""The load cases of the Airy series: growth cos(2 pi r y/L) and sin(2 pi r y/L), r full waves.

A sheet held so that it cannot widen answers growth c(y) with sigma_xx = -c alone (the first two sums
of eq. 15); the amplitudes then free its edges. A growth that is linear in y leaves no stress, so the
odd case may be taken less the line of equal slope at the ends, c~ = sin(a eta) - (-1)^r a eta with
eta = y/L, a = 2 pi r. On the half-wave basis sin(s pi eta) its coefficients decay like s^-4; those of
the sine itself, which is not a member of that basis, like s^-2.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.family import Family
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


def end_slopes(orders: NDArray[np.int64]) -> Array:
    """d/d eta of sin(2 pi r eta) at eta = 1/2, (cases,)."""
    return 2 * np.pi * orders * (-1.0) ** orders


def wave_load(along_y: Family, orders: NDArray[np.int64], without_line: bool) -> Array:
    """`Equations.load` of the C- and D-equations for unit waves, (2, 2 count, cases)."""
    even, odd = along_y.modes.numbers
    return np.array([even_load(even, orders), odd_load(odd, orders, without_line)])


def even_load(numbers: Array, orders: NDArray[np.int64]) -> Array:
    """Barred right-hand side of the C-equations for unit cos(2 pi r eta), (modes, cases)."""
    return np.asarray((numbers[:, None] == orders) * (-1.0) ** orders)


def odd_load(numbers: Array, orders: NDArray[np.int64], without_line: bool) -> Array:
    """Barred right-hand side of the D-equations for unit sin(2 pi r eta), (modes, cases).

    b_s of appendix A.1, for the sine or for the sine without its line.
    """
    a2 = (2 * np.pi * orders) ** 2
    b2 = (np.pi * numbers[:, None]) ** 2
    load = 4 * end_slopes(orders) / (b2 - a2)
    return np.asarray(load * a2 / b2 if without_line else load)


def line_load(along_y: Family) -> Array:
    """The same for the growth eta, (2, 2 count, 1)."""
    even, odd = along_y.modes.numbers[..., None]
    return np.array([np.zeros_like(even), 4 / (np.pi * odd) ** 2])


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
    nu, cases, points = sheet.poisson, orders.size, np.broadcast(x, y)
    u = np.zeros((2 * cases, 2, *points.shape))
    orders = orders.reshape(-1, *(1,) * points.ndim)
    k = 2 * np.pi * orders / sheet.length
    u[:cases, 1] = (1 + nu) * np.sin(k * y) / k
    u[cases:, 1] = -(1 + nu) * np.cos(k * y) / k
    if without_line:
        slope = end_slopes(orders) / sheet.length
        y2, x2 = y * y - sheet.length**2 / 12, x * x - sheet.width**2 / 12
        u[cases:, 0] = slope * (x * y)
        u[cases:, 1] -= slope * ((nu * y2 + x2) / 2)
    return u

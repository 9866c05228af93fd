"""The adjoint of the elastic problem: from weights of displacement to the growth that causes it.

A Ritz solution u of growth c has the least energy: a(u, z) = l(c; z) for all displacements z (see
`ritz.solver`). A linear function g of u is then l(c; z) with the z that solves a(u, z) = g(u) for all
u: one solve with the kept factor, and g(u[dc]) is the integral of dc times

    S = div z/(1 - nu)

for any change dc of the growth. The change of u with the sheet itself needs no further solve:
d g(u) = [dl - da](c, u; z), the derivatives of the two forms at fixed coefficients of u and z.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


def displacement_load(moments: Array) -> Array:
    """Of moments against p_i p_j of weights of displacement, that on the basis of the Ritz method.

    (cases, 2, degrees x, degrees y), both.
    """
    return legendre.against_values(legendre.against_values(moments, 2), 3)


def dilation_load(moments: Array, sheet: Sheet) -> Array:
    """The same of weights of the dilation, (cases, degrees x, degrees y) -> (cases, 2, ...)."""
    values, slopes = legendre.against_values, legendre.against_slopes
    x = values(slopes(moments, 1), 2) * (2 / sheet.width)
    y = slopes(values(moments, 1), 2) * (2 / sheet.length)
    return np.stack([x, y], 1)


def adjoint(solver: RitzSolver, load: Array, mirrored: bool) -> Array:
    """z for linear functions of the Ritz solution (which has no mean and no mean rotation).

    load: (cases, 2, degree x + 1, degree y + 1), their values for each function of the basis; mirrored:
    whether u_x is odd and u_y even in x.
    """
    return solver.solve_work(_without_rigid_motion(load, solver.sheet), mirrored)


def _without_rigid_motion(load: Array, sheet: Sheet) -> Array:
    """The transpose of `RitzSolver._without_rigid_motion`: the load is balanced."""
    mean = legendre.values(np.eye(3), 0)[0]  # of phi_0, phi_1, phi_2
    half_x, half_y = sheet.width / 2, sheet.length / 2
    load = load.copy()
    load[:, :, :3, :3] -= load[:, :, :1, :1] * np.multiply.outer(mean, mean)
    rotation = half_y * load[:, 0, 0, 1] - half_x * load[:, 1, 1, 0]
    slope = np.multiply.outer(rotation, mean) / 2
    load[:, 1, 1, :3] += slope / half_x
    load[:, 0, :3, 1] -= slope / half_y
    return load


def density(sheet: Sheet, z: Array) -> Array:
    """S of each z, as factors of the moments of dc against p_i p_j, (cases, degrees x, degrees y)."""
    gradient = _Gradient.of(z)
    x, y = gradient.xx * (sheet.length / 2), gradient.yy * (sheet.width / 2)
    return np.asarray((x + y) / (1 - sheet.poisson))


def by_poisson(sheet: Sheet, moments: Array, u: Array, z: Array) -> Array:
    """Derivatives of functions of u with respect to Poisson's ratio, (cases,).

    moments: of the growth, (cases, degrees x, degrees y); u: its solution; z: of the functions.
    """
    nu, slant = sheet.poisson, sheet.length / sheet.width
    stretch, poisson, shear = _energies(_Gradient.of(u), _Gradient.of(z), slant)
    square = (1 - nu**2) ** 2
    energy = (2 * nu * stretch + (1 + nu**2) * poisson) / square - shear / (2 * (1 + nu) ** 2)
    return np.asarray(_along(moments, density(sheet, z)) / (1 - nu) - energy)


def by_width(sheet: Sheet, moments: Array, u: Array, z: Array) -> Array:
    """The same with respect to the logarithm of the width."""
    nu, slant = sheet.poisson, sheet.length / sheet.width
    one, other = _Gradient.of(u), _Gradient.of(z)
    stretch = _inner(one.yy, other.yy) / slant - _inner(one.xx, other.xx) * slant
    shear = _inner(one.xy, other.xy) / slant - _inner(one.yx, other.yx) * slant
    energy = stretch / (1 - nu**2) + shear / (2 * (1 + nu))
    growth = _along(moments, other.yy) * (sheet.width / 2) / (1 - nu)
    return np.asarray(growth - energy)


class _Gradient(NamedTuple):
    """Derivatives by the local coordinates in orthonormal polynomials: of u_x by x, and so on."""

    xx: Array
    xy: Array
    yx: Array
    yy: Array

    @classmethod
    def of(cls, u: Array) -> "_Gradient":
        """Of coefficients (cases, 2, degrees x, degrees y)."""
        values, slopes = legendre.values, legendre.slopes
        by_x, by_y = values(slopes(u, 2), 3), slopes(values(u, 2), 3)
        return cls(by_x[:, 0], by_y[:, 0], by_x[:, 1], by_y[:, 1])


def _energies(one: _Gradient, other: _Gradient, slant: float) -> tuple[Array, Array, Array]:
    """Factors of 1/(1 - nu^2), nu/(1 - nu^2) and 1/(2 (1 + nu)) in the form a, (cases,) each."""
    stretch = _inner(one.xx, other.xx) * slant + _inner(one.yy, other.yy) / slant
    poisson = _inner(one.xx, other.yy) + _inner(one.yy, other.xx)
    shear = _inner(one.xy, other.xy) / slant + _inner(one.yx, other.yx) * slant
    return stretch, poisson, shear + _inner(one.xy, other.yx) + _inner(one.yx, other.xy)


def dilation_by_width(sheet: Sheet, moments: Array, u: Array) -> Array:
    """What weights of the dilation, by their moments, see of the width at fixed coefficients of u."""
    return np.asarray(-_along(moments, _Gradient.of(u).xx) * (2 / sheet.width))


def _inner(one: Array, other: Array) -> Array:
    return np.asarray((one * other).sum((-2, -1)))


def _along(moments: Array, values: Array) -> Array:
    """Inner product with the moments that the degrees have."""
    across, along = values.shape[-2:]
    return _inner(moments[..., :across, :along], values)

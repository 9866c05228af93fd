"""A-posteriori error of a truncated Airy series."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.family import Family
from linear_theory.deformation.airy.system import Equations, Solution, coupling

Array = NDArray[np.float64]


def missing_mean_square(solution: Solution, factors: Array) -> Array:
    """Mean over the sheet of |u|^2 in the first modes left out, (times,).

    factors: (2, cases, times). The truncated solution leaves in the equations just beyond the last a
    residual, which is the traction on the edges in those modes; divided by the diagonal it is an
    estimate of what the amplitudes lack there.
    """
    (of_x, of_y), (a_b, c_d), constant = solution.equations, solution.amplitudes, solution.constant
    traction_x, traction_y = (
        _traction(equations, others, constant) @ factors
        for equations, others in ((of_x, c_d), (of_y, a_b))
    )
    lacking = _mean_square_of_terms(of_x.family, traction_x)
    lacking += _mean_square_of_terms(of_y.family, traction_y)
    moment = 2 / of_y.family.beyond.wavenumbers[1] ** 2 @ traction_y[1]
    return lacking + _mean_square_of_bending(of_x.family.side, of_y.family.side, moment)


def _traction(equations: Equations, others: Array, constant: Array) -> Array:
    """Residual of the equations beyond, with the amplitudes of the other family, (2, count, cases)."""
    family = equations.family
    numbers, wavenumbers, diagonal = family.beyond
    residual = coupling(wavenumbers, equations.other) @ others
    if equations.tail is not None:
        law = diagonal * family.tail / numbers + equations.tail[:, family.count :]
        residual += law[..., None] * constant[:, None]
    return residual - equations.load[:, family.count :]


def _mean_square_of_terms(family: Family, traction: Array) -> Array:
    """Mean of |u|^2, (times,), of the terms beyond that would undo a traction (2, count, times)."""
    _, k, diagonal = family.beyond
    weights = _mean_square_of_term(k * family.half) / k**2
    return np.einsum("ak,akt->t", weights, (traction / diagonal[..., None]) ** 2)


def _mean_square_of_term(depth: Array) -> Array:
    """Bound on the mean of k^2 |u|^2 of a term of unit amplitude, depth = kH, any nu in (-1, 1/2].

    For kH >> 1 the profiles (1 - nu) e - (1 + nu) d e and 2 e + (1 + nu) d e, e = exp(-d), give
    4.4/(2 kH) at nu = 1/2; where the term reaches through the sheet, a sinh in its denominator
    gives 1/(kH)^2 more.
    """
    return 2.2 / depth * (1 + 1 / depth**2)


def _mean_square_of_bending(width: float, length: float, moment: Array) -> Array:
    """Mean of |u|^2 when a moment bends the whole sheet in its plane.

    Half waves sin(delta_s y) left at x = +-W/2 have a resultant moment, 2/delta_s^2 each, to which a
    wide sheet yields with the curvature 12 M/L^3; the variance of x^2/2 is W^4/720.
    """
    return (12 * moment / length**3) ** 2 * width**4 / 720

"""A-posteriori error of a truncated Airy series."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.system import Pair, coupling, tail_couplings

Array = NDArray[np.float64]


def missing_mean_square(pair: Pair, load: Array, factors: Array) -> Array:
    """Mean over the sheet of |u|^2 in the first modes left out, (times,).

    load: barred right-hand sides of the C- or D-equations for twice as many modes, (2 count, cases);
    factors: (cases, times). The truncated solution leaves in the equations just beyond the last a
    residual, which is the traction on the edges in those modes; divided by the diagonal it is an
    estimate of what the amplitudes lack there.
    """
    total = np.zeros(factors.shape[1])
    extended = [family.extended() for family in pair.families]
    beyond = [slice(family.count, None) for family in pair.families]
    wavenumbers = [family.wavenumbers[b] for family, b in zip(extended, beyond, strict=True)]
    tails = tail_couplings(list(zip(wavenumbers, pair.families[::-1], strict=True)))
    for i, family in enumerate(extended):
        k, diagonal = wavenumbers[i], family.diagonal[beyond[i]]
        traction = coupling(k, pair.families[1 - i]) @ pair.amplitudes[1 - i]
        law = diagonal * family.tail / family.numbers[beyond[i]]
        traction += np.multiply.outer(law + tails[i], pair.constant)
        if i == 1:
            traction -= load[beyond[i]]
        traction = traction @ factors
        total += _mean_square_of_term(k * family.half) / k**2 @ (traction / diagonal[:, None]) ** 2
        if family.step == 2:
            total += _mean_square_of_bending(pair, 2 / k**2 @ traction)
    return total


def _mean_square_of_term(depth: Array) -> Array:
    """Bound on the mean of k^2 |u|^2 of a term of unit amplitude, depth = kH, any nu in (-1, 1/2].

    For kH >> 1 the profiles (1 - nu) e - (1 + nu) d e and 2 e + (1 + nu) d e, e = exp(-d), give
    4.4/(2 kH) at nu = 1/2; where the term reaches through the sheet, a sinh in its denominator
    gives 1/(kH)^2 more.
    """
    return 2.2 / depth * (1 + 1 / depth**2)


def _mean_square_of_bending(pair: Pair, moment: Array) -> Array:
    """Mean of |u|^2 when a moment bends the whole sheet in its plane.

    Half waves sin(delta_s y) left at x = +-W/2 have a resultant moment, 2/delta_s^2 each, to which a
    wide sheet yields with the curvature 12 M/L^3; the variance of x^2/2 is W^4/720.
    """
    along_x, along_y = pair.families
    length, width = 2 * along_x.half, 2 * along_y.half
    return (12 * moment / length**3) ** 2 * width**4 / 720

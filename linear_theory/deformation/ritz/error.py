"""Degree and truncation error of a Legendre-Ritz solution, from its last coefficients."""

import math

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Pair = tuple[int, int]

SLOWEST = 5.0  # corner singularities: coefficients fall asymptotically like degree**-SLOWEST or faster
FASTEST = 0.4  # smallest ratio of neighbouring coefficients used in an extrapolation
SAFETY = 3.5  # measured on 590 fields of 60 sheets and waves: estimate/error is 1.5 or more
FLAT = 1e-6  # relative size below which a momentarily vanishing displacement has no relative error
ROUNDOFF = 3e-14
GAUSS_NOISE = 8e-15  # rounding of Gauss moments relative to the largest, per degree; measured: half


def degrees(sheet: Sheet, order: int, corner: float) -> Pair:
    """Odd degrees (across, along) with `corner` polynomials per square root of side over layer width.

    order: waves on the sheet. A wave needs pi polynomials; edge and corner layers are as wide as the
    smaller of width and wavelength, and polynomials of degree p resolve side/p**2 at an end.
    """
    layer = min(sheet.width, sheet.length / order)
    across = corner * math.sqrt(sheet.width / layer)
    along = math.pi * order + corner * math.sqrt(sheet.length / layer)
    return odd(across), odd(along)


def resolving_degrees(sheet: Sheet, order: int) -> Pair:
    """Odd degrees (across, along) below which coefficients need not decay yet."""
    return degrees(sheet, order, corner=3.0)


def first_degrees(sheet: Sheet, order: int, rtol: float) -> Pair:
    """Degrees that reach rtol in most cases, rather a little low than high.

    The factor is measured on the sheet of the paper. In a strip narrower than the wave, stress is
    confined to the ends, where it is of second order in width times wave number; its displacements are
    of the same order, on scales and areas that shrink with the width.
    """
    narrowness = min(1.0, 2 * math.pi * order * sheet.width / sheet.length)
    corner = 2.4 * max(1.0, narrowness**3.5 / rtol) ** (1 / 7)
    return degrees(sheet, order, corner)


def raised_degrees(degree: Pair, tails: tuple[float, float], aliased: float, rtol: float) -> Pair:
    """Degrees for the next attempt where the tails (across, along) are above rtol.

    aliased: the part of the tails due to too few Gauss points for c, which for growth fronts falls only
    like 1/degree.
    """

    def raised(degree: int, tail: float) -> int:
        excess = math.sqrt(2) * tail / rtol
        factor = max(1.1 * excess ** (1 / 6), 1.2, aliased / rtol)
        return degree if excess <= 1 else odd(degree * min(factor, 2.0))

    return raised(degree[0], tails[0]), raised(degree[1], tails[1])


def relative_tails(
    coefficients: Array,
    missed: tuple[Array, Array],
    amplitudes: Array,
    resolving: Pair,
    poisson: float,
) -> Array:
    """Estimated relative L2 norm of the contribution of higher degrees (across, along), (2, times).

    coefficients: of u, (cases, 2, degree x + 1, degree y + 1), orthonormal polynomials;
    missed: (cases, ...) each, further errors from too low degrees across and along the sheet: the part
    of the integral of c that they do not resolve, which is the error of u for an unresolved wave;
    amplitudes: (cases, times). As poisson approaches -1, shear is much stiffer than dilation and the
    energy a worse measure of the displacement error.
    """
    safety = SAFETY / math.sqrt(1 + poisson)
    tails = []
    for axis in (0, 1):
        shells = np.moveaxis(coefficients, axis + 2, 1)
        last, before = (
            mixed_norms(shells[:, -2:], amplitudes),
            mixed_norms(shells[:, -4:-2], amplitudes),
        )
        tail = _extrapolated(last, before, shells.shape[1] - 1, resolving[axis])
        tails.append(safety * tail + mixed_norms(missed[axis], amplitudes))
    return np.stack(tails) / _size(coefficients, amplitudes)


def beyond_rounding(finer: Array, moments: Array) -> Array:
    """Change of moments (cases, ..., degrees x, degrees y) with more points; 0 if within rounding."""
    change = finer - moments
    largest = abs(moments).max(axis=tuple(range(1, moments.ndim)), keepdims=True)
    noise = GAUSS_NOISE * max(moments.shape[-2:])
    return np.where(abs(change) > noise * largest, change, 0.0)


def relative(part: Array, coefficients: Array, amplitudes: Array) -> Array:
    """L2 norm of a part of u relative to that of u, (times,); coefficients of both are (cases, ...)."""
    return np.asarray(mixed_norms(part, amplitudes) / _size(coefficients, amplitudes))


def _size(coefficients: Array, amplitudes: Array) -> Array:
    """L2 norm of u, (times,), positive."""
    total = mixed_norms(coefficients, amplitudes)
    floor = FLAT * total.max(initial=0.0)
    return np.maximum(total, floor if floor > 0 else 1.0)


def _extrapolated(last: Array, before: Array, degree: int, resolving: int) -> Array:
    """Norm of all degrees above the last two (two, since fields of one parity skip every other).

    A geometric series with the ratio of the last two to the two before them, but not slower than the
    corner asymptotics; where layers are not resolved, each degree up to their resolution may contribute
    as much as the last.
    """
    if degree < resolving:
        return np.asarray(last * math.sqrt((resolving - degree) / 2 + 1))
    slowest = (1 + 2 / degree) ** -SLOWEST
    ratio = np.clip(last / np.maximum(before, 1e-300), min(FASTEST, slowest), slowest)
    return np.asarray(last * ratio / np.sqrt(1 - ratio**2))


def odd(degree: float) -> int:
    """The next odd integer, at least 3."""
    return max(2 * math.ceil((degree - 1) / 2) + 1, 3)

"""Least squares of samples by a basis, in blocks, and the error of what is found."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]

BLOCK = 4096
"""Samples taken together."""


class _Fit(NamedTuple):
    basis: Basis
    coefficients: Array
    residual: float
    noise: float
    factor: Array


class Fit(Shown, _Fit):
    """coefficients (*basis.shape); residual: root mean square over the samples.

    noise: standard deviation of one sample, from the residual. factor: R (size, size), the coefficients
    having the covariance noise^2 (R^T R)^-1 where the errors of the samples are independent.
    """

    def values(self, samples: Samples) -> Array:
        """c of the fit at samples, (n,)."""
        times, across, along = self.basis.factors(samples)
        found = np.einsum("nk,ni,nj,kij->n", times, across, along, self.coefficients, optimize=True)
        return np.asarray(found)


def fitted(samples: Samples, basis: Basis) -> Fit:
    """Raises ValueError where the samples do not tell the functions of the basis apart."""
    from scipy.linalg import solve_triangular  # here: scipy takes long to import

    both: Array = np.zeros((0, basis.size + 1))
    for start in range(0, samples.size, BLOCK):
        some = samples.take(slice(start, start + BLOCK))
        rows = np.concatenate([basis.columns(some), some.c[:, None]], axis=1)
        both = np.linalg.qr(np.concatenate([both, rows])).R
    factor, right = both[: basis.size, : basis.size], both[: basis.size, basis.size]
    size = abs(np.diag(factor))
    if samples.size <= basis.size or size.min() <= 1e-10 * size.max():
        raise ValueError(
            f"c has {samples.size} samples that do not tell {basis.size} functions apart "
            f"(harmonics = {basis.harmonics}, degree = {basis.degree[1]}): ask for fewer, or measure "
            "more"
        )
    square = float(np.sum(both[basis.size :, basis.size] ** 2))
    coefficients = solve_triangular(factor, right).reshape(basis.shape)
    noise = math.sqrt(square / (samples.size - basis.size))
    return Fit(basis, coefficients, math.sqrt(square / samples.size), noise, factor)

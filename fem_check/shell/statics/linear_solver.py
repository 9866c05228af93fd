"""Direct solution with the symmetric matrix of a step, and the test for positive definiteness.

For a long, narrow sheet a banded Cholesky factor after reverse Cuthill-McKee numbering is faster than
sparse solvers; a wide unstructured outline uses SuperLU.
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from fem_check.plane_stress.factor import SparseFactor
from fem_check.shell.statics.sparsity import Sparsity

Array = NDArray[np.float64]

BAND_WORK = 2e10
"""n * half_width^2 up to which the banded solver is faster (about 4 s); it needs less than 1 GB."""


class Factor(Protocol):
    """A factorised positive definite matrix."""

    def solve(self, right: Array) -> Array:
        """Solution for a right-hand side (n,)."""


class BandedFactor:
    """Cholesky factor in LAPACK's band storage."""

    def __init__(self, band: Array) -> None:
        self._band = band

    def solve(self, right: Array) -> Array:
        """See Factor."""
        solution, _ = lapack.dpbtrs(self._band, right, lower=1)
        return np.asarray(solution)


def factorise(sparsity: Sparsity, values: Array) -> Factor | None:
    """Factor of the matrix with these stored entries; None if it is not positive definite."""
    if not np.all(np.isfinite(values)):
        return None
    if sparsity.size * float(sparsity.half_width) ** 2 <= BAND_WORK:
        return _banded(sparsity, values)
    return _sparse(sparsity, values)


def _banded(sparsity: Sparsity, values: Array) -> Factor | None:
    width = sparsity.half_width
    storage = np.zeros(sparsity.size * (width + 1))
    storage[sparsity.columns * width + sparsity.rows] = values
    band, failure = lapack.dpbtrf(storage.reshape(-1, width + 1).T, lower=1, overwrite_ab=1)
    return BandedFactor(band) if failure == 0 else None


def _sparse(sparsity: Sparsity, values: Array) -> Factor | None:
    factor = SparseFactor(sparsity.matrix(values))
    try:
        return factor if factor.is_definite else None
    except RuntimeError:  # exactly singular
        return None

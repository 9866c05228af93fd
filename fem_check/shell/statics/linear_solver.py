"""Direct solution with the symmetric matrix of a step, and the test for positive definiteness.

For a long, narrow sheet a banded Cholesky factor after reverse Cuthill-McKee numbering is faster than
sparse solvers; a wide unstructured outline uses SuperLU. Where distant parts of a sheet touch, entries
lie outside the band: then a small matrix is factorised as a dense one, a large one by SuperLU.
"""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from fem_check.plane_stress.factor import SparseFactor
from fem_check.shell.statics.sparsity import Sparsity

Array = NDArray[np.float64]

BAND_WORK = 2e10
"""n * half_width^2 up to which the banded solver is faster (about 4 s); it needs less than 1 GB."""


DENSE = 1500
"""Number n of unknowns up to which a matrix that is not banded is factorised as a dense one."""


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


class DenseFactor:
    """Cholesky factor of a full matrix."""

    def __init__(self, lower: Array) -> None:
        self._lower = lower

    def solve(self, right: Array) -> Array:
        """See Factor."""
        solution, _ = lapack.dpotrs(self._lower, right, lower=1)
        return np.asarray(solution)


def factorise(sparsity: Sparsity, values: Array, coupled: Any = None) -> Factor | None:
    """Factor of the matrix with these stored entries; None if it is not positive definite.

    coupled: a sparse matrix (n, n) that is added to it; None if there is none.
    """
    if not np.all(np.isfinite(values)):
        return None
    if coupled is not None:
        dense = sparsity.size <= DENSE
        return _dense(sparsity, values, coupled) if dense else _sparse(sparsity, values, coupled)
    if sparsity.size * float(sparsity.half_width) ** 2 <= BAND_WORK:
        return _banded(sparsity, values)
    return _sparse(sparsity, values)


def _banded(sparsity: Sparsity, values: Array) -> Factor | None:
    width = sparsity.half_width
    storage = np.zeros(sparsity.size * (width + 1))
    storage[sparsity.columns * width + sparsity.rows] = values
    band, failure = lapack.dpbtrf(storage.reshape(-1, width + 1).T, lower=1, overwrite_ab=1)
    return BandedFactor(band) if failure == 0 else None


def _dense(sparsity: Sparsity, values: Array, coupled: Any) -> Factor | None:
    full = np.asfortranarray(coupled.toarray())
    full[sparsity.rows, sparsity.columns] += values
    lower, failure = lapack.dpotrf(full, lower=1, overwrite_a=1)
    return DenseFactor(lower) if failure == 0 else None


def _sparse(sparsity: Sparsity, values: Array, coupled: Any = None) -> Factor | None:
    matrix = sparsity.matrix(values)
    factor = SparseFactor(matrix if coupled is None else matrix + coupled)
    try:
        return factor if factor.is_definite else None
    except RuntimeError:  # exactly singular
        return None

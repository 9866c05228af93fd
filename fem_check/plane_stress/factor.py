"""A sparse factorisation that can be copied and pickled."""

from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

Array = NDArray[np.float64]


class SparseFactor:
    """SuperLU factor of a symmetric matrix, without row exchanges.

    matrix: (n, n), sparse. SuperLU's own object can be neither copied nor pickled: copies hold the
    matrix and factorise it again on first use. Raises RuntimeError, on first use, for an exactly
    singular matrix.
    """

    def __init__(self, matrix: Any) -> None:
        self._matrix = sp.csc_matrix(matrix)

    @cached_property
    def lu(self) -> Any:
        """SuperLU's object."""
        options = {"SymmetricMode": True}
        return splu(self._matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)

    @property
    def is_definite(self) -> bool:
        """Whether the matrix is positive definite, by the signs of the diagonal of U."""
        unmoved = np.array_equal(self.lu.perm_r, self.lu.perm_c)  # no rows were exchanged
        return unmoved and bool(np.all(self.lu.U.diagonal() > 0))

    def solve(self, right: Array) -> Array:
        """Solution for right-hand sides (n,) or (n, cases)."""
        return np.asarray(self.lu.solve(right))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "lu"}

"""The lowest eigenvalue of a Hessian that is not positive definite, and its direction."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigsh

from fem_check.shell.statics.linear_solver import Factor
from fem_check.shell.statics.sparsity import Sparsity

Array = NDArray[np.float64]

NEUTRAL = 1e-10
"""Magnitude below which eigenvalues are due to rigid motions and roundoff, not buckling."""


def lowest_mode(sparsity: Sparsity, factor: Factor, shift: float, scale: Array) -> tuple[float, Array]:
    """Lowest eigenvalue and eigenvector of H x = lambda diag(scale) x.

    factor: of H + shift diag(scale), positive definite. scale (n,). The eigenvector (n,) of the free
    unknowns has arbitrary norm and sign. Lanczos iteration on the inverse of the shifted matrix, from a
    fixed start vector, so that results are reproducible.
    """
    root = np.sqrt(scale)
    inverse = LinearOperator(
        (sparsity.size,) * 2, matvec=lambda x: root * factor.solve(root * np.ravel(x)), dtype=float
    )
    start = np.random.default_rng(0).standard_normal(sparsity.size)
    largest, vectors = eigsh(inverse, k=1, which="LA", v0=start, tol=1e-6)
    return float(1 / largest[0] - shift), np.asarray(vectors[:, 0] / root)

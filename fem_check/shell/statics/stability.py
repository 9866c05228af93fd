"""The lowest eigenvalue of a Hessian that is not positive definite, its error, and its direction.

Whether a state is a saddle is a matter of the sign of that eigenvalue, which is 0 for a rigid motion
that nothing holds, and small near a critical load. The sign is known where the eigenvalue exceeds its
error: rounding of the entries of the Hessian, each known to some units of its last digit, and the
distance of the state to the equilibrium.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, eigsh

from fem_check.shell.statics.linear_solver import Factor
from fem_check.shell.statics.sparsity import Sparsity
from linear_theory.common.estimate import Estimate

Array = NDArray[np.float64]

UNITS = 16
"""Error of an entry of a Hessian in units of its last digit: sums over the points of two elements."""

OF_STATE = 10.0
"""Largest change of an eigenvalue by an error of the state, in units of that error over the size of the
sheet. Of random free sheets it was up to 3: the sign of smaller ones is judged after a correction."""


class LowestMode(NamedTuple):
    """Lowest eigenvalue of H x = lambda diag(scale) x with its error, and its eigenvector (n,)."""

    curvature: Estimate
    direction: Array

    @property
    def is_negative(self) -> bool:
        """Whether the eigenvalue is negative beyond its error."""
        return self.curvature.value < -self.curvature.error

    def depends_on(self, distance: float) -> bool:
        """Whether it is negative, but so little that an error of the state could be the reason.

        distance: of the state from the equilibrium, over the size of the sheet.
        """
        return self.is_negative and self.curvature.value > -OF_STATE * distance

    def after(self, before: "LowestMode") -> "LowestMode":
        """This one, with what a correction of the state has changed added to its error."""
        value, error = self.curvature
        changed = abs(value - before.curvature.value)
        return LowestMode(Estimate(value, error + changed), self.direction)


def lowest_mode(
    sparsity: Sparsity, values: Array, factor: Factor, shift: float, scale: Array, coupled: Any = None
) -> LowestMode:
    """Lowest eigenvalue and eigenvector of H x = lambda diag(scale) x.

    values: stored entries of H without those of `coupled`, a sparse matrix (n, n) or None. factor: of
    H + shift diag(scale), positive definite. scale (n,). The eigenvector of the free unknowns has
    arbitrary norm and sign. Lanczos iteration on the inverse of the shifted matrix, from a fixed start
    vector, so that results are reproducible. The error of the eigenvalue is that by rounding of H.
    """
    root = np.sqrt(scale)
    inverse = LinearOperator(
        (sparsity.size,) * 2, matvec=lambda x: root * factor.solve(root * np.ravel(x)), dtype=float
    )
    start = np.random.default_rng(0).standard_normal(sparsity.size)
    largest, vectors = eigsh(inverse, k=1, which="LA", v0=start, tol=1e-6)
    direction = np.asarray(vectors[:, 0] / root)
    rounding = UNITS * np.finfo(float).eps * _magnitude(sparsity, values, coupled, direction)
    return LowestMode(Estimate(float(1 / largest[0] - shift), rounding), direction)


def _magnitude(sparsity: Sparsity, values: Array, coupled: Any, direction: Array) -> float:
    """|x| . |H| |x|, the sum of the magnitudes of all terms of x . H x."""
    size = np.abs(direction)
    terms = np.abs(values) * size[sparsity.rows] * size[sparsity.columns]
    total = 2 * terms.sum() - terms[sparsity.diagonal].sum()
    return float(total if coupled is None else total + size @ (abs(coupled) @ size))

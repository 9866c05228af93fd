"""Curvature met along the last steps, by which a factor that is kept stays a good one.

The limited-memory BFGS method (Nocedal, Math. Comp. 35:773, 1980) with the factor as first guess: a
reused factor then converges faster than linearly, at the price of a few scalar products a step.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.statics.linear_solver import Factor

Array = NDArray[np.float64]

DEPTH = 6
"""Steps that are remembered."""

SMALLEST = 1e-8
"""Least curvature along a step, relative to the sum of the sizes of its terms, from which it teaches
something. Unknowns have several units, so that their squares must not be added."""


@dataclass(frozen=True, eq=False)
class Secants:
    """Steps (m, n) of n unknowns since the factorisation, and the changes of the gradient along them.

    The corrected Hessian maps the last step to the last change, and is positive definite.

    >>> import numpy as np
    >>> from fem_check.shell.statics.secants import Secants
    >>> class Identity:  # the factor of a matrix that is 2 in truth
    ...     def solve(self, right):
    ...         return right.copy()
    >>> known = Secants().with_step(np.array([1.0, 0.0]), np.array([2.0, 0.0]))
    >>> print(known.solve(Identity(), np.array([2.0, 2.0])))
    [1. 2.]
    """

    steps: tuple[Array, ...] = ()
    changes: tuple[Array, ...] = ()

    def with_step(self, step: Array, change: Array) -> "Secants":
        """With one step (n,) more, if the energy is convex along it."""
        if not step @ change > SMALLEST * float(abs(step) @ abs(change)):
            return self
        return Secants((*self.steps[1 - DEPTH :], step), (*self.changes[1 - DEPTH :], change))

    def solve(self, factor: Factor, gradient: Array) -> Array:
        """The inverse of the corrected Hessian times a gradient, (n,)."""
        pairs = [(s, c, float(s @ c)) for s, c in zip(self.steps, self.changes, strict=True)]
        right, shares = gradient.copy(), []
        for step, change, curvature in reversed(pairs):
            shares.append(float(step @ right) / curvature)
            right -= shares[-1] * change
        found = factor.solve(right)
        for (step, change, curvature), share in zip(pairs, reversed(shares), strict=True):
            found += (share - float(change @ found) / curvature) * step
        return found


NO_SECANTS = Secants()
"""Right after a factorisation."""

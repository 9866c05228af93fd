"""The result of a minimisation, and the failure to find one."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from linear_theory.errors import SheetcrawlError

Array = NDArray[np.float64]


class ConvergenceError(SheetcrawlError, RuntimeError):
    """No minimum was found. `state` (size,): the last that was reached, at `parameter` of a ramp."""

    def __init__(self, message: str, state: Array, parameter: float = 1.0) -> None:
        super().__init__(message)
        self.state, self.parameter = state, parameter


class UnstableError(ConvergenceError):
    """A minimum for its mesh alone: waves too short for that mesh would lower the energy."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A state in which the free unknowns carry no force.

    state (size,): unknowns. energy: of all effects, force times length. iterations: of Newton's
    method, all steps of a ramp together. residual: root mean square over the sheet of the last
    correction, in units of length; what is left after it is smaller, about its square. seconds: time
    spent. negative_curvature: lowest eigenvalue of the Hessian scaled to a unit diagonal, NaN where
    it is positive definite. mode (size,): its direction, largest component 1 in the units of
    `Discretisation.units`; None where there is none.
    """

    state: Array
    energy: float
    iterations: int
    residual: float
    seconds: float
    negative_curvature: float = np.nan
    mode: Array | None = field(default=None, repr=False)

    @property
    def buckled(self) -> bool:
        """Whether the energy falls in some direction, so that this is a saddle and no minimum."""
        return self.mode is not None

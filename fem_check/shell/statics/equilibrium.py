"""The result of a minimisation, and the failure to find one."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]


class ConvergenceError(SheetcrawlError, RuntimeError):
    """No minimum was found. `state` (size,): the last that was reached, at `parameter` of a ramp."""

    def __init__(self, message: str, state: Array, parameter: float = 1.0) -> None:
        super().__init__(message)
        self.state, self.parameter = state, parameter


class UnstableError(ConvergenceError):
    """A minimum for its mesh alone: waves too short for that mesh would lower the energy."""


@dataclass(frozen=True, eq=False)
class Equilibrium(Shown):
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

    def _rows(self) -> Mapping[str, Any]:
        """Without the lowest curvature where it is positive and was not computed."""
        rows = {**super()._rows(), "buckled": self.buckled}
        return rows if self.buckled else {k: v for k, v in rows.items() if k != "negative_curvature"}

    @property
    def buckled(self) -> bool:
        """Whether the energy falls in some direction, so that this is a saddle and no minimum."""
        return self.mode is not None

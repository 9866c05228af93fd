"""The result of a minimisation, and its failure."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]


class ConvergenceError(SheetcrawlError, RuntimeError):
    """No minimum was found. `state` (size,): the last one reached, at `parameter` of a ramp."""

    def __init__(self, message: str, state: Array, parameter: float = 1.0) -> None:
        super().__init__(message)
        self.state, self.parameter = state, parameter


class UnstableError(ConvergenceError):
    """A minimum on its mesh only: waves too short for the mesh would lower the energy."""


@dataclass(frozen=True, eq=False)
class Equilibrium(Shown):
    """A state in which the free unknowns carry no force.

    state (size,): unknowns. energy: of all effects, force times length. iterations: of Newton's
    method, summed over a ramp. residual: root mean square over the sheet of the last correction, in
    units of length; the remaining error is about its square. seconds: computing time.
    negative_curvature: lowest eigenvalue of the Hessian scaled to a unit diagonal, and
    curvature_error, its error by rounding and by that of the state; NaN if it is not negative by more
    than that. mode (size,): its eigenvector, largest component 1 in the units of
    `Discretisation.units`; None if there is none.
    """

    state: Array
    energy: float
    iterations: int
    residual: float
    seconds: float
    negative_curvature: float = np.nan
    curvature_error: float = np.nan
    mode: Array | None = field(default=None, repr=False)

    def _rows(self) -> Mapping[str, Any]:
        """All values, without the lowest curvature if positive, when it is not computed."""
        rows = {**super()._rows(), "buckled": self.buckled}
        unknown = () if self.buckled else ("negative_curvature", "curvature_error")
        return {name: value for name, value in rows.items() if name not in unknown}

    @property
    def buckled(self) -> bool:
        """Whether the energy decreases in some direction, beyond the error: a saddle, not a minimum."""
        return self.mode is not None

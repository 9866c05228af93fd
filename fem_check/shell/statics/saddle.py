"""Whether an equilibrium is a saddle, by the lowest curvature of its energy."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.stability import LowestMode, lowest_mode
from linear_theory.common.estimate import Estimate

if TYPE_CHECKING:
    from fem_check.shell.statics.newton import Minimiser

Array = NDArray[np.float64]


class Saddle(NamedTuple):
    """Lowest eigenvalue of the Hessian scaled to a unit diagonal, and its eigenvector (size,).

    mode: its largest component is 1 in the units of `Discretisation.units`; None, with a curvature of
    NaN, if the eigenvalue is not negative by more than its error: a minimum.
    """

    curvature: Estimate
    mode: Array | None


NO_SADDLE = Saddle(Estimate(np.nan, np.nan), None)


def saddle(minimiser: "Minimiser", potential: Potential, state: Array, distance: float) -> Saddle:
    """The lowest curvature at a state (size,) and its direction, if it is negative.

    distance: of the state from the equilibrium, root mean square, length. An eigenvalue so small that
    this could be the reason for its sign is computed again one correction nearer, and its error
    counts the difference. Keeps the factor at the state.
    """
    if minimiser.sparsity.size == 0:
        return NO_SADDLE
    lowest = _lowest(minimiser, potential, state)
    if lowest is not None and lowest.depends_on(distance / minimiser.length):
        lowest = _nearer(minimiser, potential, state, lowest)
    if lowest is None or not lowest.is_negative:
        return NO_SADDLE
    mode = np.zeros_like(state)
    lengths = lowest.direction / minimiser.units
    mode[minimiser.sparsity.order] = lowest.direction / lengths[np.abs(lengths).argmax()]
    return Saddle(lowest.curvature, mode)


def _lowest(minimiser: "Minimiser", potential: Potential, state: Array) -> LowestMode | None:
    """That of the Hessian at a state, to rounding; None if it is positive definite."""
    here = minimiser.factorised(potential, state, 0.0, convex=False)
    minimiser.kept = here
    if here.shift == 0:
        return None
    matrix = here.values, here.factor, here.shift, here.scale, here.coupled
    return lowest_mode(minimiser.sparsity, *matrix)


def _nearer(
    minimiser: "Minimiser", potential: Potential, state: Array, before: LowestMode
) -> LowestMode | None:
    """That of a state one correction nearer to the equilibrium."""
    here, order = minimiser.kept, minimiser.sparsity.order
    assert here is not None
    step = np.zeros_like(state)
    step[order] = -here.factor.solve(potential.gradient(state)[order])
    lowest = _lowest(minimiser, potential, state + step)
    minimiser.kept = here
    return None if lowest is None else lowest.after(before)

"""Zeros of many expensive monotone functions at once, in as few evaluations as possible.

(`roots` is for cheap functions whose zeros are needed to the last digit.)
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.errors import NotConvergedError

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Problem = Callable[[Array, Integers], tuple[Array, Array]]

_MOST_EVALUATIONS = 120
_PATIENCE = 10  # number of Newton steps after which every second step becomes a bisection


def guarded_newton(
    function: Problem, start: Array, low: Array, high: Array, xtol: float, near: float = 0.0
) -> Array:
    """Zeros of N increasing functions with low < zero < high, (N,) each.

    function(x, which): values and slopes at x of the functions with indices `which`. Newton steps until
    a step is below xtol, or below `near`, after which the error is known to be below xtol. Every
    evaluation narrows the bracket; where a step would leave it, the bracket is halved. Where a function
    jumps through zero, the place of the jump is returned. Raises NotConvergedError, with the last
    iterates.
    """
    x, low, high = start.copy(), low.copy(), high.copy()
    active = np.arange(start.size)
    for evaluation in range(_MOST_EVALUATIONS):
        value, slope = function(x[active], active)
        _require_finite(value, x)
        rising = value > 0
        high[active[rising]] = x[active[rising]]
        low[active[~rising]] = x[active[~rising]]
        below, above = low[active], high[active]
        with np.errstate(divide="ignore", invalid="ignore"):
            new = x[active] - value / slope
        outside = ~((new >= below) & (new <= above)) | ~np.isfinite(slope)
        if evaluation > _PATIENCE and evaluation % 2:
            outside[:] = True
        new = np.where(value == 0, x[active], np.where(outside, (below + above) / 2, new))
        moved = abs(new - x[active])
        x[active] = new
        active = active[moved > np.where(outside, xtol, max(xtol, near))]
        if not active.size:
            return x
    raise NotConvergedError(f"{active.size} of {x.size} zeros not found to {xtol:g}", x)


def damped_newton(function: Problem, start: Array, xtol: float, near: float = 0.0) -> Array:
    """Zeros of the gradients of N convex functions of J variables, (N, J).

    function(x, which): gradients (n, J) and Hessians (n, J, J). Along a Newton step the derivative of a
    convex function increases through zero: a step that ends far beyond the zero is halved, even where
    the gradient saturates and its size carries no information. Stops as `guarded_newton` does.
    Raises NotConvergedError, with the last iterates.
    """
    x, step = start.copy(), np.zeros_like(start)
    fall = np.full(start.shape[0], np.inf)  # minus the directional derivative at the start of a step
    active = np.arange(start.shape[0])
    for _ in range(_MOST_EVALUATIONS):
        gradient, hessian = function(x[active], active)
        _require_finite(gradient, x)
        behind = (gradient * step[active]).sum(1) > 0.5 * fall[active]
        back, ahead = active[behind], active[~behind]
        step[back] /= 2
        fall[back] /= 2
        x[back] -= step[back]
        if ahead.size:
            slope = hessian[~behind]
            floor = 1e-14 * np.trace(slope, axis1=1, axis2=2)[:, None, None] * np.eye(start.shape[1])
            step[ahead] = np.linalg.solve(slope + floor, -gradient[~behind][:, :, None])[:, :, 0]
            fall[ahead] = -(gradient[~behind] * step[ahead]).sum(1)
            x[ahead] += step[ahead]
        moved = abs(step[active]).max(1)
        active = active[moved > np.where(behind, xtol, max(xtol, near))]
        if not active.size:
            return x
    raise NotConvergedError(f"{active.size} of {len(x)} balances not found to {xtol:g}", x)


def _require_finite(value: Array, x: Array) -> None:
    if not np.all(np.isfinite(value)):
        raise NotConvergedError("the value of a function is not finite", x)

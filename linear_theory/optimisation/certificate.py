"""Whether a point is a maximum: the projected gradient, and the curvature where it could still rise.

At a maximum the gradient is a combination, with multipliers >= 0, of the normals of the bounds and
constraints that are met with equality (Karush, Kuhn and Tucker). What is left of it after the best such
combination is the projected gradient p. Along the directions that leave no constraint, Z, the second
derivatives H of the objective less its constraints give the largest gain of the quadratic model: for
every eigenvector e of Z^T H Z, of eigenvalue l,

    max over d of (p . e) d + l d^2/2,

as far as the bounds and the other constraints, linearised, allow, and |d| <= 1.

The sum of these is the `gain` that may have been left. It is infinite at no point, large where the
gradient is, or where the point is a saddle, and zero at a maximum. Of an objective whose second
derivatives are not computed it is the linear model's, |p|.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.optimize import nnls

from linear_theory.common.shown import Shown
from linear_theory.optimisation.problem import Evaluation, Objective, Region, Unusable

Array = NDArray[np.float64]

ACTIVE = 1e-6
"""Distance to a bound or a constraint within which it is met with equality: both are scaled to 1."""

GAIN = 0.02
"""Share of the value that may be left for a result to be called converged: of the quadratic model, with
the errors of the gradient and the distance of a smoothed objective from the true one."""

HELD = 1e-9
"""Multipliers above this share of the gradient hold the point at a constraint, which cannot be left."""

FINEST, COARSEST = 1e-5, 0.03
"""Steps of the differences of gradients, of the whole range."""


@dataclass(frozen=True)
class Certificate(Shown):
    """What speaks for a maximum, and what against it.

    slope: of the objective in the steepest direction that leaves no constraint, for a step of the whole
    range; doubt: of it, from the error of the gradient. gain: what may have been left, see the module,
    with that error; NaN if the error is not known. highest: the largest eigenvalue of the reduced
    Hessian, negative at a maximum; NaN if it was not computed, and minus infinity if no direction is
    left. held: names of the constraints that hold the point; multipliers (unknowns,): dV for a bound
    that is moved by 1, negative for a lower one. kink: why the gradient is one from one side, in words.
    value: of the objective.
    """

    value: float
    slope: float
    doubt: float
    gain: float
    highest: float
    held: tuple[str, ...]
    multipliers: Array
    kink: str = ""

    def holds(self, rtol: float) -> bool:
        """Whether no gain above that share of the value is left, errors included, and none unknown."""
        return not self.kink and self.gain <= rtol * abs(self.value)


def certificate(
    objective: Objective, region: Region, point: Array, names: Sequence[str], second: bool = True
) -> Certificate:
    """Of a point inside a region. names: of the unknowns. second: whether to compute the curvature."""
    found = objective(point)
    met = _met(region, point, names)
    normals = np.array([one.normal for one in met]).reshape(len(met), point.size)
    pushes, left = _projected(found.gradient, normals)
    held = pushes > HELD * max(float(np.linalg.norm(found.gradient)), 1e-300)
    multipliers = np.zeros(point.size)
    for push, one in zip(pushes, met, strict=True):
        if one.unknown >= 0:
            multipliers[one.unknown] += push * one.sign
    free = null_space(normals[held]) if held.any() else np.eye(point.size)
    slope, doubt = float(np.linalg.norm(left)), float(np.linalg.norm(abs(free.T) @ found.doubt))
    gain, highest = slope + doubt, math.nan
    if second:
        pushed = [(push, one) for push, one in zip(pushes, met, strict=True) if push]
        gain, highest = _second(objective, region, point, found, free, pushed, left)
    if math.isnan(doubt):
        gain = math.nan
    return Certificate(
        value=found.value,
        slope=slope,
        doubt=doubt,
        gain=gain,
        highest=highest,
        held=tuple(dict.fromkeys(one.name for one, h in zip(met, held, strict=True) if h)),
        multipliers=multipliers,
        kink=found.kink,
    )


class _Met(NamedTuple):
    """A bound (of an unknown, an upper or a lower one) or a row of a constraint, met with equality."""

    name: str
    normal: Array
    unknown: int = -1
    sign: float = 1.0
    constraint: int = -1
    row: int = -1


def _met(region: Region, point: Array, names: Sequence[str]) -> list[_Met]:
    """All that is met with equality, with outward normals (unknowns,)."""
    found, axes = [], np.eye(point.size)
    for place, name in enumerate(names):
        if region.high[place] - point[place] <= ACTIVE:
            found.append(_Met(f"upper bound of {name}", axes[place], place))
        if point[place] - region.low[place] <= ACTIVE:
            found.append(_Met(f"lower bound of {name}", -axes[place], place, -1.0))
    for number, constraint in enumerate(region.constraints):
        slopes = constraint.slopes(point)
        for row in np.flatnonzero(constraint.excess(point) >= -ACTIVE):
            found.append(_Met(constraint.name, slopes[row], constraint=number, row=int(row)))
    return found


def _projected(gradient: Array, normals: Array) -> tuple[Array, Array]:
    """Multipliers >= 0 of the normals that leave the least of a gradient, and what they leave."""
    if not normals.size:
        return np.zeros(0), gradient
    pushes, _ = nnls(normals.T, gradient)
    return pushes, gradient - normals.T @ pushes


def _second(
    objective: Objective,
    region: Region,
    point: Array,
    found: Evaluation,
    free: Array,
    pushed: list[tuple[float, _Met]],
    left: Array,
) -> tuple[float, float]:
    """Gain of the quadratic model in the free directions, (unknowns, directions), and the largest
    eigenvalue; the linear gain and NaN where the neighbours of the point have no gradient."""
    if not free.shape[1]:
        return 0.0, -math.inf
    try:
        hessian = _reduced(objective, region, point, found, free)
    except Unusable:
        size = np.linalg.norm(left) + np.linalg.norm(abs(free.T) @ found.doubt)
        return float(size), math.nan
    for push, one in pushed:
        if one.constraint >= 0:
            constraint = region.constraints[one.constraint]
            row = np.eye(constraint.excess(point).size)[one.row]
            hessian -= free.T @ constraint.curvature(push * row) @ free
    values, vectors = np.linalg.eigh((hessian + hessian.T) / 2)
    gain = 0.0
    for curvature, direction in zip(values, (free @ vectors).T, strict=True):
        slope, doubt = float(direction @ left), float(abs(direction) @ found.doubt)
        room = _room(region, point, direction)
        gain += max(_gain(slope + sign * doubt, float(curvature), *room) for sign in (1, -1))
    return gain, float(values[-1])


def _room(region: Region, point: Array, direction: Array) -> tuple[float, float]:
    """How far one may go along a direction and against it, at most 1, by the linearised constraints.

    Those that are met with equality do not count: directions leave none of them.
    """
    moves = [direction, -direction]
    gaps = [region.high - point, point - region.low]
    for constraint in region.constraints:
        moves.append(constraint.slopes(point) @ direction)
        gaps.append(-constraint.excess(point))
    move, gap = np.concatenate(moves), np.concatenate(gaps)
    counts = gap > ACTIVE
    with np.errstate(divide="ignore", invalid="ignore"):
        steps = gap[counts] / abs(move[counts])
    ahead, behind = (steps[sign * move[counts] > 0] for sign in (1, -1))
    return float(np.min(ahead, initial=1.0)), float(np.min(behind, initial=1.0))


def _gain(slope: float, curvature: float, ahead: float, behind: float) -> float:
    """Largest slope d + curvature d^2/2 for -behind <= d <= ahead."""
    ends = [0.0] + [slope * d + curvature * d * d / 2 for d in (ahead, -behind)]
    if curvature < 0 and -behind < -slope / curvature < ahead:
        ends.append(slope * slope / (-2 * curvature))
    return max(ends)


def _reduced(
    objective: Objective, region: Region, point: Array, found: Evaluation, free: Array
) -> Array:
    """Second derivatives in the free directions, by central differences of gradients."""
    scale = max(abs(found.value), float(np.linalg.norm(found.gradient)), 1e-300)
    step = min(max(math.sqrt(float(found.doubt.max()) / scale), FINEST), COARSEST)
    columns = []
    for direction in free.T:
        move = step * direction
        ahead, behind = objective(point + move), objective(point - move)
        columns.append(free.T @ (ahead.gradient - behind.gradient) / (2 * step))
    return np.array(columns).T

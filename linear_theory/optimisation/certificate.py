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

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.optimize import nnls

from linear_theory.common.shown import Shown
from linear_theory.optimisation.limits import Beside, Worst
from linear_theory.optimisation.problem import Evaluation, Limited, Objective, Region, Unusable

Array = NDArray[np.float64]

ACTIVE = 1e-6
"""Distance to a bound or a constraint within which it is met with equality: both are scaled to 1."""

NEAR = 1e-4
"""The same of a limit on a computed number, to which the search keeps a margin."""

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
    value: of the objective. pushes: multipliers of the constraints and limits that hold the point, and
    of the smallest of several objectives, by name, as they are scaled.
    """

    value: float
    slope: float
    doubt: float
    gain: float
    highest: float
    held: tuple[str, ...]
    multipliers: Array
    kink: str = ""
    pushes: Mapping[str, float] = field(default_factory=dict)

    def holds(self, rtol: float) -> bool:
        """Whether no gain above that share of the value is left, errors included, and none unknown."""
        return not self.kink and self.gain <= rtol * abs(self.value)


def certificate(
    objective: Objective, region: Region, point: Array, names: Sequence[str], second: bool = True
) -> Certificate:
    """Of a point inside a region. names: of the unknowns. second: whether to compute the curvature."""
    if isinstance(objective, Worst):
        return _of_the_worst(objective, region, point, names, second)
    found = objective(point)
    met = _met(region, point, names)
    normals = np.array([one.normal for one in met]).reshape(len(met), point.size)
    pushes, left = _projected(found.gradient, normals)
    held = pushes > HELD * max(float(np.linalg.norm(found.gradient)), 1e-300)
    multipliers, sums = np.zeros(point.size), dict[str, float]()
    for push, one in zip(pushes[held], itertools.compress(met, held), strict=True):
        if one.unknown >= 0:
            multipliers[one.unknown] += push * one.sign
        else:
            sums[one.name] = sums.get(one.name, 0.0) + float(push)
    pushed = [(push, one) for push, one in zip(pushes, met, strict=True) if push]
    found = _with_limits(found, region, point, pushed)
    free = null_space(normals[held]) if held.any() else np.eye(point.size)
    slope, doubt = float(np.linalg.norm(left)), float(np.linalg.norm(abs(free.T) @ found.doubt))
    gain, highest = slope + doubt, math.nan
    if second:
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
        pushes=sums,
    )


def _of_the_worst(
    worst: Worst, region: Region, point: Array, names: Sequence[str], second: bool
) -> Certificate:
    """In the epigraph form, with the smallest value as one more unknown."""
    found = worst(point)
    scale = max(abs(found.value), float(np.linalg.norm(found.gradient)), 1e-300)
    lifted = Region(
        low=np.append(region.low, -np.inf),
        high=np.append(region.high, np.inf),
        centre=np.append(region.centre, 0.0),
        spread=np.append(region.spread, 1.0),
        constraints=tuple(Beside(one) for one in region.constraints),
        limits=(*(Beside(one) for one in region.limits), *worst.lifted(scale)),
    )

    def height(at: Array) -> Evaluation:
        last = scale * np.eye(at.size)[-1]
        return Evaluation(scale * float(at[-1]), found.error, last, np.zeros(at.size))

    top = np.append(point, found.value / scale)
    proof = certificate(height, lifted, top, [*names, "the worst"], second)
    return replace(proof, multipliers=proof.multipliers[:-1])


def _with_limits(
    found: Evaluation, region: Region, point: Array, pushed: "list[tuple[float, _Met]]"
) -> Evaluation:
    """With the errors and the kinks of the limits that hold the point."""
    doubt, kinks = found.doubt, [found.kink]
    for push, one in pushed:
        if one.limit >= 0:
            limit = region.limits[one.limit]
            doubt = doubt + push * limit.doubt(point)
            kinks.append(limit.kink(point))
    return replace(found, doubt=doubt, kink="; ".join(dict.fromkeys(filter(None, kinks))))


class _Met(NamedTuple):
    """A bound (of an unknown, an upper or a lower one) or a row of a constraint, met with equality."""

    name: str
    normal: Array
    unknown: int = -1
    sign: float = 1.0
    constraint: int = -1
    row: int = -1
    limit: int = -1


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
    for number, limit in enumerate(region.limits):
        if float(limit.excess(point)[0]) >= -NEAR:
            found.append(_Met(limit.name, limit.slopes(point)[0], limit=number))
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
        limited = [(push, region.limits[one.limit]) for push, one in pushed if one.limit >= 0]
        hessian = _reduced(_less(objective, limited), point, found, free)
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
    for limit in region.limits:
        moves.append(limit.slopes(point) @ direction)
        gaps.append(np.maximum(-limit.excess(point) - (NEAR - ACTIVE), 0.0))
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


def _less(objective: Objective, limited: Sequence[tuple[float, Limited]]) -> Objective:
    """The objective less the limits that hold the point, of its gradient alone."""

    def evaluated(point: Array) -> Evaluation:
        found = objective(point)
        normals = [push * limit.slopes(point)[0] for push, limit in limited]
        return replace(found, gradient=found.gradient - sum(normals, np.zeros(point.size)))

    return evaluated if limited else objective


def _reduced(objective: Objective, point: Array, found: Evaluation, free: Array) -> Array:
    """Second derivatives in the free directions, by central differences of gradients."""
    scale = max(abs(found.value), float(np.linalg.norm(found.gradient)), 1e-300)
    step = min(max(math.sqrt(float(found.doubt.max()) / scale), FINEST), COARSEST)
    columns = []
    for direction in free.T:
        move = step * direction
        ahead, behind = objective(point + move), objective(point - move)
        columns.append(free.T @ (ahead.gradient - behind.gradient) / (2 * step))
    return np.array(columns).T

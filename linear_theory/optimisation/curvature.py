"""The gain of the quadratic model about a point, see `certificate`."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.optimisation.held import ACTIVE, NEAR, Met
from linear_theory.optimisation.problem import Evaluation, Limited, Objective, Region, Unusable

Array = NDArray[np.float64]

FINEST, COARSEST, FARTHEST = 1e-5, 0.03, 0.25
"""Steps of the differences of gradients, of the whole range: least and most, and most where the errors
of the gradients ask for more and there is room."""


def second_order_gain(
    objective: Objective,
    region: Region,
    point: Array,
    found: Evaluation,
    free: Array,
    pushed: list[tuple[float, Met]],
    left: Array,
) -> tuple[float, float]:
    """Gain of the quadratic model in the free directions, (unknowns, directions), and the largest
    eigenvalue; the linear gain and NaN where the neighbours of the point have no gradient."""
    if not free.shape[1]:
        return 0.0, -math.inf
    try:
        limited = [(push, region.limits[one.limit]) for push, one in pushed if one.limit >= 0]
        room = [_room(region, point, direction) for direction in free.T]
        steps = _steps(found, room)
        hessian, doubts = _reduced(_less(objective, limited), point, free, steps)
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
        unsure = float(abs(direction) @ np.maximum(doubts, found.doubt)) / steps.min()
        ahead, behind = _room(region, point, direction)
        gain += max(
            _gain(slope + sign * doubt, float(curvature) + unsure, ahead, behind) for sign in (1, -1)
        )
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


def _steps(found: Evaluation, room: Sequence[tuple[float, float]]) -> Array:
    """Of the differences in each direction, as far as there is room there (directions,)."""
    scale = max(abs(found.value), float(np.linalg.norm(found.gradient)), 1e-300)
    step = max(math.sqrt(float(found.doubt.max()) / scale), FINEST)
    return np.array([min(step, max(COARSEST, min(FARTHEST, *one))) for one in room])


def _reduced(objective: Objective, point: Array, free: Array, steps: Array) -> tuple[Array, Array]:
    """Second derivatives in the free directions, by central differences of gradients.

    Second: the largest errors of these gradients, (unknowns,).
    """
    columns, doubts = [], np.zeros(point.size)
    for direction, step in zip(free.T, steps, strict=True):
        move = step * direction
        ahead, behind = objective(point + move), objective(point - move)
        columns.append(free.T @ (ahead.gradient - behind.gradient) / (2 * step))
        doubts = np.maximum(doubts, (ahead.doubt + behind.doubt) / 2)
    return np.array(columns).T, doubts

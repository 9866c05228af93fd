"""Whether a point is a maximum: the projected gradient, and the curvature where it could still rise.

At a maximum the gradient is a combination, with multipliers >= 0, of the normals of the bounds and
constraints that are met with equality (Karush, Kuhn and Tucker). What is left of it after the best such
combination is the projected gradient p. Along the directions that leave no constraint, Z, the second
derivatives H of the objective less its constraints give the largest gain of the quadratic model: for
every eigenvector e of Z^T H Z, of eigenvalue l,

    max over d of (p . e) d + l d^2/2,

as far as the bounds and the other constraints, linearised, allow, and |d| <= 1. Errors count: a slope
along e that may be wrong by s may be so on either side, and with it l, the difference of two slopes at
the distance 2 h, by s/h. Where that leaves no curvature, as at a kink, the gain is that of the slope.

The sum of these is the `gain` that may have been left. It is infinite at no point, large where the
gradient is, or where the point is a saddle, and zero at a maximum. Of an objective whose second
derivatives are not computed it is the linear model's, |p|.
"""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space

from linear_theory.common.shown import Shown
from linear_theory.optimisation.curvature import second_order_gain
from linear_theory.optimisation.held import Met, met, projected
from linear_theory.optimisation.limits import Beside, Worst
from linear_theory.optimisation.problem import Evaluation, Objective, Region

Array = NDArray[np.float64]

GAIN = 0.02
"""Share of the value that may be left for a result to be called converged: of the quadratic model, with
the errors of the gradient and the distance of a smoothed objective from the true one."""

HELD = 1e-9
"""Multipliers above this share of the gradient hold the point at a constraint, which cannot be left."""


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
    holding = met(region, point, names)
    normals = np.array([one.normal for one in holding]).reshape(len(holding), point.size)
    pushes, left = projected(found.gradient, normals)
    held = pushes > HELD * max(float(np.linalg.norm(found.gradient)), 1e-300)
    multipliers, sums = np.zeros(point.size), dict[str, float]()
    for push, one in zip(pushes[held], itertools.compress(holding, held), strict=True):
        if one.unknown >= 0:
            multipliers[one.unknown] += push * one.sign
        else:
            sums[one.name] = sums.get(one.name, 0.0) + float(push)
    pushed = [(push, one) for push, one in zip(pushes, holding, strict=True) if push]
    found = _with_limits(found, region, point, pushed)
    free = null_space(normals[held]) if held.any() else np.eye(point.size)
    slope, doubt = float(np.linalg.norm(left)), float(np.linalg.norm(abs(free.T) @ found.doubt))
    gain, highest = slope + doubt, math.nan
    if second:
        gain, highest = second_order_gain(objective, region, point, found, free, pushed, left)
    if math.isnan(doubt):
        gain = math.nan
    return Certificate(
        value=found.value,
        slope=slope,
        doubt=doubt,
        gain=gain,
        highest=highest,
        held=tuple(dict.fromkeys(one.name for one, h in zip(holding, held, strict=True) if h)),
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
    found: Evaluation, region: Region, point: Array, pushed: "list[tuple[float, Met]]"
) -> Evaluation:
    """With the errors and the kinks of the limits that hold the point."""
    doubt, kinks = found.doubt, [found.kink]
    for push, one in pushed:
        if one.limit >= 0:
            limit = region.limits[one.limit]
            doubt = doubt + push * limit.doubt(point)
            kinks.append(limit.kink(point))
    return replace(found, doubt=doubt, kink="; ".join(dict.fromkeys(filter(None, kinks))))

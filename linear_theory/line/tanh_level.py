"""Balance of the friction law tanh(v/v0) on a body that carries a travelling wave.

In units of |alpha|/(nT), V is the root q of

    int w tanh X dphi = 0,   X = (q + mean z - z)/width.

Where the wave is symmetric, so that int tanh(Y) dphi = 0 for Y = -s_1 g/width, q is of order alpha
like mean z and w/w_0 - 1 are, and the same integral is written without cancellation as

    int [tanh(X - Y) (1 - tanh X tanh Y) + (w/w_0 - 1) tanh X] dphi.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Tanh
from linear_theory.line.body import Body
from linear_theory.line.profile import GAUSS_NODES, GAUSS_WEIGHTS, MOST_HALVINGS, Profile, polynomial
from linear_theory.line.result import Level
from linear_theory.line.roots import EPS, bracketed_newton

Array = NDArray[np.float64]

SATURATED = 20.0
"""|tanh(x)| = 1 to rounding beyond this."""

UNIT = Tanh(1.0)
"""The law for speeds in slip speeds."""

NARROWEST = 1e-290
"""Least slip speed, relative to the range of speeds: by a smaller one, or a subnormal one, a division
would overflow. It changes q by as much at most."""


def not_narrower(law: FrictionLaw, width: float) -> FrictionLaw:
    """The law, or that of its kind with this width where its own is smaller."""
    return law if law.width >= width else law.scaled(law.width / width)


def tanh_level(body: Body, width: float, guess: float) -> Level:
    """q for a slip speed of `width`."""
    symmetric = body.profile.symmetric
    if symmetric:
        body = Body(body.profile.anchored(0.0), body.growth, body.size)

    def balance(level: Array, finer: float = 1.0) -> tuple[Array, Array]:
        return _balance(body, float(level), width, finer)

    span = body.range[1] - body.range[0]
    width = max(width, NARROWEST * span)
    coarse = NARROWEST * span if symmetric else 4 * EPS * span
    level = float(bracketed_newton(balance, *body.range, guess, atol=coarse))
    miss, slope = balance(np.array(level), finer=0.5)
    noise = 0.0 if symmetric else 4 * EPS * _weight(body)
    error = float((abs(miss) + noise) / slope) + 16 * EPS * abs(level) + coarse + body.noise
    return Level(level, error)


def _weight(body: Body) -> float:
    """Mean of w/w_0."""
    return 1 + body.profile.mean(body.gain)


def _balance(body: Body, level: float, width: float, finer: float) -> tuple[Array, Array]:
    """Integral of (w/w_0) tanh X over the period, and its derivative by the level."""

    def arguments(g: Array) -> Array:
        shift = level + body.mean_height - body.bent(g)
        return np.stack([shift - body.straight(g), -body.straight(g), shift]) / width

    measure, g = quadrature(body.profile, lambda g: arguments(g)[:2], finer)
    (x, y, gap), gain = arguments(g)[:, None], body.gain(g)
    symmetric = body.profile.symmetric
    met, moved = UNIT.at(y).moved(gap, 1.0) if symmetric else (UNIT.at(x), None)
    force, tangent = met.force[0], met.tangent[0]
    lacking = (1 + gain) * force if moved is None else moved[0] + gain * force
    return np.array(measure @ lacking), np.array((measure * (1 + gain)) @ tangent / width)


def quadrature(
    profile: Profile, arguments: Callable[[Array], Array], finer: float
) -> tuple[Array, Array]:
    """Weights (of the period) and values of g at Gauss points that resolve tanh of the arguments."""
    measure, _, values = phased_quadrature(profile, arguments, finer)
    return measure, values


def phased_quadrature(
    profile: Profile, arguments: Callable[[Array], Array], finer: float
) -> tuple[Array, Array, Array]:
    """The same with the phases of the points, in radians, between."""
    node, left, right = _panels(profile, arguments, finer)
    half = (right - left) / 2
    distance = left + half + half * GAUSS_NODES[:, None]
    values = polynomial(profile.taylor[:, node], distance)
    measure = (GAUSS_WEIGHTS[:, None] * abs(half) / (2 * math.pi)).ravel()
    return measure, (profile.nodes[node] + distance).ravel(), values.ravel()


def _panels(
    profile: Profile, arguments: Callable[[Array], Array], widest: float
) -> tuple[NDArray[np.intp], Array, Array]:
    """Node and signed distances from it of both ends of every panel of the quadrature.

    Cells are halved until each argument, monotone on a cell, varies by less than `widest` over it or
    stays SATURATED.
    """
    # From the end nearer to 0, as g is exact at nodes of value 0: `width` may be below rounding.
    node = np.arange(profile.nodes.size - 1)
    ahead = abs(profile.values[:-1]) <= abs(profile.values[1:])
    right = np.where(ahead, 1.0, -1.0) * np.diff(profile.nodes)
    node, left = np.where(ahead, node, node + 1), np.zeros(node.size)
    finished = []
    for left_over in range(MOST_HALVINGS, -1, -1):
        ends = arguments(polynomial(profile.taylor[:, node], np.stack([left, right])))
        low, high = ends.min(axis=1), ends.max(axis=1)
        near = (low < SATURATED) & (high > -SATURATED)
        split = np.any(near & (high - low > widest), axis=0) & (left_over > 0)
        finished.append((node[~split], left[~split], right[~split]))
        if not split.any():
            break
        node, left, right = node[split], left[split], right[split]
        middle = (left + right) / 2
        node = np.concatenate([node, node])
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
    node, left, right = (np.concatenate(a) for a in zip(*finished, strict=True))
    return node, left, right

"""A strip with a natural curvature under its weight, ends up: shell and plate against the elastica.

With the vertical force Q on what lies beyond a point, per width,

    B theta'' = Q cos(theta),   Q' = r - q,   z' = sin(theta),   r = k z^2 where z < 0;

theta and Q vanish in the middle, theta' - kappa and Q at the end. Where the middle is flat, at a depth
d = sqrt(q/k), the product with theta' has an integral at any slope: for an end at the height z

    B kappa^2/2 = q (z + 2 d/3) for z > 0,   s D^2/2 (1 - D/(3 d)) for z < 0,   D = z + d, s = 2 q/d.

So the end leaves the ground, z = 0, at B kappa^2 = 4 q d/3, and on rigid ground (d = 0) its height is
B kappa^2/(2 q). For small slopes the strip is then off the ground over the length sqrt(2 B kappa/q).
"""

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp
from scipy.optimize import brentq

from figures.validation.problems.strips import HeavyStrip, Shape, uniform_strip

Array = NDArray[np.float64]

THICKNESS, WEIGHT, HALF, WIDTH = 0.03, 2.5e-4, 0.5, 0.02  # those of `uniform_strip`
assert HeavyStrip(HALF, WIDTH, THICKNESS, WEIGHT) == HeavyStrip()
BENDING = THICKNESS**3 / 12


def depth(stiffness: float) -> float:
    return float(np.sqrt(WEIGHT / stiffness))


def rise(curvature: float, stiffness: float) -> float:
    """Of the end above the middle, D, from the integral."""
    d, work = depth(stiffness), BENDING * curvature**2 / 2
    if work >= 2 * WEIGHT * d / 3:
        return work / WEIGHT + d / 3
    return float(brentq(lambda x: WEIGHT / d * x**2 * (1 - x / (3 * d)) - work, 0, d))


def strip(curvature: float, stiffness: float, elements: int = 20) -> Shape:
    """Of the nonlinear shell, nu = 0, with that rest curvature along the strip."""
    return uniform_strip(curvature, stiffness, elements)


def elastica(curvature: float, stiffness: float) -> Shape:
    """The same by collocation."""
    d = depth(stiffness)
    along = np.linspace(0, HALF, 400)

    def rates(_: Array, state: Array) -> Array:
        angle, bent, force, height = state
        reaction = stiffness * np.minimum(height, 0) ** 2
        return np.stack([bent, force * np.cos(angle) / BENDING, reaction - WEIGHT, np.sin(angle)])

    def ends(middle: Array, end: Array) -> Array:
        return np.array([middle[0], middle[2], end[1] - curvature, end[2]])

    guess = np.zeros((4, along.size))
    free = np.sqrt(2 * BENDING * curvature / WEIGHT)
    off = np.maximum(along - HALF + free, 0)
    guess[1] = curvature * (1 - (1 - off / free) ** 2)
    guess[0] = curvature * (off**2 / free - off**3 / (3 * free**2))
    guess[2] = np.where(off > 0, WEIGHT * (free - off), 0)
    guess[3] = -d + np.concatenate([[0], np.cumsum(np.sin(guess[0]))[1:] * (along[1])])
    found = solve_bvp(rates, ends, along, guess, tol=1e-6, max_nodes=20000)
    assert found.success, found.message
    return Shape(found.x, found.y[3])


def length_off_rigid_ground(curvature: float) -> float:
    """l in B theta'' = q (l - s) cos(theta), theta = theta' = 0 at s = 0, theta' = kappa at l."""
    start = np.sqrt(2 * BENDING * curvature / WEIGHT)
    ratio = WEIGHT * start**3 / BENDING  # of lengths over `start`

    def rates(place: Array, state: Array, length: Array) -> Array:
        bend = ratio * length[0] * (1 - place) * np.cos(state[0]) * length[0] ** 2
        return np.stack([state[1], bend])

    def ends(foot: Array, end: Array, length: Array) -> Array:
        return np.array([foot[0], foot[1], end[1] - curvature * start * length[0]])

    place = np.linspace(0, 1, 21)
    guess = np.stack([place**2 / 2, place]) * curvature * start
    found = solve_bvp(rates, ends, place, guess, p=[1.0], tol=1e-8)
    assert found.success, found.message
    return float(start * found.p[0])

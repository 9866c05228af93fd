"""Shapes between the kept ones, and how far they are from those that were not kept.

The states of most steps may be dropped, but the positions of a few points, the probes, are known at all
of them. Interpolated from the times of the kept states alone, the probes show what the interpolation of
a state misses, also where the kept times are too far apart to see the motion at all.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.discretisation import Discretisation
from fem_check.shell.region import Region
from fem_check.shell.stepping.step_control import extrapolated

Array = NDArray[np.float64]

NEIGHBOURS = 4
"""States that a shape between them is interpolated from."""

PROBES = 16
"""Points whose positions are kept at every step."""

MARGIN = 2
"""The error anywhere on the sheet is at most so many times what the probes show."""


def probe_region(discretisation: Discretisation) -> Region:
    """Vertices that are spread over the sheet, the corners first."""
    mesh = discretisation.mesh
    return discretisation.points(_spread(mesh.p[:, np.unique(mesh.t)], PROBES))


def _spread(points: Array, count: int) -> Array:
    """Of points (2, n) those that are far from each other, (2, count or n)."""
    middle = points.mean(1, keepdims=True)
    chosen = [int(np.hypot(*(points - middle)).argmax())]
    distance = np.full(points.shape[1], np.inf)
    while len(chosen) < min(count, points.shape[1]):
        last = points[:, chosen[-1:]]
        distance = np.minimum(distance, np.hypot(*(points - last)))
        chosen.append(int(distance.argmax()))
    return points[:, chosen]


def between(times: Array, values: Any, t: float, count: int = NEIGHBOURS) -> Array:
    """Values (n, ...) at times (n,), at another time by the polynomial through the `count` nearest."""
    count = min(count, times.size)
    place = int(np.searchsorted(times, t)) - count // 2
    begin = int(np.clip(place, 0, times.size - count))
    near = slice(begin, begin + count)
    flat = np.reshape(values[near], (count, -1))
    return np.reshape(extrapolated(times[near], flat, t), np.shape(values)[1:])


def interpolation_error(times: Array, probes: Array, kept: Array, t: float) -> float:
    """Largest distance, anywhere on the sheet, between a shape by `between` and the true one at time t.

    times (n,), probes (n, points, components): of all steps. kept: times of the kept states.
    """
    if np.any(kept == t):
        return 0.0
    rows = np.searchsorted(times, kept)
    found = between(kept, probes[rows], t)
    steps = between(times, probes, t)
    finer = between(times, probes, t, NEIGHBOURS + 2)
    return MARGIN * (_distance(found, steps) + _distance(steps, finer))


def motion_around(times: Array, probes: Array, t: float, width: float) -> float:
    """How far the probes move within the time `width` around t, length: diagonal of their boxes."""
    near = probes[np.abs(times - t) <= width / 2]
    return float(np.sqrt((np.ptp(near, axis=0) ** 2).sum(-1)).max()) if len(near) else 0.0


def _distance(first: Array, second: Array) -> float:
    """Largest distance of points (points, components)."""
    return float(np.sqrt(((first - second) ** 2).sum(-1)).max())

"""Shapes between the kept ones, and how far they are from those that were not kept.

The states of most steps may be dropped, but the positions of a few points, the probes, are known at all
of them. Interpolated from the times of the kept states alone, the probes show what the interpolation of
a state misses, also where the kept times are too far apart to see the motion at all.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.extrapolation import extrapolated
from fem_check.shell.kinematics.region import Region

Array = NDArray[np.float64]

NEIGHBOURS = 4
"""States that a shape between them is interpolated from."""

PROBES = 16
"""Points whose positions are kept at every step."""

MARGIN = 2
"""The error is at most this multiple of what the probes show: elsewhere on the sheet it is up to 1.2
times as large, and of the motion between two steps only differences of interpolations are known."""


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
    return _through(times, values, t, int(np.searchsorted(times, t)) - count // 2, count)


def _through(times: Array, values: Any, t: float, begin: int, count: int) -> Array:
    """The polynomial through `count` values from `begin` on, or the nearest that there are."""
    count = min(count, times.size)
    begin = int(np.clip(begin, 0, times.size - count))
    near = slice(begin, begin + count)
    flat = np.reshape(values[near], (count, -1))
    return np.reshape(extrapolated(times[near], flat, t), np.shape(values)[1:])


def interpolation_error(
    times: Array, probes: Array, snaps: NDArray[np.bool_], kept: Array, t: float
) -> float:
    """Largest distance, anywhere on the sheet, between a shape by `between` and the true one at time t.

    times (n,), probes (n, points, components): of all steps. snaps (n,): whether the sheet snapped over
    in the step that ended then. kept: times of the kept states.
    """
    if np.any(kept == t):
        return 0.0
    found = between(kept, probes[np.searchsorted(times, kept)], t)
    return MARGIN * (_distance(found, between(times, probes, t)) + _step_error(times, probes, snaps, t))


def _step_error(times: Array, probes: Array, snaps: NDArray[np.bool_], t: float) -> float:
    """Of the cubic through neighbouring steps: what two more of them change and by how much parabolas
    that lean to either side differ. Within a snap nothing is known but its ends."""
    if np.any(times == t):
        return 0.0
    after = int(np.searchsorted(times, t))
    cubic, finer = between(times, probes, t), between(times, probes, t, NEIGHBOURS + 2)
    early, late = (_through(times, probes, t, after - k, 3) for k in (2, 1))
    jump = _distance(probes[after - 1], probes[after]) if snaps[after] else 0.0
    return _distance(cubic, finer) + _distance(early, late) + jump


def motion_around(times: Array, probes: Array, t: float, width: float) -> float:
    """How far the probes move within the time `width` around t, length: diagonal of their boxes."""
    near = probes[np.abs(times - t) <= width / 2]
    return float(np.sqrt((np.ptp(near, axis=0) ** 2).sum(-1)).max()) if len(near) else 0.0


def _distance(first: Array, second: Array) -> float:
    """Largest distance of points (points, components)."""
    return float(np.sqrt(((first - second) ** 2).sum(-1)).max())

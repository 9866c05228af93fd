"""Shapes interpolated between the kept ones, and the error of this interpolation.

The states of most steps may be dropped, but the positions of a few points, the probes, are kept at all
steps. Interpolating the probes from the times of the kept states shows the error of interpolated
states, even if the kept times are too far apart to resolve the motion.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.extrapolation import extrapolated
from fem_check.shell.kinematics.region import Region

Array = NDArray[np.float64]

NEIGHBOURS = 4
"""Number of states from which a shape is interpolated."""

PROBES = 16
"""Number of points whose positions are kept at every step."""

MARGIN = 2
"""Bound of the ratio of the error to that at the probes: elsewhere on the sheet it is up to 1.2 times
as large, and between two steps the motion is known only through differences of interpolations."""


def probe_region(discretisation: Discretisation) -> Region:
    """Vertices distributed over the sheet, corners first."""
    mesh = discretisation.mesh
    return discretisation.points(_spread(mesh.p[:, np.unique(mesh.t)], PROBES))


def _spread(points: Array, count: int) -> Array:
    """A subset of points (2, n) that are far from each other, (2, count or n)."""
    middle = points.mean(1, keepdims=True)
    chosen = [int(np.hypot(*(points - middle)).argmax())]
    distance = np.full(points.shape[1], np.inf)
    while len(chosen) < min(count, points.shape[1]):
        last = points[:, chosen[-1:]]
        distance = np.minimum(distance, np.hypot(*(points - last)))
        chosen.append(int(distance.argmax()))
    return points[:, chosen]


def between(times: Array, values: Any, t: float, count: int = NEIGHBOURS) -> Array:
    """Values (n, ...) at times (n,), interpolated to time t by a polynomial through `count` of them."""
    return _through(times, values, t, int(np.searchsorted(times, t)) - count // 2, count)


def _through(times: Array, values: Any, t: float, begin: int, count: int) -> Array:
    """The polynomial through `count` values from `begin` on, shifted to the available ones."""
    count = min(count, times.size)
    begin = int(np.clip(begin, 0, times.size - count))
    near = slice(begin, begin + count)
    flat = np.reshape(values[near], (count, -1))
    return np.reshape(extrapolated(times[near], flat, t), np.shape(values)[1:])


def interpolation_error(
    times: Array, probes: Array, snaps: NDArray[np.bool_], kept: Array, t: float
) -> float:
    """Largest distance, anywhere on the sheet, between a shape from `between` and the true one at time
    t.

    times (n,), probes (n, points, components): of all steps. snaps (n,): whether the sheet snapped
    through in the step that ended then. kept: times of the kept states.
    """
    if np.any(kept == t):
        return 0.0
    found = between(kept, probes[np.searchsorted(times, kept)], t)
    return MARGIN * (_distance(found, between(times, probes, t)) + _step_error(times, probes, snaps, t))


def _step_error(times: Array, probes: Array, snaps: NDArray[np.bool_], t: float) -> float:
    """Error of the cubic through neighbouring steps: the change with two more steps, and the difference
    of the parabolas on either side. Within a snap-through only its ends are known."""
    if np.any(times == t):
        return 0.0
    after = int(np.searchsorted(times, t))
    cubic, finer = between(times, probes, t), between(times, probes, t, NEIGHBOURS + 2)
    early, late = (_through(times, probes, t, after - k, 3) for k in (2, 1))
    jump = _distance(probes[after - 1], probes[after]) if snaps[after] else 0.0
    return _distance(cubic, finer) + _distance(early, late) + jump


def motion_around(times: Array, probes: Array, t: float, width: float) -> float:
    """Motion of the probes within the time `width` around t, length: diagonal of bounding boxes."""
    near = probes[np.abs(times - t) <= width / 2]
    return float(np.sqrt((np.ptp(near, axis=0) ** 2).sum(-1)).max()) if len(near) else 0.0


def _distance(first: Array, second: Array) -> float:
    """Largest distance of points (points, components)."""
    return float(np.sqrt(((first - second) ** 2).sum(-1)).max())

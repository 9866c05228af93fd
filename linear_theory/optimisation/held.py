"""What holds a point at its place: bounds, constraints and limits that are met with equality."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from linear_theory.optimisation.problem import Region

Array = NDArray[np.float64]

ACTIVE = 1e-6
"""Distance to a bound or a constraint within which it is met with equality: both are scaled to 1."""

NEAR = 1e-4
"""The same of a limit on a computed number, to which the search keeps a margin."""


class Met(NamedTuple):
    """A bound (of an unknown, an upper or a lower one) or a row of a constraint, met with equality."""

    name: str
    normal: Array
    unknown: int = -1
    sign: float = 1.0
    constraint: int = -1
    row: int = -1
    limit: int = -1


def met(region: Region, point: Array, names: Sequence[str]) -> list[Met]:
    """All that is met with equality, with outward normals (unknowns,)."""
    found, axes = [], np.eye(point.size)
    for place, name in enumerate(names):
        if region.high[place] - point[place] <= ACTIVE:
            found.append(Met(f"upper bound of {name}", axes[place], place))
        if point[place] - region.low[place] <= ACTIVE:
            found.append(Met(f"lower bound of {name}", -axes[place], place, -1.0))
    for number, constraint in enumerate(region.constraints):
        slopes = constraint.slopes(point)
        for row in np.flatnonzero(constraint.excess(point) >= -ACTIVE):
            found.append(Met(constraint.name, slopes[row], constraint=number, row=int(row)))
    for number, limit in enumerate(region.limits):
        if float(limit.excess(point)[0]) >= -NEAR:
            found.append(Met(limit.name, limit.slopes(point)[0], limit=number))
    return found


def projected(gradient: Array, normals: Array) -> tuple[Array, Array]:
    """Multipliers >= 0 of the normals that leave the least of a gradient, and what they leave."""
    if not normals.size:
        return np.zeros(0), gradient
    pushes, _ = nnls(normals.T, gradient)
    return pushes, gradient - normals.T @ pushes

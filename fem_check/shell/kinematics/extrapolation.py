"""Extrapolation of states to another time or parameter."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def extrapolated(times: ArrayLike, states: Sequence[Array] | Array, target: float) -> Array:
    """Value (size,) at time `target` of the polynomial through states (n, size) at times (n,)."""
    places: list[Any] = np.asarray(times, float).tolist()
    weights = [
        np.prod([(target - other) / (place - other) for j, other in enumerate(places) if j != i])
        for i, place in enumerate(places)
    ]
    return np.asarray(np.array(weights) @ np.asarray(states))

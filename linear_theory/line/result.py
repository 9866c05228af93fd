"""What the two ways to balance friction on a line hand back, and when a body counts as at rest."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

REST_SPEED = 1e-3
"""Slower than this part of the range of speeds counts as at rest (for `sticks` only).

Loose on purpose: a pulse with gaps, interpolated by a trigonometric series, rings in the gaps.
"""

REST_PART = 0.1
"""The body sticks if at least this part of it is at rest.

By this measure 0.13 % of the body is at rest under a sine, 8 % under sin(phi)^3, and half of it or
more under pulses with gaps.
"""


class Level(NamedTuple):
    """A speed in units of |alpha|/(nT), and its error."""

    value: float
    error: float


class LineMotion(NamedTuple):
    """Speeds of a balanced body: mean and its error, V(t), the largest speed against the ground.

    times, velocity: (T,); first, second: coefficients of alpha and alpha^2; sticks: see `CrawlSpeed`.
    """

    mean: float
    error: float
    times: Array
    velocity: Array
    fastest: float
    first: float
    second: float
    sticks: bool

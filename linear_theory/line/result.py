"""Result of the two friction balances on a line, and the criterion for a body at rest."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate

Array = NDArray[np.float64]

REST_SPEED = 1e-3
"""Fraction of the range of speeds below which a point counts as at rest (for `sticks` only).

Deliberately large: the trigonometric series of a pulse with gaps rings in the gaps.
"""

REST_PART = 0.1
"""The body sticks if at least this fraction of it is at rest.

By this criterion 0.13 % of the body is at rest under a sine, 8 % under sin(phi)^3, and half or more
under pulses with gaps.
"""


class Level(NamedTuple):
    """A speed in units of |alpha|/(nT), and its error."""

    value: float
    error: float


class LineMotion(NamedTuple):
    """Speeds of a body in balance: mean and its error, V(t), the largest speed relative to the ground.

    times, velocity: (T,); power: mean power of friction over mu times the weight, friction (T,): its
    course; first, second: coefficients of alpha and alpha^2; sticks: see `CrawlSpeed`.
    """

    mean: float
    error: float
    times: Array
    velocity: Array
    fastest: float
    first: float
    second: float
    sticks: bool
    power: Estimate
    friction: Array

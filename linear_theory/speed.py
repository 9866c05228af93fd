"""The answer to the one question: how fast, how sure, at what cost."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CrawlSpeed:
    """Speed of a crawling sheet, in length/time; positive is towards +y, the way of the wave.

    mean: V averaged over one period; error: estimate of its numerical error, absolute;
    model_error: distance to the nonlinear sheet, absolute, NaN where it is not known;
    converged: whether error met the tolerance that was asked for.
    times (T,), velocity (T,): V_y(t) over one period.
    rigid: (3, T), V_x, V_y and the rate of rotation Omega about the origin (anticlockwise), for
    motions that are not mirror symmetric in x; None otherwise.
    first_order, second_order: V_1 and V_2 of V = V_1 alpha + V_2 alpha**2 + ..., within this model;
    NaN where they were not computed.
    slip_ratio: slip speed of the friction law over the largest speed relative to the ground: dry
    friction where it is << 1, viscous where it is >> 1; 0 for Coulomb, infinite for viscous.
    sticks: whether at some time part of the sheet is at rest and a range of forces is balanced,
    so that V is the value that the regularised law selects.
    seconds: time spent, set-up and solution; model: what is assumed, in words.
    """

    mean: float
    error: float
    model_error: float
    converged: bool
    times: Array
    velocity: Array
    seconds: float
    model: str
    slip_ratio: float
    first_order: float = np.nan
    second_order: float = np.nan
    sticks: bool = False
    rigid: Array | None = None

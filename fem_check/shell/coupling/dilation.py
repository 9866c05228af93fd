"""tr ε of the mid-surface, and the steps in which it may act back on the wave."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

LONGEST = 0.5
"""Longest step times the rate of the feedback: half the limit of stability of the scheme."""


class Dilation:
    """tr ε, the logarithm of the area over that of the undeformed sheet, at points (2, n) of it.

    Logarithmic, since growth by exp(alpha c) that nothing holds is then exactly tr ε = 2 alpha c.
    Raises ValueError for points outside of the sheet: a wave that was asked for on another body.
    """

    def __init__(self, discretisation: Discretisation, places: Array) -> None:
        try:
            self.region = discretisation.points(places)
        except ValueError as error:
            raise ValueError(
                f"wave: must be on the body of the scene, an Outline where that has a mesh ({error})"
            ) from None
        a11, a22, a12 = self.region.metric
        self._area = np.sqrt(a11 * a22 - a12**2)

    def at(self, state: Array) -> Array:
        """Of the sheet with those unknowns, (n,)."""
        return np.log(PointState(self.region, state, (1, 2)).jacobian / self._area)


def longest_step(scene: Scene) -> float:
    """Steps in which feedback is stable, units of time; inf without feedback.

    A free sheet adds coefficient times 2 alpha c to dc/dt.
    """
    equation: Any = getattr(scene.wave, "equation", None)
    if not scene.drive.has_state or equation is None or equation.feedback is None:
        return np.inf
    rate = 2 * abs(equation.feedback.coefficient * scene.alpha)
    return LONGEST / rate if rate > 0 else np.inf

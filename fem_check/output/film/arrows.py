"""Friction on the sheet as arrows, frame by frame."""

from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.output.geometry import inside
from fem_check.output.moving import Frame, Moving, friction_at, turned

Array = NDArray[np.float64]

ARROWS = 24
"""Approximate number of arrows on a rectangle: fewer than on a picture, which is looked at longer."""

LONGEST = 0.9
"""Length of the longest arrow relative to the spacing of arrows."""

NEAR = 0.3
"""How far inside the sheet arrows start, relative to their spacing: none leaves it by much."""


class Arrows(NamedTuple):
    """frame: with the points on which the forces act; ways (2, n): along the forces, in units of length
    such that the largest is nearly as long as the points are apart."""

    frame: Frame
    ways: Array


class Friction:
    """The arrows of a film, computed for the frames of one period if the motion repeats."""

    def __init__(self, moving: Moving, periods: int, samples: int) -> None:
        points, triangles = moving.covering()
        width, length = np.ptp(points, axis=1)
        along = max(3, round(float(np.sqrt(ARROWS * length / width))))
        across = max(2, round(ARROWS / along))
        self._moving, self._points = moving, inside(points, triangles, across, along, NEAR)
        self._frames = moving.frames(self._points, periods, samples)
        self._samples, self._repeats = samples, moving.most_periods is None
        self._force = lru_cache(samples)(self._force_in)
        self._step = LONGEST * min(width / across, length / along)
        self.acts = moving.speed.regime != "none" and self._points.size > 0

    def at(self, index: int) -> Arrows:
        """The arrows in a frame."""
        frame = self._frames[index]
        force, heading = self._force(index % self._samples if self._repeats else index)
        scale = self._step / self._largest
        return Arrows(frame, scale * turned(force, frame.heading - heading))

    @cached_property
    def _largest(self) -> float:
        """The largest force of the first period."""
        return max(float(np.hypot(*self._force(k)[0]).max()) for k in range(self._samples)) or 1.0

    def _force_in(self, index: int) -> tuple[Array, float]:
        """At the phase of a frame, with the heading of the sheet at that phase in `Moving.at`."""
        return friction_at(self._moving, self._points, self._frames[index].time)

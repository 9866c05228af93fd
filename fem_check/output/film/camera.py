"""Parallel projection of points in space onto the page."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

AZIMUTH = math.radians(24)
"""Turn of the camera about the vertical: the sheet is seen from its side x > 0, and a little from
behind, so that its far and near edges are told apart."""

LOWEST, HIGHEST = math.radians(28), math.radians(70)
"""Range of the elevation of the camera."""

CLEAR = math.radians(6)
"""How much steeper than the steepest ground the camera looks: no hill hides the sheet behind it."""


@dataclass(frozen=True)
class Camera:
    """A parallel projection: y runs to the right and away, z upwards, x towards the viewer.

    elevation: of the camera over the horizon, radians; stretch: factor on heights.

    >>> import numpy as np
    >>> from fem_check.output.film.camera import Camera
    >>> page = Camera.over(steepest=0.0).page(np.array([[0.0], [0.0], [1.0]]))
    >>> print(page.ravel().round(2))
    [0.   0.88]
    """

    elevation: float
    stretch: float = 1.0

    @classmethod
    def over(cls, steepest: float, stretch: float = 1.0) -> "Camera":
        """A camera that sees all of a ground with that largest slope."""
        needed = math.atan(stretch * steepest) + CLEAR
        return cls(min(max(LOWEST, needed), HIGHEST), stretch)

    @cached_property
    def _axes(self) -> Array:
        """Unit vectors to the right and upwards on the page, and towards the viewer, (3, 3)."""
        c, s = math.cos(AZIMUTH), math.sin(AZIMUTH)
        low, high = math.cos(self.elevation), math.sin(self.elevation)
        return np.array([[s, c, 0.0], [-high * c, high * s, low], [low * c, -low * s, high]])

    def page(self, places: Array) -> Array:
        """Positions (2, ...) on the page of points (3, ...)."""
        return self._seen(places)[:2]

    def depth(self, places: Array) -> Array:
        """How near points (3, ...) are to the viewer, (...)."""
        return self._seen(places)[2]

    def _seen(self, places: Array) -> Array:
        stretched = np.stack([places[0], places[1], self.stretch * places[2]])
        return np.tensordot(self._axes, stretched, 1)

    def light(self, normals: Array) -> Array:
        """Brightness 0 to 1 of faces with unit normals (3, ...): by a lamp at the upper left."""
        lamp = np.array([0.35, -0.45, 0.82])
        return np.abs(np.tensordot(lamp / np.linalg.norm(lamp), normals, 1))

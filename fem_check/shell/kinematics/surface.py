"""Reference surfaces: maps of a flat parameter domain with exact derivatives.

A surface is a function of the parameters (xi_1, xi_2) that returns the six vectors

    X, X_1, X_2, X_11, X_22, X_12          array (6, 3, *points)

The unit normal N is X_1 x X_2 over its length and the curvature B_ab = N . X_ab, so that a sphere
with outward N has negative curvature.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


class Surface(Protocol):
    """A map of the parameters to space."""

    def __call__(self, xi1: Array, xi2: Array) -> Array:
        """X, X_1, X_2, X_11, X_22, X_12 at the points, (6, 3, *xi1.shape)."""


def _vectors(xi1: Array, *vectors: tuple[Array | float, Array | float, Array | float]) -> Array:
    out = np.zeros((6, 3, *xi1.shape))
    for row, vector in enumerate(vectors):
        for component, value in enumerate(vector):
            out[row, component] = value
    return out


@dataclass(frozen=True)
class Flat(Value):
    """The plane z = height with X = (xi_1, xi_2, height)."""

    height: float = 0.0

    def __call__(self, xi1: Array, xi2: Array) -> Array:
        """See Surface."""
        return _vectors(xi1, (xi1, xi2, self.height), (1, 0, 0), (0, 1, 0))


@dataclass(frozen=True)
class AnnulusSector(Value):
    """A flat ring in polar coordinates: xi_1 the radius > 0, xi_2 the angle from the x axis."""

    def __call__(self, xi1: Array, xi2: Array) -> Array:
        """See Surface."""
        c, s = np.cos(xi2), np.sin(xi2)
        return _vectors(
            xi1,
            (xi1 * c, xi1 * s, 0),
            (c, s, 0),
            (-xi1 * s, xi1 * c, 0),
            (0, 0, 0),
            (-xi1 * c, -xi1 * s, 0),
            (-s, c, 0),
        )


@dataclass(frozen=True)
class Cylinder(Value):
    """A circular cylinder about the y axis: xi_1 the angle from the crown, xi_2 = y.

    X = (radius sin xi_1, xi_2, radius cos xi_1); the normal points outwards.
    Raises ValueError for a radius <= 0.
    """

    radius: float

    def __post_init__(self) -> None:
        validation.positive("radius", self.radius)

    def __call__(self, xi1: Array, xi2: Array) -> Array:
        """See Surface."""
        s, c = self.radius * np.sin(xi1), self.radius * np.cos(xi1)
        return _vectors(xi1, (s, xi2, c), (c, 0, -s), (0, 1, 0), (-s, 0, -c))


@dataclass(frozen=True)
class SpherePart(Value):
    """A sphere: xi_1 the longitude, |xi_2| < pi/2 the latitude of a globe whose axis is y.

    At xi = 0 the surface touches the plane z = radius and its parameter lines run along x and y;
    the normal points outwards. Raises ValueError for a radius <= 0.
    """

    radius: float

    def __post_init__(self) -> None:
        validation.positive("radius", self.radius)

    def __call__(self, xi1: Array, xi2: Array) -> Array:
        """See Surface."""
        r = self.radius
        s, c, sl, cl = np.sin(xi1), np.cos(xi1), np.sin(xi2), np.cos(xi2)
        return _vectors(
            xi1,
            (r * s * cl, r * sl, r * c * cl),
            (r * c * cl, 0, -r * s * cl),
            (-r * s * sl, r * cl, -r * c * sl),
            (-r * s * cl, 0, -r * c * cl),
            (-r * s * cl, -r * sl, -r * c * cl),
            (-r * c * sl, 0, r * s * sl),
        )

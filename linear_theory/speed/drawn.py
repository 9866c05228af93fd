"""Deformation of the sheet of a given speed over one period, for pictures.

A speed carries a `Deformation` that is evaluated only for drawing, and costs nothing otherwise.
"""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.deformation.field import LinearField
from linear_theory.energy.stored import Storing, stored_rate
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

STORING = 2.0
"""Relative error of the rate of storing over that of the displacement: of the strain, once more."""


class _Touch(NamedTuple):
    velocity: Array
    load: Array


class Touch(Shown, _Touch):
    """Contact at n points at one time: velocity (2, n) in the frame of the body, length per time, and
    normal load (n,) per area of the undeformed sheet, 1 without growth."""


class Deformation(Protocol):
    """A periodically deforming sheet, in the frame of the body.

    The frame has its origin in the centre of mass of the undeformed area and moves and turns with the
    sheet as a whole (see `path`). points: (2, n), of the undeformed sheet, units of length. words:
    description of the shape, for a caption.
    """

    alpha: float
    law: FrictionLaw
    words: str

    @property
    def drive(self) -> Drive:
        """The wave on the sheet."""

    @property
    def centre(self) -> Array:
        """Centre of mass of the undeformed area, (2,)."""

    def covering(self) -> tuple[Array, Integers]:
        """Points (2, n) and triangles (m, 3) that cover the undeformed sheet, fine enough to draw."""

    def places(self, points: Array, times: Array) -> Array:
        """Positions of the points relative to the centre of mass, (2 or 3, times, n)."""

    def growth(self, points: Array, times: Array) -> Array:
        """c at the points, (times, n)."""

    def contact(self, points: Array, t: float) -> Touch:
        """Velocity and normal load at the points, at one time."""

    def stress(self, points: Array, t: float) -> Array | None:
        """Stress (xx, yy, xy) at the points, (3, n), units of Young's modulus; None if not known."""

    def storing(self, times: Array) -> Storing:
        """Rate at which energy is stored at times (n,)."""


class LinearDeformation(Shown):
    """`Deformation` x + alpha u(x, y, t) in small-strain theory.

    find: returns the field u; called on first use, so that a speed need not keep a solution.
    """

    def __init__(
        self,
        find: Callable[[], LinearField],
        alpha: float,
        contact: Contact,
        words: str = "shape to first order in alpha",
    ) -> None:
        self._find, self.alpha, self.words = find, alpha, words
        self._load, self.law = contact.load, contact.friction

    def _contents(self) -> Mapping[str, Any]:
        return {"words": self.words, "alpha": self.alpha, "load": self._load, "law": self.law}

    @cached_property
    def field(self) -> LinearField:
        """u per unit alpha."""
        return self._find()

    @property
    def drive(self) -> Drive:
        """See Deformation."""
        return self.field.drive

    @property
    def centre(self) -> Array:
        """See Deformation."""
        return np.array(self.field.centre)

    def covering(self) -> tuple[Array, Integers]:
        """See Deformation."""
        return self.field.covering()

    def places(self, points: Array, times: Array) -> Array:
        """See Deformation."""
        moved = self.alpha * self.field.displacement(points[0], points[1], np.reshape(times, (-1, 1)))
        return np.asarray((points - self.centre[:, None])[:, None] + moved)

    def growth(self, points: Array, times: Array) -> Array:
        """See Deformation."""
        value = self.drive.value(points[0], points[1], np.reshape(times, (-1, 1)))
        return np.broadcast_to(value, (np.size(times), points.shape[1]))

    def contact(self, points: Array, t: float) -> Touch:
        """See Deformation."""
        weight = self._pressure(points, t)
        if self.law.map is not None:
            weight = weight * self.law.map.values(points[0], points[1], t)
        return Touch(self._velocity(points, t), weight)

    def _pressure(self, points: Array, t: float) -> Array:
        """Normal load, without the map of friction."""
        dilation = self.field.strain(points[0], points[1], t)[:2].sum(0)
        rate = self._load.rate(dilation, self.growth(points, np.array([t]))[0])
        return np.asarray(1 + self.alpha * rate)

    def _velocity(self, points: Array, t: float) -> Array:
        """Of what touches the ground."""
        return self.alpha * self.field.velocity(points[0], points[1], t)

    def stress(self, points: Array, t: float) -> Array:
        """See Deformation."""
        return self.alpha * self.field.stress(points[0], points[1], t)

    def storing(self, times: Array) -> Storing:
        """See Deformation. Of order alpha^2."""
        rate = self.alpha**2 * stored_rate(self.field, times)
        return Storing(rate, STORING * self.field.error * float(np.mean(abs(rate))))

"""A cycle of shapes, prepared for pictures of its speed."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.mesh import location as triangles
from fem_check.shell.cycle.motion import CycleMotion, depth_of
from fem_check.shell.cycle.shapes import Shapes, time_factors
from fem_check.shell.cycle.stored import storing
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.kinematics.region import Region
from linear_theory.common.shown import Shown
from linear_theory.energy.stored import Storing
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.motion.rigid import centre_and_gyration
from linear_theory.speed.drawn import Touch
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

MOTIONS = 4
"""Sets of points whose shape functions are kept: a film returns to the same ones in each frame."""


class CycleDeformation(Shown):
    """See `linear_theory.speed.drawn.Deformation`; the shapes are those behind the speed.

    other: shapes on another mesh, and the least ratio of the difference to the error (`other_mesh`).
    """

    def __init__(
        self, shapes: Shapes, contact: Contact, other: tuple[Shapes, float] | None = None
    ) -> None:
        self._other = other
        self.shapes, self._load, self.law = shapes, contact.load, contact.friction
        self._depth = depth_of(shapes, contact)
        self.alpha = shapes.scene.alpha
        where = "in the plane" if shapes.scene.planar else "in space"
        self.words = f"shape of the nonlinear sheet {where}"
        self._motions = lru_cache(MOTIONS)(self._motion_of)

    def _contents(self) -> Mapping[str, Any]:
        return {"words": self.words, "alpha": self.alpha, "load": self._load, "law": self.law}

    @property
    def crosses(self) -> bool:
        """Whether the sheet passes through itself; False if unknown, see `Shapes.crossed`."""
        crossed = self.shapes.crossed
        return crossed is not None and bool(crossed.any())

    @property
    def drive(self) -> Drive:
        """See Deformation."""
        return self.shapes.scene.drive

    @cached_property
    def centre(self) -> Array:
        """See Deformation."""
        region = self.shapes.discretisation.interior
        return np.array(centre_and_gyration(region.reference[0, :2], region.measure)[0])

    def covering(self) -> tuple[Array, Integers]:
        """See Deformation."""
        return triangles.covering(self.shapes.discretisation.mesh)

    def places(self, points: Array, times: Array) -> Array:
        """See Deformation; the third component is the height above z = 0."""
        return self._motion(points).places(np.asarray(times))

    def growth(self, points: Array, times: Array) -> Array:
        """See Deformation."""
        return np.stack([self.shapes.model.growth(float(t), *points) for t in times])

    def contact(self, points: Array, t: float) -> Touch:
        """See Deformation."""
        found = self._motion(points).at(np.array([t]))
        weight = 1.0
        if self._load is Load.GROUND:  # the reaction is a pressure
            weight = self.shapes.model.find(Gravity).weight
        return Touch(found.velocity[:, 0, :, 0, 0], found.area[0, :, 0, 0] / weight)

    def stress(self, points: Array, t: float) -> None:
        """See Deformation; not computed."""

    def storing(self, times: Array) -> Storing:
        """See Deformation. Of the sheet with its weight on the ground."""
        return storing(self.shapes, self._other, times)

    def _motion(self, points: Array) -> "_AtPoints":
        return self._motions(points.tobytes())

    def _motion_of(self, points: bytes) -> "_AtPoints":
        there = np.frombuffer(points).reshape(2, -1)
        of = {"points": there, "map": self.law.map, "depth": self._depth}
        return _AtPoints(self.shapes, self._load, 1, mirrored=False, **of)


@dataclass(frozen=True, eq=False)
class _AtPoints(CycleMotion):
    """The motion at given points, each treated as a cell with one point of weight 1."""

    points: Array

    @cached_property
    def region(self) -> Region:
        """The points."""
        return self.shapes.discretisation.points(self.points)

    def places(self, times: Array) -> Array:
        """Positions in the frame of the body, (components, times, points)."""
        values, _ = time_factors(times, self.shapes.scene.period, self._highest)
        position = np.tensordot(values, self._places, 1).swapaxes(0, 1)
        seen, _ = self._frame.seen(times, position[:2], np.zeros_like(position[:2]))
        return np.concatenate([seen, position[2:]])

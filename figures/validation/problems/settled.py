"""Static shapes of scenes whose wave is constant in time: sheets that do not move but lie, or curl."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check import Ground
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.kinematics.discretisation import Discretisation
from linear_theory import Scene

Array = NDArray[np.float64]

FEWEST = 4
"""Phases of a cycle of shapes, all of them the same here."""


@dataclass(frozen=True)
class Settled:
    """The static shape of a sheet."""

    sheet: Discretisation
    state: Array

    def position(self, x: float, y: float) -> Array:
        """Of a point of the undeformed sheet, (3,)."""
        return np.asarray(self.sheet.point((x, y)).position(self.state, (0,))[0, :, 0])


def settled(scene: Scene) -> Settled:
    """Where growth is ramped up from the undeformed sheet."""
    shapes = cycle_of_shapes(scene, FEWEST)
    return Settled(shapes.discretisation, shapes.states[0])


def on_ground(scene: Scene, stiffness: float) -> Scene:
    """The same scene on ground of another stiffness."""
    effects = [Ground(stiffness) if isinstance(e, Ground) else e for e in scene.effects]
    return scene.but(effects=effects)


def natural_curvature(scene: Scene) -> float:
    """Of a scene whose wave is constant, upwards, 1/length."""
    wave = scene.drive
    middle = np.zeros(1)
    return -scene.curvature_coupling * float(wave.value(middle, middle, 0.0)[0])

"""Parameters of the sheet and of its growth."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.gradient.direction import Direction, GrowthChange
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.scene.scene import Scene
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

STEP = 1e-5
"""Of the width, relative, for central differences of c; their error is of its square."""


@dataclass(frozen=True)
class Alpha(Parameter):
    """The growth coupling."""

    name = "growth.alpha"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.alpha

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return scene.but(alpha=value)

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        return Direction(alpha=1.0)


@dataclass(frozen=True)
class Width(Parameter):
    """The width of the sheet, at fixed length; a wave c(x, y, t) stays where it is in x."""

    name = "sheet.width"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.sheet.width

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return scene.but(sheet=replace(scene.sheet, width=value))

    def direction(self, scene: Scene) -> Direction:
        """Raises ValueError for a wave or a map of friction that does not change with the width."""
        if scene.contact.friction.map is not None:
            raise ValueError(f"over = {self.name!r}: friction must not have a map, fixed in lengths")
        growth = self._stretched(scene) if scene.drive.depends_on_x else None
        return Direction(width=1 / scene.sheet.width, growth=growth)

    def _stretched(self, scene: Scene) -> GrowthChange:
        """What c changes by at points that move with the sheet, x dc/dx per width."""
        width = scene.sheet.width
        try:
            ahead, behind = (
                drive(scene.wave, replace(scene.sheet, width=width * (1 + sign * STEP)))
                for sign in (1, -1)
            )
        except ValueError as error:
            raise ValueError(
                f"over = {self.name!r}: the wave must be known on a sheet of any width, not "
                f"{validation.shown(scene.wave)} ({error}); take differences"
            ) from None

        def slope(name: str, x: Array, y: Array, t: Array) -> Array:
            near, far = x * (1 - STEP), x * (1 + STEP)
            change = getattr(ahead, name)(far, y, t) - getattr(behind, name)(near, y, t)
            return np.asarray(change / (2 * STEP * width))

        return GrowthChange(partial(slope, "value"), partial(slope, "rate"))


@dataclass(frozen=True)
class Poisson(Parameter):
    """Poisson's ratio."""

    name = "sheet.poisson"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.sheet.poisson

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return with_sheet(scene, poisson=value)

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        return Direction(poisson=1.0)


def with_sheet(scene: Scene, **changes: float) -> Scene:
    """The scene with another thickness or Poisson ratio of the sheet, and of the material of its
    effects."""
    effects = [
        replace(effect, material=replace(effect.material, **changes))
        if hasattr(effect, "material")
        else effect
        for effect in scene.effects
    ]
    return scene.but(sheet=replace(scene.sheet, **changes), effects=effects)

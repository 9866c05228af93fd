"""Parameters of the sheet and of its growth."""

from dataclasses import dataclass, replace

from linear_theory.gradient.direction import Direction
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.scene.scene import Scene


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
    """The width of the sheet, at fixed length: of waves that do not depend on x."""

    name = "sheet.width"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.sheet.width

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return scene.but(sheet=replace(scene.sheet, width=value))

    def direction(self, scene: Scene) -> Direction:
        """Raises ValueError for a wave or a map of friction that does not change with the width."""
        if scene.drive.depends_on_x:
            raise ValueError(f"over = {self.name!r}: the wave must not depend on x")
        if scene.contact.friction.map is not None:
            raise ValueError(f"over = {self.name!r}: friction must not have a map, fixed in lengths")
        return Direction(width=1 / scene.sheet.width)


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

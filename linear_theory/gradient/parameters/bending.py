"""Parameters of a sheet that bends on its ground: curvature coupling, thickness, weight, ground."""

from dataclasses import dataclass, replace
from typing import ClassVar

from linear_theory.deformation.plate import foundation
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.parameters.parameter import Parameter, lacks
from linear_theory.gradient.parameters.sheet import with_sheet
from linear_theory.scene.scene import Scene


class OfBending(Parameter):
    """A number that counts where the sheet bends alone."""

    def direction(self, scene: Scene) -> Direction:
        """Raises ValueError for a sheet that does not bend."""
        if scene.planar:
            raise lacks(self.name, "a sheet that bends", "effects in the plane")
        self.value(scene)
        return Direction(bending=True)


@dataclass(frozen=True)
class CurvatureCoupling(OfBending):
    """beta, the rest curvature per c, 1/length."""

    name = "growth.curvature_coupling"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.curvature_coupling

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return scene.but(curvature_coupling=value)


@dataclass(frozen=True)
class Thickness(OfBending):
    """The thickness of the sheet, at a fixed weight per area."""

    name = "sheet.thickness"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.sheet.thickness

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return with_sheet(scene, thickness=value)


@dataclass(frozen=True)
class OfEffect(OfBending):
    """A number of the plate on its ground that one of the effects gives, by the same name."""

    number: ClassVar[str]

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        if not any(self._has(effect) for effect in scene.effects):
            raise lacks(self.name, f"an effect with a {self.number}", "one without")
        return float(getattr(foundation(scene.effects), self.number))

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        self.value(scene)
        change = {self.number: value}
        effects = [replace(e, **change) if self._has(e) else e for e in scene.effects]
        return scene.but(effects=effects)

    def _has(self, effect: object) -> bool:
        return self.number in getattr(effect, "plate_numbers", {})


class Weight(OfEffect):
    """The weight per area, force per length^2."""

    name = "gravity.weight"
    number = "weight"


class Stiffness(OfEffect):
    """The stiffness k of the ground (eq. 2), force per length^4."""

    name = "ground.stiffness"
    number = "stiffness"

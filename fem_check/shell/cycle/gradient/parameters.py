"""Parameters of finite-element scenes, besides those of `linear_theory.gradient.parameters`."""

from abc import abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from linear_theory.common import validation
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.parameters.names import parameters
from linear_theory.gradient.parameters.parameter import Parameter, lacks
from linear_theory.scene.scene import Scene


class OfScene(Parameter):
    """A number of a scene whose effect is found by differences of forces at frozen shapes."""

    def direction(self, scene: Scene) -> Direction:
        """Nothing in the terms of small-strain theory."""
        self.value(scene)
        return Direction()


@dataclass(frozen=True)
class OfSheet(OfScene):
    """A number of the sheet that its material has, too."""

    field: ClassVar[str]

    @property
    def name(self) -> str:
        """See Parameter."""
        return f"sheet.{self.field}"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return float(getattr(scene.sheet, self.field))

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        change = {self.field: validation.real(self.name, value)}
        effects = [
            replace(effect, material=replace(effect.material, **change))
            if hasattr(effect, "material")
            else effect
            for effect in scene.effects
        ]
        return scene.but(sheet=replace(scene.sheet, **change), effects=effects)


class Thickness(OfSheet):
    """The thickness."""

    field = "thickness"


class PoissonRatio(OfSheet):
    """Poisson's ratio."""

    field = "poisson"


@dataclass(frozen=True)
class CurvatureCoupling(OfScene):
    """beta of eq. 4."""

    name = "growth.curvature_coupling"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return scene.curvature_coupling

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return scene.but(curvature_coupling=validation.real(self.name, value))


@dataclass(frozen=True)
class OfEffect(OfScene):
    """A number of one effect of the scene."""

    field: ClassVar[str]

    @property
    @abstractmethod
    def kind(self) -> type:
        """The class of the effect."""

    @property
    def name(self) -> str:
        """See Parameter."""
        return f"{self.kind.__name__.lower()}.{self.field}"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        effect = scene.find(self.kind)
        if effect is None:
            names = ", ".join(type(other).__name__ for other in scene.effects) or "none"
            raise lacks(self.name, f"the effect {self.kind.__name__} (it has: {names})", scene.sheet)
        return float(getattr(effect, self.field))

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        self.value(scene)
        own = scene.find(self.kind)
        other = replace(own, **{self.field: value})
        effects = [other if effect is own else effect for effect in scene.effects]
        return scene.but(effects=effects)


class Weight(OfEffect):
    """The weight per area."""

    field, kind = "weight", Gravity


class Stiffness(OfEffect):
    """The k of eq. 2."""

    field, kind = "stiffness", Ground


OWN: dict[str, Parameter] = {
    one.name: one for one in (Thickness(), PoissonRatio(), CurvatureCoupling(), Weight(), Stiffness())
}
"""By their names, as in scene files."""


def cycle_parameters(over: Any) -> tuple[Parameter, ...]:
    """Parameters from names or objects, one or several. Raises ValueError as `parameters` does.

    >>> from fem_check.shell.cycle.gradient.parameters import cycle_parameters
    >>> print(*(one.name for one in cycle_parameters(["alpha", "sheet.thickness", "wave.sine.1"])))
    growth.alpha sheet.thickness wave.sine.1
    """
    listed = [over] if isinstance(over, str | Parameter) else over
    if isinstance(listed, Iterable):
        listed = [OWN.get(one, one) if isinstance(one, str) else one for one in listed]
    return parameters(listed)

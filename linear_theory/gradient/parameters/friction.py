"""Parameters of friction: its slip speed, its coefficients by direction, its map."""

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

from linear_theory.common import validation
from linear_theory.friction.contact import Contact
from linear_theory.friction.directional import Directional
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Tanh
from linear_theory.friction.maps import Mapped, Patches
from linear_theory.friction.wrapped import Wrapped
from linear_theory.gradient.direction import Direction, LawsAside, MapsAside
from linear_theory.gradient.parameters.parameter import Parameter, lacks
from linear_theory.scene.scene import Scene

STEP = 1e-5
"""Of a number of a law, relative, for central differences of its forces at given velocities: these are
smooth in it, so that they have an error of 1e-10."""


class OfFriction(Parameter):
    """One of the numbers of the law of friction that a scene states, which has no effects for it."""

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        if any(effect.law is not None for effect in scene.effects):
            raise ValueError(
                f"over = {self.name!r}: the friction of the scene must be stated by its contact, not "
                "by its effects"
            )
        contact = scene.contact
        value = validation.real(self.name, value)
        law = self.law_with(contact.friction, value)
        return scene.but(contact=Contact(contact.load, law, contact.slope))

    @abstractmethod
    def law_with(self, law: FrictionLaw, value: float) -> FrictionLaw:
        """The law with another value."""


@dataclass(frozen=True)
class SlipSpeed(OfFriction):
    """The slip speed of tanh friction."""

    name = "friction.slip_speed"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return self._tanh(scene.contact.friction).slip_speed

    def law_with(self, law: FrictionLaw, value: float) -> FrictionLaw:
        """See OfFriction."""
        return law.scaled(self._tanh(law).slip_speed / validation.positive(self.name, value))

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        return Direction(slip=1 / self.value(scene))

    def _tanh(self, law: FrictionLaw) -> Tanh:
        inner = _core(law)
        form = inner.form if isinstance(inner, Directional) else inner
        if not isinstance(form, Tanh):
            raise lacks(self.name, "friction with a slip speed", law)
        return form


@dataclass(frozen=True)
class Coefficient(OfFriction):
    """One of the numbers of friction with a direction."""

    field: ClassVar[str]

    @property
    def name(self) -> str:
        """See Parameter."""
        return f"friction.{self.field}"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return float(getattr(self._directional(scene.contact.friction), self.field))

    def law_with(self, law: FrictionLaw, value: float) -> FrictionLaw:
        """See OfFriction."""
        self._directional(law)
        return _with_core(law, lambda own: replace(own, **{self.field: value}))

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        law, value = scene.contact.friction, self.value(scene)
        step = STEP * self._scale(value)
        ahead, behind = (self.law_with(law, value + sign * step) for sign in (1, -1))
        return Direction(law=LawsAside(ahead, behind, 2 * step))

    def _scale(self, value: float) -> float:
        return value

    def _directional(self, law: FrictionLaw) -> Directional:
        own = _core(law)
        if not isinstance(own, Directional):
            raise lacks(self.name, "Directional friction", law)
        return own


class Forward(Coefficient):
    """The coefficient against forward slip."""

    field = "forward"


class Backward(Coefficient):
    """The coefficient against backward slip."""

    field = "backward"


class Sideways(Coefficient):
    """The coefficient against slip sideways."""

    field = "sideways"


class Heading(Coefficient):
    """Where forward is, radians anticlockwise from +y."""

    field = "heading"

    def _scale(self, value: float) -> float:
        return 1.0


@dataclass(frozen=True)
class PatchFriction(OfFriction):
    """The mu of a patch of a map of friction, by its number, from 0."""

    patch: int

    def __post_init__(self) -> None:
        validation.integer("patch", self.patch, 0)

    @property
    def name(self) -> str:
        """See Parameter."""
        return f"friction.map.mu.{self.patch}"

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return self._patches(scene.contact.friction).patches[self.patch][-1]

    def law_with(self, law: FrictionLaw, value: float) -> FrictionLaw:
        """See OfFriction."""
        changed = self._with(self._patches(law), value)
        return _with_map(law, changed)

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        own, value = self._patches(scene.contact.friction), self.value(scene)
        step = STEP * value
        ahead, behind = (self._with(own, value + sign * step) for sign in (1, -1))
        return Direction(map=MapsAside(ahead, behind, 2 * step))

    def _with(self, own: Patches, value: float) -> Patches:
        patches = list(own.patches)
        patches[self.patch] = (*patches[self.patch][:-1], value)
        return Patches(patches, own.edge, own.outside, own.fixed_to)

    def _patches(self, law: FrictionLaw) -> Patches:
        own = law.map
        if not isinstance(own, Patches):
            raise lacks(self.name, "a map of Patches", law)
        if self.patch >= len(own.patches):
            raise ValueError(f"over = {self.name!r}: the map has {len(own.patches)} patches, from 0")
        return own


def _core(law: FrictionLaw) -> FrictionLaw:
    """The law within maps and faces."""
    while isinstance(law, Wrapped):
        law = law.law
    return law


def _with_core(law: FrictionLaw, change: Callable[[Any], FrictionLaw]) -> FrictionLaw:
    """The law with that within it changed."""
    return law.around(_with_core(law.law, change)) if isinstance(law, Wrapped) else change(law)


def _with_map(law: FrictionLaw, own: Patches) -> FrictionLaw:
    """The law with another map."""
    if isinstance(law, Mapped):
        return Mapped(law.law, own)
    assert isinstance(law, Wrapped)
    return law.around(_with_map(law.law, own))

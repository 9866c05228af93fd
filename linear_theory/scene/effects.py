"""What a scene asks of the effects that it names, and what they say of its contact with the ground."""

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from linear_theory.common.validation import shown
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load

if TYPE_CHECKING:
    from linear_theory.scene.scene import Scene
    from linear_theory.sheet.rectangle import Sheet


@runtime_checkable
class NamedEffect(Protocol):
    """A physical effect that a scene names; see `fem_check.shell.effects.effect.Effect`.

    needs_space: whether it requires three components. stretches: whether it gives the sheet in-plane
    stiffness. bends: whether it depends on a rest curvature. incline: of the ground, radians. law, mu:
    friction law and coefficient of friction; None for other effects.
    """

    @property
    def needs_space(self) -> bool: ...  # noqa: D102

    @property
    def stretches(self) -> bool: ...  # noqa: D102

    @property
    def bends(self) -> bool: ...  # noqa: D102

    @property
    def incline(self) -> float: ...  # noqa: D102

    @property
    def law(self) -> FrictionLaw | None: ...  # noqa: D102

    @property
    def mu(self) -> float | None: ...  # noqa: D102

    def pressed_by(self, components: int) -> Load | None:
        """The normal load by which it presses the sheet on the ground; None if it does not."""

    def beyond_theory(self, scene: "Scene") -> str:
        """The part that theories of a flat rectangle cannot represent, in words; empty if none."""

    def under(self, sheet: "Sheet") -> "NamedEffect":
        """The effect adapted to that sheet."""

    def check_scene(self, scene: "Scene") -> None:
        """Raise ValueError if the scene lacks what the effect requires, or contradicts it."""


def contact_of(effects: Iterable[NamedEffect], components: int, said: Contact | None) -> Contact:
    """Load, friction and slope from the effects, else from `said`, which must not contradict them."""
    presses = [load for effect in effects if (load := effect.pressed_by(components)) is not None]
    rubs = [effect for effect in effects if effect.law is not None]
    if said is not None and said.load is Load.GROUND and Load.GROUND not in presses:
        raise ValueError("load = 'ground': the scene must name the effect Ground")
    load = presses[-1] if presses else (Load.CURRENT if said is None else said.load)
    law = rubs[0].law if rubs else None
    if law is None:
        found = Contact(load) if said is None else replace(said, load=load)
    else:
        found = Contact(load, law, _slope(effects, rubs[0].mu))
    if said is not None and said.slope and said.slope != found.slope:
        raise ValueError(
            f"slope = {said.slope:g}: must be 0 or {found.slope:g}, that of the scene's effects "
            "(Gravity with its incline, and Friction)"
        )
    if said is not None and said.load != load:
        raise ValueError(
            f"load = {str(said.load)!r}: must be None or {str(load)!r}, the load of the scene's effects"
        )
    if said is not None and said.friction != found.friction:
        raise ValueError(
            f"friction = {shown(said.friction)}: must be None or that of the scene, which names "
            f"Friction with {shown(law)}"
        )
    return found


def _slope(effects: Iterable[NamedEffect], mu: float | None) -> float:
    """tan(incline)/mu."""
    incline = sum(effect.incline for effect in effects)
    return math.tan(incline) / mu if incline and mu else 0.0


def checked_effects(effects: Any) -> tuple[Any, ...]:
    """The effects as a tuple, also from a single one. Raises ValueError for anything else."""
    if _is_effect(effects):
        return (effects,)
    if isinstance(effects, type | str) or not isinstance(effects, Iterable):
        raise ValueError(
            f"effects = {shown(effects)}: must be a sequence of effects, as [Membrane(material)]"
        )
    found = tuple(effects)
    for i, effect in enumerate(found):
        if not _is_effect(effect):
            hint = "an instance, made with its arguments" if isinstance(effect, type) else "an effect"
            raise ValueError(f"effects[{i}] = {shown(effect)}: must be {hint}")
        if type(effect) in map(type, found[:i]):
            raise ValueError(f"effects: {type(effect).__name__} is named twice, must be named once")
    return found


def in_order(effects: Iterable[NamedEffect]) -> list[NamedEffect]:
    """The effects in one order, whatever theirs is: it has no meaning, but sums round differently."""
    return sorted(effects, key=lambda e: (not e.stretches, not e.bends, type(e).__name__))


def _is_effect(value: object) -> bool:
    """Whether a value is an instance, not a class, with the interface of an effect."""
    return not isinstance(value, type) and isinstance(value, NamedEffect)

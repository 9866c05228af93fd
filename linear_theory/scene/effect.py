"""The interface of effects as needed by a scene."""

from typing import TYPE_CHECKING, Protocol, runtime_checkable

from linear_theory.friction.laws import FrictionLaw
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

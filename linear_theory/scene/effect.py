"""What a scene asks of the effects that it names."""

from typing import TYPE_CHECKING, Protocol, runtime_checkable

from linear_theory.friction.laws import FrictionLaw
from linear_theory.friction.load import Load

if TYPE_CHECKING:
    from linear_theory.scene.scene import Scene
    from linear_theory.sheet.rectangle import Sheet


@runtime_checkable
class NamedEffect(Protocol):
    """A part of the physics of a sheet that a scene names; see `fem_check.shell.effects.effect.Effect`.

    needs_space: whether it has no meaning with two components. stretches, bends: whether it gives the
    sheet a shape, with a rest curvature. incline: of the ground, radians. law, mu: of friction, its
    coefficient; None unless it is that.
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
        """The load with which it presses the sheet on the ground; None if it does not."""

    def beyond_theory(self, scene: "Scene") -> str:
        """What of it the theories of a flat rectangle cannot represent, in words; empty if all."""

    def under(self, sheet: "Sheet") -> "NamedEffect":
        """The effect as it acts on that sheet."""

    def check_scene(self, scene: "Scene") -> None:
        """Raise ValueError where the scene lacks what it needs or contradicts it."""

"""What a parameter of a scene is: a name, a value, scenes with other values, and a direction."""

from abc import ABC, abstractmethod
from typing import TypeVar

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.gradient.direction import Direction
from linear_theory.scene.scene import Scene

T = TypeVar("T")


class Parameter(Value, ABC):
    """One number of a scene. name: its field, as in scene files and sweeps; entries of lists by number.

    A parameter of one's own inherits from this class.
    """

    @property
    @abstractmethod
    def name(self) -> str:
        """A dotted path, such as "sheet.width"."""

    @abstractmethod
    def value(self, scene: Scene) -> float:
        """Its value. Raises ValueError for a scene that does not have it."""

    @abstractmethod
    def changed(self, scene: Scene, value: float) -> Scene:
        """The scene with another value. Raises ValueError for one out of range."""

    @abstractmethod
    def direction(self, scene: Scene) -> Direction:
        """What changes per unit of it. Raises ValueError where V has no derivative."""


def lacks(name: str, kind: str, value: object) -> ValueError:
    """The refusal of a scene that does not have a parameter."""
    return ValueError(f"over = {name!r}: the scene must have {kind}, not {validation.shown(value)}")

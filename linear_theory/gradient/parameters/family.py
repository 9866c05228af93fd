"""A parameter of any wave: of a function that makes the wave from a number."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from linear_theory.common import validation
from linear_theory.gradient.direction import Direction, GrowthChange
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.scene.scene import Scene
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import drive


@dataclass(frozen=True)
class WaveFamily(Parameter):
    """The number s of a family of waves c(x, y, t; s), of which the scene has the one at `number`.

    label: its name; make: the wave of a number, with the period of the scene's. step: of the
    central difference of c by s, whose error is of its square. Raises ValueError for a make that is not
    callable and a step that is not positive.

    >>> import numpy as np
    >>> from linear_theory import FieldWave, Sheet, Scene
    >>> def oblique(s):
    ...     return FieldWave(lambda x, y, t: np.sin(2 * np.pi * (s * x + y - t)), period=1.0)
    >>> tilt = WaveFamily("tilt", 0.2, oblique)
    >>> scene = Scene(Sheet(), oblique(0.2), alpha=0.1)
    >>> print(tilt.value(scene), tilt.direction(scene).growth.across)
    0.2 True
    """

    label: str
    number: float
    make: Callable[[float], Wave]
    step: float = 1e-5

    def __post_init__(self) -> None:
        validation.label("label", self.label)
        validation.real("number", self.number)
        validation.positive("step", self.step)
        if not callable(self.make):
            raise ValueError(f"make = {validation.shown(self.make)}: must be a function of a number")

    @property
    def name(self) -> str:
        """The label."""
        return self.label

    def value(self, scene: Scene) -> float:
        """See Parameter."""
        return self.number

    def changed(self, scene: Scene, value: float) -> Scene:
        """See Parameter."""
        return scene.but(wave=self.make(validation.real(self.name, value)))

    def at(self, value: float) -> "WaveFamily":
        """The parameter of the scene with another value."""
        return replace(self, number=value)

    def direction(self, scene: Scene) -> Direction:
        """See Parameter."""
        ahead, behind = (drive(self.make(self.number + s * self.step), scene.sheet) for s in (1, -1))
        return Direction(growth=GrowthChange.between(ahead, behind, 2 * self.step))

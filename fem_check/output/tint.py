"""What colours a sheet: its growth, or the wave where lengths do not grow."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.output.moving import Frame, Moving

Array = NDArray[np.float64]

PHASES = 24
"""Number of phases from which the scale is determined."""


class Tint(NamedTuple):
    """A quantity: its label and unit, whether it is growth, and the end of its scale in that unit."""

    label: str
    unit: str
    grows: bool
    most: float

    def of(self, growth: Array, wave: Array) -> Array:
        """Its values."""
        return 100 * growth if self.grows else wave

    def at(self, frame: Frame) -> Array:
        """Its values on a frame."""
        return self.of(frame.growth, frame.wave)

    @property
    def axis(self) -> str:
        """The label with the unit."""
        return f"{self.label} ({self.unit})" if self.unit else self.label


def tint(growth: Array, wave: Array) -> Tint:
    """From all values of growth, alpha c, and of c."""
    most = 100 * float(np.abs(growth).max())
    if most:
        return Tint(r"growth $\alpha c$", "%", True, most)
    return Tint("wave $c$", "", False, float(np.abs(wave).max()))


def tint_of(moving: Moving, points: Array) -> Tint:
    """Of a motion, over a period."""
    some = points[:, :: max(1, points.shape[1] // 400)]
    frames = list(moving.frames(some, 1, PHASES))
    return tint(*(np.array([getattr(f, name) for f in frames]) for name in ("growth", "wave")))

"""Growth as one measures it, a share of the length, and the coupling alpha of the theory."""

from typing import NamedTuple

import numpy as np

from linear_theory.common import validation
from linear_theory.growth.laws import GrowthLaw, growth_law
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

POINTS = 33
"""Each way, at which growth of any shape is looked at."""


class Extremes(NamedTuple):
    """Largest and smallest change of length by growth, as a share of the length: 0.12 is 12 %."""

    crest: float
    trough: float


def extremes(scene: Scene) -> Extremes:
    """Of a scene, over the sheet and a period."""
    c = scene.alpha * _growth(scene.drive)
    stretch = scene.growth.law.stretch(np.array([c.max(), c.min()]))
    return Extremes(float(stretch[0] - 1), float(stretch[1] - 1))


def alpha_of(crest: float, wave: Wave, sheet: Sheet, law: GrowthLaw | str = "exp") -> float:
    """alpha > 0 with which lengths at the crest of the wave grow by the share `crest` > 0.

    law: of growth, or its name; the stretch is 1 + crest where c is largest. Raises ValueError for
    other values and for a wave that is nowhere positive.

    >>> import math
    >>> from fem_check.answer.growth import alpha_of
    >>> from linear_theory import Sheet, SineWave
    >>> print(f"{alpha_of(0.12, SineWave(), Sheet()):.12f} {math.log(1.12):.12f}")
    0.113328685307 0.113328685307
    """
    crest = validation.positive("growth", crest)
    largest = float(_growth(drive(wave, sheet)).max())
    if largest <= 0:
        raise ValueError(f"growth = {crest:g}: the wave has no crest, its largest c is {largest:g}")
    return growth_law(law).strain(crest) / largest


def _growth(drive: Drive) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """c at places and times that leave out no extreme by much."""
    width, length = drive.sheet.width, drive.sheet.length
    x, y = (s * np.linspace(-0.5, 0.5, POINTS) for s in (width, length))
    return drive.growths(np.repeat(x, POINTS), np.tile(y, POINTS))

"""Measured growth, as a relative change of length, and the growth coupling alpha of the theory."""

from typing import NamedTuple

import numpy as np

from linear_theory.common import validation
from linear_theory.growth.laws import GrowthLaw, growth_law
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

POINTS = 33
"""Sampling points in each direction at which growth of any form is evaluated."""


class Extremes(NamedTuple):
    """Largest and smallest relative change of length by growth: 0.12 is 12 %."""

    crest: float
    trough: float


def extremes(scene: Scene) -> Extremes:
    """Extremes of growth over the sheet and one period of a scene.

    Raises ValueError for a growth by which lengths vanish, or which no number can hold.
    """
    c = _growth(scene.drive)
    scene.growth.metric(c)
    strain = scene.alpha * c
    stretch = scene.growth.law.stretch(np.array([strain.max(), strain.min()]))
    return Extremes(float(stretch[0] - 1), float(stretch[1] - 1))


def alpha_of(crest: float, wave: Wave, sheet: Sheet, law: GrowthLaw | str = "exp") -> float:
    """alpha > 0 for which lengths at the crest of the wave grow by the fraction `crest` > 0.

    law: growth law or its name; the stretch is 1 + crest where c is largest. Raises ValueError for
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
        raise ValueError(
            f"growth = {crest:g}: the wave must be positive somewhere, its largest c is {largest:g}"
        )
    return growth_law(law).strain(crest) / largest


def _growth(drive: Drive) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """c at points and times dense enough to come close to every extremum."""
    width, length = drive.sheet.width, drive.sheet.length
    x, y = (s * np.linspace(-0.5, 0.5, POINTS) for s in (width, length))
    return drive.growths(np.repeat(x, POINTS), np.tile(y, POINTS))

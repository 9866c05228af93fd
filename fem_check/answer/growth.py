"""Growth as one measures it, a share of the length, and the coupling alpha of the theory."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from linear_theory.common import validation
from linear_theory.deformation.field import Wave
from linear_theory.line.growth import GROWTH_LAWS
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.reach import growths

if TYPE_CHECKING:
    from fem_check.predict.levels import Question

POINTS = 33
"""Each way, at which growth of any shape is looked at."""


class Extremes(NamedTuple):
    """Largest and smallest change of length by growth, as a share of the length: 0.12 is 12 %."""

    crest: float
    trough: float


def extremes(question: "Question") -> Extremes:
    """Of the question's growth law, over the sheet and a period."""
    c = question.alpha * _growth(question.wave, question.sheet)
    stretch = GROWTH_LAWS[question.growth_law].stretch(np.array([c.max(), c.min()]))
    return Extremes(float(stretch[0] - 1), float(stretch[1] - 1))


def alpha_of(crest: float, wave: Wave, sheet: Sheet, growth_law: str = "exp") -> float:
    """alpha > 0 with which lengths at the crest of the wave grow by the share `crest` > 0.

    The stretch 1 + crest is exp(alpha c), 1 + alpha c or (1 + 2 alpha c)^(1/2) by the growth law, c at
    its largest. Raises ValueError for other values and for a wave that is nowhere positive.

    >>> import math
    >>> from fem_check.answer.growth import alpha_of
    >>> from linear_theory import Sheet, SineWave
    >>> print(f"{alpha_of(0.12, SineWave(), Sheet()):.12f} {math.log(1.12):.12f}")
    0.113328685307 0.113328685307
    """
    crest = validation.positive("growth", crest)
    largest = float(_growth(wave, sheet).max())
    if largest <= 0:
        raise ValueError(f"growth = {crest:g}: the wave has no crest, its largest c is {largest:g}")
    strain = {
        "exp": np.log1p(crest),
        "linear": crest,
        "metric": crest + crest**2 / 2,
    }[validation.choice("growth_law", growth_law, tuple(GROWTH_LAWS))]
    return float(strain / largest)


def _growth(wave: Wave, sheet: Sheet) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """c at places and times that leave out no extreme by much."""
    x, y = (s * np.linspace(-0.5, 0.5, POINTS) for s in (sheet.width, sheet.length))
    return np.asarray(growths(wave, np.repeat(x, POINTS), np.tile(y, POINTS), sheet.length))

"""A number of the write-up, and the sheet and wave that most of them are about."""

from typing import NamedTuple

from linear_theory import Sheet, SineWave

SMALL_ALPHA = 1e-5
"""At which V/alpha^2 is its limit to about alpha^2."""

SHOWN_ALPHA = 0.25
"""Of figure 3A, of the original paper too."""

SHEET, WAVE = Sheet(), SineWave()


class Number(NamedTuple):
    """value: a float, or several; origin: what made it, in words or as a call."""

    value: float | list[float]
    origin: str


Numbers = dict[str, Number]

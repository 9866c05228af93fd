"""The film of the README: the sheet of its first block, crawling.

    python -m figures.draw.readme_movie [--out FOLDER]

A sheet of 40 x 15 x 0.8 mm grows by 12 % of its length at the crest of a pulse that runs along it every
8 s. The speed is that of the nonlinear sheet; the same bytes on every run.
"""

import math
from collections.abc import Sequence

from fem_check import Prediction, predict
from fem_check.output import Units
from figures.common.command import parser
from figures.common.folders import GALLERY
from linear_theory import Sheet, pulse_wave

SHEET = Sheet(length=40.0, width=15.0, thickness=0.8)
"""In millimetres."""

PULSE = pulse_wave(0.2, period=8.0)
"""In seconds."""

ALPHA = math.log(1.12)
"""Growth exp(alpha c) of 12 % at the crest."""

UNITS = Units("mm", "s")

PERIODS, FRAMES, FPS, WIDTH = 10, 12, 15.0, 560
"""Some 8 s of film below 3 MB."""

NAME = "crawl.gif"


def answer() -> Prediction:
    """The speed of the sheet."""
    return predict(SHEET, PULSE, ALPHA, rtol=1e-2)


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the film of the README."""
    options = parser("python -m figures.draw.readme_movie", __doc__, GALLERY).parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    path = options.out / NAME
    print(answer().movie(path, periods=PERIODS, frames=FRAMES, fps=FPS, width=WIDTH, units=UNITS))


if __name__ == "__main__":
    main()

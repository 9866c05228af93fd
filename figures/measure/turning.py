"""The first periods of two sheets stepped in time, the symbols of the figure of paths.

    python -m figures.measure.turning [--out FILE] [--periods 20]

Writes figures/data/turning.csv, which figures.draw.turning reads: half a minute. The paper's sheet
in the plane is driven by an oblique wave and by one that is stronger on its right side. Friction acts
back on it, but its force is 1e-4 of the stiffness, and its slip speed 2 % of the largest speed: dry.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.stepping.simulation import simulate
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import sliding_scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.path import Poses
from linear_theory.wave.given import FieldWave

Array = NDArray[np.float64]

SHEET = Sheet()

ALPHA = 0.2
"""Large enough for a circle of about a hundred periods."""

ANGLE = np.pi / 4
"""Of the oblique wave against +y, to the right."""

SLIP = 0.01
"""Slip speed, L/T."""

CELLS, STEPS, PERIODS = (2, 4), 64, 20
"""Elements across and along, of degree 5; steps per period, which leave 0.2 % of the speed; periods."""

DIGITS = 6
"""Significant digits written: more than the error of the step leaves, fewer than roundoff changes."""


def oblique(x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
    """c of a sine of wavelength L that runs at ANGLE to +y; L = T = 1."""
    along = np.sin(ANGLE) * np.asarray(x) + np.cos(ANGLE) * np.asarray(y)
    return np.asarray(np.sin(2 * np.pi * (along - t)))


def unequal(x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
    """c of a sine along +y whose amplitude grows from 1/2 at the left to 3/2 at the right edge."""
    amplitude = 1 + np.asarray(x) / SHEET.width
    return np.asarray(amplitude * np.sin(2 * np.pi * (np.asarray(y) - t)))


WAVES = {"oblique": FieldWave(oblique, 1.0), "unequal": FieldWave(unequal, 1.0)}


@dataclass(frozen=True)
class Row:
    """Pose of the body frame after so many periods of full growth, as seen from its pose before them.

    wave: key of WAVES; x, y in L, heading in radians; error, heading_error: what the steps in time do
    to place and heading: the change by half as many steps, since they fall in proportion at least.
    """

    wave: str
    period: int
    x: float
    y: float
    heading: float
    error: float
    heading_error: float


TABLE = Table(
    DATA / "turning.csv",
    Row,
    "python -m figures.measure.turning",
    f"alpha = {ALPHA:g}, lengths in L, angles in radians",
    DIGITS,
)


def compute(periods: int = PERIODS) -> list[Row]:
    """Both waves, after a ramp of growth of one period."""
    return [row for wave in tracked("turning", WAVES) for row in rows(wave, periods)]


def rows(name: str, periods: int) -> list[Row]:
    """Poses at the ends of the periods, the start included."""
    path, coarse = stepped(name, periods, STEPS), stepped(name, periods, STEPS // 2)
    errors = np.hypot(*(path.position - coarse.position))
    turned = abs(path.heading - coarse.heading)
    numbers = np.stack([*path.position, path.heading, errors, turned], 1)[1:]
    return [Row(name, k, *row) for k, row in enumerate(numbers.tolist())]


def stepped(name: str, periods: int, steps: int) -> Poses:
    """Poses at the start of the ramp, at its end, from which they are seen, and at ends of periods."""
    scene = sliding_scene(SHEET, WAVES[name], ALPHA, SLIP, CELLS)
    return simulate(scene, periods, steps=steps, ramp=1.0, keep_every=steps).path.seen_from(1)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, periods=(PERIODS, "how many"))
    TABLE.write(compute(options.periods), options.out)


if __name__ == "__main__":
    main()

"""The first periods of two sheets stepped in time, the symbols of the figure of paths.

    python -m figures.measure.turning [--out FILE] [--periods 20]

Writes figures/data/turning.csv, which figures.draw.turning reads: half a minute. The paper's sheet
in the plane is driven by an oblique wave and by one that is stronger on its right side. Friction acts
back on it, but its force is 1e-4 of the stiffness, and its slip speed 2 % of the largest speed: dry.
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.scene.material import Material
from fem_check.shell.scene.scene import Scene
from fem_check.shell.stepping.simulation import simulate
from figures.common import output
from figures.common.folders import DATA
from figures.common.records import write_rows
from linear_theory.common.records import read_rows
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.path import Poses
from linear_theory.wave.given import FieldWave

Array = NDArray[np.float64]

PATH = DATA / "turning.csv"
COMMAND = "python -m figures.measure.turning"

SHEET = Sheet()

ALPHA = 0.2
"""Large enough for a circle of about a hundred periods."""

ANGLE = np.pi / 4
"""Of the oblique wave against +y, to the right."""

SLIP, WEAK = 0.01, 1e-4
"""Slip speed, L/T; friction over stiffness, mu weight L/(E h)."""

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


def membrane() -> Membrane:
    """Of the sheet's thickness and Poisson ratio."""
    return Membrane(Material(SHEET.thickness, SHEET.poisson))


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


def compute(periods: int = PERIODS) -> list[Row]:
    """Both waves, after a ramp of growth of one period."""
    found = []
    with output.Progress("turning", len(WAVES)) as progress:
        for wave in WAVES:
            found += rows(wave, periods)
            progress.advance()
    return found


def rows(name: str, periods: int) -> list[Row]:
    """Poses at the ends of the periods, the start included."""
    path, coarse = stepped(name, periods, STEPS), stepped(name, periods, STEPS // 2)
    errors = np.hypot(*(path.position - coarse.position))
    turned = abs(path.heading - coarse.heading)
    numbers = np.stack([*path.position, path.heading, errors, turned], 1)[1:]
    return [Row(name, k, *row) for k, row in enumerate(numbers.tolist())]


def stepped(name: str, periods: int, steps: int) -> Poses:
    """Poses at the start of the ramp, at its end, from which they are seen, and at ends of periods."""
    effects = (membrane(), Gravity(WEAK * SHEET.thickness, "current"), Friction(1.0, SLIP))
    scene = Scene(SHEET, WAVES[name], ALPHA, effects=effects, cells=CELLS)
    return simulate(scene, periods, steps=steps, ramp=1.0, keep_every=steps).path.seen_from(1)


def write(table: Sequence[Row], path: Path = PATH) -> Path:
    """The rows as a table, after a line that tells how it was made."""
    words = f"alpha = {ALPHA:g}, lengths in L, angles in radians"
    return write_rows(path, table, COMMAND, words, DIGITS)


def read(path: Path = PATH) -> list[Row]:
    """The rows of a table. Raises FileNotFoundError, naming the command that makes it."""
    return read_rows(path, Row, COMMAND)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=PATH, metavar="FILE")
    parser.add_argument("--periods", type=int, default=PERIODS)
    options = parser.parse_args(arguments)
    write(compute(options.periods), options.out)


if __name__ == "__main__":
    main()

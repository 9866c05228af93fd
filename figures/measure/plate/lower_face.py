"""What friction on the lower face of a sheet, not on its mid-surface, adds to V under viscous friction.

    python -m figures.measure.plate.lower_face [--out FILE]

Writes figures/data/lower_face.csv: a second. The lower face slips by (h/2) beta grad w_t in addition
(docs/saddle.md). Let s be its part along y per unit beta, less its mean over the sheet. With the load
1 + alpha e + beta p the balance of viscous friction adds, with means over sheet and period,

    V_ab: -<e s>,    V_bb: -<p s>.

For a deflection A sin(k y - omega t) and p = -(S/rho g) w with S the rate of the ground the second is
(S/rho g) (h/4) A^2 k omega > 0: a trough presses most, and its lower face slips against the wave.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.saddle import COEFFICIENT, LAWS, PLACES, WAVES, scene
from linear_theory import ritz_field, second_order
from linear_theory.deformation.plate import PlateField, foundation, plate_field
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

POINTS = (16, 40)
"""Gauss points across and along."""

PHASES = 16
"""Times: a product of two fields, each of one frequency, has none above two."""

STEP = 1e-4
"""Of the central difference of the deflection, over L and T: 1e-6 of its value."""


@dataclass(frozen=True)
class Row:
    """Coefficients over L^2/T and L^3/T: V_ab of the mid-surface, and what the lower face adds."""

    ground: str
    middle_ab: float
    added_ab: float
    added_bb: float
    seconds: float


TABLE = Table(
    DATA / "lower_face.csv",
    Row,
    "python -m figures.measure.plate.lower_face",
    "sine wave, viscous friction; speeds in L/T, beta in 1/L, seconds of the processor",
    6,
)


def added(asked: Scene, rtol: float = 1e-4) -> tuple[float, float]:
    """What viscous friction on the lower face adds to V_ab and V_bb of a scene with a sine wave.

    L^2/T and L^3/T. rtol: of both fields, by which the error of the sums is a few times rtol.
    """
    sheet = asked.sheet
    plane = ritz_field(sheet, asked.wave, rtol=rtol)
    ground = foundation(asked.effects)
    plate, drive = plate_field(sheet, asked.wave, ground, rtol), asked.drive
    x, y, weights = grid(sheet.width, sheet.length)
    mixed = bent = 0.0
    for t in asked.wave.period * np.arange(PHASES) / PHASES:
        strain, pressure = plane.strain(x, y, t), plate.pressure(x, y, t)
        load = ground.load.rate(strain[0] + strain[1], drive.value(x, y, t))
        slip = sheet.thickness / 2 * _slope_rate(plate, x, y, t)
        slip -= np.sum(weights * slip)
        mixed -= float(np.sum(weights * load * slip)) / PHASES
        bent -= float(np.sum(weights * pressure * slip)) / PHASES
    return mixed, bent


def _slope_rate(plate: PlateField, x: Array, y: Array, t: float) -> Array:
    """d/dt of dw/dy."""

    def slope(at: float) -> Array:
        return (plate.deflection(x, y + STEP, at) - plate.deflection(x, y - STEP, at)) / (2 * STEP)

    return (slope(t + STEP) - slope(t - STEP)) / (2 * STEP)


def grid(width: float, length: float, points: tuple[int, int] = POINTS) -> tuple[Array, Array, Array]:
    """Gauss points, and weights of sum 1."""
    (x, p), (y, q) = (np.polynomial.legendre.leggauss(n) for n in points)
    return width / 2 * x[:, None], length / 2 * y[None, :], np.outer(p, q) / 4


def row(place: str) -> Row:
    """One row of the table."""
    begin = time.process_time()
    asked = scene(PLACES[place], WAVES["sine"], LAWS["viscous"], 0.01, 0.0)
    middle = second_order(asked, rtol=COEFFICIENT).coefficients.alpha_beta.value
    mixed, bent = added(asked)
    return Row(place, middle, mixed, bent, time.process_time() - begin)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    TABLE.write([row(place) for place in PLACES], TABLE.options(__doc__, arguments).out)


if __name__ == "__main__":
    main()

"""What viscous friction on the lower face adds to V_ab and V_bb, in a few sums of its own.

The lower face slips by (h/2) beta grad(w_t) in addition. Let s be its part along y per unit beta, less
its mean over the sheet. With the load 1 + alpha e + beta p viscous friction adds, with means over sheet
and period,

    V_ab: -<e s>,    V_bb: -<p s>.

For a deflection A sin(k y - omega t) and p = -(S/rho g) w with S the rate of the ground the second is
(S/rho g) (h/4) A^2 k omega > 0: a trough presses most, and its lower face slips against the wave.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory import ritz_field
from linear_theory.deformation.plate import PlateField, foundation, plate_field
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

POINTS = (16, 40)
"""Gauss points across and along."""

PHASES = 16
"""Times: a product of two fields, each of one frequency, has none above two."""

STEP = 1e-4
"""Of the central difference of the deflection, over L and T: 1e-6 of its value."""


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
        slip = sheet.thickness / 2 * slope_rate(plate, x, y, t)
        slip -= np.sum(weights * slip)
        mixed -= float(np.sum(weights * load * slip)) / PHASES
        bent -= float(np.sum(weights * pressure * slip)) / PHASES
    return mixed, bent


def slope_rate(plate: PlateField, x: Array, y: Array, t: float) -> Array:
    """d/dt of dw/dy."""

    def slope(at: float) -> Array:
        return (plate.deflection(x, y + STEP, at) - plate.deflection(x, y - STEP, at)) / (2 * STEP)

    return (slope(t + STEP) - slope(t - STEP)) / (2 * STEP)


def grid(width: float, length: float, points: tuple[int, int] = POINTS) -> tuple[Array, Array, Array]:
    """Gauss points, and weights of sum 1."""
    (x, p), (y, q) = (np.polynomial.legendre.leggauss(n) for n in points)
    return width / 2 * x[:, None], length / 2 * y[None, :], np.outer(p, q) / 4

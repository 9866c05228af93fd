"""Elastic energy of a sheet in small-strain theory: the rate at which growth stores it.

Growth does the work -int h sigma : I alpha dc/dt dA on a sheet whose shape is held, and no force does
any on one that is in equilibrium: the stress of plane stress is orthogonal to every strain of free
edges. So this is the rate of the stored energy, and its mean over a period vanishes. With
tr sigma = (tr eps - 2 alpha c) E/(1 - nu) nothing but the dilation is needed.

In the same way the curvature coupling does the work D (1 + nu) beta^2 int (lap w + 2 c) dc/dt dA on a
plate with deflection beta w, which bends it and moves it on its ground.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre
from linear_theory.common.shown import Shown
from linear_theory.deformation.field import LinearField
from linear_theory.deformation.plate import PlateField
from linear_theory.deformation.ritz import legendre
from linear_theory.motion.cells import gauss
from linear_theory.motion.motion import CellGrid

Array = NDArray[np.float64]

DENSITY, ORDER = 2.0, 6
"""Cells per wave and Gauss points per cell: the integrand has no kinks."""

BATCH = 64
"""Times at once."""

MORE_POINTS = 12
"""Gauss points per direction beyond the degree of a deflection: waves between its polynomials."""


class _Storing(NamedTuple):
    rate: Array
    error: float


class Storing(Shown, _Storing):
    """Rate at which energy is stored over E h and the undeformed area, 1/time, (times,).

    error: estimated mean of its absolute error over a period; NaN if not known.
    """


def stored_rate(field: LinearField, times: Array) -> Array:
    """d(stored energy)/dt over E h alpha^2 and the area of the sheet, 1/time, (times,)."""
    across, along = field.drive.short_waves
    grid = CellGrid.graded(field.sheet, along, DENSITY, field.mirrored, across)
    return np.concatenate(
        [_rate(field, times[i : i + BATCH], grid) for i in range(0, times.size, BATCH)]
    )


def bent_rate(plate: PlateField, times: Array) -> Array:
    """d(stored energy)/dt of bending and ground over E h beta^2 and the area of the sheet, (times,).

    Units of length^2 per time.
    """
    return np.concatenate([_bent(plate, times[i : i + BATCH]) for i in range(0, times.size, BATCH)])


def _bent(plate: PlateField, times: Array) -> Array:
    sheet, field = plate.sheet, plate.at(times)
    (a, by_x), (b, by_y) = (gauss_legendre(degree + MORE_POINTS) for degree in plate.degree)
    laplacian = field.derivative_polynomials()[:, 2:4].sum(1)
    bent = legendre.evaluate(laplacian[:, None], a[:, None], b)[:, 0]
    bent = np.tensordot(field.cases.amplitudes(times).T, bent, 1)
    x, y, t = sheet.width / 2 * a[:, None], sheet.length / 2 * b, times[:, None, None]
    c, rate = (np.broadcast_to(f(x, y, t), bent.shape) for f in (plate.drive.value, plate.drive.rate))
    rigidity = sheet.thickness**2 / (12 * (1 - sheet.poisson))  # D (1 + nu)/(E h)
    return np.asarray(rigidity * (((bent + 2 * c) * rate) @ by_y @ by_x) / 4)


def _rate(field: LinearField, times: Array, grid: CellGrid) -> Array:
    motion, weights = field.motion(times, grid, ORDER), gauss(ORDER).weights
    x, y = motion.position
    rate = field.drive.rate(x, y, times.reshape(-1, *(1,) * x.ndim))
    stress = (motion.dilation - 2 * motion.growth) / (1 - field.sheet.poisson)
    density = -stress * rate * motion.area
    area = float((motion.area @ weights @ weights).sum())
    return np.asarray((density @ weights @ weights).sum(-1) / area)

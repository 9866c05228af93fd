"""How the lower face of a bending sheet moves along the ground, beside its mid-surface.

Its points lie at x - (h/2) n. With u per unit alpha and the deflection beta w + alpha beta w_ab +
beta^2 w_bb, upwards, the normal of a surface (x + alpha u, w) is, along the ground and to second order,

    n_a = - beta w_a + alpha beta (u_c,a w_c - w_ab,a) - beta^2 w_bb,a,

so that the lower face is displaced by (h/2) beta grad(w) at first order, and at second by

    (h/2) [alpha beta (grad(w_ab) - grad(u_c) w_c) + beta^2 grad(w_bb)].
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.deformation.plate.field import FINER, PlateField
from linear_theory.deformation.plate.second import SecondDeflection
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.second.field import SecondOrderField

Array = NDArray[np.float64]


class FaceMotion(NamedTuple):
    """Of the lower face beside the mid-surface at times and points, (2, times, ...) each.

    displacement, first: per unit beta; mixed, bent: velocities per unit alpha beta and beta^2.
    """

    displacement: Array
    first: Array
    mixed: Array
    bent: Array


class LowerFace:
    """The lower face of a sheet, from its fields.

    error: estimated relative L2 error of its velocity of first order at the worst phase; speed: largest
    root mean square of that, length^2 per time.
    """

    def __init__(self, plane: SecondOrderField, plate: PlateField) -> None:
        self.plane, self.plate, self.sheet = plane, plate, plate.sheet
        self.deflection = SecondDeflection(plane, plate).measured()
        self.depth = self.sheet.thickness / 2
        self.error, self.speed = self._measured()
        self._kept: tuple[Array, SecondDeflection, tuple[Array, ...]] | None = None

    def _measured(self) -> tuple[float, float]:
        across, along = (ritz_error.odd(d / FINER) for d in self.plate.degree)
        coarse = PlateField(self.plate.drive, self.plate.foundation, (across, along), self.plate.cases)
        slopes = self.plate.derivative_polynomials()[:, :2]
        change = slopes.copy()
        change[..., : across + 1, : along + 1] -= coarse.derivative_polynomials()[:, :2]
        phases = self.plate.drive.period * np.arange(32) / 32
        harmonic = self.plate.at(phases) is self.plate
        rates = self.plate.cases.rates(phases) if harmonic else self.plate.cases.samples()
        size = float(mixed_norms(slopes, rates).max(initial=0.0))
        missed = float(mixed_norms(change, rates).max(initial=0.0))
        return (missed / size if size else 0.0), self.depth * size / 2

    def on(self, position: Array, times: Array) -> FaceMotion:
        """At points (2, ...) and times (T,)."""
        deflection, plate = self.deflection.at(times), self.plate.at(times)
        slopes, gradients, second = self._values(position, deflection)
        amplitudes, rates = plate.cases.amplitudes(times), plate.cases.rates(times)
        slope, slope_rate = (_at(factors, slopes, 1) for factors in (amplitudes, rates))
        gradient, gradient_rate = (_at(factors, gradients, 2) for factors in (amplitudes, rates))
        mixed, bent = _at(deflection.rates(times), second, 2)
        turned = np.einsum("kjt...,kt...->jt...", gradient_rate, slope)
        turned += np.einsum("kjt...,kt...->jt...", gradient, slope_rate)
        return FaceMotion(*(self.depth * v for v in (slope, slope_rate, mixed - turned, bent)))

    def _values(self, position: Array, deflection: SecondDeflection) -> tuple[Array, ...]:
        """Slopes of w (cases, 2, ...), of u (cases, 2, 2, ...), of w_ab and w_bb (basis, 2, 2, ...)."""
        if self._kept is None or self._kept[0] is not position or self._kept[1] is not deflection:
            local = 2 * position[0] / self.sheet.width, 2 * position[1] / self.sheet.length
            plate, plane = deflection.plate, deflection.plane
            tables = plate.derivative_polynomials()[:, :2], plane.first.gradient_polynomials
            found = tuple(_evaluated(table, *local) for table in (*tables, deflection.slopes))
            self._kept = position, deflection, found
        return self._kept[2]


def _evaluated(table: Array, x: Array, y: Array) -> Array:
    """Polynomials (n, ..., degree x + 1, degree y + 1) at points, (n, ..., *points)."""
    flat = table.reshape(len(table), -1, *table.shape[-2:])
    return legendre.evaluate(flat, x, y).reshape(*table.shape[:-2], *x.shape)


def _at(factors: Array, values: Array, components: int) -> Array:
    """(..., times, *points) from factors (cases, times) and values (cases, ..., *points)."""
    return np.moveaxis(np.tensordot(factors.T, values, 1), 0, components)

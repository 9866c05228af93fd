"""Deformation of a bending sheet on its ground over one period, for pictures and for its power."""

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.field import LinearField, combine
from linear_theory.deformation.plate import PlateField
from linear_theory.deformation.plate.stretching import StretchField
from linear_theory.deformation.ritz import legendre
from linear_theory.energy.stored import Storing, bent_rate
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.speed.drawn import LinearDeformation

Array = NDArray[np.float64]


class BentDeformation(LinearDeformation):
    """`Deformation` of a plate in full contact: heights, pressure and slip to leading order in beta.

    The sheet is at x + alpha u, at the height beta w less the depth at which the ground carries it. Its
    load is 1 + alpha e + beta p, and what touches the ground slips with alpha v_1 + beta^2 v_b, on the
    lower face with (h/2) beta grad(dw/dt) in addition (see `terms` and `lower_face`).

    find_plate: returns the deflection w per unit curvature coupling; called on first use. couplings:
    alpha and beta.
    """

    def __init__(
        self,
        find: Callable[[], LinearField],
        find_plate: Callable[[], PlateField],
        couplings: tuple[float, float],
        contact: Contact,
    ) -> None:
        super().__init__(find, couplings[0], contact, "shape to first order in alpha and beta")
        self._find_plate, self._beta = find_plate, couplings[1]

    @cached_property
    def plate(self) -> PlateField:
        """w per unit curvature coupling."""
        return self._find_plate()

    @cached_property
    def stretch(self) -> StretchField:
        """The displacement of order beta^2."""
        return StretchField(self.plate)

    def places(self, points: Array, times: Array) -> Array:
        """See Deformation; the third component is the height above z = 0, the ground at rest."""
        flat = super().places(points, times)
        deflection = self.plate.deflection(points[0], points[1], np.reshape(times, (-1, 1)))
        return np.concatenate([flat, (self._beta * deflection - self.plate.foundation.depth)[None]])

    def _pressure(self, points: Array, t: float) -> Array:
        return super()._pressure(points, t) + self._beta * self.plate.pressure(points[0], points[1], t)

    def _velocity(self, points: Array, t: float) -> Array:
        at, (x, y) = np.array(t), points
        stretch = self.stretch.at(at)
        bent = combine(stretch.rates(at), stretch.displacements(x, y))
        velocity = super()._velocity(points, t) + self._beta**2 * bent
        return velocity + self._of_face(x, y, at) if self.law.on_lower_face else velocity

    def _of_face(self, x: Array, y: Array, t: Array) -> Array:
        """Of the lower face beside the mid-surface, to first order in beta."""
        plate, sheet = self.plate.at(t), self.plate.sheet
        slopes = plate.derivative_polynomials()[:, :2]
        basis = legendre.evaluate(slopes, 2 * x / sheet.width, 2 * y / sheet.length)
        return sheet.thickness / 2 * self._beta * combine(plate.cases.rates(t), basis)

    def storing(self, times: Array) -> Storing:
        """See Deformation. Of second order in alpha and beta; growth and bending do not mix there.

        Raises ValueError where growth changes the weight as a whole, which does work against it that
        the ratio of friction to stiffness does not tell.
        """
        if self._load is not Load.MATERIAL and self.drive.series is None:
            raise ValueError(
                f"load = {str(self._load)!r}: must be 'material' for the power of growth of a sheet "
                "that bends, or the wave a TravellingWave, which does not change the weight; "
                "simulate(scene).power has it for any"
            )
        plane, rate = super().storing(times), self._beta**2 * bent_rate(self.plate, times)
        return Storing(
            plane.rate + rate, plane.error + 2 * self.plate.error * float(np.mean(abs(rate)))
        )

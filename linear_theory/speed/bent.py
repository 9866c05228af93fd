"""Deformation of a sheet that bends on its ground, to first order in alpha and beta."""

from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.field import LinearField
from linear_theory.deformation.plate import PlateField
from linear_theory.energy.stored import Storing, bent_rate
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.speed.drawn import LinearDeformation

Array = NDArray[np.float64]


class BentDeformation(LinearDeformation):
    """`LinearDeformation`, seen from above, of a sheet that stores energy by bending, too.

    find_plate: returns the deflection w per unit curvature coupling; called on first use.
    """

    def __init__(
        self,
        find: Callable[[], LinearField],
        find_plate: Callable[[], PlateField],
        couplings: tuple[float, float],
        contact: Contact,
    ) -> None:
        super().__init__(find, couplings[0], contact)
        self._find_plate, self._beta = find_plate, couplings[1]

    @cached_property
    def plate(self) -> PlateField:
        """w per unit curvature coupling."""
        return self._find_plate()

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

"""Sources that are quadratic in a deflection and the growth that bends it, at the phases of a wave."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.plate.field import PlateField
from linear_theory.deformation.second.source import GaussGrid, at_each_time

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class QuadraticSource(ABC):
    """Virtual work of a deflection w and of c on test functions, quadratic in both together."""

    plate: PlateField

    def moments(self, times: Array, amplitudes: Array) -> Array:
        """At times (T,), (T, 2, degree x + 1, degree y + 1); amplitudes: of the load cases."""
        grid, fields = self._on_grid()
        growths = grid.growth(self.plate.drive.value, times)
        return self._works(grid, fields, amplitudes, growths)

    def moment_rates(self, times: Array, amplitudes: Array, rates: Array) -> Array:
        """Time derivatives of `moments`: a central difference, exact for a quadratic."""
        grid, fields = self._on_grid()
        step = self.plate.drive.period / (2 * np.pi)
        growths = grid.growth(self.plate.drive.value, times)
        changes = step * grid.growth(self.plate.drive.rate, times)
        after, before = (
            self._works(grid, fields, amplitudes + sign * step * rates, growths + sign * changes)
            for sign in (1, -1)
        )
        return np.asarray((after - before) / (2 * step))

    def _works(self, grid: GaussGrid, fields: Array, amplitudes: Array, growths: Array) -> Array:
        pairs = zip(at_each_time(amplitudes, fields), growths, strict=True)
        return np.stack([self._work(grid, values, c) for values, c in pairs])

    @abstractmethod
    def _on_grid(self) -> tuple[GaussGrid, Array]:
        """Gauss points, and what `_work` needs of each load case there, (cases, fields, ...)."""

    @abstractmethod
    def _work(self, grid: GaussGrid, fields: Array, c: Array) -> Array:
        """(2, degree x + 1, degree y + 1) for the fields at one time and c."""


def bending_moments(bent: Array, poisson: float) -> Array:
    """M(A) = (1 - nu) A + nu tr(A) I over the bending stiffness, of A = (xx, yy, xy)."""
    trace = poisson * (bent[0] + bent[1])
    found = (1 - poisson) * bent
    found[:2] += trace
    return found

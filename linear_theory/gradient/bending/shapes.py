"""The deformation of a bending sheet in polynomials of fixed degrees, and what weights make of it."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import Harmonics
from linear_theory.deformation.plate import PlateField, foundation
from linear_theory.deformation.plate.stretching import StretchField
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz.moments import gauss_moments
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.deformation.second.field import SecondOrderField
from linear_theory.friction.load import Load
from linear_theory.gradient.bending.weights import TimeWeights
from linear_theory.scene.scene import Scene
from linear_theory.speed.plate.terms import PlateTerms

Array = NDArray[np.float64]

PARTS = ("v_1", "v_2", "v_b", "e", "p")
"""Of the balance, in the order of `Shapes.works`."""

TIMES = 64
"""Of waves that are no series, whose deformation is solved for at every time, in one go."""


class Shapes(NamedTuple):
    """The fields of a scene; ratio: beta/alpha."""

    plane: SecondOrderField
    plate: PlateField
    stretch: StretchField
    ratio: float

    @classmethod
    def of(cls, scene: Scene, terms: PlateTerms) -> "Shapes":
        """Those of a scene that is solved."""
        ratio = scene.curvature_coupling / scene.alpha
        return cls(terms.plane, terms.plate, terms.stretch, ratio)

    def near(self, scene: Scene) -> "Shapes":
        """Those of a scene near the own one."""
        solver = RitzSolver(scene.sheet, self.plane.first.degree)
        driven = scene.drive.fine
        plane = SecondOrderField(RitzField(driven, solver), scene.growth)
        plate = PlateField(driven, foundation(scene.effects), self.plate.degree)
        ratio = scene.curvature_coupling / scene.alpha
        return Shapes(plane, plate, StretchField(plate, self.stretch.degree), ratio)

    def at(self, times: Array) -> "Shapes":
        """The fields that serve these times."""
        plane, plate = self.plane._for_times(times), self.plate.at(times)
        return self._replace(plane=plane, plate=plate, stretch=self.stretch.at(times))

    @property
    def is_series(self) -> bool:
        """Whether one basis serves all times."""
        return isinstance(self.plate.cases, Harmonics)

    def works(self, weights: TimeWeights) -> Array:
        """Weights times velocities and loads, of each of `PARTS`, (parts, k, 2, T)."""
        if self.is_series:
            return self._works(weights)
        starts = range(0, weights.times.size, TIMES)
        found = [weights.some(slice(start, start + TIMES)) for start in starts]
        return np.concatenate([self.at(one.times)._works(one) for one in found], -1)

    def _works(self, weights: TimeWeights) -> Array:
        plane, plate, stretch, times = self.plane, self.plate, self.stretch, weights.times
        velocities = [
            _summed(weights.on_velocity(polynomials), rates)
            for polynomials, rates in (
                (plane.first._polynomials, plane.first._amplitude_rates(times)),
                (plane._polynomials, plane._times.rates(times)),
                (stretch._polynomials, stretch.rates(times)),
            )
        ]
        counts = weights.load.shape[-2:]
        loads = [
            _summed(weights.on_load(polynomials), plate.cases.amplitudes(times))
            for polynomials in (
                load_polynomials(plane.first, plate.foundation.load, (counts[0], counts[1])),
                -plate.pressing * plate.polynomials,
            )
        ]
        a, ratio = weights.sizes, self.ratio
        first, second, bent = velocities
        return np.stack([first, a * second, a * ratio**2 * bent, loads[0], ratio * loads[1]])


def load_polynomials(first: RitzField, load: Load, counts: tuple[int, int]) -> Array:
    """e of each load case, (cases, degrees x, degrees y)."""
    if load is Load.GROWN:
        moments = gauss_moments(first.sheet, counts, first._cases.growths)
        return load.rate(np.zeros_like(moments), moments)
    slopes = first.gradient_polynomials
    dilation = slopes[:, 0, 0] + slopes[:, 1, 1]
    return load.rate(dilation, np.zeros_like(dilation))


def _summed(values: Array, factors: Array) -> Array:
    """Sums over the basis of values (k, 2, T, basis) and factors (basis, T)."""
    return np.einsum("kstj,jt->kst", values, factors)

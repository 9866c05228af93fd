"""The deformation to second order in polynomials of fixed degrees, and what weights make of it."""

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
from linear_theory.gradient.second.weights import TimeWeights
from linear_theory.scene.scene import Scene
from linear_theory.speed.plate.terms import PlateTerms

Array = NDArray[np.float64]

PARTS = ("v_1", "v_2", "e", "v_b", "p")
"""Of the balance, in the order of `Shapes.works`; the first three of a planar sheet."""

TIMES = 64
"""Of waves that are no series, whose deformation is solved for at every time, in one go."""


class Bent(NamedTuple):
    """The deflection of a sheet, its stretching by it, and beta/alpha."""

    plate: PlateField
    stretch: StretchField
    ratio: float

    def near(self, scene: Scene) -> "Bent":
        """Those of a scene near the own one."""
        plate = PlateField(scene.drive.fine, foundation(scene.effects), self.plate.degree)
        return Bent(plate, StretchField(plate, self.stretch.degree), ratio_of(scene))

    def at(self, times: Array) -> "Bent":
        """The fields that serve these times."""
        return self._replace(plate=self.plate.at(times), stretch=self.stretch.at(times))

    @property
    def pressures(self) -> Array:
        """p of each load case, (cases, degrees x, degrees y)."""
        return -self.plate.pressing * self.plate.polynomials


class Shapes(NamedTuple):
    """The fields of a scene and what its normal load is; bent: None for a sheet that stays plane."""

    plane: SecondOrderField
    load: Load
    bent: Bent | None = None

    @classmethod
    def of(cls, scene: Scene, terms: PlateTerms) -> "Shapes":
        """Those of a bending scene that is solved."""
        bent = Bent(terms.plate, terms.stretch, ratio_of(scene))
        return cls(terms.plane, terms.plate.foundation.load, bent)

    def near(self, scene: Scene) -> "Shapes":
        """Those of a scene near the own one."""
        solver = RitzSolver(scene.sheet, self.plane.first.degree)
        plane = SecondOrderField(RitzField(scene.drive.fine, solver), scene.growth)
        return Shapes(plane, self.load, self.bent and self.bent.near(scene))

    def at(self, times: Array) -> "Shapes":
        """The fields that serve these times."""
        plane = self.plane._for_times(times)
        return self._replace(plane=plane, bent=self.bent and self.bent.at(times))

    @property
    def degrees(self) -> list[tuple[int, int]]:
        """Of all fields."""
        own = [self.plane.first.degree]
        return own + ([self.bent.plate.degree, self.bent.stretch.degree] if self.bent else [])

    @property
    def errors(self) -> Array:
        """Relative, of each of `PARTS`."""
        plane, bent = self.plane, self.bent
        own = [plane.error, plane.second_error, plane.error]
        return np.array(
            own + ([bent.stretch.error + 2 * bent.plate.error, bent.plate.error] if bent else [])
        )

    @property
    def is_series(self) -> bool:
        """Whether one basis serves all times."""
        return isinstance(self.plane.first._cases, Harmonics)

    def works(self, weights: TimeWeights) -> Array:
        """Weights times velocities and loads, of each of `PARTS`, (parts, k, 2, T)."""
        if self.is_series:
            return self._works(weights)
        starts = range(0, weights.times.size, TIMES)
        found = [weights.some(slice(start, start + TIMES)) for start in starts]
        return np.concatenate([self.at(one.times)._works(one) for one in found], -1)

    def _works(self, weights: TimeWeights) -> Array:
        plane, bent, times, a = self.plane, self.bent, weights.times, weights.sizes
        first, counts = plane.first, weights.load.shape[-2:]
        growing = load_polynomials(first, self.load, (counts[0], counts[1]))
        by_first = weights.on_velocity(first._polynomials)
        by_second = weights.on_velocity(plane._polynomials)
        found = [
            _summed(by_first, first._amplitude_rates(times)),
            a * _summed(by_second, plane._times.rates(times)),
            _summed(weights.on_load(growing), first._amplitudes(times)),
        ]
        if bent:
            by_stretch = weights.on_velocity(bent.stretch._polynomials)
            pressing = _summed(weights.on_load(bent.pressures), bent.plate.cases.amplitudes(times))
            slipping = _summed(by_stretch, bent.stretch.rates(times))
            found += [a * bent.ratio**2 * slipping, bent.ratio * pressing]
        return np.stack(found)


def ratio_of(scene: Scene) -> float:
    """beta/alpha."""
    return scene.curvature_coupling / scene.alpha


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

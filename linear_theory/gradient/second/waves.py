"""Derivatives by the harmonics of a travelling wave: all by one pass back through the deformation.

The load cases of a wave do not depend on its amplitudes, which are functions of time a_j(t), linear in
those of the harmonics. Velocity and load of first order are linear in a_j, u_2 and the stretching by
deflection quadratic: of these two, whose derivatives are not known at single times, there are those of
means over the period, see `transpose`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import Harmonics
from linear_theory.deformation.plate import PlateField
from linear_theory.deformation.plate.field import first_degrees as plate_degrees
from linear_theory.deformation.plate.stretching import BendingSource
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.deformation.second.source import Source
from linear_theory.gradient import elastic
from linear_theory.gradient.direction import Harmonic
from linear_theory.gradient.second.shapes import Bent, Shapes, load_polynomials
from linear_theory.gradient.second.transpose import BendingFlux, PlaneFlux, QuadraticFlux
from linear_theory.gradient.second.weights import TimeWeights
from linear_theory.wave.sampled import drive
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]
Change = Sequence[Harmonic]


class Rules(NamedTuple):
    """Linear functions of values at times (rules, T), as means are, and the weights of these.

    sides: at the times, or at those of both halves of a period, of which the mean is taken.
    """

    sides: Sequence[TimeWeights]
    rules: Array


@dataclass(frozen=True)
class Waves:
    """Harmonics up to a number, of a scene whose wave is a series.

    shapes: of the scene; rtol: of the deformation by harmonics that its wave does not have.
    """

    shapes: Shapes
    highest: int
    rtol: float

    @cached_property
    def series(self) -> TravellingWave:
        """The wave of the scene."""
        cases = self.shapes.plane.first._cases
        assert isinstance(cases, Harmonics)
        return cases.series

    @cached_property
    def all(self) -> TravellingWave:
        """A wave with all the harmonics and a mean."""
        ones, own = np.ones(max(self.highest, self.series.cosine.size)), self.series
        return TravellingWave(ones, ones, own.count, own.period, 1.0)

    @cached_property
    def first(self) -> RitzField:
        """u_1 by each of them."""
        sheet, own = self.shapes.plane.sheet, self.shapes.plane.first.degree
        both = int(self.all.orders[-1] + self.series.orders[-1])  # waves of a product
        least = own if self._has_all else ritz_error.first_degrees(sheet, both, self.rtol)
        across, along = (max(pair) for pair in zip(least, own, strict=True))
        return RitzField(drive(self.all, sheet).fine, RitzSolver(sheet, (across, along)))

    @cached_property
    def bent(self) -> Bent | None:
        """w by each of them, None for a planar sheet; the stretching is of the scene."""
        if not self.shapes.bent:
            return None
        own, driven = self.shapes.bent.plate, self.first.drive
        least = plate_degrees(own.sheet, own.foundation, driven, self.rtol)
        least = own.degree if self._has_all else least
        across, along = (max(pair) for pair in zip(least, own.degree, strict=True))
        plate = PlateField(driven, own.foundation, (across, along))
        return self.shapes.bent._replace(plate=plate)

    @property
    def _has_all(self) -> bool:
        return self.highest <= self.series.cosine.size

    @property
    def degrees(self) -> list[tuple[int, int]]:
        """Of all of these."""
        return [self.first.degree] + ([self.bent.plate.degree] if self.bent else [])

    def amplitudes(self, wave: TravellingWave, times: Array, rates: bool = False) -> Array:
        """Of the load cases in a wave (cases, *times.shape), or their rates."""
        even, odd = wave.factor_rates(times) if rates else wave.factors(times)
        lacking = np.zeros((self.all.cosine.size - len(even), *times.shape))
        mean = np.full((1, *times.shape), 0.0 if rates else wave.mean)
        return np.concatenate([even, lacking, odd, lacking, mean])

    def changes(self, change: Change, times: Array, rates: bool = False) -> Array:
        """What they change by, (cases, *times.shape)."""
        found = np.zeros((2 * self.all.cosine.size + 1, *times.shape))
        for k, cosine, sine in change:
            if k == 0:
                found[-1] += 0.0 if rates else cosine
                continue
            unit = np.eye(k)[-1]
            for size, parts in ((cosine, (unit, 0 * unit)), (sine, (0 * unit, unit))):
                if size:
                    wave = TravellingWave(*parts, self.series.count, self.series.period)
                    found += size * self.amplitudes(wave, times, rates)
        return found

    def at_times(self, weights: TimeWeights, changes: Sequence[Change]) -> Array:
        """Changes of what weights make of v_1, e and p at their times, (2 or 3, k, changes, 2, T)."""
        first, bent, counts = self.first, self.bent, weights.load.shape[-2:]
        by_rate = weights.on_velocity(first._polynomials)
        growing = load_polynomials(first, self.shapes.load, (counts[0], counts[1]))
        by_value = [weights.on_load(growing)]
        if bent:
            by_value.append(weights.on_load(bent.ratio * bent.pressures))
        found = []
        for change in changes:
            value, rate = (self.changes(change, weights.times, r) for r in (False, True))
            pairs = [(by_rate, rate), *((part, value) for part in by_value)]
            found.append(np.stack([np.einsum("kstj,jt->kst", *pair) for pair in pairs]))
        return np.stack(found, 2)

    def of_means(self, rules: Sequence[Rules], changes: Sequence[Change]) -> list[Array]:
        """Changes of the odd part of what weights make of v_2 and v_b, of each rule.

        (1 or 2, k, rules, changes) each.
        """
        phases = self._phases
        slopes = np.stack([self.changes(change, phases) for change in changes])
        here = self.amplitudes(self.series, phases)
        found = []
        for flux, solver, factor in self._fluxes:
            tested = np.concatenate([self._tested(one, solver) for one in rules], 1)
            by_cases = factor * flux.by_cases(here, tested)
            found.append(np.einsum("njs,cjs->nc", by_cases, slopes))
        sizes = [len(one.sides[0].velocity) * len(one.rules) for one in rules]
        parts = np.split(np.stack(found), np.cumsum(sizes)[:-1], 1)
        shapes = [(len(found), -1, len(one.rules), len(changes)) for one in rules]
        return [part.reshape(shape) for part, shape in zip(parts, shapes, strict=True)]

    @property
    def _fluxes(self) -> "list[tuple[QuadraticFlux, RitzSolver, float]]":
        """Of u_2 and of the stretching by deflection, with the solver of these and their share."""
        first, own = self.first, self.shapes.plane._source
        plane = Source(first.drive, first.gradient_polynomials, own.square, own.weight)
        found: list[tuple[QuadraticFlux, RitzSolver, float]] = [
            (PlaneFlux(first, plane), first.solver, 1.0)
        ]
        if bent := self.bent:
            degree = bent.stretch.degree if self._has_all else bent.plate.degree
            flux = BendingFlux(first, BendingSource(bent.plate, degree))
            found.append((flux, RitzSolver(first.sheet, degree), bent.ratio**2))
        return found

    @cached_property
    def _phases(self) -> Array:
        """That resolve products of two harmonics."""
        count = 4 * self.all.cosine.size + 1
        return np.linspace(0, self.series.period, count, endpoint=False)

    def _tested(self, of: Rules, solver: RitzSolver) -> Array:
        """Displacements on which the fluxes at each phase do work, (phases, k rules, 2, ...).

        Between the phases, fluxes are trigonometric polynomials: their rates at other times are sums
        over the phases.
        """
        across, along = solver.degree
        summed = 0.0
        for weights in of.sides:
            mean = weights.velocity.mean(1)[..., : across + 1, : along + 1]  # of both signs, a cancels
            series = trigonometric_rates(weights.times, self._phases, self.series.period)
            summed = summed + np.einsum("rt,ts,ktdij->skrdij", of.rules, series, mean, optimize=True)
        moments = np.asarray(summed) / len(of.sides)
        load = elastic.displacement_load(moments.reshape(-1, *moments.shape[-3:]))
        z = elastic.adjoint(solver, load, mirrored=True)
        return z.reshape(len(moments), -1, *moments.shape[-3:])


def trigonometric_rates(times: Array, phases: Array, period: float) -> Array:
    """Rates at times (T,) of the trigonometric polynomials that are 1 at one of the phases, (T, S).

    phases: equidistant over the period, an odd number of them.
    """
    highest, frequency = len(phases) // 2, 2 * np.pi / period
    k = frequency * np.arange(1, highest + 1)
    angle = k[:, None, None] * (times[:, None] - phases)
    return np.asarray(-2 / len(phases) * np.tensordot(k, np.sin(angle), 1))

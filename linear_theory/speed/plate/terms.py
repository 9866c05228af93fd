"""What bending adds to the second order of the friction balance: pressure and slip.

To second order in (alpha, beta) the mid-surface slips with alpha v_1 + alpha^2 v_2 + beta^2 v_b and
carries the load 1 + alpha e + beta p: a deflection moves no point along the ground at first order, and
growth and deflection together move none at second order, because the energy of the sheet is even in
(beta, w). The balance of second order is linear in its sources (see `second_order`), so that

    v_2 and e give V_aa,    p gives V_ab,    v_b gives V_bb.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.deformation.field import LinearField
from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.deformation.plate import PlateField, foundation, plate_field
from linear_theory.deformation.plate.stretching import StretchField
from linear_theory.deformation.second.field import SecondOrderField, second_order_field
from linear_theory.friction.contact import Contact
from linear_theory.motion.motion import Motion
from linear_theory.scene.scene import Scene
from linear_theory.speed.expansion import (
    SECOND_SHARE,
    Coefficients,
    field_tolerance,
    second_field_error,
)

Array = NDArray[np.float64]

PLATE_SHARE = 0.5
"""Fraction of rtol allotted to the deflection; its error is that of a coarser solution."""

PRESSED = 1e-4
"""Smallest V_ab against which errors count, in L/T times pressure; where it is not 0 by symmetry, on a
layer of 0.005 L it is 5e-4."""


class Weights(NamedTuple):
    """How much of each source of second order is counted: of alpha^2, alpha beta and beta^2."""

    growth: float = 0.0
    pressure: float = 0.0
    bending: float = 0.0


@dataclass(eq=False)
class PlateTerms:
    """The deformation of a bending sheet: in its plane, its deflection, its stretching by slopes."""

    plane: SecondOrderField
    plate: PlateField
    stretch: StretchField
    _kept: tuple[Array, Array, Array] | None = field(default=None, repr=False)

    @classmethod
    def of(cls, scene: Scene, rtol: float) -> "PlateTerms":
        """For a scene of a sheet on its ground; rtol: of the speed."""
        ground = foundation(scene.effects)
        plane = second_order_field(scene.sheet, scene.wave, scene.growth, field_tolerance(rtol))
        plate = plate_field(scene.sheet, scene.wave, ground, PLATE_SHARE * rtol)
        return cls(plane, plate, StretchField(plate).measured())

    def contact(self, scene: Scene) -> Contact:
        """That of the scene, with the reference area of weight and pressure as its load."""
        return replace(scene.contact, load=self.plate.foundation.load)

    @property
    def lift_off(self) -> tuple[float, float]:
        """The beta, negative and positive, at which the pressure vanishes somewhere, 1/length."""
        return self.plate.lift_off(-1.0), self.plate.lift_off(1.0)

    @property
    def largest_pressure(self) -> float:
        """Root mean square of p over the sheet at the worst phase, units of length."""
        norms = mixed_norms(self.plate.polynomials, self.plate.cases.samples())
        return float(norms.max(initial=0.0) / 2 * self.plate.pressing)

    @property
    def smallest(self) -> tuple[float, float]:
        """Of V_ab and V_bb, length^2/time and length^3/time: errors of smaller ones count relative to
        these.

        V_ab: 1e-4 of L/T times the root mean square of p, which on stiff ground is in layers at the
        edges. V_bb: the root mean square of v_b, since viscous friction lets it vanish.
        """
        unit = self.plane.sheet.length / self.plane.drive.period
        return PRESSED * unit * self.largest_pressure, self.stretch.speed

    def on(self, motion: Motion, times: Array) -> tuple[Array, Array]:
        """v_b (2, times, cells, n, n) and p (times, cells, n, n) at the points of a motion."""
        plate, stretch = self.plate.at(times), self.stretch.at(times)
        if plate is not self.plate or self._kept is None or self._kept[0] is not motion.position:
            x, y = motion.position
            self._kept = motion.position, stretch.displacements(x, y), plate.deflections(x, y)
        _, displacements, deflections = self._kept
        velocity = np.moveaxis(np.tensordot(stretch.rates(times).T, displacements, 1), 1, 0)
        deflection = np.tensordot(plate.cases.amplitudes(times).T, deflections, 1)
        return velocity, -plate.pressing * deflection


@dataclass(frozen=True)
class PlateCoefficients(Coefficients):
    """The balance of second order with weighted sources."""

    terms: PlateTerms
    weights: Weights

    def field_error(self, motion: RigidMotion) -> float:
        """Error of what is counted due to the errors of the deformation."""
        second = weighted_error(self.terms, self.weights, motion.fastest)
        return self._first_error(motion) + self.alpha**2 * second

    def work_errors(self, motion: RigidMotion) -> Array:
        """See Crawl."""
        second = weighted_error(self.terms, self.weights, motion.fastest)
        errors = np.array([self.field.error * motion.fastest, 2 * second])
        return self.power_per_speed(motion) * errors

    def _motion(self, times: Array) -> Motion:
        motion, w = super()._motion(times), self.weights
        second = w.growth * np.asarray(motion.second)
        if w.bending:
            second = second + w.bending * self.terms.on(motion, times)[0]
        # what a turning sheet's displacement does belongs to the order alpha^2
        return replace(motion, second=second, displacement=motion.displacement if w.growth else None)

    def _rate(self, times: Array, motion: Motion) -> Array:
        rate, w = self.weights.growth * super()._rate(times, motion), self.weights
        return rate + w.pressure * self.terms.on(motion, times)[1] if w.pressure else rate


def weighted_error(terms: PlateTerms, weights: Weights, fastest: float) -> float:
    """Error of the weighted coefficients of second order due to the errors of the deformation.

    fastest: the largest speed against the ground per unit alpha. p enters linearly, v_b is quadratic in
    the deflection, and the error of u_1 counts for both.
    """
    plane, plate, stretch = terms.plane, terms.plate, terms.stretch
    pressure = (plate.error + plane.error) * terms.largest_pressure * fastest
    bending = (stretch.error + 2 * plate.error + plane.error) * stretch.speed
    own = weights.growth * second_field_error(plane, fastest)
    return own + SECOND_SHARE * (abs(weights.pressure) * pressure + weights.bending * bending)


@dataclass(frozen=True)
class BendingAlone(Crawl):
    """The balance of a sheet without growth in its plane, alpha = 0, that slips with beta^2 v_b.

    `alpha` stands for beta^2 here, and the load is the weight alone.
    """

    field: LinearField
    terms: PlateTerms

    @property
    def starts_at_second_order(self) -> bool:
        """Never: v_b is even in the wave."""
        return False

    def field_error(self, motion: RigidMotion) -> float:
        """Error of V due to that of v_b."""
        return abs(self.alpha) * SECOND_SHARE * self._slip_error

    def work_errors(self, motion: RigidMotion) -> Array:
        """See Crawl."""
        return np.array([self.power_per_speed(motion) * self._slip_error, 0.0])

    @property
    def _slip_error(self) -> float:
        """Of v_b."""
        stretch, plate = self.terms.stretch, self.terms.plate
        return (stretch.error + 2 * plate.error) * stretch.speed

    def _motion(self, times: Array) -> Motion:
        motion = super()._motion(times)
        velocity = self.terms.on(motion, times)[0]
        return replace(motion, velocity=velocity, second=None, displacement=None)

    def _rate(self, times: Array, motion: Motion) -> Array:
        return np.zeros_like(motion.growth)

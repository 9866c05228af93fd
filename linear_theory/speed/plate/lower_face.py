"""The speed to second order of a bending sheet with friction on its lower face.

The slip of first order is then alpha v_1 + beta s_1, s_1 = (h/2) grad(w_t) (see `plate.lower_face`):
two slips that compete. V is a sum of a part of first degree in (alpha, beta), which vanishes for waves
with c(t + T/2) = -c(t), and one of second, but no polynomial: it is one for viscous friction alone, and
else another multiple of alpha^2 on each ray beta/alpha. With (alpha, beta) = size * (a, b) the sources
of the balance (see `second_order`) are

    slip a v_1 + b s_1,    of second order a^2 v_2 + a b s_ab + b^2 (v_b + s_bb),    load 1 + a e + b p.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.period import Period, average
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.plate.lower_face import LowerFace
from linear_theory.friction.contact import Contact
from linear_theory.friction.directional import Directional
from linear_theory.friction.law import Derived, FrictionLaw
from linear_theory.friction.laws import Viscous
from linear_theory.motion.motion import Motion
from linear_theory.motion.rigid import RigidNorm
from linear_theory.speed.expansion import (
    FIRST_SHARE,
    SECOND_SHARE,
    SMALLEST,
    TINY_ALPHA,
    Coefficients,
    cells,
    second_field_error,
    tiny,
)
from linear_theory.speed.plate.terms import PlateTerms, Weights, weighted_error
from linear_theory.speed.result import Estimate

Array = NDArray[np.float64]

UNKNOWN = Estimate(math.nan, math.inf)


class Ray(NamedTuple):
    """A direction in the plane of growth coupling alpha and curvature coupling beta (1/length)."""

    alpha: float
    beta: float


@dataclass(frozen=True)
class FaceCoefficients(Coefficients):
    """The balance on a ray, at the tiny size `alpha`."""

    terms: PlateTerms
    face: LowerFace
    ray: Ray

    def field_error(self, motion: RigidMotion) -> float:
        """Error of the second order due to the errors of the deformation."""
        return self.alpha**2 * face_error(self.terms, self.face, self.ray, motion.fastest)

    def _motion(self, times: Array) -> Motion:
        motion, (a, b) = super()._motion(times), self.ray
        of_face = self.face.on(motion.position, times)
        second = a**2 * np.asarray(motion.second) + a * b * of_face.mixed + b**2 * of_face.bent
        second = second + b**2 * self.terms.on(motion, times)[0]
        moved = motion.displacement
        return replace(
            motion,
            velocity=a * motion.velocity + b * of_face.first,
            second=second,
            displacement=None if moved is None else a * moved + b * of_face.displacement,
        )

    def _rate(self, times: Array, motion: Motion) -> Array:
        pressure = self.terms.on(motion, times)[1]
        return self.ray.alpha * super()._rate(times, motion) + self.ray.beta * pressure


def face_error(terms: PlateTerms, face: LowerFace, ray: Ray, fastest: float) -> float:
    """Error of the second order on a ray due to the errors of the deformation, length/time.

    fastest: the largest speed against the ground per unit of size.
    """
    a, b = abs(ray.alpha), abs(ray.beta)
    own = weighted_error(terms, Weights(0.0, b, b**2), fastest)
    own += a**2 * second_field_error(terms.plane, fastest / a) if a else 0.0
    load = a + b * terms.largest_pressure
    mixed, bent = face.depth * face.deflection.errors * face.deflection.speeds
    slips = load * b * face.error * face.speed + a * b * mixed + b**2 * bent
    return float(own + SECOND_SHARE * slips)


class FacePeriod(NamedTuple):
    """The motion on a ray: its period at the tiny size, and errors of both orders (2, 3)."""

    period: Period
    errors: Array


def on_ray(terms: PlateTerms, face: LowerFace, ray: Ray, contact: Contact, rtol: float) -> FacePeriod:
    """Balance on a ray; contact: with a law for speeds per unit of size."""
    unit = abs(ray.alpha) * terms.plane.sheet.length / terms.plane.drive.period
    unit += abs(ray.beta) * face.speed
    tolerance = Tolerance(rtol, SMALLEST * rtol * TINY_ALPHA**2 * unit)
    fine = cells(rtol, terms.plane, contact)
    crawl = FaceCoefficients(terms.plane, TINY_ALPHA, tiny(contact), fine, terms, face, ray)
    period = average(crawl, tolerance)
    fastest, law = period.fastest / TINY_ALPHA, contact.friction
    first = 0.0
    if not (terms.plane.drive.changes_sign and law.reversible):
        slips = abs(ray.alpha) * terms.plane.error * fastest + abs(ray.beta) * face.error * face.speed
        first = FIRST_SHARE * slips
    norm = RigidNorm(terms.plane.gyration, terms.plane.mirrored and law.mirrored)
    second = norm.each(face_error(terms, face, ray, fastest))
    return FacePeriod(period, period.mean_errors + np.stack([norm.each(first), second]))


def face_coefficients(
    terms: PlateTerms, second: Estimate, contact: Contact, rtol: float
) -> tuple[Estimate, Estimate]:
    """V_ab and V_bb under viscous friction, NaN with infinite error under any other law.

    From the rays (1, +-b); second: V_aa.
    """
    if not _is_linear(contact.friction):
        return UNKNOWN, UNKNOWN
    face, b = LowerFace(terms.plane, terms.plate), 1 / (terms.largest_pressure or 1.0)
    found = [on_ray(terms, face, Ray(1.0, s * b), contact, rtol) for s in (1, -1)]
    (up, down), errors = (f.period.means[1, 1] for f in found), [f.errors[1, 1] for f in found]
    error = float(sum(errors)) / 2
    mixed = Estimate(float(up - down) / (2 * b), error / b)
    bent = float(up + down) / 2 - second.value
    return mixed, Estimate(bent / b**2, (error + second.error) / b**2)


def _is_linear(law: FrictionLaw) -> bool:
    """Whether force is a linear function of velocity."""
    if isinstance(law, Derived):
        return _is_linear(law.law)
    if isinstance(law, Directional):
        return law.reversible and type(law.form) is Viscous
    return type(law) is Viscous

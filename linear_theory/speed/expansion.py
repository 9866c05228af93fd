"""The friction balance at the smallest growth, whose means are the coefficients of the speed.

See `second_order` for the equations.
"""

import math
from dataclasses import KW_ONLY, dataclass, replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl, Resolution, first_resolution, joint_resolution
from linear_theory.balance.period import Period, Resolved, resolved
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.common import validation
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.second.field import SecondOrderField
from linear_theory.friction.contact import Contact
from linear_theory.motion.rigid import RigidNorm
from linear_theory.speed.result import RigidSpeed

Array = NDArray[np.float64]

POINTS = 33
"""Points per direction at which growth of any form is checked."""

TINY_ALPHA = 1e-9
"""The alpha at which the balance is solved; neglected terms are of this relative size."""

SMALLEST = 1e-2
"""Of V_2, in L/T: errors of smaller ones count relative to this."""

MORE_HALVINGS = 8
"""Additional halvings of cells compared with an alpha that is not tiny: cells too coarse at a
stagnation point make q_1(t) rough, and the mean over time would then be refined in vain."""

COARSEST = 0.1
"""Largest tolerance of q_1."""

FIELD_SHARE = 0.1
"""Fraction of rtol allotted to the deformation, small because accuracy is cheap there."""

FIRST_SHARE, SECOND_SHARE = 0.02, 1.2
"""Bounds of the errors of V_1 (see `Crawl.field_error`) and V_2 relative to that of the velocity."""


@dataclass(frozen=True)
class Coefficients(Crawl):
    """The balance with q_1 alone as counted motion; or, at a given coupling, with q_0/coupling + q_1.

    coupling: the alpha of the speed that is asked for; 0 for V_2 alone.
    """

    field: SecondOrderField
    _: KW_ONLY
    coupling: float = 0.0

    @property
    def counts_leading(self) -> bool:
        """Never."""
        return False

    @property
    def _share(self) -> float:
        """Factor of q_0 in the counted motion."""
        if not self.coupling or self.starts_at_second_order:
            return 0.0
        return self.alpha**2 / self.coupling

    def counted(self, motion: RigidMotion) -> Array:
        """See Crawl."""
        second = super().counted(motion)
        return second + self._share * motion.leading.T if self._share else second

    @property
    def speed_per_rate(self) -> float:
        """See Crawl."""
        leading = abs(self._share / self.alpha) * self.drive.speed_per_rate(self.alpha, True)
        return super().speed_per_rate + leading

    def field_error(self, motion: RigidMotion) -> float:
        """Error of what is counted due to the errors of u_1 and u_2."""
        return self._first_error(motion) + self.alpha**2 * second_field_error(
            self.field, motion.fastest
        )

    def _first_error(self, motion: RigidMotion) -> float:
        """The part of q_0."""
        return abs(self._share) * FIRST_SHARE * self.field.error * motion.fastest

    def work_errors(self, motion: RigidMotion) -> Array:
        """See Crawl."""
        second = second_field_error(self.field, motion.fastest)
        errors = np.array([self.field.error * motion.fastest, 2 * second])
        return self.power_per_speed(motion) * errors


def field_tolerance(rtol: float) -> float:
    """Tolerance of the deformation, so that its error is a small part of that of V_2."""
    return max(FIELD_SHARE * rtol, validation.SMALLEST_RTOL)


def leading_period(
    field: SecondOrderField, contact: Contact, rtol: float, coupling: float = 0.0
) -> Period:
    """A period of motion at TINY_ALPHA, with the mean and error of what `Coefficients` counts.

    contact: with a friction law for speeds per unit alpha.
    """
    return leading_motion(field, contact, rtol, coupling).period()


def leading_motion(
    field: SecondOrderField, contact: Contact, rtol: float, coupling: float = 0.0
) -> Resolved:
    """The motion of that period."""
    fine = cells(rtol, field, contact, coupling)
    crawl = Coefficients(field, TINY_ALPHA, tiny(contact), fine, coupling=coupling)
    return resolved(crawl, of_second(rtol, field))


def at_coupling(alpha: float, period: Period) -> RigidSpeed:
    """The motion at an alpha, from a period of `Coefficients` with it as their coupling.

    NaN, with infinite error, where part of the sheet is at rest: V is not smooth in alpha then.
    """
    scale = (alpha / TINY_ALPHA) ** 2
    mean, error = scale * period.rigid_mean, scale * period.rigid_error
    if period.sticks:
        mean, error = np.full(3, math.nan), np.full(3, math.inf)
    return RigidSpeed(alpha * period.orders[0] + alpha**2 * period.orders[1], mean, error)


def of_second(rtol: float, field: SecondOrderField) -> Tolerance:
    """Of a speed over (coupling/TINY_ALPHA)^2, or of V_2, with a bound near 0."""
    unit = field.sheet.length / field.drive.period
    return Tolerance(rtol, SMALLEST * rtol * TINY_ALPHA**2 * unit)


def tiny(contact: Contact) -> Contact:
    """The contact for motions at TINY_ALPHA, from one with a friction law per unit alpha."""
    return replace(contact, friction=contact.friction.scaled(1 / TINY_ALPHA))


def cells(rtol: float, field: SecondOrderField, contact: Contact, coupling: float = 0.0) -> Resolution:
    """The first resolution of the balance for an alpha that is tiny.

    Where q_0 has a mean, q_1 counts less by the coupling.
    """
    joint = coupling != 0 and not (field.drive.changes_sign and contact.friction.reversible)
    share = min(abs(coupling), 1.0) if joint else 1.0
    first = first_resolution(min(rtol / share, COARSEST))
    fine = replace(first, halvings=first.halvings + MORE_HALVINGS, tolerance=0.02 * rtol)
    if not joint:
        return fine
    least = joint_resolution(rtol, not contact.friction.limited)
    orders, halvings = (least.order, fine.order), (least.halvings, fine.halvings)
    return replace(fine, order=max(orders), halvings=max(halvings))


def field_errors(field: SecondOrderField, period: Period, contact: Contact) -> Array:
    """What the errors of u_1 and u_2 do to V_x, V_y, Omega of first and second order, (2, 3).

    0 where the motion vanishes by symmetry.
    """
    fastest = period.fastest / TINY_ALPHA
    law = contact.friction
    first = 0.0 if field.drive.changes_sign and law.reversible else FIRST_SHARE * field.error * fastest
    norm = RigidNorm(field.gyration, field.mirrored and law.mirrored)
    return np.stack([norm.each(first), norm.each(second_field_error(field, fastest))])


def second_field_error(field: SecondOrderField, fastest: float) -> float:
    """Error of V_2 due to the errors of u_1 and u_2.

    The factors measured at single times are at most 1.1, against SECOND_SHARE used here (widths from
    0.1 L to 2 L, one and two waves, all loads); most are below 0.1.
    """
    return SECOND_SHARE * (field.error * fastest + field.second_error * field.second_speed)

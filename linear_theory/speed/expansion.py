"""The friction balance at the smallest growth, whose means are the coefficients of the speed.

See `second_order` for the equations.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.balance import RigidMotion
from linear_theory.balance.crawl import Crawl, Resolution, first_resolution
from linear_theory.balance.period import Period, average
from linear_theory.common import validation
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.second.field import SecondOrderField
from linear_theory.friction.contact import Contact
from linear_theory.motion.rigid import RigidNorm

Array = NDArray[np.float64]

POINTS = 33
"""Points per direction at which growth of any form is checked."""

TINY_ALPHA = 1e-9
"""The alpha at which the balance is solved; neglected terms are of this relative size."""

MORE_HALVINGS = 8
"""Additional halvings of cells compared with an alpha that is not tiny: cells too coarse at a
stagnation point make q_1(t) rough, and the mean over time would then be refined in vain."""

FIELD_SHARE = 0.1
"""Fraction of rtol allotted to the deformation, small because accuracy is cheap there."""

FIRST_SHARE, SECOND_SHARE = 0.02, 1.2
"""Bounds of the errors of V_1 (see `Crawl.field_error`) and V_2 relative to that of the velocity."""


@dataclass(frozen=True)
class Coefficients(Crawl):
    """The balance with q_1 alone as counted motion."""

    field: SecondOrderField

    @property
    def counts_leading(self) -> bool:
        """Never."""
        return False

    def field_error(self, motion: RigidMotion) -> float:
        """Error of V_2 due to the errors of u_1 and u_2."""
        return self.alpha**2 * second_field_error(self.field, motion.fastest)

    def work_errors(self, motion: RigidMotion) -> Array:
        """See Crawl."""
        second = second_field_error(self.field, motion.fastest)
        errors = np.array([self.field.error * motion.fastest, 2 * second])
        return self.power_per_speed(motion) * errors


def field_tolerance(rtol: float) -> float:
    """Tolerance of the deformation, so that its error is a small part of that of V_2."""
    return max(FIELD_SHARE * rtol, validation.SMALLEST_RTOL)


def leading_period(field: SecondOrderField, contact: Contact, rtol: float) -> Period:
    """A period of motion at TINY_ALPHA, with the mean and error of second order alone.

    contact: with a friction law for speeds per unit alpha.
    """
    unit = field.sheet.length / field.drive.period
    tolerance = Tolerance(rtol, 1e-2 * rtol * TINY_ALPHA**2 * unit)
    return average(Coefficients(field, TINY_ALPHA, tiny(contact), fine_cells(rtol)), tolerance)


def tiny(contact: Contact) -> Contact:
    """The contact for motions at TINY_ALPHA, from one with a friction law per unit alpha."""
    return replace(contact, friction=contact.friction.scaled(1 / TINY_ALPHA))


def fine_cells(rtol: float) -> Resolution:
    """The first resolution of the balance for an alpha that is tiny."""
    resolution = first_resolution(rtol)
    return replace(resolution, halvings=resolution.halvings + MORE_HALVINGS)


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

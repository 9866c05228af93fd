"""Friction forces on a crawling sheet at given points."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.balance.crawl import Crawl
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.field import LinearField, checked_field
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.speed.crawl import beyond_reach
from linear_theory.speed.reach import warn_if_beyond

Array = NDArray[np.float64]


def friction_field(
    field: LinearField,
    alpha: float,
    x: ArrayLike,
    y: ArrayLike,
    t: float,
    load: Load | str | None = None,
    friction: FrictionLaw | str | None = None,
    slip_speed: float | None = None,
    rtol: float = 1e-6,
) -> "FrictionField":
    """Friction forces on a crawling sheet at time t and at the points x, y (broadcast).

    Raises ValueError as `crawl_speed` does, and for points outside the sheet. Warns
    (BeyondReachWarning) as it does.

    >>> import numpy as np
    >>> from linear_theory import Sheet, SineWave, airy_series, friction_field
    >>> field = airy_series(Sheet(), SineWave(), rtol=1e-4)
    >>> friction = friction_field(field, alpha=0.25, x=0.1, y=[-0.25, 0.25], t=0.0)
    >>> print(np.hypot(*friction.force) / friction.weight)  # mu N, as Coulomb says
    [1. 1.]
    >>> print((friction.force * friction.slip).sum(0) < 0)  # against the slip
    [ True  True]
    """
    field = checked_field(field)
    alpha, t = validation.real("alpha", alpha), validation.real("t", t)
    x, y = np.broadcast_arrays(validation.real_array("x", x), validation.real_array("y", y))
    contact, rtol = Contact.named(load, friction, slip_speed), validation.tolerance(rtol)
    found = _friction_field(field, alpha, x, y, t, contact, rtol)
    warn_if_beyond(alpha, beyond_reach(field, alpha))
    return found


@one_blas_thread
def _friction_field(
    field: LinearField,
    alpha: float,
    x: Array,
    y: Array,
    t: float,
    contact: Contact,
    rtol: float,
) -> "FrictionField":
    """`friction_field`, without its checks and its warning."""
    v_x = v_y = omega = 0.0
    if alpha != 0:
        motion = Crawl.to(rtol, field, alpha, contact).balance(np.array([t]))
        v_x, v_y, omega = alpha * (motion.leading + alpha * motion.remainder)[0]
    rigid = np.stack([v_x - omega * (y - field.centre[1]), v_y + omega * (x - field.centre[0])])
    slip = alpha * field.velocity(x, y, t) + rigid
    growth = field.drive.value(x, y, t)
    rate = contact.load.rate(field.strain(x, y, t)[:2].sum(0), growth)
    weight = 1 + alpha * rate
    if contact.friction.map is not None:
        weight = weight * contact.friction.map.values(x, y, t)
    return FrictionField(-weight * contact.friction.force(slip), slip, weight)


class _Forces(NamedTuple):
    force: Array
    slip: Array
    weight: Array


class FrictionField(Shown, _Forces):
    """force (2, ...): per reference area, divided by mu times the weight per area; slip (2, ...):
    velocity relative to the ground, length per time; weight (...): normal load per reference area, 1
    without growth."""

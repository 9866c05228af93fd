"""Speed of a crawling sheet: balance of friction at every time, then the mean over a period."""

import math
import time
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.balance.period import Crawl, average, first_resolution
from linear_theory.common import validation
from linear_theory.common.progress import Report, watched
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.airy import airy_series
from linear_theory.deformation.field import LinearField, Wave
from linear_theory.deformation.ritz import ritz_field
from linear_theory.friction.law import LOADS, FrictionLaw, load_rate, warn_if_viscous
from linear_theory.motion.motion import CellGrid
from linear_theory.scene import arguments
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.drawn import LinearDeformation
from linear_theory.speed.model_error import LEVELS, model_error
from linear_theory.speed.reach import judged, too_large_growth, warn_if_beyond
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.second_order import check_model, second_order_speed
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

METHODS = ("auto", "airy", "ritz")

SHOWN_RTOL = 1e-3
"""Relative error of a deformation that is only drawn: less than a line is wide."""


def crawl_speed(
    sheet: Sheet,
    wave: Wave,
    alpha: float,
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
    method: str = "auto",
    order: int = 1,
    growth_law: str = "exp",
    area: str = "grown",
    *,
    progress: bool | Report | None = None,
) -> CrawlSpeed:
    """Mean speed of a rectangular sheet in the small-strain theory (eqs 10 and 11), or to second order.

    alpha: growth coupling; load: "current", "grown" or "material" (see `friction.load_rate`);
    friction: "coulomb", "tanh" with its slip_speed (length per time), or "viscous"; rtol, atol: the
    result is converged where error <= max(rtol |mean|, atol), atol = 1e-3 rtol alpha^2 L/T unless
    given; of a motion that is not mirror symmetric the sizes of rigid_error and rigid_mean count (all
    three components, see `rigid.RigidNorm`);
    method: "airy" for waves c(y, t), "ritz" for any, or "auto".

    order = 1 is the paper's theory: strains of first order, in a balance that is not expanded. It is
    good for waves that crawl at order alpha (pulses, c(t + T/2) != -c(t)), with a relative error of
    order alpha; for a sine wave, whose speed is of order alpha^2, it is the speed of the stated model,
    not a leading term (25 % too fast for the default sheet). order = 2 is V_1 alpha + V_2 alpha^2 of
    the nonlinear sheet with that growth_law and area (see `second_order`), right up to order alpha^3,
    for a sine alpha^4; any wave, by Ritz. It says nothing of large alpha. order = 1 does not depend on
    growth_law and area but for its `model_error`: the distance to the nonlinear sheet of that
    growth_law, area and load where it was measured (`model_error.model_error`), else NaN.
    progress: True prints on stderr, a function is called with a `progress.Progress`.

    Raises ValueError for bad input, among it an alpha so large that the area element
    1 + alpha tr(strain) is not positive somewhere (order 1) or that lengths vanish (order 2), and
    NotConvergedError where the wave, one that jumps, asks more of the deformation than fits in memory.
    Warns (ViscousRegimeWarning) where friction = "tanh" acts as viscous: see `CrawlSpeed.regime`; and
    (BeyondReachWarning) where growth is too large for a theory of small growth, |alpha c| > 1/2 or
    sooner, see `reach`: such a speed is never converged, and `CrawlSpeed.beyond_reach` says why.

    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> for order in (1, 2):  # of the theory, for the sheet of the paper
    ...     speed = crawl_speed(Sheet(), SineWave(), alpha=0.05, order=order, rtol=1e-2)
    ...     print(f"V = {speed.mean:.4f} L/T, nonlinear sheet within {speed.model_error:.0e}")
    V = 0.0048 L/T, nonlinear sheet within 1e-03
    V = 0.0038 L/T, nonlinear sheet within 1e-05
    """
    sheet, wave = arguments.sheet(sheet), arguments.wave(wave)
    check_model(order, growth_law, area)
    with watched(progress, "crawl_speed"):
        if order == 2:
            validation.choice("method", method, ("auto", "ritz"))
            found = second_order_speed(
                sheet, wave, alpha, growth_law, area, load, friction, slip_speed, rtol, atol
            )
        else:
            field = _field(sheet, wave, rtol, method)
            found = _field_speed(field, alpha, load, friction, slip_speed, rtol, atol)
    distance = model_error(LEVELS[order], sheet, wave, alpha, growth_law, area, load, friction)
    # Found anew if it is drawn, so that a speed does not hold on to a solution and its tables.
    shown = partial(_field, sheet, wave, SHOWN_RTOL, "ritz" if order == 2 else method)
    law = FrictionLaw(friction, slip_speed)
    deformation = LinearDeformation(shown, float(alpha), load, law)
    found = replace(found, model_error=distance, deformation=deformation)
    warn_if_viscous(found, slip_speed)
    warn_if_beyond(alpha, found.beyond_reach)
    return found


def field_speed(
    field: LinearField,
    alpha: float,
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
) -> CrawlSpeed:
    """`crawl_speed` for a deformation that is known: series, Ritz or finite elements.

    Raises ValueError and warns as `crawl_speed` does.

    >>> from linear_theory import Sheet, SineWave, field_speed, ritz_field
    >>> field = ritz_field(Sheet(), SineWave(), rtol=1e-4)
    >>> for friction in ("coulomb", "viscous"):
    ...     speed = field_speed(field, alpha=0.25, friction=friction, rtol=1e-3)
    ...     print(f"V = {speed.mean:.3f} L/T, friction is {speed.regime}")
    V = 0.106 L/T, friction is dry
    V = 0.064 L/T, friction is viscous
    """
    found = _field_speed(arguments.field(field), alpha, load, friction, slip_speed, rtol, atol)
    warn_if_viscous(found, slip_speed)
    warn_if_beyond(alpha, found.beyond_reach)
    return found


def _field(sheet: Sheet, wave: Wave, rtol: float, method: str) -> LinearField:
    """Deformation of first order for a speed that is right to rtol."""
    validation.choice("method", method, METHODS)
    travelling = isinstance(wave, TravellingWave)
    if method == "airy" and not travelling:
        raise ValueError("method = 'airy': must be 'ritz' for a wave that depends on x")
    field_rtol = max(0.1 * validation.tolerance(rtol), validation.SMALLEST_RTOL)
    if method != "ritz" and isinstance(wave, TravellingWave):
        return airy_series(sheet, wave, rtol=field_rtol)
    return ritz_field(sheet, wave, rtol=field_rtol)


@one_blas_thread
def _field_speed(
    field: LinearField,
    alpha: float,
    load: str,
    friction: str,
    slip_speed: float | None,
    rtol: float,
    atol: float | None,
) -> CrawlSpeed:
    """`field_speed` without its warning."""
    start = time.perf_counter()
    alpha = validation.real("alpha", alpha)
    rtol = validation.tolerance(rtol)
    validation.choice("load", load, LOADS)
    law = FrictionLaw(friction, slip_speed)
    unit = field.sheet.length / field.wave.period
    atol = validation.absolute_tolerance(atol, rtol, alpha, unit)
    deformation = LinearDeformation(lambda: field, alpha, load, law)
    if alpha == 0:
        return replace(_at_rest(field, load, law), deformation=deformation)
    crawl = Crawl(field, alpha, load, law, first_resolution(rtol))
    period = average(crawl, rtol, atol)
    found = CrawlSpeed(
        mean=period.mean,
        error=period.error,
        model_error=math.nan,
        converged=crawl.norm.meets(period.rigid_mean, period.rigid_error, rtol, atol),
        times=period.times,
        velocity=period.rigid[1],
        seconds=field.seconds + time.perf_counter() - start,
        model=_model(field, load, law),
        slip_ratio=law.slip_ratio(period.fastest),
        first_order=period.first_order,
        sticks=period.sticks,
        rigid=None if field.mirrored else period.rigid,
        rigid_mean=None if field.mirrored else period.rigid_mean,
        rigid_error=None if field.mirrored else period.rigid_error,
        deformation=deformation,
    )
    return judged(found, _beyond_reach(field, alpha))


def _beyond_reach(field: LinearField, alpha: float) -> str:
    """Why small strain says nothing at this alpha, in words; empty if it does."""
    x = y = np.zeros(1)  # a travelling wave shows all its phases at any point
    if alpha and not isinstance(field.wave, TravellingWave):
        grid = CellGrid.uniform(field.sheet, 4, 8, half=False)
        x, y = field.motion(np.zeros(1), grid, order=5).position
    return too_large_growth(field.wave, alpha, x, y, field.sheet.length)


def friction_field(
    field: LinearField,
    alpha: float,
    x: ArrayLike,
    y: ArrayLike,
    t: float,
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-6,
) -> "FrictionField":
    """Friction on a crawling sheet at time t and at the points x, y (broadcast).

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
    field = arguments.field(field)
    alpha, t = validation.real("alpha", alpha), validation.real("t", t)
    x, y = np.broadcast_arrays(validation.real_array("x", x), validation.real_array("y", y))
    law, rtol = FrictionLaw(friction, slip_speed), validation.tolerance(rtol)
    found = _friction_field(field, alpha, x, y, t, load, law, rtol)
    warn_if_beyond(alpha, _beyond_reach(field, alpha))
    return found


@one_blas_thread
def _friction_field(
    field: LinearField,
    alpha: float,
    x: Array,
    y: Array,
    t: float,
    load: str,
    law: FrictionLaw,
    rtol: float,
) -> "FrictionField":
    """`friction_field` without its checks and its warning."""
    v_x = v_y = omega = 0.0
    if alpha != 0:
        motion = Crawl(field, alpha, load, law, first_resolution(rtol)).balance(np.array([t]))
        v_x, v_y, omega = alpha * (motion.leading + alpha * motion.remainder)[0]
    rigid = np.stack([v_x - omega * (y - field.centre[1]), v_y + omega * (x - field.centre[0])])
    slip = alpha * field.velocity(x, y, t) + rigid
    speed = np.hypot(*slip)
    rate = load_rate(
        load, field.strain(x, y, t)[:2].sum(0), field.wave.value(x, y, t, field.sheet.length)
    )
    weight = 1 + alpha * rate
    with np.errstate(divide="ignore", invalid="ignore"):
        force = np.where(speed > 0, -weight * law.ratio(speed) * slip, 0.0)
    return FrictionField(force, slip, weight)


class _Forces(NamedTuple):
    force: Array
    slip: Array
    weight: Array


class FrictionField(Shown, _Forces):
    """force (2, ...): per reference area, over mu times the weight per area; slip (2, ...): velocity
    against the ground, length per time; weight (...): load per reference area, 1 without growth."""


def _at_rest(field: LinearField, load: str, law: FrictionLaw) -> CrawlSpeed:
    """No growth, no motion."""
    nothing = np.zeros(1)
    words, ratio = _model(field, load, law), law.slip_ratio(0.0)
    return CrawlSpeed(0.0, 0.0, 0.0, True, nothing, nothing, field.seconds, words, ratio, 0.0)


def _model(field: LinearField, load: str, law: FrictionLaw) -> str:
    return f"small strain ({type(field).__name__}), {load} load, {law.name} friction"

"""The speed of a nonlinear sheet to second order in the growth coupling, V = V_1 alpha + V_2 alpha^2.

With v = alpha v_1 + alpha^2 v_2 from `second_field`, load 1 + alpha e and V = alpha q_0 + alpha^2 q_1
the balance of friction says, at its first and second order,

    int f(|w|) w/|w| . R dA = 0,                                   w = v_1 + q_0,
    int [D(w) (v_2 + q_1) + e f(|w|) w/|w|] . R dA = 0,             D(w) = d(f(|w|) w/|w|)/dw.

For dry friction D(w) is of size 1/|w|: at the few points where w = 0 that is integrable in the plane.
The cells are halved towards these points until the rest, of size the square root of the area of the
last cell, is below the tolerance (`period.first_resolution`); V_1 and V_2 are the means of q_0 and q_1.
"""

import math
import time
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory import validation
from linear_theory.balance import RigidMotion
from linear_theory.field import Wave
from linear_theory.friction import LOADS, FrictionLaw
from linear_theory.period import Crawl, Period, average, first_resolution
from linear_theory.second_field import AREAS, GROWTH_LAWS, SecondOrderField, second_order_field
from linear_theory.sheet import Sheet
from linear_theory.speed import CrawlSpeed
from linear_theory.waves import TravellingWave

Array = NDArray[np.float64]

ORDERS = (1, 2)
"""Of the theories that `crawl_speed` offers."""

TINY_ALPHA = 1e-9
"""At which the balance is solved: what is neglected is of this relative size."""

MORE_HALVINGS = 8
"""Of cells, than an alpha that is not tiny asks for: a point at rest next to which a cell is not halved
enough makes q_1(t) uneven, and the mean over time would then be refined in vain."""

PHASES = 256
"""Phases per harmonic at which growth is checked."""

FIELD_SHARE = 0.1
"""Of rtol, for the deformation: it costs little."""

FIRST_SHARE, SECOND_SHARE = 0.02, 1.2
"""Of the error of the velocity, what at most reaches V_1 (see `Crawl.field_error`) and V_2."""


class SecondOrder(NamedTuple):
    """Coefficients of V = first alpha + second alpha^2 + ..., length/time, and their errors, absolute.

    first is 0 where c(t + T/2) = -c(t). second is NaN, its error infinite, where at some time part of
    the sheet is at rest, since V is not smooth in alpha then.
    seconds: time spent; model: what is assumed, in words.
    """

    first: float
    second: float
    first_error: float
    second_error: float
    seconds: float
    model: str


@dataclass(frozen=True)
class _Coefficients(Crawl):
    """The balance of which q_1 alone counts."""

    field: SecondOrderField

    def counted(self, motion: RigidMotion) -> Array:
        """alpha^2 q_1, (times,)."""
        return np.asarray(self.alpha**2 * motion.remainder[:, 1])

    def field_error(self, motion: RigidMotion) -> float:
        """What the errors of u_1 and u_2 do to V_2.

        At single times met were factors up to 1.1 where SECOND_SHARE stands (widths from 0.1 L to 2 L,
        one and two waves, all loads); most are below 0.1.
        """
        field = self.field
        speed = field.error * motion.fastest + field.second_error * field.second_speed
        return SECOND_SHARE * self.alpha**2 * speed


def second_order(
    sheet: Sheet,
    wave: Wave,
    growth_law: str = "exp",
    area: str = "grown",
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-3,
) -> SecondOrder:
    """Coefficients of the mean speed of a stiff, planar, nonlinear sheet for small growth.

    They are those of the planar Koiter membrane (eq. 1a), not of a linear theory: for a sine wave,
    first = 0 and second is the limit of V/alpha^2. How far in alpha two orders reach they do not say.

    wave: a TravellingWave; growth_law: of lengths, "exp" exp(alpha c), "linear" 1 + alpha c or "metric"
    (1 + 2 alpha c)^(1/2); area: in which energy is counted, "grown" or "undeformed"; load: "current",
    "grown" or "material" (see `friction.load_rate`); friction: "coulomb", "viscous", or "tanh" with
    slip_speed, length per time and unit |alpha|: what stays fixed as alpha -> 0 is its ratio to alpha.
    rtol: of `second`, whose error is to be below max(rtol |second|, 0.01 rtol L/T); a miss shows in
    second_error. `first` comes with the same cells and times.

    Raises ValueError for bad input, among it waves that depend on x.
    """
    start = time.perf_counter()
    rtol, law = validation.tolerance(rtol), FrictionLaw(friction, slip_speed)
    validation.choice("load", load, LOADS)
    field = second_order_field(sheet, wave, growth_law, area, field_tolerance(rtol))
    period = leading_period(field, load, law, rtol)
    second, second_error = coefficient(period)
    return SecondOrder(
        first=period.first_order,
        second=second,
        first_error=first_error(field, period),
        second_error=second_error,
        seconds=time.perf_counter() - start,
        model=words(growth_law, area, load, law),
    )


def field_tolerance(rtol: float) -> float:
    """Of the deformation, whose error is then a small part of that of V_2."""
    return max(FIELD_SHARE * rtol, validation.SMALLEST_RTOL)


def coefficient(period: Period) -> tuple[float, float]:
    """V_2 and its estimated error from a period at TINY_ALPHA."""
    if period.sticks:
        return math.nan, math.inf
    return period.mean / TINY_ALPHA**2, period.error / TINY_ALPHA**2


def first_error(field: SecondOrderField, period: Period) -> float:
    """Estimated error of V_1, length per time; none where symmetry makes it 0."""
    if field.wave.is_half_period_antisymmetric:
        return 0.0
    return period.first_error + FIRST_SHARE * field.error * period.fastest / TINY_ALPHA


def leading_period(field: SecondOrderField, load: str, law: FrictionLaw, rtol: float) -> Period:
    """A period of motion at TINY_ALPHA, whose mean and error are those of second order alone.

    law: for speeds per unit alpha.
    """
    unit = field.sheet.length / field.wave.period
    atol = 1e-2 * rtol * TINY_ALPHA**2 * unit
    resolution = first_resolution(rtol)
    resolution = replace(resolution, halvings=resolution.halvings + MORE_HALVINGS)
    crawl = _Coefficients(field, TINY_ALPHA, load, law.scaled(1 / TINY_ALPHA), resolution)
    return average(crawl, rtol, atol)


def words(growth_law: str, area: str, load: str, law: FrictionLaw) -> str:
    """What the coefficients assume."""
    return (
        f"second order in alpha, growth law {growth_law}, energy per {area} area, {load} load, "
        f"{law.name} friction"
    )


def second_order_speed(
    sheet: Sheet,
    wave: Wave,
    alpha: float,
    growth_law: str,
    area: str,
    load: str,
    friction: str,
    slip_speed: float | None,
    rtol: float,
    atol: float | None,
) -> CrawlSpeed:
    """V_1 alpha + V_2 alpha^2; arguments, result and errors raised are those of `crawl_speed`."""
    start, alpha = time.perf_counter(), validation.real("alpha", alpha)
    rtol, law = validation.tolerance(rtol), FrictionLaw(friction, slip_speed)
    validation.choice("load", load, LOADS)
    field = second_order_field(sheet, wave, growth_law, area, field_tolerance(rtol))
    unit = sheet.length / field.wave.period
    atol = 1e-3 * rtol * alpha**2 * unit if atol is None else validation.positive("atol", atol)
    check_growth(growth_law, alpha, field.wave)
    period = leading_period(field, load, law.scaled(abs(alpha) or 1.0), rtol)
    second, second_error = coefficient(period)
    mean = alpha * period.first_order + alpha**2 * second
    error = abs(alpha) * first_error(field, period) + alpha**2 * second_error
    return CrawlSpeed(
        mean=mean,
        error=error,
        model_error=math.nan,
        converged=error <= max(rtol * abs(mean), atol),
        times=period.times,
        velocity=alpha * period.orders[0] + alpha**2 * period.orders[1],
        seconds=time.perf_counter() - start,
        model=words(growth_law, area, load, law),
        slip_ratio=law.width / (abs(alpha) * period.fastest / TINY_ALPHA) if alpha else math.inf,
        first_order=period.first_order,
        second_order=second,
        sticks=period.sticks,
    )


def check_growth(growth_law: str, alpha: float, wave: TravellingWave) -> None:
    """Raise ValueError where lengths would vanish: 1 + alpha c or 1 + 2 alpha c not positive."""
    if growth_law == "exp":
        return
    factor = 1.0 if growth_law == "linear" else 2.0
    phases = np.linspace(0, 2 * np.pi, PHASES * wave.cosine.size)
    lowest = float((alpha * wave.profile(phases)).min())
    if 1 + factor * lowest <= 0:
        raise ValueError(
            f"alpha = {alpha:g}: alpha c reaches {lowest:.3g}; must be > {-1 / factor:g} for "
            f"growth_law {growth_law!r}"
        )


def check_model(order: int, growth_law: str, area: str) -> None:
    """Raise ValueError for an order or for names that do not exist."""
    if validation.integer("order", order) not in ORDERS:
        raise ValueError(f"order = {order}: must be one of {', '.join(map(str, ORDERS))}")
    validation.choice("growth_law", growth_law, GROWTH_LAWS)
    validation.choice("area", area, AREAS)

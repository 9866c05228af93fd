"""How fast any wave makes a body on a line crawl (paper eqs 5-7)."""

import time

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.field import Wave
from linear_theory.friction.law import FrictionLaw, warn_if_viscous
from linear_theory.line.growth import Growth
from linear_theory.line.result import Balance
from linear_theory.line.samples import sampled_balance
from linear_theory.line.travelling import travelling_balance
from linear_theory.scene import arguments
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.given import FieldWave
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]


@one_blas_thread
def line_balance(
    wave: Wave,
    alpha: float,
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
    growth_law: str = "linear",
    body: str = "line",
    *,
    length: float | None = None,
) -> CrawlSpeed:
    """Speed of the body |y| <= length/2 driven by any wave c(y, t).

    wave: a `TravellingWave` (solved to rounding, V is constant) or anything with `period`, `value`
    and `rate` as in `field.Wave`, evaluated at x = 0 (sampled until the error meets rtol).
    length: of the body, in the unit of length that all speeds are in. 1 unless given for a
    TravellingWave, which is a function of y/length; any other wave is a function of y, and has no
    length of its own: it must be given.
    alpha: dimensionless growth coupling; growth_law: of the stretch, "exp" exp(alpha c), "linear"
    1 + alpha c (eq. 5) or "metric" (1 + 2 alpha c)^(1/2), without expansion in alpha.
    body: "line", its weight counted per length, or "strip", narrow, growing in both directions, its
    weight counted per area; load: "current", "grown" (the same here) or "material", weight conserved.
    friction: "coulomb", "tanh" with its `slip_speed` in length/time, or "viscous".
    rtol, atol: `converged` says whether error <= max(rtol |mean|, atol), atol =
    1e-3 rtol alpha^2 length/period unless given (length/time).

    Returns a `CrawlSpeed`, whose first_order and second_order are the limits of small alpha: for dry
    friction on a travelling wave (median c - mean c) L/(nT) and [p E|c - median|/(2 f) +
    s_2 (median^2 - E c^2)] L/(nT), f the density of c at its median, p and s_2 those of the body and
    the growth law (see `travelling`); for tanh at a fixed slip speed they are the viscous ones.
    Raises ValueError, naming the place, where no length would be left (1 + alpha c <= 0, 1 + 2 alpha c
    <= 0) or |alpha c| >= 100 for "exp", and for other bad arguments. Warns (ViscousRegimeWarning)
    where friction = "tanh" acts as viscous: see `CrawlSpeed.regime`.

    >>> from linear_theory import SineWave, TravellingWave, line_balance, line_speed
    >>> sine = line_balance(SineWave(), alpha=0.25)
    >>> print(f"V = {sine.mean:.5f} L/T", abs(sine.mean - line_speed(0.25)) <= sine.error)
    V = 0.06007 L/T True
    >>> pulse = line_balance(TravellingWave(cosine=[1.0, 0.5], sine=[0.0, 0.0]), alpha=0.05)
    >>> print(f"V = {pulse.mean:.3f} L/T, {pulse.first_order:.1f} alpha L/T for small alpha")
    V = -0.022 L/T, -0.5 alpha L/T for small alpha

    A wave of 20 mm on a body of that length, 1 s, and a body twice as long:

    >>> import numpy as np
    >>> from linear_theory import FieldWave
    >>> wave = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y / 20 - t)) + 0 * x, period=1.0)
    >>> for length in (20, 40):
    ...     speed = line_balance(wave, alpha=0.25, rtol=1e-2, length=length)
    ...     print(f"V = {speed.mean:.2f} mm/s")
    V = 1.20 mm/s
    V = 1.20 mm/s
    """
    start, wave = time.perf_counter(), arguments.wave(wave)
    alpha, rtol = validation.real("alpha", alpha), validation.tolerance(rtol)
    growth = Growth.of(growth_law, load, body)
    law = FrictionLaw(friction, slip_speed)
    length = _checked_length(length, wave)
    atol = validation.absolute_tolerance(atol, rtol, alpha, length / wave.period)
    answer = _in_lengths(wave, alpha, law.scaled(length), growth, rtol, atol / length, length)
    found = CrawlSpeed(
        mean=length * answer.mean,
        error=length * answer.error,
        model_error=np.nan,
        converged=length * answer.error <= max(rtol * length * abs(answer.mean), atol),
        times=answer.times,
        velocity=length * answer.velocity,
        slip_ratio=law.slip_ratio(length * answer.fastest),
        first_order=length * answer.first,
        second_order=length * answer.second,
        sticks=answer.sticks and answer.fastest > 0,
        seconds=time.perf_counter() - start,
        model=_words(law, growth, body),
    )
    warn_if_viscous(found, slip_speed)
    return found


def _checked_length(length: float | None, wave: Wave) -> float:
    """That of the body. Raises ValueError where it is neither given nor without effect."""
    if length is not None:
        return validation.positive("length", length)
    if isinstance(wave, TravellingWave):
        return 1.0
    raise ValueError(
        f"length = None: must be given, > 0, for wave = {wave!r}, a function of y in some unit of "
        "length; only a TravellingWave is a function of y/length"
    )


def _in_lengths(
    wave: Wave,
    alpha: float,
    law: FrictionLaw,
    growth: Growth,
    rtol: float,
    atol: float,
    length: float,
) -> Balance:
    """The balance in units of the length of the body, those of law and atol."""
    if isinstance(wave, TravellingWave):
        return travelling_balance(wave, alpha, law, growth)
    return sampled_balance(_on_unit(wave, length), alpha, law, growth, rtol, atol)


def _on_unit(wave: Wave, length: float) -> FieldWave:
    """A wave on a body of that length as one on a body of length 1; its rate is found as before."""

    def value(x: Array, y: Array, t: Array) -> Array:
        return wave.value(length * x, length * y, t, length)

    def rate(x: Array, y: Array, t: Array) -> Array:
        return wave.rate(length * x, length * y, t, length)

    differenced = isinstance(wave, FieldWave) and wave.differenced
    return FieldWave(value, wave.period, None if differenced else rate)


def _words(law: FrictionLaw, growth: Growth, body: str) -> str:
    friction = {"coulomb": "dry friction", "viscous": "viscous friction"}.get(
        law.name, f"friction tanh(v/{law.width:g})"
    )
    shape = {"line": "body on a line", "strip": "narrow strip that grows both ways"}[body]
    load = {0: "weight conserved", 1: "load on the current length", 2: "load on the current area"}
    return (
        f"{shape}, stretch {growth.law.words}, quasi-static, shape not affected by friction; "
        f"{friction}, {load[growth.power]}"
    )

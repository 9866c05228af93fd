"""How fast any wave makes a body on a line crawl (paper eqs 5-7)."""

import time

import numpy as np

from linear_theory import validation
from linear_theory.field import Wave
from linear_theory.line_law import LineLaw
from linear_theory.line_samples import sampled_balance
from linear_theory.line_travelling import travelling_balance
from linear_theory.speed import CrawlSpeed
from linear_theory.waves import TravellingWave


def line_balance(
    wave: Wave,
    alpha: float,
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-4,
) -> CrawlSpeed:
    """Speed of the body 0 <= S <= 1 (L = 1, y = S - 1/2) driven by any wave c(y, t).

    wave: a `TravellingWave` (solved to rounding, V is constant) or anything with `period`, `value`
    and `rate` as in `field.Wave`, evaluated at x = 0 (sampled until the error meets rtol).
    alpha: dimensionless growth coupling, 1 + alpha c > 0 everywhere.
    load: "current", "grown" (the same on a line) or "material"; friction: "coulomb", "tanh" with
    its `slip_speed` in length/time, or "viscous".
    rtol: `converged` says whether error <= max(rtol |mean|, 1e-3 rtol alpha^2 L/period).

    Returns a `CrawlSpeed`, whose first_order and second_order are the limits of small alpha: for dry
    friction on a travelling wave (median c - mean c)/(nT) and E|c - median|/(2 p nT), p the density
    of c at its median; for tanh at a fixed slip speed they are those of viscous friction.
    Raises ValueError, naming the place, where 1 + alpha c <= 0, and for other bad arguments.
    """
    start = time.perf_counter()
    alpha, rtol = validation.real("alpha", alpha), validation.tolerance(rtol)
    law = LineLaw(load, friction, slip_speed)
    if isinstance(wave, TravellingWave):
        answer = travelling_balance(wave, alpha, law)
    else:
        answer = sampled_balance(wave, alpha, law, rtol)
    goal = max(rtol * abs(answer.mean), 1e-3 * rtol * alpha**2 / wave.period)
    return CrawlSpeed(
        mean=answer.mean,
        error=answer.error,
        model_error=np.nan,
        converged=answer.error <= goal,
        times=answer.times,
        velocity=answer.velocity,
        slip_ratio=law.slip_ratio(answer.fastest),
        first_order=answer.first,
        second_order=answer.second,
        sticks=answer.sticks,
        seconds=time.perf_counter() - start,
        model=law.words,
    )

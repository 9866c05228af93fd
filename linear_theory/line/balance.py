"""How fast any wave makes a body on a line crawl (paper eqs 5-7)."""

import time

import numpy as np

from linear_theory import validation
from linear_theory.field import Wave
from linear_theory.friction import LOADS, FrictionLaw
from linear_theory.line.samples import sampled_balance
from linear_theory.line.travelling import travelling_balance
from linear_theory.speed import CrawlSpeed
from linear_theory.waves import TravellingWave


def line_balance(
    wave: Wave,
    alpha: float,
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
) -> CrawlSpeed:
    """Speed of the body 0 <= S <= 1 (L = 1, y = S - 1/2) driven by any wave c(y, t).

    wave: a `TravellingWave` (solved to rounding, V is constant) or anything with `period`, `value`
    and `rate` as in `field.Wave`, evaluated at x = 0 (sampled until the error meets rtol).
    alpha: dimensionless growth coupling, 1 + alpha c > 0 everywhere.
    load: "current", "grown" (the same on a line) or "material"; friction: "coulomb", "tanh" with
    its `slip_speed` in length/time, or "viscous".
    rtol, atol: `converged` says whether error <= max(rtol |mean|, atol), atol =
    1e-3 rtol alpha^2 L/period unless given (length/time).

    Returns a `CrawlSpeed`, whose first_order and second_order are the limits of small alpha: for dry
    friction on a travelling wave (median c - mean c)/(nT) and E|c - median|/(2 p nT), p the density
    of c at its median; for tanh at a fixed slip speed they are those of viscous friction.
    Raises ValueError, naming the place, where 1 + alpha c <= 0, and for other bad arguments.
    """
    start = time.perf_counter()
    alpha, rtol = validation.real("alpha", alpha), validation.tolerance(rtol)
    grows = validation.choice("load", load, LOADS) != "material"
    law = FrictionLaw(friction, slip_speed)
    atol = 1e-3 * rtol * alpha**2 / wave.period if atol is None else validation.positive("atol", atol)
    if isinstance(wave, TravellingWave):
        answer = travelling_balance(wave, alpha, law, grows)
    else:
        answer = sampled_balance(wave, alpha, law, grows, rtol, atol)
    return CrawlSpeed(
        mean=answer.mean,
        error=answer.error,
        model_error=np.nan,
        converged=answer.error <= max(rtol * abs(answer.mean), atol),
        times=answer.times,
        velocity=answer.velocity,
        slip_ratio=law.width / answer.fastest if answer.fastest else law.width and np.inf,
        first_order=answer.first,
        second_order=answer.second,
        sticks=answer.sticks,
        seconds=time.perf_counter() - start,
        model=_words(law, grows),
    )


def _words(law: FrictionLaw, grows: bool) -> str:
    friction = {"coulomb": "dry friction", "viscous": "viscous friction"}.get(
        law.name, f"friction tanh(v/{law.width:g})"
    )
    load = "load on the current length" if grows else "weight conserved"
    return (
        "body on a line, stretch 1 + alpha c, quasi-static, shape not affected by friction; "
        f"{friction}, {load}"
    )

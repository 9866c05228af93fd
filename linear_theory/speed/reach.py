"""How far in alpha the theories of small growth reach, and how an answer says that alpha is too large.

First order takes strains as small, second order expands the speed in alpha, and neither sees where it
ends: V_1 alpha + V_2 alpha^2 is a number at any alpha. Two bounds come from the theory itself.

* Growth |alpha c| <= 1/2. At 1/2 the laws of growth that agree to first order are no longer alike:
  where c is lowest lengths are 0.61 (exp), 0.5 (linear) and 0 (metric) of what they were, and there end
  the powers of alpha c of which (1 + 2 alpha c)^(1/2) is the sum. Those of the speed itself end at the
  Laplace limit 0.66 for a sine wave on a line. Measured (`make tables`), the second order of the
  paper's sheet is 5 and 10 % off at a growth of 0.25 and 0.37, and from 0.445 on there is no such
  sheet: its free edges wrinkle. Those of wider sheets do so sooner.
* A term of second order below the largest speed of the points of the sheet. Friction cannot balance
  where all of the sheet slips one way, so that |V| is below that speed, whatever the law of friction.
  This ends the second order of waves that are steep where c is near its median.
"""

import warnings
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.errors import BeyondReachWarning
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

LARGEST_GROWTH = 0.5
"""Of |alpha c|, see the module's head."""


def too_large_growth(drive: Drive, alpha: float, x: Array, y: Array) -> str:
    """What is beyond reach in this growth, in words; empty if nothing is. x, y: points of the sheet."""
    largest = abs(alpha) * float(abs(drive.growths(x, y)).max())
    if largest <= LARGEST_GROWTH:
        return ""
    return f"growth |alpha c| reaches {largest:.3g}, the theory ends at {LARGEST_GROWTH:g}"


def too_large_term(second: float, fastest: float) -> str:
    """What is beyond reach in a term V_2 alpha^2, in words; fastest: largest speed of the points."""
    if fastest == 0 or not abs(second) > fastest:  # at rest there is roundoff; NaN is no answer anyway
        return ""
    return (
        f"V_2 alpha^2 = {second:.3g} is above {fastest:.3g}, the largest speed of the points of the "
        "sheet, which no balance of friction allows"
    )


def judged(found: CrawlSpeed, beyond: str) -> CrawlSpeed:
    """The answer, which is not converged where something is beyond reach."""
    return replace(found, converged=False, beyond_reach=beyond) if beyond else found


def warn_if_beyond(alpha: float, beyond: str) -> None:
    """Warn where something is beyond reach; by the function that the user calls."""
    if beyond:
        warnings.warn(
            f"alpha = {alpha:g} is beyond the reach of the theory: {beyond}; for any strain use "
            "fem_check.cycle_speed, or line_balance for a narrow strip",
            BeyondReachWarning,
            stacklevel=3,
        )

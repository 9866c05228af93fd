"""Range of validity in alpha of the theories of small growth, and how a result states that it is left.

First-order theory assumes small strains, second-order theory expands the speed in alpha, and neither
detects its own limit: V_1 alpha + V_2 alpha^2 is finite at any alpha. Two bounds follow from the
theory.

* Growth |alpha c| <= 1/2. At 1/2 growth laws that agree to first order differ strongly: where c is
  lowest, lengths are 0.61 (exp), 0.5 (linear) and 0 (metric) times the original, and the power series
  of (1 + 2 alpha c)^(1/2) ceases to converge. That of the speed converges up to the Laplace limit 0.66
  for a sine wave on a line. Measured (`make tables`), the second order of the paper's sheet is 5 and
  10 % off at a growth of 0.25 and 0.37, and above 0.445 the flat sheet is unstable: its free edges
  wrinkle. Wider sheets wrinkle at smaller growth.
* A second-order term below the largest speed of the points of the sheet. Friction cannot balance if all
  points slip in one direction, so that |V| is below that speed for any friction law. This limits the
  second order for waves that are steep where c is near its median.
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
"""Largest admissible |alpha c|, see the module docstring."""


def too_large_growth(drive: Drive, alpha: float, x: Array, y: Array) -> str:
    """How growth exceeds the range of validity, in words; empty if not. x, y: points of the sheet."""
    largest = abs(alpha) * float(abs(drive.growths(x, y)).max())
    if largest <= LARGEST_GROWTH:
        return ""
    return f"growth |alpha c| reaches {largest:.3g}, must be <= {LARGEST_GROWTH:g} in this theory"


def too_large_term(second: float, fastest: float) -> str:
    """How V_2 alpha^2 exceeds the largest speed of the points, `fastest`, in words; empty if not."""
    if fastest == 0 or not abs(second) > fastest:  # roundoff at rest; NaN is no answer anyway
        return ""
    return (
        f"V_2 alpha^2 = {second:.3g} is above {fastest:.3g}, the largest speed of the points of the "
        "sheet, at which friction cannot balance"
    )


def judged(found: CrawlSpeed, beyond: str) -> CrawlSpeed:
    """The result, marked as not converged if it is beyond reach."""
    return replace(found, converged=False, beyond_reach=beyond) if beyond else found


def warn_if_beyond(alpha: float, beyond: str) -> None:
    """Warn if a result is beyond reach; to be called by the function that the user calls."""
    if beyond:
        warnings.warn(
            f"alpha = {alpha:g} is beyond the reach of the theory: {beyond}; for larger strains use "
            "fem_check.cycle_speed, or line_balance for a narrow strip",
            BeyondReachWarning,
            stacklevel=3,
        )

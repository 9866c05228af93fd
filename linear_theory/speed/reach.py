"""Range of validity in alpha of the theories of small growth, and how a result states that it is left.

First-order theory assumes small strains, second-order theory expands the speed in alpha, and neither
detects its own limit: V_1 alpha + V_2 alpha^2 is finite at any alpha. Three bounds follow from the
theory.

* Growth |alpha c| <= 1/2. At 1/2 growth laws that agree to first order differ strongly: where c is
  lowest, lengths are 0.61 (exp), 0.5 (linear) and 0 (metric) times the original, and the power series
  of (1 + 2 alpha c)^(1/2) ceases to converge. That of the speed converges up to the Laplace limit 0.66
  for a sine wave on a line. Measured (`make tables`), the second order of the paper's sheet is 5 and
  10 % off at a growth of 0.25 and 0.37, and above 0.445 the flat sheet is unstable: its free edges
  wrinkle. Wider sheets wrinkle at smaller growth.
* Rotations up to 1/2 rad. Growth that is linear in y bends a sheet in its plane without stress, as heat
  bends a bimetal: c = b y turns the places (x, y) by alpha b x, so that the ends of a wide sheet swing
  far while all strains are small (those of a long one for c = a x). A strain that is linear in the
  displacement is wrong by half of the square of the rotation, 12 % at 1/2. For one sine wave on a sheet
  of width W the rotation is 0.95 alpha W/L: at W = 10 L and alpha = 0.1 the second order is 30 % above
  the nonlinear sheet (0.0110 for 0.0085 L/T), and at W = 100 L no number means anything.
* A second-order term below the largest speed of the points of the sheet. Friction cannot balance if all
  points slip in one direction, so that |V| is below that speed for any friction law. This limits the
  second order for waves that are steep where c is near its median.
"""

import warnings
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.errors import BeyondReachWarning
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

LARGEST_GROWTH = 0.5
"""Largest admissible |alpha c|, see the module docstring."""

LARGEST_ROTATION = 0.5
"""Largest admissible rotation, radians, likewise."""

FEWEST, PER_WAVE, MOST, TIMES = 16, 4, 256, 32
"""Gauss points across and along from which the linear part of c is found, and times of a period."""


def too_large_growth(drive: Drive, alpha: float, x: Array, y: Array) -> str:
    """How growth exceeds the range of validity, in words; empty if not. x, y: points of the sheet."""
    largest = abs(alpha) * float(abs(drive.growths(x, y)).max())
    if largest <= LARGEST_GROWTH:
        return ""
    return f"growth |alpha c| reaches {largest:.3g}, must be <= {LARGEST_GROWTH:g} in this theory"


def too_large_rotation(drive: Drive, alpha: float) -> str:
    """How the ends of a rectangular sheet turn beyond the range of validity, in words; empty if not."""
    largest = abs(alpha) * rotation(drive)
    if largest <= LARGEST_ROTATION:
        return ""
    return (
        f"the ends of the sheet turn by {largest:.3g} rad in its plane, must be <= "
        f"{LARGEST_ROTATION:g} in this theory"
    )


def rotation(drive: Drive) -> float:
    """Largest rotation of any place of a rectangle by the linear part of c, per unit alpha, radians.

    c = a x + b y, fitted over the sheet at any time, turns (x, y) by a y - b x.
    """
    half = np.array([drive.sheet.width, drive.sheet.length]) / 2
    counts = [min(max(FEWEST, PER_WAVE * n), MOST) for n in drive.short_waves]
    (x, across), (y, along) = (gauss_legendre(count) for count in counts)
    times = drive.period / TIMES * np.arange(float(TIMES))
    c = drive.alone.value(half[0] * x[:, None], half[1] * y, times[:, None, None])
    c = np.broadcast_to(c, (TIMES, *counts))
    moments = [c @ along @ (across * x), c @ (along * y) @ across]  # 4/3 of the slopes times half
    a, b = (0.75 * moment / size for moment, size in zip(moments, half, strict=True))
    return float((abs(a) * half[1] + abs(b) * half[0]).max())


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

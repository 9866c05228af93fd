"""Speeds of the nonlinear sheet and of the bar at finite strain, the symbols of figure 3B.

    python -m figures.measure.nonlinear [--out FILE] [--rtol 3e-4]

Writes figures/data/nonlinear.csv, which the figure reads: half a minute of computing. The sheet is
that of the paper (2:1, nu = 1/2), grown by exp(2 alpha c), with its energy per grown area, planar, its
shapes static and not affected by friction; the load is the weight per current area. Friction is dry, or
tanh(v/v0) with v0 in proportion to the speeds alpha L/T of the deformation: v0 = 0.01, 1 and 100 alpha
L/T make dry, mixed and viscous crawling. The bar is the same growth in one dimension, exactly.
"""

import itertools
import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem_check.shell.cycle.speed import cycle_speed
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import friction_law, smooth_scene
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.line.finite import line_cycle_speed
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.travelling import SineWave

RTOL = 3e-4
"""Relative error asked of the speeds of the sheet: a tenth of the width of a line."""

CELLS = (8, 16)
"""Elements across and along; bicubic and smooth across edges (BFS). Their error is below 1e-4 of V."""

ALPHAS = (0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.325, 0.4)

SLIPS = {"coulomb": 0.0, "dry": 0.01, "mixed": 1.0, "viscous": 100.0}
"""Slip speed v0 over alpha L/T by the name of the regime."""

DIGITS = 6
"""Significant digits written: more than the error leaves, fewer than roundoff changes."""

ROUNDING = 0.5 * 10.0 ** (1 - DIGITS)
"""Relative error by rounding to DIGITS, all the error of the bar."""


@dataclass(frozen=True)
class Speed:
    """One speed and its estimated numerical error in L/T.

    body: "sheet" or "bar"; friction: a key of SLIPS; slip_ratio: v0 over the largest speed against the
    ground.
    """

    body: str
    friction: str
    alpha: float
    speed: float
    error: float
    slip_ratio: float


TABLE = Table(
    DATA / "nonlinear.csv",
    Speed,
    "python -m figures.measure.nonlinear",
    "speeds and errors in L/T",
    DIGITS,
)


def compute(alphas: Sequence[float] = ALPHAS, rtol: float = RTOL) -> list[Speed]:
    """Speeds of sheet and bar at all alphas and slip speeds.

    Raises RuntimeError if a speed misses its tolerance.
    """
    pairs = list(itertools.product(SLIPS, alphas))
    speeds = [sheet_speed(alpha, law, rtol) for law, alpha in tracked("nonlinear sheet", pairs)]
    for alpha in alphas:
        speed = float(line_cycle_speed(alpha, "exp"))
        speeds.append(Speed("bar", "coulomb", alpha, speed, ROUNDING * abs(speed), 0.0))
    return speeds


def sheet_speed(alpha: float, friction: str, rtol: float) -> Speed:
    """The nonlinear sheet under one law of friction."""
    scene = smooth_scene(Sheet(), SineWave(), alpha, CELLS)
    law = friction_law(SLIPS[friction] * alpha)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)  # viscous crawling is meant
        found = cycle_speed(scene, "current", rtol=rtol, **law)
    if not found.converged:
        raise RuntimeError(
            f"alpha = {alpha}, {friction}: error {found.error:.2g} of {found.mean:.4g} misses {rtol:g}"
        )
    return Speed("sheet", friction, alpha, found.mean, found.error, found.slip_ratio)


def select(speeds: Sequence[Speed], body: str, friction: str = "coulomb") -> tuple[np.ndarray, ...]:
    """alpha, speed and error, each (n,), of one body under one friction."""
    chosen = [s for s in speeds if (s.body, s.friction) == (body, friction)]
    return tuple(np.array([(s.alpha, s.speed, s.error) for s in chosen]).reshape(-1, 3).T)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, rtol=(RTOL, "relative error of the speeds"))
    TABLE.write(compute(rtol=options.rtol), options.out)


if __name__ == "__main__":
    main()

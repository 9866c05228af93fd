"""Speeds between dry and viscous friction: V/alpha^2 against the slip speed v0, by five models.

    python -m figures.measure.regimes [--out FILE] [--rtol 3e-4]

Writes figures/data/regimes.csv, which `figures.draw.regimes` draws: half a minute of computing. The
law is tanh(v/v0), with v0 in units of the speeds alpha L/T of the deformation; 0 stands for Coulomb and
inf for viscous friction. Wave and sheet are those of the paper (one sine wave; 2:1, nu = 1/2, growth
exp(2 alpha c), energy per grown area), the load is the weight per current area. The models: "line", a
body on a line; "linear", eqs 10 and 11; "second order", the limit of small alpha; "nonlinear", static
shapes not affected by friction; "stepped", through time, with friction 1e-4 of the stiffness.
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.stepping.simulation import simulate
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import friction_law, sliding_scene, smooth_scene
from linear_theory import (
    CrawlSpeed,
    RitzField,
    Sheet,
    SineWave,
    ViscousRegimeWarning,
    crawl_speed,
    field_speed,
    line_balance,
    ritz_field,
)

SHEET, WAVE, ALPHA = Sheet(), SineWave(), 0.1

RTOL = 3e-4
"""Relative error asked of the speeds, but for the stepped ones: a tenth of the width of a line."""

SLIPS = tuple(float(f"{10 ** (k / 4):.2g}") for k in range(-12, 13))
"""Slip speeds over alpha L/T, four to a decade, of the curves; every second one for the symbols."""

LIMITS = (0.0, np.inf)
"""Slip speeds of Coulomb and of viscous friction."""

STEPPED = (0.032, 0.32, 1.0, 10.0)

STEPS = 128
"""Steps per period."""

CELLS = (8, 16)
"""Elements across and along of the nonlinear sheet; their error is below 1e-4 of V."""

DIGITS = 7
"""Significant digits written."""


@dataclass(frozen=True)
class Row:
    """V/alpha^2 and its estimated numerical error in L/T.

    model: key of MODELS; slip: v0 over alpha L/T; slip_ratio: v0 over the largest speed against the
    ground.
    """

    model: str
    slip: float
    coefficient: float
    error: float
    slip_ratio: float


TABLE = Table(
    DATA / "regimes.csv",
    Row,
    "python -m figures.measure.regimes",
    f"alpha = {ALPHA:g}; slip: v0/(alpha L/T), coefficient: V/alpha^2 and its error in L/T",
    DIGITS,
)

Law = dict[str, Any]
"""Arguments friction and slip_speed."""


def line(law: Law, rtol: float) -> CrawlSpeed:
    """The body on a line."""
    return line_balance(WAVE, ALPHA, rtol=rtol, **law)


def linear(law: Law, rtol: float) -> CrawlSpeed:
    """The paper's theory."""
    return field_speed(deformation(rtol), ALPHA, rtol=rtol, **law)


@cache
def deformation(rtol: float) -> RitzField:
    """Of first order, a tenth of the error of the speed."""
    return ritz_field(SHEET, WAVE, rtol=0.1 * rtol)


def second_order(law: Law, rtol: float) -> CrawlSpeed:
    """V_2 alpha^2: for a sine wave that is all."""
    return crawl_speed(SHEET, WAVE, ALPHA, rtol=rtol, order=2, **law)


def nonlinear(law: Law, rtol: float) -> CrawlSpeed:
    """The cycle of static shapes."""
    return cycle_speed(smooth_scene(SHEET, WAVE, ALPHA, CELLS), "current", rtol=rtol, **law)


def stepped(law: Law, steps: int = STEPS) -> CrawlSpeed:
    """A ramp of half a period and one period, with the error of the mesh."""
    scene = sliding_scene(SHEET, WAVE, ALPHA, law["slip_speed"])
    return simulate(scene, periods=1, steps=steps, mesh_error=True).speed


MODELS: dict[str, tuple[Callable[[Law, float], CrawlSpeed], tuple[float, ...]]] = {
    "line": (line, (*LIMITS, *SLIPS)),
    "linear": (linear, (*LIMITS, *SLIPS)),
    "second order": (second_order, (*LIMITS, *SLIPS)),
    "nonlinear": (nonlinear, (*LIMITS, *SLIPS[::2])),
    "stepped": (lambda law, rtol: stepped(law), STEPPED),
}
"""How each model finds a speed, and at which slip speeds."""


def row(model: str, slip: float, rtol: float = RTOL) -> Row:
    """One speed. Raises RuntimeError if it misses its tolerance (steps have none)."""
    speed, _ = MODELS[model]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)  # here that is what is studied
        found = speed(friction_law(slip * ALPHA), rtol)
    if not (found.converged or model == "stepped"):
        raise RuntimeError(
            f"{model}, slip speed {slip:g} alpha L/T: error {found.error:.2g} of {found.mean:.4g} "
            f"misses {rtol:g}"
        )
    return Row(model, slip, found.mean / ALPHA**2, found.error / ALPHA**2, found.slip_ratio)


def compute(rtol: float = RTOL) -> list[Row]:
    """All rows of the table, saying how far it is."""
    chosen = [(model, slip) for model, (_, slips) in MODELS.items() for slip in sorted(slips)]
    return [row(model, slip, rtol) for model, slip in tracked("regimes", chosen)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, rtol=(RTOL, "relative error of the speeds"))
    TABLE.write(compute(options.rtol), options.out)


if __name__ == "__main__":
    main()

"""Speeds of the nonlinear sheet and of the bar at finite strain, the symbols of figure 3B.

    python -m figures.measure.nonlinear [--out FILE] [--rtol 3e-4]

Writes figures/data/nonlinear.csv, which the figure reads: half a minute of computing. The sheet is
that of the paper (2:1, nu = 1/2), grown by exp(2 alpha c), with its energy per grown area, planar, its
shapes static and not affected by friction; the load is the weight per current area. Friction is dry, or
tanh(v/v0) with v0 in proportion to the speeds alpha L/T of the deformation: v0 = 0.01, 1 and 100 alpha
L/T make dry, mixed and viscous crawling. The bar is the same growth in one dimension, exactly.
"""

import argparse
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import skfem

from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.scene.material import Material
from fem_check.shell.scene.scene import Scene
from figures.common import output
from figures.common.folders import DATA
from figures.common.records import write_rows
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.common.records import read_rows
from linear_theory.line.finite import line_cycle_speed
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.travelling import SineWave

PATH = DATA / "nonlinear.csv"
COMMAND = "python -m figures.measure.nonlinear"

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


def compute(alphas: Sequence[float] = ALPHAS, rtol: float = RTOL) -> list[Speed]:
    """Speeds of sheet and bar at all alphas and slip speeds.

    Raises RuntimeError if a speed misses its tolerance.
    """
    speeds = []
    with output.Progress("nonlinear sheet", len(SLIPS) * len(alphas)) as progress:
        for friction in SLIPS:
            for alpha in alphas:
                speeds.append(sheet_speed(alpha, friction, rtol))
                progress.advance()
    for alpha in alphas:
        speed = float(line_cycle_speed(alpha, "exp"))
        speeds.append(Speed("bar", "coulomb", alpha, speed, ROUNDING * abs(speed), 0.0))
    return speeds


def sheet_speed(alpha: float, friction: str, rtol: float) -> Speed:
    """The nonlinear sheet under one law of friction."""
    sheet = Sheet()
    membrane = Membrane(Material(sheet.thickness, sheet.poisson))
    scene = Scene(
        sheet, SineWave(), alpha, effects=(membrane,), cells=CELLS, element=skfem.ElementQuadBFS()
    )
    slip = SLIPS[friction] * alpha
    law = {"friction": "tanh", "slip_speed": slip} if slip else {"friction": "coulomb"}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)  # viscous crawling is meant
        found = cycle_speed(scene, "current", rtol=rtol, **law)
    if not found.converged:
        raise RuntimeError(
            f"alpha = {alpha}, {friction}: error {found.error:.2g} of {found.mean:.4g} misses {rtol:g}"
        )
    return Speed("sheet", friction, alpha, found.mean, found.error, found.slip_ratio)


def write(speeds: Sequence[Speed], path: Path = PATH) -> Path:
    """The rows as a table, after a line that tells how it was made."""
    return write_rows(path, speeds, COMMAND, "speeds and errors in L/T", DIGITS)


def read(path: Path = PATH) -> list[Speed]:
    """The rows of a table. Raises FileNotFoundError, naming the command that makes it."""
    return read_rows(path, Speed, COMMAND)


def select(speeds: Sequence[Speed], body: str, friction: str = "coulomb") -> tuple[np.ndarray, ...]:
    """alpha, speed and error, each (n,), of one body under one friction."""
    chosen = [s for s in speeds if (s.body, s.friction) == (body, friction)]
    return tuple(np.array([(s.alpha, s.speed, s.error) for s in chosen]).reshape(-1, 3).T)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=PATH, metavar="FILE")
    parser.add_argument("--rtol", type=float, default=RTOL)
    options = parser.parse_args(arguments)
    write(compute(rtol=options.rtol), options.out)


if __name__ == "__main__":
    main()

"""V over growth and rest curvature, figure 4 of the seed paper, by steps in time.

    python -m figures.measure.gait_map [--out FILE] [--points 11] [--friction viscous]

Writes figures/data/gait_map.csv, one row for each gait, 4 to 10 s of the processor; it goes on where
the file ends. The paper's sheet, weight and ground, driven by the excitable wave "nu = -0.1" from its
start: the second and third cycle count. One map over kappa, the rest curvature per c in 1/L, serves all
readings of the paper's beta: "printed" kappa = beta, "thickness" kappa = beta/h, "hundred" kappa =
100 beta. Friction "viscous" is the paper's tanh law with v0 = 1 in
its own units, "dry" has v0 = 0.02 L a cycle.
"""

import functools
import time
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Material,
    Membrane,
    excitable_preset,
    simulate,
)
from fem_check.excitable import Excitation
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory import Sheet
from linear_theory.common.errors import SheetcrawlError
from linear_theory.scene.scene import Scene

SHEET = Sheet()
MATERIAL = Material(SHEET.thickness, SHEET.poisson)
WEIGHT, STIFFNESS = Gravity(2.5e-4), Ground(0.5)
CELLS, STEPS, PERIODS, POINTS = (4, 8), 64, 3, 11

FRICTIONS = {"viscous": 1.0, "dry": 0.02 / 42.4}
"""Slip speeds, length over the unit of time of the equation; a cycle takes about 42.4 of them."""

LARGEST = 0.3, 10.0
"""|alpha| and |kappa| of the map."""

READINGS = {"printed": 1.0, "thickness": 1 / SHEET.thickness, "hundred": 100.0}
"""kappa L over the paper's beta."""

BACKWARD, FORWARD = (-0.25, -0.15), (-0.3, 0.1)
"""alpha and beta of the paper's two gaits."""

BILAYER = (0.02, 0.05, 0.1)
"""|alpha| on the lines beta = +-100 alpha of two equal layers."""

DIGITS = 4


@dataclass(frozen=True)
class Row:
    """A gait: V in L per cycle of the second and of the third cycle, NaN where it stopped.

    snapped: steps that do not resolve the motion; crossed: states in which the sheet crosses itself.
    """

    alpha: float
    kappa: float
    friction: str
    second: float
    third: float
    snapped: int
    crossed: int
    seconds: float
    said: str


TABLE = Table(
    DATA / "gait_map.csv",
    Row,
    "python -m figures.measure.gait_map",
    "kappa in 1/L, speeds in L a cycle, seconds of the processor",
    DIGITS,
)


@functools.cache
def wave() -> Excitation:
    """The wave of all gaits, of unit of time 1."""
    return excitable_preset("nu = -0.1").on(SHEET, until=200.0, rtol=1e-2)


def gait(alpha: float, kappa: float, friction: str) -> Scene:
    """The scene of a point of the map."""
    law = Friction(1.0, FRICTIONS[friction])
    effects = [Membrane(MATERIAL), Bending(MATERIAL), WEIGHT, STIFFNESS, law]
    return Scene(SHEET, wave(), alpha, kappa, effects, cells=CELLS)


def places(points: int) -> Iterator[tuple[float, float]]:
    """The paper's gaits in every reading, the bilayer lines, and the grid."""
    for alpha, beta in (BACKWARD, FORWARD):
        yield from ((alpha, beta * factor) for factor in READINGS.values())
    for alpha in BILAYER:
        yield from ((a, k * 100 * alpha) for a in (-alpha, alpha) for k in (-1, 1))
    alphas, kappas = axes(points)
    yield from ((float(a), float(k)) for a in alphas for k in kappas)


def axes(points: int = POINTS) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """alpha and kappa of the grid, as the table has them."""
    alphas, kappas = (np.linspace(-most, most, points) for most in LARGEST)
    return np.array([_kept(a) for a in alphas]), np.array([_kept(k) for k in kappas])


def _kept(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")


def row(alpha: float, kappa: float, friction: str) -> Row:
    """One gait."""
    begin, nan = time.process_time(), float("nan")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = simulate(gait(alpha, kappa, friction), PERIODS, steps=STEPS, mesh_error=False)
        except SheetcrawlError as problem:
            said = " ".join(str(problem).split())
            return Row(alpha, kappa, friction, nan, nan, 0, 0, time.process_time() - begin, said)
    second, third = (float(v) * found.scene.period for v in found.period_speeds[-2:])
    crossed = 0 if found.crossed is None else int(found.crossed.sum())
    spent = time.process_time() - begin
    return Row(alpha, kappa, friction, second, third, int(found.snapped.sum()), crossed, spent, "")


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(
        __doc__,
        arguments,
        points=(POINTS, "alphas and kappas of the grid"),
        friction=("viscous", "viscous or dry"),
    )
    rows = TABLE.read(options.out) if options.out.exists() else []
    known = {(r.alpha, r.kappa, r.friction) for r in rows}
    wanted = dict.fromkeys((_kept(a), _kept(k)) for a, k in places(options.points))
    left = [(a, k) for a, k in wanted if (a, k, options.friction) not in known]
    for alpha, kappa in tracked("gaits", left):
        rows.append(row(alpha, kappa, options.friction))
        TABLE.write(rows, options.out)


if __name__ == "__main__":
    main()

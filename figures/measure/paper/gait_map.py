"""V over growth and rest curvature, figure 4 of the paper, by steps in time.

    python -m figures.measure.paper.gait_map [--out FILE] [--points 21] [--friction both] [--workers 2]

Writes figures/data/gait_map.csv, one row for each gait and law of friction, 6 to 30 s of the processor;
it goes on where the file ends, and computes rows without an error again. One process writes, with as
many to compute as there are workers. The readings of the paper are those of `paper_gait`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.paper.paper_gait import (
    BACKWARD,
    DIGITS,
    FORWARD,
    FRICTIONS,
    READINGS,
    Measured,
    kept,
    measured,
    paper_scene,
)

STEPS, POINTS = 64, 21

LARGEST = 0.3, 10.0
"""|alpha| and |kappa| of the map."""

BILAYER = (0.02, 0.05, 0.1)
"""|alpha| on the lines beta = +-100 alpha of two equal layers."""


@dataclass(frozen=True)
class Place:
    """A gait and its friction."""

    alpha: float
    kappa: float
    friction: str


@dataclass(frozen=True)
class Row(Measured, Place):
    """A gait and its speed."""


TABLE = Table(
    DATA / "gait_map.csv",
    Row,
    "python -m figures.measure.paper.gait_map",
    "kappa in 1/L, speeds in L a cycle, seconds of the processor",
    DIGITS,
)


def places(points: int) -> Iterator[tuple[float, float]]:
    """The paper's gaits in every reading, the bilayer lines, and the grid, alpha and kappa."""
    for alpha, beta in (BACKWARD, FORWARD):
        yield from ((alpha, kept(beta * factor)) for factor in READINGS.values())
    for alpha in BILAYER:
        yield from ((a, k * 100 * alpha) for a in (-alpha, alpha) for k in (-1, 1))
    alphas, kappas = axes(points)
    yield from ((a, k) for a in alphas.tolist() for k in kappas.tolist())


def axes(points: int = POINTS) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """alpha and kappa of the grid, as the table has them."""
    alphas, kappas = (np.linspace(-most, most, points) for most in LARGEST)
    return np.array([kept(a) for a in alphas]), np.array([kept(k) for k in kappas])


def on_whole_grid(rows: Sequence[Row]) -> list[Row]:
    """Those of one law of friction on the finest grid that has a row at every place; else all."""
    for points in (POINTS, (POINTS + 1) // 2):
        alphas, kappas = (set(values.tolist()) for values in axes(points))
        found = [r for r in rows if r.alpha in alphas and r.kappa in kappas]
        if len(found) == points**2:
            return found
    return list(rows)


def place_of(row: Row) -> Place:
    """Without its speed."""
    return Place(row.alpha, row.kappa, row.friction)


def counts(row: Row) -> bool:
    """Whether it has all that is computed: an error, or a reason why there is no speed."""
    return bool(row.said) or not np.isnan(row.error)


def row(place: Place) -> Row:
    """One gait."""
    return Row(**vars(place), **vars(measured(paper_scene(**vars(place)), STEPS)))


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(
        __doc__,
        arguments,
        points=(POINTS, "alphas and kappas of the grid"),
        friction=("both", "viscous, dry or both"),
        workers=(1, "processes"),
    )
    laws = list(FRICTIONS) if options.friction == "both" else [options.friction]
    # Law by law: a run that is stopped leaves one whole map rather than two halves
    wanted = [Place(a, k, law) for law in laws for a, k in dict.fromkeys(places(options.points))]
    Filling(TABLE, options.out, place_of, counts).fill(wanted, row, options.workers)


if __name__ == "__main__":
    main()

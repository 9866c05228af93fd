"""V on uneven ground, figure 6 of the paper, by steps in time.

    python -m figures.measure.paper.terrain [--out FILE] [--form cosine] [--friction dry] [--points 7]

Writes figures/data/terrain.csv, one row for each ground, 6 to 15 s of the processor; it goes on where
the file ends. nx = L/lambda_x and ny = L/lambda_y count the waves of height 0.02 on a length L.
"printed" is eq. 13, z = A sin(2 pi nx x/L) sin(2 pi ny y/L), which is flat where nx or ny is 0,
although the paper shows ridges there; "cosine" has cosines in place of the sines.

The gait is the forward one of figure 4C in the reading "thickness"; that of figure 3B, which the
caption of figure 6 names, has a speed of order alpha^2 only: rows "flat sheet" are of the four grounds
that the paper shows.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy

from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.paper.paper_gait import (
    DIGITS,
    FORWARD,
    FRICTIONS,
    READINGS,
    Measured,
    kept,
    measured,
    paper_scene,
)

HEIGHT = 0.02
"""A of eq. 13, L."""

GAITS = {
    "forward": (FORWARD[0], kept(FORWARD[1] * READINGS["thickness"])),
    "flat sheet": (0.25, 0.0),
}
"""alpha and kappa."""

FORMS: dict[str, Any] = {"printed": sympy.sin, "cosine": sympy.cos}

MOST, POINTS = 15.0, 7
"""Largest number of waves and grounds each way: all four of the paper are among them."""

SHOWN = {"A": (0.0, 0.0), "B": (0.0, 7.5), "C": (5.0, 0.0), "D": (15.0, 15.0)}
"""nx and ny of flat ground and of the panels of the figure."""

STEPS = 64


@dataclass(frozen=True)
class Place:
    """A gait, its friction, and a ground of nx and ny waves on a length L."""

    gait: str
    friction: str
    form: str
    nx: float
    ny: float


@dataclass(frozen=True)
class Row(Measured, Place):
    """A ground and the speed on it."""


TABLE = Table(
    DATA / "terrain.csv",
    Row,
    "python -m figures.measure.paper.terrain",
    "waves on a length L, speeds in L a cycle, seconds of the processor",
    DIGITS,
)


def height(form: str, nx: float, ny: float) -> Any:
    """z(x, y) as an expression, L = 1; None for flat ground.

    >>> from figures.measure.paper.terrain import height
    >>> print(height("printed", 5.0, 0.0), height("cosine", 5.0, 0.0))
    None 0.02*cos(31.4159265358979*x)
    """
    if not (nx and ny) and (form == "printed" or not (nx or ny)):
        return None
    x, y, wave = sympy.Symbol("x"), sympy.Symbol("y"), FORMS[form]
    return HEIGHT * wave(2 * np.pi * nx * x) * wave(2 * np.pi * ny * y)


def places(form: str, friction: str, points: int) -> Iterator[Place]:
    """The paper's grounds, for both gaits, then a grid, every other line of it first."""
    for gait in GAITS:
        yield from (Place(gait, friction, form, *ground) for ground in SHOWN.values())
    waves = [kept(n) for n in np.linspace(0, MOST, points)]
    waves = [*waves[::2], *waves[1::2]]
    order = sorted(range(points**2), key=lambda k: max(divmod(k, points)))
    for i, j in (divmod(k, points) for k in order):
        yield Place("forward", friction, form, waves[i], waves[j])


def place_of(row: Row) -> Place:
    """Without its speed."""
    return Place(row.gait, row.friction, row.form, row.nx, row.ny)


def row(place: Place) -> Row:
    """One ground."""
    ground = height(place.form, place.nx, place.ny)
    scene = paper_scene(*GAITS[place.gait], place.friction, height=ground)
    return Row(**vars(place), **vars(measured(scene, STEPS)))


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(
        __doc__,
        arguments,
        form=("cosine", " or ".join(FORMS)),
        friction=("dry", " or ".join(FRICTIONS)),
        points=(POINTS, "grounds each way"),
        workers=(1, "processes"),
    )
    wanted = list(dict.fromkeys(places(options.form, options.friction, options.points)))
    Filling(TABLE, options.out, place_of).fill(wanted, row, options.workers)


if __name__ == "__main__":
    main()

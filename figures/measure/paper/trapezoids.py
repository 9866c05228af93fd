"""V of trapezoids of one area, figure 5 of the paper, by steps in time.

    python -m figures.measure.paper.trapezoids [--out FILE] [--reading thickness] [--friction viscous]

Writes figures/data/trapezoids.csv, one row for each sheet, 4 to 20 s of the processor; it goes on where
the file ends. w1 and w2 are the widths of the rear and of the leading edge with respect to the wave, in
units of the width W = L/2 of the rectangle: only so are the paper's L' = 2L/(w1 + w2) and the area
L^2/2 of its caption the same statement. L' is in units of L. The wave is that of the outline, from
the start y^2/(1 + y^2) with y from the rear edge in units of L.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from fem_check import Outline
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.paper.paper_gait import (
    BACKWARD,
    DIGITS,
    FORWARD,
    FRICTIONS,
    READINGS,
    SHEET,
    Measured,
    kept,
    measured,
    paper_scene,
)

GAITS = {"forward": FORWARD, "backward": BACKWARD}
"""Panels A and B of the figure."""

RATIOS = tuple(kept(2.0**k) for k in (0, -2, 2, -1, 1, -0.5, 0.5, -1.5, 1.5))
"""w1/w2, in an order in which any part of the table covers the whole range."""

LENGTHS = (0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8)
"""L'/L; the two optima of the paper are 0.9 and 1.4."""

STEPS = 64
SIZE, COARSE = 0.36, 0.54
"""Sides of the triangles, L; on the rectangle 2 x 3 and 1 x 2 cells of four triangles."""


@dataclass(frozen=True)
class Place:
    """A gait in a reading, and the shape of its sheet."""

    gait: str
    reading: str
    friction: str
    ratio: float
    length: float


@dataclass(frozen=True)
class Row(Measured, Place):
    """A trapezoid and its speed."""


TABLE = Table(
    DATA / "trapezoids.csv",
    Row,
    "python -m figures.measure.paper.trapezoids",
    "ratio = w1/w2, length = L'/L, speeds in L a cycle, seconds of the processor",
    DIGITS,
)


def outline(ratio: float, length: float) -> Outline:
    """The trapezoid of a ratio w1/w2 and a length L'/L, of the area of the rectangle.

    >>> from figures.measure.paper.trapezoids import outline
    >>> print(round(outline(ratio=3.0, length=0.8).area, 12))
    0.5
    """
    front = 2 / (length * (1 + ratio)) * SHEET.width
    return Outline.trapezoid(ratio * front, front, length * SHEET.length)


def places(reading: str, friction: str) -> Iterator[Place]:
    """A grid for each gait."""
    for ratio in RATIOS:
        for gait in GAITS:
            for length in LENGTHS:
                yield Place(gait, reading, friction, ratio, length)


def place_of(row: Row) -> Place:
    """Without its speed."""
    return Place(row.gait, row.reading, row.friction, row.ratio, row.length)


def row(place: Place) -> Row:
    """One trapezoid."""
    alpha, beta = GAITS[place.gait]
    shape, kappa = outline(place.ratio, place.length), beta * READINGS[place.reading]
    fine, coarse = (
        paper_scene(alpha, kappa, place.friction, outline=shape, size=size) for size in (SIZE, COARSE)
    )
    found = measured(fine, STEPS, coarse)
    return Row(**vars(place), **vars(found))


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(
        __doc__,
        arguments,
        reading=("thickness", f"of beta: {', '.join(READINGS)}"),
        friction=("viscous", " or ".join(FRICTIONS)),
        workers=(1, "processes"),
    )
    filling = Filling(TABLE, options.out, place_of)
    filling.fill(list(places(options.reading, options.friction)), row, options.workers)


if __name__ == "__main__":
    main()

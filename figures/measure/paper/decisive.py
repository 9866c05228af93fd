"""The paper's two gaits with one thing changed at a time: what its statements of them depend on.

    python -m figures.measure.paper.decisive [--out FILE]

Writes figures/data/decisive.csv, one row for each change, 8 to 25 s of the processor; it goes on where
the file ends. The gaits are those of figure 4, kappa = beta/h. Changes: none; a finer mesh, 6 x 12
elements for 4 x 8; a ground a hundred times stiffer; a tenth of the weight; other waves by name.
"""

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from fem_check.shell.stepping.trajectory import Trajectory
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.paper.paper_gait import (
    BACKWARD,
    DIGITS,
    FINE,
    FORWARD,
    READINGS,
    RIGID,
    WEIGHT,
    Measured,
    kept,
    moved,
    paper_scene,
    told,
)

STEPS = 64

OTHER_STEPS = {"48 steps": 48, "96 steps": 96, "128 steps": 128}
"""With which a sheet that buckles may take another way; under dry friction."""

GAITS = {"backward": BACKWARD, "forward": FORWARD}

CHANGES: dict[str, dict[str, Any]] = {
    "none": {},
    "finer mesh": {"cells": FINE},
    "stiff ground": {"ground": RIGID},
    "tenth of the weight": {"weight": WEIGHT / 10},
    "wave printed": {"waves": "printed"},
    "wave nu = -0.05": {"waves": "nu = -0.05"},
    **{change: {} for change in OTHER_STEPS},
}
"""Arguments of `paper_scene`."""

DRY = ("none", "finer mesh", "stiff ground", "tenth of the weight", *OTHER_STEPS)
"""Those that are run under dry friction."""

VISCOUS = tuple(change for change in CHANGES if change not in OTHER_STEPS)


@dataclass(frozen=True)
class Place:
    """A gait, its friction, and what is not as in the map."""

    gait: str
    friction: str
    change: str


@dataclass(frozen=True)
class Row(Measured, Place):
    """Its speed, and the depth in L to which its deepest point sinks after the first cycle."""

    depth: float


TABLE = Table(
    DATA / "decisive.csv",
    Row,
    "python -m figures.measure.paper.decisive",
    "kappa = beta/h, speeds in L a cycle, depth in L, seconds of the processor",
    DIGITS,
)


def places() -> Iterator[Place]:
    """All of them, viscous friction first."""
    for friction, changes in (("viscous", VISCOUS), ("dry", DRY)):
        yield from (Place(gait, friction, change) for change in changes for gait in GAITS)


def place_of(row: Row) -> Place:
    """Without its speed."""
    return Place(row.gait, row.friction, row.change)


def row(place: Place) -> Row:
    """One gait."""
    begin, (alpha, beta) = time.process_time(), GAITS[place.gait]
    kappa = kept(beta * READINGS["thickness"])
    scene = paper_scene(alpha, kappa, place.friction, **CHANGES[place.change])
    found = moved(scene, OTHER_STEPS.get(place.change, STEPS), mesh_error=True)
    speeds = told(found, found.errors.mesh, time.process_time() - begin)
    return Row(**vars(place), **vars(speeds), depth=depth(found))


def depth(found: Trajectory) -> float:
    """Of the deepest point of the mesh below z = 0, after the first cycle."""
    times = found.stored_times[found.stored_times > found.start + found.scene.period]
    return float(max(-found.positions(t)[2].min() for t in times))


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, workers=(1, "processes"))
    Filling(TABLE, options.out, place_of).fill(list(places()), row, options.workers)


if __name__ == "__main__":
    main()

"""The centre of mass of the paper's two gaits over four cycles, for figure 4.

    python -m figures.measure.paper.gait_paths [--out FILE]

Writes figures/data/gait_paths.csv, half a minute; kappa = beta/h.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.measure.paper.decisive import GAITS
from figures.measure.paper.paper_gait import DIGITS, FRICTIONS, READINGS, kept, moved, paper_scene

STEPS, PERIODS = 64, 4


@dataclass(frozen=True)
class Row:
    """y of the centre of mass in L, after a number of cycles from the start of the first one."""

    gait: str
    friction: str
    cycles: float
    y: float


TABLE = Table(
    DATA / "gait_paths.csv",
    Row,
    "python -m figures.measure.paper.gait_paths",
    "kappa = beta/h, y in L",
    DIGITS,
)


def path(gait: str, friction: str) -> list[Row]:
    """The path of a gait, from y = 0."""
    alpha, beta = GAITS[gait]
    scene = paper_scene(alpha, kept(beta * READINGS["thickness"]), friction)
    found = moved(scene, STEPS, periods=PERIODS)
    cycles = (found.times - found.start) / found.scene.period
    counted = cycles > -1e-9
    y = found.centre[1] - np.interp(0.0, cycles, found.centre[1])
    return [
        Row(gait, friction, float(c), float(v))
        for c, v in zip(cycles[counted], y[counted], strict=True)
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments)
    wanted = [(gait, friction) for friction in FRICTIONS for gait in GAITS]
    TABLE.write([row for pair in tracked("gaits", wanted) for row in path(*pair)], options.out)


if __name__ == "__main__":
    main()

"""What crawling costs under friction with a direction: a wave and a sheet that breathes.

    python -m figures.measure.energy.gaits [--out FILE] [--rtol 3e-3]

Writes figures/data/energy_gaits.csv, which `figures.draw.energy` draws: a minute of computing.
Gaits, dry friction 1 - r forward, 1 + r backward and 1 sideways, and models as in
`figures.measure.directional`, here "line" and "nonlinear": over r at ALPHA, and over alpha at RS.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from fem_check.shell.cycle.speed import cycle_speed
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import smooth_scene
from figures.measure import directional
from linear_theory import CrawlSpeed, line_balance

ALPHA, RS = 0.1, (0.0, 0.4)

RTOL = 1e-2
"""Relative error asked of the speeds: the width of a line."""

GRID = {
    "line": ([round(0.05 * k, 2) for k in range(20)], [0.01 * 1.25**k for k in range(17)]),
    "nonlinear": ([0.0, 0.2, 0.4, 0.6, 0.8], [0.02, 0.05, 0.2, 0.3]),
}
"""r at ALPHA, and alpha at RS, of each model; without a direction a breath goes nowhere."""


@dataclass(frozen=True)
class Row:
    """Cost of transport over mu, and efficiency, with their numerical errors.

    model, wave, r: as in `directional.Row`.
    """

    model: str
    wave: str
    r: float
    alpha: float
    cost: float
    cost_error: float
    efficiency: float
    efficiency_error: float


TABLE = Table(
    DATA / "energy_gaits.csv",
    Row,
    "python -m figures.measure.energy.gaits",
    "r: (backward - forward)/(backward + forward); cost of transport over mu = (backward + forward)/2",
    6,
)


def answer(model: str, wave: str, r: float, alpha: float, rtol: float = RTOL) -> CrawlSpeed:
    """The speed with its energy."""
    gait, law = directional.WAVES[wave], directional.law(r)
    if model == "line":
        return line_balance(
            gait, alpha, friction=law, rtol=rtol, atol=rtol * alpha**2, growth_law="exp", length=1.0
        )
    scene = smooth_scene(directional.SHEET, gait, alpha, directional.CELLS)
    return cycle_speed(scene, "current", law, rtol=rtol, atol=rtol * alpha**2)


def row(model: str, wave: str, r: float, alpha: float, rtol: float = RTOL) -> Row:
    """One row."""
    found = answer(model, wave, r, alpha, rtol)
    return Row(model, wave, r, alpha, *found.cost_of_transport, *found.efficiency)


def places() -> list[tuple[str, str, float, float]]:
    """Model, wave, r and alpha of all rows."""
    found = []
    for model, (differences, alphas) in GRID.items():
        for wave in directional.WAVES:
            found += [(model, wave, r, ALPHA) for r in differences]
            found += [(model, wave, r, alpha) for r in RS for alpha in alphas]
    return [place for place in found if place[2] or place[1] == "wave"]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, rtol=(RTOL, "relative error of the speeds"))
    rows = [row(*place, options.rtol) for place in tracked("energy of gaits", places())]
    TABLE.write(rows, options.out)


if __name__ == "__main__":
    main()

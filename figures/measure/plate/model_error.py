"""How far the second order in (alpha, beta) of a sheet on its ground is from a cycle of its shapes.

    python -m figures.measure.plate.model_error [--out FILE]

Writes figures/data/plate_error.csv: sheets, grounds, weights, laws and couplings drawn at random, each
row from its number alone; four minutes of one core, and it goes on where the file ends. The bound in
`linear_theory.speed.plate.error` is from its first rows, and the others test it.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Material,
    Membrane,
    Scene,
    cycle_speed,
)
from figures.common.filling import Filling
from figures.common.folders import DATA
from figures.common.records import Table
from linear_theory import FrictionLaw, Sheet, SineWave, Tanh, Viscous, crawl_speed, second_order
from linear_theory.common.errors import SheetcrawlError
from linear_theory.deformation.plate import foundation
from linear_theory.speed.plate.error import RANGES, bound, slip_ratio, tension
from linear_theory.speed.plate.terms import PlateTerms


@dataclass(frozen=True)
class Row:
    """A scene, E = L = T = 1, and its speeds over alpha^2 L/T.

    share: beta over that at which it lifts off; slip: see `plate.error.slip_ratio`; planar, mixed and
    bent: terms in alpha^2, alpha beta, beta^2; theory, cycle: V by the plate and by shapes, NaN where
    there is none; error: of both; seconds: of the processor.
    """

    number: int
    width: float
    poisson: float
    thickness: float
    weight: float
    stiffness: float
    law: str
    alpha: float
    share: float
    slip: float
    planar: float
    mixed: float
    bent: float
    theory: float
    cycle: float
    error: float
    seconds: float


TABLE = Table(
    DATA / "plate_error.csv",
    Row,
    "python -m figures.measure.plate.model_error",
    "E = L = T = 1; speeds over alpha^2 L/T, seconds of the processor",
    6,
)

ROWS, SEED = 100, 20

RTOL = 1e-3
"""Of both speeds, relative to the sum of the sizes of the terms."""

MOST_TENSION = 5.0
"""Twice that up to which the bound stands."""

TANH = 0.3
"""Slip speed over |alpha| L/T."""

LAWS = ("dry", "tanh", "viscous")

RESOLVED = 0.08
"""Length of the edge layers from which on 8 elements along the sheet resolve them, else 12."""


def drawn(number: int) -> Row:
    """Sheet, ground and couplings of a row; beta as a share of that at lift-off, without speeds."""
    rng = np.random.default_rng((SEED, number))

    def spread(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    width, poisson, thickness = spread(0.2, 1.0), rng.uniform(0, 0.5), spread(0.01, 0.06)
    layer, depth = spread(0.04, 0.3), thickness * spread(0.1, 2.0)
    spring = thickness**3 / 12 / (1 - poisson**2) / layer**4
    weight = spring * depth / 2
    return Row(
        *(number, width, float(poisson), thickness, weight, weight / depth**2),
        *(LAWS[number % len(LAWS)], spread(0.003, 0.3), float(rng.uniform(-0.95, 0.95))),
        *(math.nan,) * 8,
    )


def scene(row: Row, beta: float) -> Scene:
    """The scene of a row at that curvature coupling."""
    sheet = Sheet(width=row.width, poisson=row.poisson, thickness=row.thickness)
    material = Material(row.thickness, row.poisson)
    effects: list[object] = [Membrane(material), Bending(material)]
    effects += [Gravity(row.weight), Ground(row.stiffness)]
    laws: dict[str, FrictionLaw] = {"tanh": Tanh(TANH * row.alpha), "viscous": Viscous()}
    if row.law in laws:
        weak = 1e-3 * row.alpha * row.thickness / row.weight
        effects.append(Friction(weak, law=laws[row.law]))
    along = 8 if layer(row) >= RESOLVED else 12
    cells = max(round(along * row.width), 2), along
    return Scene(sheet, SineWave(), row.alpha, beta, effects, cells=cells)


def layer(row: Row) -> float:
    """Length over which bending spreads a load on the ground, over L."""
    rigidity = row.thickness**3 / 12 / (1 - row.poisson**2)
    return float((rigidity / (2 * math.sqrt(row.stiffness * row.weight))) ** 0.25)


def tension_of(row: Row) -> float:
    """See `plate.error.tension`."""
    asked = scene(row, 0.0)
    return tension(row.alpha, asked.sheet, foundation(asked.effects))


def numbers(row: Row) -> dict[str, float]:
    """Those of `plate.error.RANGES`, of a row that is known."""
    ground = foundation(scene(row, 0.0).effects)
    return {
        "width over length": row.width,
        "Poisson ratio": row.poisson,
        "thickness over length": row.thickness,
        "edge layer over length": ground.layer,
        "depth over thickness": ground.depth / row.thickness,
        "alpha": row.alpha,
        "share of lift-off": abs(row.share),
        "tension": tension_of(row),
        "slip": row.slip,
    }


def within(row: Row) -> bool:
    """Whether the bound stands for it."""
    known = numbers(row)
    return all(low <= known[name] <= high for name, (low, high) in RANGES.items())


def bound_of(row: Row) -> float:
    """The bound, over alpha^2."""
    return bound(numbers(row), row.planar, abs(row.mixed) + abs(row.bent))


def off(row: Row) -> float:
    """What it is a bound of."""
    return abs(row.theory - row.cycle)


def measured(number: int) -> Row:
    """One row of the table."""
    begin, row = time.process_time(), drawn(number)
    form = second_order(scene(row, 0.0), rtol=RTOL).coefficients
    beta, square = row.share * form.lift_off[1], row.alpha**2
    ratio = beta / row.alpha
    planar, mixed = form.alpha_alpha.value, form.alpha_beta.value * ratio
    bent, asked = form.beta_beta.value * ratio**2, scene(row, beta)
    theory = crawl_speed(asked, order=2, rtol=RTOL)
    atol = RTOL * (abs(planar) + abs(mixed) + abs(bent)) * square
    cycle, error = _by_cycle(asked, atol)
    return replace(
        row,
        slip=slip_ratio(asked, PlateTerms.of(asked, RTOL)),
        planar=planar,
        mixed=mixed,
        bent=bent,
        theory=theory.mean / square,
        cycle=cycle / square,
        error=(error + theory.error) / square,
        seconds=time.process_time() - begin,
    )


def _by_cycle(asked: Scene, atol: float) -> tuple[float, float]:
    """V and its error; NaN where there is no cycle, as of a sheet that buckles."""
    try:
        found = cycle_speed(asked, rtol=RTOL, atol=atol)
    except (SheetcrawlError, ArithmeticError):
        return math.nan, math.nan
    return found.mean, found.error


def wanted() -> list[int]:
    """Numbers of the rows: those of sheets that do not wrinkle, whose shapes take minutes."""
    return [n for n in range(ROWS) if tension_of(drawn(n)) <= MOST_TENSION]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    Filling(TABLE, out, lambda row: row.number).fill(wanted(), measured)


if __name__ == "__main__":
    main()

"""How far the second order in (alpha, beta) of a sheet on its ground is from a cycle of its shapes.

    python -m figures.measure.plate.model_error [--out FILE]

Writes linear_theory/data/plate_error.csv, from which `linear_theory.speed.plate_error` takes its bound:
sheets, grounds, weights, laws and couplings drawn at random, each row from its number alone; 15 minutes
of one core, and it goes on where the file ends. The last HELD_OUT rows are not used for the bound: the
tests count how many of them it covers.
"""

import math
import time
from collections.abc import Sequence

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
from figures.common.records import Table
from linear_theory import FrictionLaw, Sheet, SineWave, Tanh, Viscous, crawl_speed, second_order
from linear_theory.common.errors import SheetcrawlError
from linear_theory.speed.plate_error import COMMAND, PATH, Row

TABLE = Table(PATH, Row, COMMAND, "E = L = T = 1; speeds over alpha^2 L/T, seconds of the processor", 6)

ROWS, SEED = 120, 20

RTOL = 1e-3
"""Of both speeds, relative to the sum of the sizes of the terms."""

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
        *(math.nan,) * 7,
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
    numbers = thin(row)
    along = 8 if numbers >= RESOLVED else 12
    cells = max(round(along * row.width), 2), along
    return Scene(sheet, SineWave(), row.alpha, beta, effects, cells=cells)


def thin(row: Row) -> float:
    """Length over which bending spreads a load on the ground, over L."""
    rigidity = row.thickness**3 / 12 / (1 - row.poisson**2)
    return float((rigidity / (2 * math.sqrt(row.stiffness * row.weight))) ** 0.25)


def measured(number: int) -> Row:
    """One row of the table."""
    begin, row = time.process_time(), drawn(number)
    form = second_order(scene(row, 0.0), rtol=RTOL).coefficients
    beta = row.share * form.lift_off[1]
    asked, square = scene(row, beta), row.alpha**2
    terms = form.alpha_alpha.value, form.alpha_beta.value * beta / row.alpha
    terms = (*terms, form.beta_beta.value * (beta / row.alpha) ** 2)
    theory = crawl_speed(asked, order=2, rtol=RTOL)
    size = sum(map(abs, terms))
    try:
        cycle = cycle_speed(asked, rtol=RTOL, atol=RTOL * size * square)
        found = cycle.mean, cycle.error
    except (SheetcrawlError, ArithmeticError) as problem:
        print(f"row {number}: {problem}", flush=True)
        found = math.nan, math.nan
    return Row(
        *(number, row.width, row.poisson, row.thickness, row.weight, row.stiffness),
        *(row.law, row.alpha, row.share),
        *terms,
        theory.mean / square,
        found[0] / square,
        (found[1] + theory.error) / square,
        time.process_time() - begin,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    Filling(TABLE, out, lambda row: row.number).fill(range(ROWS), measured)


if __name__ == "__main__":
    main()

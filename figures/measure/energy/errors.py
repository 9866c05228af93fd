"""Numerical errors of power and cost of transport, claimed and true, for random sheets.

    python -m figures.measure.energy.errors [--out FILE] [--count 60]

Writes figures/data/energy_error.csv, ten minutes of the processor; it goes on where the file ends. Each
case is answered twice: at a tolerance as a user may ask for, and much finer, by other means where there
are any. The levels take turns:

line            a general wave, sampled          the same as a travelling wave, exact to rounding
first order     `crawl_speed`, Airy's series     Legendre-Ritz at FINE of the tolerance
second order    `crawl_speed(order=2)`           at FINE of the tolerance
plate           the same for a sheet that bends  at FINE of the tolerance
cycle           `cycle_speed` on a few elements  three times as many each way
"""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Scene, cycle_speed
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory import (
    BeyondReachWarning,
    Coulomb,
    CrawlSpeed,
    Directional,
    Estimate,
    FieldWave,
    FrictionLaw,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    ViscousRegimeWarning,
    crawl_speed,
    line_balance,
    pulse_wave,
)
from linear_theory.friction.contact import Contact
from linear_theory.wave.protocol import Wave

FINE, FINEST = 1e-2, 1e-5
"""Tolerance of the finer answer over that of the first; not below FINEST."""

CELLS, FINER_CELLS = (2, 4), 3
"""Elements of cycles, per wave along the sheet, and how many times as many the finer answer has."""

COUNT = 60


@dataclass(frozen=True)
class Row:
    """Of one case, power in L/T, cost over mu. claimed: the error of the answer; true: its distance to
    the finer one, which is in doubt by `doubt`, the error that the finer one claims. cost: infinite
    where no distance is resolved."""

    case: int
    level: str
    wave: str
    law: str
    load: str
    width: float
    poisson: float
    alpha: float
    beta: float
    rtol: float
    power: float
    claimed: float
    true: float
    doubt: float
    cost: float
    cost_claimed: float
    cost_true: float
    cost_doubt: float


TABLE = Table(
    DATA / "energy_error.csv",
    Row,
    "python -m figures.measure.energy.errors",
    "power in L/T over mu weight, cost of transport over mu, beta in 1/L",
    5,
)


class Case(NamedTuple):
    """What is asked."""

    scene: Scene
    rtol: float
    wave: str


Answer = Callable[[Case], CrawlSpeed]


def waves(random: np.random.Generator) -> dict[str, TravellingWave]:
    """One of each kind."""
    cosine, sine = random.normal(size=(2, 3)) / np.arange(1, 4) ** 2
    return {
        "sine": SineWave(count=int(random.integers(1, 3))),
        "pulse": pulse_wave(float(random.uniform(0.2, 0.6))),
        "three harmonics": TravellingWave(cosine, sine),
    }


def laws(random: np.random.Generator, alpha: float) -> tuple[FrictionLaw, ...]:
    """The laws: slips are of the size of alpha."""
    backward = float(random.uniform(1, 3))
    return Coulomb(), Tanh(0.2 * abs(alpha)), Viscous(), Directional(1.0, backward)


def planar(random: np.random.Generator) -> Case:
    """A flat sheet, its wave, growth and contact."""
    sheet = Sheet(width=float(np.exp(random.uniform(np.log(0.1), 0))), poisson=random.uniform(0, 0.5))
    made = waves(random)
    name = str(random.choice([*made]))
    alpha = float(random.choice([-1, 1]) * np.exp(random.uniform(np.log(0.01), np.log(0.2))))
    law = laws(random, alpha)[random.integers(4)]
    contact = Contact.named(str(random.choice(["current", "grown", "material"])), law)
    scene = Scene(
        sheet,
        made[name],
        alpha,
        effects=[Membrane(Material(sheet.thickness, sheet.poisson))],
        cells=(CELLS[0], CELLS[1] * made[name].count),
        contact=contact,
    )
    return Case(scene, float(10 ** random.uniform(-3, -1)), name)


def bending(random: np.random.Generator) -> Case:
    """The same as a bilayer on the paper's ground; few elements, which the theory does not use."""
    flat, alpha = planar(random), float(random.choice([-1, 1]) * random.uniform(0.005, 0.02))
    material = Material(flat.scene.sheet.thickness, flat.scene.sheet.poisson)
    law = laws(random, alpha)[random.integers(1, 3)]  # with a derivative at rest, for a scene
    effects = [Membrane(material), Bending(material), Gravity(2.5e-4), Ground(0.5)]
    beta = float(random.uniform(-0.1, 0.1))
    effects.append(Friction(1e-3, law=law))
    scene = Scene(flat.scene.sheet, flat.scene.wave, alpha, beta, effects, cells=CELLS)
    return flat._replace(scene=scene)


def finer(rtol: float) -> float:
    """Tolerance of the finer answer."""
    return max(FINE * rtol, FINEST)


def _sampled(case: Case) -> CrawlSpeed:
    wave, period = case.scene.wave, case.scene.period
    given = FieldWave(lambda x, y, t: wave.value(x, y, t), period)
    return _on_line(case, given)


def _on_line(case: Case, wave: Wave) -> CrawlSpeed:
    asked, contact = case.scene, case.scene.contact
    law, rtol = contact.friction, case.rtol
    return line_balance(wave, asked.alpha, contact.load, law, rtol=rtol, length=1.0)


def _by_theory(order: int, share: float, method: str = "auto") -> Answer:
    def answer(case: Case) -> CrawlSpeed:
        rtol = case.rtol if share == 1 else finer(case.rtol)
        return crawl_speed(case.scene, rtol=rtol, order=order, method=method)

    return answer


def _by_finer_cycle(case: Case) -> CrawlSpeed:
    across, along = case.scene.cells or CELLS
    cells = FINER_CELLS * across, FINER_CELLS * along
    return cycle_speed(case.scene.but(cells=cells), rtol=case.rtol / 10)


LEVELS: dict[str, tuple[Callable[[np.random.Generator], Case], Answer, Answer]] = {
    "line": (planar, _sampled, lambda case: _on_line(case, case.scene.wave)),
    "first order": (planar, _by_theory(1, 1.0), _by_theory(1, FINE, "ritz")),
    "second order": (planar, _by_theory(2, 1.0), _by_theory(2, FINE)),
    "plate": (bending, _by_theory(2, 1.0), _by_theory(2, FINE)),
    "cycle": (planar, lambda case: cycle_speed(case.scene, rtol=case.rtol), _by_finer_cycle),
}
"""What each level is asked, its answer, and the finer one."""


def row(number: int) -> Row:
    """One row of the table, of a case that its number makes."""
    names = [*LEVELS]
    name = names[number % len(names)]
    make, answer, fine = LEVELS[name]
    case = make(np.random.default_rng([7, number]))
    asked, contact = case.scene, case.scene.contact
    found, exact = answer(case), fine(case)
    return Row(
        number,
        name,
        case.wave,
        contact.friction.words,
        str(contact.load),
        asked.sheet.width,
        asked.sheet.poisson,
        asked.alpha,
        asked.curvature_coupling,
        case.rtol,
        *_compared(found.power, exact.power),
        *_compared(found.cost_of_transport, exact.cost_of_transport),
    )


def _compared(found: Estimate, exact: Estimate) -> tuple[float, float, float, float]:
    return found.value, found.error, abs(found.value - exact.value), exact.error


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, count=(COUNT, "number of cases"))
    rows = TABLE.read(options.out) if options.out.exists() else []
    known = {r.case for r in rows}
    with warnings.catch_warnings():
        for kind in (BeyondReachWarning, ViscousRegimeWarning):
            warnings.simplefilter("ignore", kind)
        for number in tracked("cases", [n for n in range(options.count) if n not in known]):
            rows = sorted([*rows, row(number)], key=lambda r: r.case)
            TABLE.write(rows, options.out)


if __name__ == "__main__":
    main()

"""What a direction of friction costs: processor time over that of the same question without one.

    python -m figures.measure.directional_cost [--out FILE]

Writes figures/data/directional_cost.csv, of which docs/howto/friction_direction.md has the table: half
a minute of computing. Coefficients 0.5 forward, 1.5 backward, 1 sideways, a sine, alpha = 0.1, the 2:1
sheet of the paper. Each question is asked TIMES times, and the fastest one counts.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from fem_check import Friction, Gravity, Material, Membrane, Scene, cycle_speed, simulate
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory import (
    Coulomb,
    Directional,
    Sheet,
    SineWave,
    Tanh,
    Viscous,
    crawl_speed,
    line_balance,
)
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.law import FrictionLaw

ALPHA, TIMES = 0.1, 3

LAWS: dict[str, Isotropic] = {"dry": Coulomb(), "tanh": Tanh(2e-3), "viscous": Viscous()}


@dataclass(frozen=True)
class Row:
    """question, law: what was asked. rtol: to which tolerance, 0 for equal steps. plain: seconds
    without a direction; cost: those with one over that."""

    question: str
    law: str
    rtol: float
    plain: float
    cost: float


TABLE = Table(
    DATA / "directional_cost.csv",
    Row,
    "python -m figures.measure.directional_cost",
    "processor seconds without a direction of friction, and the ratio of those with one to them",
    3,
)


def on_line(law: FrictionLaw, rtol: float) -> object:
    """The body on a line."""
    return line_balance(SineWave(), ALPHA, friction=law, rtol=rtol)


def first(law: FrictionLaw, rtol: float) -> object:
    """The theory of the paper."""
    return crawl_speed(Sheet(), SineWave(), ALPHA, friction=law, rtol=rtol)


def second(law: FrictionLaw, rtol: float) -> object:
    """Theory to second order."""
    return crawl_speed(Sheet(), SineWave(), ALPHA, friction=law, rtol=rtol, order=2)


def scene(law: FrictionLaw) -> Scene:
    """A flat sheet for cycles and steps."""
    stretching, weight = Membrane(Material(0.03, 0.5)), Gravity(3e-6, load="current")
    return Scene(
        Sheet(), SineWave(), ALPHA, effects=[stretching, weight, Friction(1.0, law=law)], cells=(2, 4)
    )


def cycle(law: FrictionLaw, rtol: float) -> object:
    """A cycle of shapes."""
    return cycle_speed(scene(law), rtol=rtol)


def stepped(law: FrictionLaw, rtol: float) -> object:
    """Steps in time."""
    return simulate(scene(law), periods=1, steps=48)


Ask = Callable[[FrictionLaw, float], Any]

QUESTIONS: dict[str, tuple[Ask, tuple[str, ...], tuple[float, ...]]] = {
    "body on a line": (on_line, tuple(LAWS), (1e-2,)),
    "2:1 sheet": (first, tuple(LAWS), (1e-2, 1e-3, 1e-4)),
    "2:1 sheet, order=2": (second, tuple(LAWS), (1e-2,)),
    "cycle": (cycle, ("tanh",), (1e-2,)),
    "stepped shell": (stepped, ("tanh",), (0.0,)),
}


def seconds(ask: Ask, law: FrictionLaw, rtol: float) -> float:
    """The least of several times."""
    found = []
    for _ in range(TIMES):
        start = time.process_time()
        ask(law, rtol)
        found.append(time.process_time() - start)
    return min(found)


def row(question: str, law: str, rtol: float) -> Row:
    """One question with and without a direction."""
    ask, form = QUESTIONS[question][0], LAWS[law]
    plain = seconds(ask, form, rtol)
    directed = seconds(ask, Directional(0.5, 1.5, 1.0, form=form), rtol)
    return Row(question, law, rtol, plain, directed / plain)


def compute() -> list[Row]:
    """All rows of the table, saying how far it is."""
    chosen = [
        (q, law, rtol) for q, (_, laws, rtols) in QUESTIONS.items() for law in laws for rtol in rtols
    ]
    return [row(*one) for one in tracked("cost of a direction", chosen)]


def page(rows: Sequence[Row]) -> list[str]:
    """The rows of the table of the page."""
    told: dict[tuple[str, str], list[Row]] = {}
    for one in rows:
        told.setdefault((one.question, one.law), []).append(one)
    lines = []
    for (question, law), found in told.items():
        rtols = ", ".join(f"{one.rtol:.0e}".replace("e-0", "e-") for one in found if one.rtol)
        asked = f"{question}, {law}{rtols and f', rtol {rtols}'}"
        lines.append(f"| {asked} | {', '.join(f'{one.cost:.1f}' for one in found)} |")
    return lines


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments)
    found = compute()
    TABLE.write(found, options.out)
    print("\n".join(page(found)))


if __name__ == "__main__":
    main()

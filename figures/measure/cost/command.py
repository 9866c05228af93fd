"""What accuracy costs in time: work-precision diagrams of all levels, and the price of each effect.

    python -m figures.measure.cost [--quick] [--panels abcge]      (or `make cost`: one thread)
    python -m figures.measure.cost --draw                          the picture alone, from the tables

Four minutes on a quiet machine, seconds with --quick. Writes measured numbers into figures/data (they
differ from run to run; the committed ones are those that are quoted) and the picture into figures/out:

    cost.csv          every point: panel, level, knob, its value, errors (true and claimed), seconds
    cost_orders.csv   powers: of the error and of the time, by the knob; plateaus
    cost_effects.csv  scene by scene what was built, evaluated and spent
    cost.png, .pdf    error against time: (a) displacement, (b) small-strain and (c) nonlinear speed

Errors are against converged references by another method, made here. They do not depend on the
machine; times do.
"""

import argparse
import math
import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from figures.common import style
from figures.common.folders import DATA
from figures.common.output import Progress
from figures.draw import cost as cost_draw
from figures.measure.cost import effects as cost_effects
from figures.measure.cost import growth as cost_growth
from figures.measure.cost.cases import Case, chosen, measured
from figures.measure.cost.effects import EffectRow
from figures.measure.cost.fields import Fields
from figures.measure.cost.speeds import LinearSpeeds, NonlinearSpeeds
from figures.measure.cost.tables import Order, Point, orders, read, write
from figures.measure.meters import import_seconds, machine, peak_memory

PATIENCE, QUICK_PATIENCE = 0.4, 0.02
"""Seconds for the repeats of one measurement, of which there are at least three."""

QUICK_LINEAR_RTOL, QUICK_CELLS, QUICK_RTOL = 1e-4, (4, 8), 1e-3
"""References of the short run: enough to see that everything works."""

MEMORY = "from linear_theory import *; crawl_speed(Sheet(), SineWave(), 0.25, rtol=1e-6)"
"""Whose peak memory is told: the most that linear theory is asked for here."""

REFERENCE = "references"
"""Level of the rows that tell by how much the references of a panel differ."""


def measure(quick: bool, panels: Sequence[str]) -> list[Point]:
    """All points of these keys of SOURCES, references first."""
    patience = QUICK_PATIENCE if quick else PATIENCE
    points: list[Point] = []
    cases: list[Case] = []
    for panel in panels:
        made, doubt = SOURCES[panel](quick)
        cases += chosen(made, quick)
        if not math.isnan(doubt):
            points.append(_reference(cases[-1].panel, doubt))
    with Progress("cost", max(len(cases), 1)) as progress:
        for case in cases:
            points.append(measured(case, patience))
            progress.advance()
    return points


def _fields(_: bool) -> tuple[Iterable[Case], float]:
    fields = Fields()
    return fields.cases(), fields.disagreement()


def _linear(quick: bool) -> tuple[Iterable[Case], float]:
    speeds = LinearSpeeds(QUICK_LINEAR_RTOL) if quick else LinearSpeeds()
    return speeds.cases(), speeds.disagreement()


def _nonlinear(quick: bool) -> tuple[Iterable[Case], float]:
    speeds = NonlinearSpeeds(QUICK_CELLS, QUICK_RTOL) if quick else NonlinearSpeeds()
    return speeds.cases(), speeds.disagreement()


def _growth(_: bool) -> tuple[Iterable[Case], float]:
    return cost_growth.cases(), math.nan


SOURCES: dict[str, Callable[[bool], tuple[Iterable[Case], float]]] = {
    "a": _fields,
    "b": _linear,
    "c": _nonlinear,
    "g": _growth,
}


PANELS = "abcge"
"""Letters of all parts: the panels of the figure, growth and effects."""


def _reference(panel: str, doubt: float) -> Point:
    """The difference of the references as a row of the table; it has no time."""
    nan = math.nan
    return Point(panel, REFERENCE, "none", nan, doubt, nan, nan, 0, nan, nan, nan)


def print_points(points: Sequence[Point]) -> None:
    """As a table."""
    print(
        f"\n{'panel':<16}{'level':<21}{'knob':<13}{'value':>9}{'error':>9}{'claimed':>9}"
        f"{'model':>9}{'ms':>11}{'least':>11}{'most':>11}"
    )
    for p in points:
        times = "".join(f"{1e3 * s:11.3f}" for s in (p.seconds, p.fastest, p.slowest))
        errors = "".join(f"{e:9.1e}" for e in (p.error, p.claimed, p.model_claimed))
        print(f"{p.panel:<16}{p.level:<21}{p.knob:<13}{p.value:>9g}{errors}{times}")


def print_orders(found: Sequence[Order]) -> None:
    """As a table."""
    print("\nerror ~ work^-order while it falls, then the plateau; time ~ work^exponent at the end;")
    print("error ~ time^-efficiency. Work is the knob's value, or its inverse for tolerances")
    print(
        f"{'panel':<16}{'level':<21}{'knob':<13}{'from':>8}{'to':>9}{'points':>7}{'order':>7}"
        f"{'plateau':>9}{'exponent':>9}{'efficiency':>11}"
    )
    for o in found:
        print(
            f"{o.panel:<16}{o.level:<21}{o.knob:<13}{o.first:>8g}{o.last:>9g}{o.points:>7}"
            f"{o.error_order:7.1f}{o.plateau:9.1e}{o.time_exponent:9.2f}{o.efficiency:11.1f}"
        )


def print_effects(rows: Sequence[EffectRow]) -> None:
    """As a table."""
    print(
        f"\nEffects: sheet of {cost_effects.CELLS[0]} x {cost_effects.CELLS[1]} elements; per step: "
        "iterations, gradients, Hessians, factors"
    )
    print(
        f"{'scene':<22}{'unknowns':>9}{'deriv.':>7}{'iter.':>7}{'grad.':>7}{'Hess.':>7}{'fact.':>7}"
        f"{'MB':>7}{'ms/grad.':>9}{'ms/Hess.':>9}{'ms/step':>9}{'ratio':>8}"
    )
    for r in rows:
        counts = "".join(f"{c:7.1f}" for c in (r.iterations, r.gradients, r.hessians, r.factors))
        times = "".join(
            f"{1e3 * s:9.3f}" for s in (r.gradient_seconds, r.hessian_seconds, r.step_seconds)
        )
        print(
            f"{r.scene:<22}{r.unknowns:>9}{r.derivative:>7}{counts}{r.memory_mb:7.2f}{times}"
            f"{r.ratio:8.2g}"
        )


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure, print, write the tables and draw."""
    options = parsed(arguments)
    points = read((options.data or DATA) / "cost.csv", Point) if options.draw else record(options)
    if points:
        figure = cost_draw.draw(points)
        print(*style.save(figure, "cost", options.out, tuple(options.formats)), sep="\n")


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Options of the command."""
    parser = argparse.ArgumentParser(prog="figures.measure.cost", description=__doc__.splitlines()[0])
    parser.add_argument("--draw", action="store_true", help="only draw what was measured before")
    parser.add_argument("--quick", action="store_true", help="few points, coarse references")
    parser.add_argument("--panels", default=PANELS, help="some of a, b, c, g (growth), e (effects)")
    parser.add_argument("--out", type=Path, help="folder of the figure (figures/out)")
    parser.add_argument("--data", type=Path, help="folder of the tables (figures/data if complete)")
    parser.add_argument("--formats", nargs="+", choices=list(style.METADATA), default=["png", "pdf"])
    options = parser.parse_args(arguments)
    if not set(options.panels) <= set(PANELS):
        parser.error(f"--panels {options.panels}: must be some of {PANELS}")
    return options


def record(options: argparse.Namespace) -> Sequence[Point]:
    """Measure, print and write the tables; points of the figure."""
    complete = not options.quick and set(options.panels) == set(PANELS)
    folder = options.data or (DATA if complete else style.OUTPUT_DIR)
    words = f"processor seconds, {machine()}"
    print(words)
    if os.environ.get("OMP_NUM_THREADS") != "1":
        print("OMP_NUM_THREADS is not 1: times are those of all threads together")
    tables = measured_tables(options.quick, options.panels)
    print(*(write(rows, folder / f"{name}.csv", words) for name, rows in tables.items() if rows))
    return tables["cost"]


def measured_tables(quick: bool, panels: str) -> dict[str, Sequence[Any]]:
    """Rows by name of the table; they are printed too."""
    points = measure(quick, [panel for panel in panels if panel in SOURCES])
    found, effects = orders(points), []
    if points:
        print_points(points)
        print_orders(found)
    if "e" in panels:
        effects = cost_effects.rows(quick, QUICK_PATIENCE if quick else PATIENCE)
        print_effects(effects)
        print_process()
    return {"cost": points, "cost_orders": found, "cost_effects": effects}


def print_process() -> None:
    """Import time and peak memory, each in a process of its own."""
    seconds, memory = import_seconds("linear_theory"), peak_memory(MEMORY)
    print(f"\nimport linear_theory: {seconds:.2f} s; crawl_speed at rtol 1e-6 takes {memory:.0f} MB")


if __name__ == "__main__":
    main()

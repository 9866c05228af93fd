"""What accuracy costs in time, at all levels, and the price of each effect.

    python -m figures.measure.cost [--quick] [--panels abcge] [--data FOLDER]

Four minutes on a quiet machine, seconds with --quick. `make cost` runs it with one thread and draws
the picture too (`figures.draw.cost`). Writes measured numbers into figures/data (they differ from run
to run; the committed ones are those that are quoted), or into figures/out where a part is left out:

    cost.csv          every point: panel, level, knob, its value, errors (true and claimed), seconds
    cost_orders.csv   powers: of the error and of the time, by the knob; plateaus
    cost_effects.csv  scene by scene what was built, evaluated and spent

Errors are against converged references by another method, made here. They do not depend on the
machine; times do.
"""

import argparse
import math
import os
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from figures.common.command import parser
from figures.common.folders import DATA, OUT
from figures.common.output import tracked
from figures.measure.cost import effects, growth
from figures.measure.cost.cases import Case, chosen, measured
from figures.measure.cost.fields import Fields
from figures.measure.cost.printed import print_effects, print_orders, print_points, print_process
from figures.measure.cost.speeds import LinearSpeeds, NonlinearSpeeds
from figures.measure.cost.tables import COMMAND, REFERENCE, Point, orders, write
from figures.measure.meters import machine

PATIENCE, QUICK_PATIENCE = 0.4, 0.02
"""Seconds for the repeats of one measurement, of which there are at least three."""

QUICK_LINEAR_RTOL, QUICK_CELLS, QUICK_RTOL = 1e-4, (4, 8), 1e-3
"""References of the short run: enough to see that everything works."""


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
    return points + [measured(case, patience) for case in tracked("cost", cases)]


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
    return growth.cases(), math.nan


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


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure, print and write the tables."""
    options = parsed(arguments)
    complete = not options.quick and set(options.panels) == set(PANELS)
    folder = options.data or (DATA if complete else OUT)
    words = f"processor seconds, {machine()}"
    print(words)
    if os.environ.get("OMP_NUM_THREADS") != "1":
        print("OMP_NUM_THREADS is not 1: times are those of all threads together")
    tables = measured_tables(options.quick, options.panels)
    print(*(write(rows, folder / f"{name}.csv", words) for name, rows in tables.items() if rows))


def parsed(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Options of the command."""
    made = parser(
        COMMAND,
        __doc__,
        quick=(False, "few points, coarse references"),
        panels=(PANELS, "some of a, b, c, g (growth), e (effects)"),
    )
    made.add_argument("--data", type=Path, help="folder of the tables (figures/data if complete)")
    options = made.parse_args(arguments)
    if not set(options.panels) <= set(PANELS):
        made.error(f"--panels {options.panels}: must be some of {PANELS}")
    return options


def measured_tables(quick: bool, panels: str) -> dict[str, Sequence[Any]]:
    """Rows by name of the table; they are printed too."""
    points = measure(quick, [panel for panel in panels if panel in SOURCES])
    found, prices = orders(points), list[effects.EffectRow]()
    if points:
        print_points(points)
        print_orders(found)
    if "e" in panels:
        prices = effects.rows(quick, QUICK_PATIENCE if quick else PATIENCE)
        print_effects(prices)
        print_process()
    return {"cost": points, "cost_orders": found, "cost_effects": prices}

"""What is timed: a level of the theory at one setting, and how its error is judged."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

from fem_check.plane_stress.field import PlaneStressField, plane_stress_field
from figures.measure.cost.tables import Point
from figures.measure.meters import timed
from linear_theory import Sheet, SineWave

SHEET, WAVE = Sheet(), SineWave()
"""The paper's sheet and wave: 2 : 1, nu = 1/2, h = 0.03 L, one wave on the sheet."""

LINE = "1D, closed form"
BAR = "1D, finite strain"
STRIP = "narrow strip"
PLAIN = "Airy, plain"
TAIL = "Airy, with tail"
RITZ = "Ritz"
P2, P4 = "FEM P2", "FEM P4"
SECOND = "second order"
CYCLE = "cycle of shapes"
STEPPER = "stepper"
AUTO = "predict"


class Judged(NamedTuple):
    """Relative errors of a result: true, claimed of the numbers, claimed of the model."""

    error: float
    claimed: float = math.nan
    model_claimed: float = math.nan


def elements(level: str, n: int) -> Callable[[], PlaneStressField]:
    """The field of finite elements P2 or P4, triangles of longest side L/n."""
    return partial(plane_stress_field, SHEET, WAVE, degree=int(level[-1]), size=SHEET.length / n)


UNJUDGED = Judged(math.nan)
"""Of what is only timed."""


@dataclass(frozen=True)
class Case:
    """One point of a work-precision diagram: what is solved and how the result is judged.

    panel, level, knob, value: as in `Point`; quick: whether it is part of the short run.
    """

    panel: str
    level: str
    knob: str
    value: float
    solve: Callable[[], Any]
    judge: Callable[[Any], Judged] = lambda _: UNJUDGED
    quick: bool = True


def measured(case: Case, patience: float) -> Point:
    """The case, solved and timed until the patience in seconds ends."""
    timing = timed(case.solve, patience)
    return Point(
        case.panel,
        case.level,
        case.knob,
        float(case.value),
        *case.judge(timing.result),
        timing.repeats,
        timing.median,
        timing.fastest,
        timing.slowest,
    )


def chosen(cases: Iterable[Case], quick: bool) -> list[Case]:
    """All of them, or those of the short run."""
    return [case for case in cases if case.quick or not quick]

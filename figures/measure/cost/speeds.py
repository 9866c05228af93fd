"""Panels (b) and (c): mean speeds of the paper's sheet, dry friction, weight per current area.

(b) is the small-strain balance (eqs 10 and 11): series and finite elements differ in the field, and
each is judged by a speed from the other's. (c) is the nonlinear sheet in the plane (exponential growth,
energy per grown area): the reference is its cycle of shapes on a fine mesh of another element (bicubic,
smooth), and the levels that are no nonlinear sheet end on a plateau, their model's error.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from fem_check.choice.levels import strip as strip_level
from fem_check.choice.prediction import predict
from fem_check.choice.result import Prediction
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.stepping.simulation import simulate
from figures.common.scenes import membrane, sliding_scene, smooth_scene
from figures.measure.cost.cases import (
    AUTO,
    BAR,
    CYCLE,
    LINE,
    P2,
    P4,
    PLAIN,
    RITZ,
    SECOND,
    SHEET,
    STEPPER,
    STRIP,
    TAIL,
    WAVE,
    Case,
    Judged,
    elements,
)
from linear_theory import (
    airy_series,
    crawl_speed,
    field_speed,
    line_balance,
    line_cycle_speed,
    line_speed,
)
from linear_theory.common.tolerance import Tolerance
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed

LINEAR, NONLINEAR = "linear speed", "nonlinear speed"
"""Names of the panels."""

LINEAR_ALPHA, NONLINEAR_ALPHA = 0.1, 0.25
"""Growth couplings of panels (b) and (c)."""

REFERENCE_RTOL = 1e-6
"""Of the speeds from the field of another method that judge panel (b)."""

TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)

PLAIN_MODES = ((5, 1e-2), (10, 1e-2), (20, 1e-3), (40, 1e-3))
CELLS = {P2: ((4, 1e-2), (8, 1e-2), (16, 1e-2)), P4: ((2, 1e-2), (4, 1e-3), (8, 1e-4))}
"""Modes, or L over the size of the triangles, and the tolerance of a balance that does not spoil the
field."""

FINE, FINE_RTOL = (12, 24), 2e-5
"""Elements and tolerance of the reference of panel (c)."""

PREDICTED = (0.5, 0.2, 0.1, 1e-2, 1e-3, 1e-4)
"""Tolerances of numbers and model together, for which `predict` chooses the level."""

CYCLE_CELLS, CYCLE_RTOL = ((1, 2), (2, 4), (4, 8)), 1e-4
"""Of degree 5, their numbers, and the tolerance at which the mesh is what is seen."""

STEPS, SLIP, STEPPED_CELLS = 128, 1e-3, (2, 4)
"""Steps per period, slip speed (L/T) and elements around which each is varied apart."""

VARIED_STEPS = (16, 32, 64, 128, 256)
VARIED_SLIPS = (0.3, 0.1, 0.03, 0.01)
VARIED_CELLS = ((1, 2), (2, 4), (4, 8))


class LinearSpeeds:
    """Panel (b): ways to the speed of the small-strain balance."""

    def __init__(self, rtol: float = REFERENCE_RTOL) -> None:
        speed = partial(crawl_speed, SHEET, WAVE, LINEAR_ALPHA, rtol=rtol)
        self.exact = {RITZ: speed(method="ritz").mean, TAIL: speed(method="airy").mean}

    def disagreement(self) -> float:
        """Of the two references: below it, errors mean nothing."""
        return abs(self.exact[TAIL] / self.exact[RITZ] - 1)

    def cases(self) -> Iterator[Case]:
        """All that is compared."""
        strip = partial(line_balance, WAVE, LINEAR_ALPHA, body="strip")
        yield self._case(LINE, "points", 1, partial(line_speed, LINEAR_ALPHA), RITZ)
        yield self._case(STRIP, "points", 1, strip, RITZ)
        for modes, rtol in PLAIN_MODES:
            field = partial(airy_series, SHEET, WAVE, modes=modes, tail=False)
            solve = partial(balanced, field, rtol)
            yield self._case(PLAIN, "modes", modes, solve, RITZ, quick=modes < 40)
        for rtol in TOLERANCES:
            for level, method, reference in ((TAIL, "airy", RITZ), (RITZ, "ritz", TAIL)):
                solve = partial(crawl_speed, SHEET, WAVE, LINEAR_ALPHA, rtol=rtol, method=method)
                yield self._case(level, "rtol", rtol, solve, reference, quick=rtol > 1e-4)
        for level, settings in CELLS.items():
            for n, rtol in settings:
                solve = partial(balanced, elements(level, n), rtol)
                yield self._case(level, "L/size", n, solve, TAIL, quick=n <= 4)

    def _case(
        self,
        level: str,
        knob: str,
        value: float,
        solve: Callable[[], Any],
        reference: str,
        quick: bool = True,
    ) -> Case:
        judge = partial(judged, exact=self.exact[reference])
        return Case(LINEAR, level, knob, value, solve, judge, quick)


def balanced(field: Callable[[], Any], rtol: float) -> CrawlSpeed:
    """Speed of the small-strain balance from the field that is returned."""
    return field_speed(field(), LINEAR_ALPHA, rtol=rtol)


class NonlinearSpeeds:
    """Panel (c): ways to the speed of the nonlinear sheet."""

    def __init__(self, cells: tuple[int, int] = FINE, rtol: float = FINE_RTOL) -> None:
        scene = smooth_scene(SHEET, WAVE, NONLINEAR_ALPHA, cells)
        self.exact = cycle_speed(scene, rtol=rtol)

    def disagreement(self) -> float:
        """What the reference claims of its own error, there being no better one."""
        return self.exact.error / abs(self.exact.mean)

    def cases(self) -> Iterator[Case]:
        """All that is compared."""
        yield self._case(LINE, "points", 1, partial(line_speed, NONLINEAR_ALPHA))
        yield self._case(BAR, "points", 1, partial(line_cycle_speed, NONLINEAR_ALPHA, "exp"))
        scene = Scene(SHEET, WAVE, NONLINEAR_ALPHA)
        strip = partial(strip_level, scene, Tolerance(1e-4, 1e-9))
        yield self._case(STRIP, "points", 1, strip)
        for level, options in (
            (TAIL, {"method": "airy"}),
            (RITZ, {"method": "ritz"}),
            (SECOND, {"order": 2}),
        ):
            for rtol in TOLERANCES[:4]:
                solve = partial(crawl_speed, SHEET, WAVE, NONLINEAR_ALPHA, rtol=rtol, **options)
                yield self._case(level, "rtol", rtol, solve, quick=rtol > 1e-3)
        for rtol in TOLERANCES[:4]:
            solve = partial(cycle_speed, planar(), rtol=rtol)
            yield self._case(CYCLE, "rtol", rtol, solve, quick=rtol > 1e-3)
        for cells in CYCLE_CELLS:
            solve = partial(cycle_speed, planar(cells), rtol=CYCLE_RTOL)
            yield self._case(CYCLE, "cells across", cells[0], solve, quick=cells[0] < 2)
        for rtol in PREDICTED:
            auto = partial(predict, SHEET, WAVE, NONLINEAR_ALPHA, rtol=rtol)
            yield self._case(AUTO, "rtol", rtol, auto, quick=rtol > 1e-2)
        yield from self._steppers()

    def _steppers(self) -> Iterator[Case]:
        """Time step, mesh and slip speed, each apart; of the mesh the stepper claims nothing."""
        for n in VARIED_STEPS:
            yield self._case(STEPPER, "steps", n, partial(stepped, steps=n), quick=n < 64)
        for cells in VARIED_CELLS:
            case = self._case(STEPPER, "cells across", cells[0], partial(stepped, cells=cells), False)
            yield replace(case, judge=partial(unclaimed, case.judge))
        for slip in VARIED_SLIPS:
            yield self._case(STEPPER, "slip speed", slip, partial(stepped, slip=slip), quick=False)

    def _case(
        self, level: str, knob: str, value: float, solve: Callable[[], Any], quick: bool = True
    ) -> Case:
        judge = partial(judged, exact=self.exact.mean)
        return Case(NONLINEAR, level, knob, value, solve, judge, quick)


def unclaimed(judge: Callable[[Any], Judged], found: Any) -> Judged:
    """What `judge` says but for the claim."""
    return judge(found)._replace(claimed=np.nan)


def planar(cells: tuple[int, int] = STEPPED_CELLS) -> Scene:
    """The nonlinear sheet in the plane with nothing but its membrane, elements of degree 5."""
    return Scene(SHEET, WAVE, NONLINEAR_ALPHA, effects=(membrane(SHEET),), cells=cells)


def stepped(
    steps: int = STEPS, cells: tuple[int, int] = STEPPED_CELLS, slip: float = SLIP
) -> CrawlSpeed:
    """Its speed by stepping through a ramp of half a period and one period."""
    scene = sliding_scene(SHEET, WAVE, NONLINEAR_ALPHA, slip, cells)
    return simulate(scene, periods=1, steps=steps).speed


def judged(found: Any, exact: float) -> Judged:
    """Relative errors of a speed: a number, a `CrawlSpeed` or a `Prediction` of one."""
    if isinstance(found, Prediction):
        found = found.speed
    if not isinstance(found, CrawlSpeed):
        return Judged(abs(float(found) / exact - 1))
    claims = np.array([found.error, found.model_error]) / abs(exact)
    return Judged(abs(found.mean / exact - 1), *claims.tolist())

"""The levels that answer the question, from cheap to general, each a function of the same question.

    strip         closed balance of a narrow isotropic strip, finite strain      microseconds to ms
    first order   small strain (eqs 10, 11), series or Ritz                      tens of ms
    second order  V_1 alpha + V_2 alpha^2 of the nonlinear sheet                 tenths of a second
    cycle         the nonlinear sheet itself, statics and friction balance       tenths of a second on

The target of all is the planar nonlinear sheet of the stated growth law, area measure and load, so
stiff that friction does not change its shape. The last level is that sheet; how far the others are from
it is known where it was measured (`linear_theory.speed.model_error`).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.scene.material import Material
from fem_check.shell.scene.scene import Scene, default_cells
from linear_theory.common import validation
from linear_theory.common.progress import part_of
from linear_theory.common.shown import Shown
from linear_theory.deformation.field import Wave
from linear_theory.deformation.ritz import ritz_field
from linear_theory.deformation.second.field import AREAS, GROWTH_LAWS
from linear_theory.friction.law import LOADS, FrictionLaw
from linear_theory.line import line_balance
from linear_theory.scene import arguments
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.crawl import SHOWN_RTOL, crawl_speed
from linear_theory.speed.drawn import LinearDeformation
from linear_theory.speed.model_error import model_error
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.survey import WaveSurvey

MESHES = (1, 2, 4)
"""Factors of the default cells that the nonlinear sheet is tried with, coarse to fine."""

HELPED = 0.5
"""Share of the error that a finer mesh leaves at most where the mesh is what makes it: order 2 and more
leave a quarter. Else a wave too rough in time does, and four times the work would be in vain."""


@dataclass(frozen=True)
class Question(Shown):
    """A sheet, its wave and what is assumed; arguments as in `crawl_speed`.

    Raises ValueError for names that do not exist and numbers out of range.
    """

    sheet: Sheet
    wave: Wave
    alpha: float
    growth_law: str = "exp"
    area: str = "grown"
    load: str = "current"
    friction: str = "coulomb"
    slip_speed: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "sheet", arguments.sheet(self.sheet))
        object.__setattr__(self, "wave", arguments.wave(self.wave))
        object.__setattr__(self, "alpha", validation.real("alpha", self.alpha))
        validation.choice("growth_law", self.growth_law, GROWTH_LAWS)
        validation.choice("area", self.area, AREAS)
        validation.choice("load", self.load, LOADS)
        FrictionLaw(self.friction, self.slip_speed)

    @property
    def unit(self) -> float:
        """Of speeds, length per period."""
        return self.sheet.length / self.wave.period


Level = Callable[[Question, float, float], CrawlSpeed]
"""Answers a question to a relative and an absolute tolerance."""


def strip(question: Question, rtol: float, atol: float) -> CrawlSpeed:
    """The narrow strip, as long as the sheet; ValueError for a wave that depends on x."""
    q = question
    if WaveSurvey.on_sheet(q.wave, q.sheet).depends_on_x:
        raise ValueError("method = 'strip': cannot represent a wave that depends on x, 'cycle' can")
    found = line_balance(
        q.wave,
        q.alpha,
        q.load,
        q.friction,
        q.slip_speed,
        rtol,
        atol,
        q.growth_law,
        "strip",
        length=q.sheet.length,
    )
    return replace(found, model_error=distance("strip", q), deformation=shape(q))


def shape(question: Question) -> LinearDeformation:
    """The sheet of the question as linear theory deforms it: a picture for a level that has none."""
    q = question
    field = partial(ritz_field, q.sheet, q.wave, rtol=SHOWN_RTOL)
    return LinearDeformation(field, q.alpha, q.load, FrictionLaw(q.friction, q.slip_speed))


def first_order(question: Question, rtol: float, atol: float) -> CrawlSpeed:
    """Small strain; its target's growth law and area measure do not enter."""
    return _theory(question, rtol, atol, 1)


def second_order(question: Question, rtol: float, atol: float) -> CrawlSpeed:
    """The expansion of the target to second order in alpha."""
    return _theory(question, rtol, atol, 2)


def cycle(question: Question, rtol: float, atol: float) -> CrawlSpeed:
    """The target, on finer meshes as long as the tolerance is not met and they help."""
    seconds, before = 0.0, math.inf
    for factor in MESHES:
        sheet = scene(question, factor)
        with part_of("{} x {} elements".format(*sheet.cells or ())):
            found = cycle_speed(
                sheet, question.load, question.friction, question.slip_speed, rtol, atol
            )
        seconds += found.seconds
        if found.converged or found.error > HELPED * before:
            break
        before = found.error
    return replace(found, seconds=seconds)


def scene(question: Question, factor: int = 1) -> Scene:
    """The planar sheet of the question with `factor` times the default cells each way."""
    q = question
    across, along = default_cells(q.sheet, q.wave, planar=True)
    return Scene(
        q.sheet,
        q.wave,
        q.alpha,
        effects=(Membrane(Material(q.sheet.thickness, q.sheet.poisson)),),
        growth_law=q.growth_law,
        area=q.area,
        cells=(factor * across, factor * along),
    )


def _theory(question: Question, rtol: float, atol: float, order: int) -> CrawlSpeed:
    q = question
    return crawl_speed(
        q.sheet,
        q.wave,
        q.alpha,
        q.load,
        q.friction,
        q.slip_speed,
        rtol,
        atol,
        order=order,
        growth_law=q.growth_law,
        area=q.area,
    )


LEVELS: dict[str, Level] = {
    "strip": strip,
    "first order": first_order,
    "second order": second_order,
    "cycle": cycle,
}
"""By name, cheapest first; the last one is the target."""

TARGET = "cycle"
"""The level that is the target."""

TARGET_EFFECTS = (Membrane,)
"""Classes of the effects that the target knows: see `abilities.left_out` for those that it does not."""


def distance(level: str, question: Question) -> float:
    """Between that level and the target, absolute, as far as it was measured; else NaN."""
    q = question
    if level == TARGET:
        return 0.0
    return model_error(level, q.sheet, q.wave, q.alpha, q.growth_law, q.area, q.load, q.friction)

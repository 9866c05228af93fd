"""The levels that answer the question, from cheap to general, each a function of the same scene.

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
from dataclasses import replace
from functools import partial

from fem_check.mesh.elements import default_cells
from fem_check.shell.cycle.speed import Cycle
from fem_check.shell.effects.koiter import Membrane
from linear_theory.common.progress import part_of
from linear_theory.common.tolerance import Tolerance
from linear_theory.line.balance import line_crawl
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import drawn_deformation, theory_speed
from linear_theory.speed.model_error import model_error
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.wave_error import with_wave_error

MESHES = (1, 2, 4)
"""Factors of the default cells that the nonlinear sheet is tried with, coarse to fine."""

HELPED = 0.5
"""Share of the error that a finer mesh leaves at most where the mesh is what makes it: order 2 and more
leave a quarter. Else a wave too rough in time does, and four times the work would be in vain."""


Level = Callable[[Scene, Tolerance], CrawlSpeed]
"""Answers for a planar scene to a tolerance."""


def strip(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """The narrow strip, as long as the sheet; ValueError for a wave that depends on x."""
    if scene.drive.depends_on_x:
        raise ValueError("method = 'strip': cannot represent a wave that depends on x, 'cycle' can")
    found, distance = line_crawl(scene, tolerance, "strip"), model_error("strip", scene)
    return replace(found, model_error=distance, deformation=drawn_deformation(scene))


def first_order(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """Small strain; the target's growth law and energy area do not enter."""
    return theory_speed(scene, tolerance, order=1)


def second_order(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """The expansion of the target to second order in alpha."""
    return theory_speed(scene, tolerance, order=2)


def cycle(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """The target, on finer meshes as long as the tolerance is not met and they help."""
    return with_wave_error(scene, tolerance, partial(_numbers_of_cycle, scene))


def _numbers_of_cycle(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    seconds, before = 0.0, math.inf
    for factor in MESHES:
        fine = finer(scene, factor)
        with part_of("{} x {} elements".format(*fine.cells or ())):
            found = Cycle(fine).speed(tolerance)
        seconds += found.seconds
        if found.converged or found.error > HELPED * before:
            break
        before = found.error
    return replace(found, seconds=seconds)


def finer(scene: Scene, factor: int) -> Scene:
    """A planar scene with `factor` times its cells each way."""
    across, along = scene.cells or default_cells(scene.drive, planar=True)
    return scene.but(cells=(factor * across, factor * along))


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


def distance(level: str, scene: Scene) -> float:
    """Between that level and the target, absolute, as far as it was measured; else NaN."""
    return 0.0 if level == TARGET else model_error(level, scene)

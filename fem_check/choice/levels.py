"""The levels of theory, from cheap to general, each a function of the same scene.

    strip         closed-form balance of a narrow isotropic strip, finite strain microseconds to ms
    first order   small strain (eqs 10, 11), series or Ritz                      tens of ms
    second order  V_1 alpha + V_2 alpha^2 of the nonlinear sheet                 tenths of a second
    cycle         the nonlinear sheet itself, statics and friction balance       tenths of a second up

Aside of them stands `line`, another body: one-dimensional, with its weight per length (eqs 5 to 7).

The target is the planar nonlinear sheet with the stated growth law, area measure and load, so stiff
that friction does not change its shape. The last level is that sheet; the distance of the others to it
is known where it was measured (`linear_theory.speed.model_error`).
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from fem_check.shell.effects.koiter import Membrane
from linear_theory.common.progress import part_of
from linear_theory.common.tolerance import Tolerance
from linear_theory.line.balance import line_crawl
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import drawn_deformation, theory_speed
from linear_theory.speed.model_error import model_error
from linear_theory.speed.power_error import with_power_error
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.wave_error import with_wave_error

MESHES = (1, 2, 4)
"""Refinement factors of the default cells tried for the nonlinear sheet, coarse to fine."""

HELPED = 0.5
"""A finer mesh must reduce the error at least to this fraction, else the mesh is not what limits it:
convergence of order 2 leaves a quarter. A wave too rough in time is not helped by finer meshes."""


Level = Callable[[Scene, Tolerance], CrawlSpeed]
"""Speed of a planar scene to a tolerance."""


def strip(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """A narrow strip as long as the sheet. Raises ValueError for a wave that depends on x."""
    found, distance = _narrow(scene, tolerance, "strip"), model_error("strip", scene)
    found = with_power_error(found, "strip", scene)
    return replace(found, model_error=distance, deformation=drawn_deformation(scene))


def line(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """A one-dimensional body as long as the sheet. Raises ValueError for a wave that depends on x.

    How far a sheet is from it is not known: two sheets of one drive may move to either side of it.
    """
    return _narrow(scene, tolerance, "line")


def _narrow(scene: Scene, tolerance: Tolerance, body: str) -> CrawlSpeed:
    if scene.drive.depends_on_x:
        raise ValueError(f"level = {body!r}: must be 'cycle' for a wave that depends on x")
    return line_crawl(scene, tolerance, body)


def first_order(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """Small strain, independent of the target's growth law and energy area."""
    return theory_speed(scene, tolerance, order=1)


def second_order(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """The expansion of the target to second order in alpha."""
    return theory_speed(scene, tolerance, order=2)


def cycle(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """The target, on finer and finer meshes until the tolerance is met or they no longer help."""
    return with_wave_error(scene, tolerance, partial(_numbers_of_cycle, scene))


def _numbers_of_cycle(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    # Here: finite elements take longer to load than a strip to be answered.
    from fem_check.shell.cycle.speed import Cycle

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
    """A planar scene with `factor` times its cells in each direction."""
    from fem_check.mesh.elements import default_cells

    across, along = scene.cells or default_cells(scene.drive, planar=True)
    return scene.but(cells=(factor * across, factor * along))


LEVELS: dict[str, Level] = {
    "strip": strip,
    "first order": first_order,
    "second order": second_order,
    "cycle": cycle,
}
"""The levels by name, cheapest first; the last one is the target."""

ASIDE: dict[str, Level] = {"line": line}
"""Answered by name only: a body that is not the target, nor on the way to it."""

TARGET = "cycle"
"""Name of the level that is the target."""

TARGET_EFFECTS = (Membrane,)
"""Classes of the effects in the target; `abilities.left_out` lists those that it neglects."""


def distance(level: str, scene: Scene) -> float:
    """Distance between that level and the target, absolute, where it was measured; else NaN."""
    return 0.0 if level == TARGET else model_error(level, scene)

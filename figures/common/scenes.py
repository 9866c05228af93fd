"""The sheets that tables and figures simulate, and the friction that they meet."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import skfem

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.material import Material
from linear_theory.friction.load import Load
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Wave
from linear_theory.wave.travelling import SineWave

ACROSS = ((0.15, 2), (0.6, 4), (1.2, 8), (math.inf, 12))
"""Elements across sheets up to a width over L. For the paper's sheet twice as many each way change V by
1e-4 alpha^2 at most, alpha up to 0.4; the estimate of the error is cautious, up to 1e-3 alpha^2."""

ALONG, ALONG_NARROW = 8, 16
"""Elements along, for each wave, and at least for a narrow sheet, whose ends are layers as long as it
is wide."""

WEAK = 1e-4
"""Friction over stiffness, mu weight L/(E h), for which it does not change the shape."""


def membrane(sheet: Sheet) -> Membrane:
    """Of the sheet's thickness and Poisson ratio."""
    return Membrane(Material(sheet.thickness, sheet.poisson))


def smooth_scene(
    sheet: Sheet,
    wave: Wave,
    alpha: float,
    cells: tuple[int, int],
    growth_law: str = "exp",
    area: str = "grown",
) -> Scene:
    """A sheet that only stretches, on bicubic elements smooth across edges (BFS)."""
    return Scene(
        sheet,
        wave,
        alpha,
        effects=(membrane(sheet),),
        growth_law=growth_law,
        area=area,
        cells=cells,
        element=skfem.ElementQuadBFS(),
    )


def planar_scene(
    sheet: Sheet, count: int, alpha: float, growth_law: str = "exp", area: str = "grown"
) -> Scene:
    """The same under a sine wave, on as many elements as 1e-3 alpha^2 needs."""
    return smooth_scene(sheet, SineWave(count), alpha, enough_cells(sheet, count), growth_law, area)


def enough_cells(sheet: Sheet, count: int) -> tuple[int, int]:
    """Elements across and along."""
    width = sheet.width / sheet.length
    across = next(n for limit, n in ACROSS if width <= limit)
    if count > 1 and across == 4:
        across = 6
    return across, max(ALONG * count, ALONG_NARROW if width < 0.3 else 0)


def sliding_scene(
    sheet: Sheet, wave: Wave, alpha: float, slip: float, cells: tuple[int, int] | None = None
) -> Scene:
    """A sheet that only stretches, for steps in time, under weak friction tanh(v/slip)."""
    weight = Gravity(WEAK * sheet.thickness, Load.CURRENT)
    effects = (membrane(sheet), weight, Friction(1.0, slip))
    return Scene(sheet, wave, alpha, effects=effects, cells=cells)


def shell_scene(
    element: str,
    across: int,
    sheet: Sheet,
    wave: Wave,
    alpha: float,
    coupling: float,
    effects: Sequence[Effect],
) -> Scene:
    """A sheet that bends, on a uniform mesh of "BFS" or "Argyris", twice as many elements along."""
    if element == "BFS":
        return Scene(sheet, wave, alpha, coupling, effects, cells=(across, 2 * across))
    x, y = sheet.width / 2, sheet.length / 2
    grid = np.linspace(-x, x, across + 1), np.linspace(-y, y, 2 * across + 1)
    return Scene(sheet, wave, alpha, coupling, effects, mesh=skfem.MeshTri.init_tensor(*grid))


def friction_law(slip_speed: float) -> dict[str, Any]:
    """Arguments friction and slip_speed: tanh(v/slip_speed), or its limits at 0 and at infinity."""
    if slip_speed == 0 or math.isinf(slip_speed):
        return {"friction": "viscous" if slip_speed else "coulomb"}
    return {"friction": "tanh", "slip_speed": slip_speed}

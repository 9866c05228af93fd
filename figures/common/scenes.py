"""Meshes for tables of the nonlinear sheet: as many elements as 1e-3 alpha^2 needs."""

import math

import skfem

from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.scene.material import Material
from fem_check.shell.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.travelling import SineWave

ACROSS = ((0.15, 2), (0.6, 4), (1.2, 8), (math.inf, 12))
"""Elements across sheets up to a width over L. For the paper's sheet twice as many each way change V by
1e-4 alpha^2 at most, alpha up to 0.4; the estimate of the error is cautious, up to 1e-3 alpha^2."""

ALONG, ALONG_NARROW = 8, 16
"""Elements along, for each wave, and at least for a narrow sheet, whose ends are layers as long as it
is wide."""


def planar_scene(
    sheet: Sheet, count: int, alpha: float, growth_law: str = "exp", area: str = "grown"
) -> Scene:
    """A sheet that only stretches, under a sine wave, on bicubic elements smooth across edges (BFS)."""
    return Scene(
        sheet,
        SineWave(count),
        alpha,
        effects=(Membrane(Material(sheet.thickness, sheet.poisson)),),
        growth_law=growth_law,
        area=area,
        cells=cells(sheet, count),
        element=skfem.ElementQuadBFS(),
    )


def cells(sheet: Sheet, count: int) -> tuple[int, int]:
    """Elements across and along."""
    width = sheet.width / sheet.length
    across = next(n for limit, n in ACROSS if width <= limit)
    if count > 1 and across == 4:
        across = 6
    return across, max(ALONG * count, ALONG_NARROW if width < 0.3 else 0)

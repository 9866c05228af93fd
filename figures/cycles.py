"""Speeds of the nonlinear sheet under several loads from one cycle of static shapes.

A static shape in the plane does not depend on what rests on the sheet. `cycle_speed` finds the shapes
for each load anew; here they are kept, which saves a third to a half of the time of a table.
"""

import math
from dataclasses import replace

import skfem

from fem_check.shell.cycle.balance import CycleBalance, Period
from fem_check.shell.cycle.motion import UnresolvedError, is_mirrored
from fem_check.shell.cycle.shapes import Shapes, cycle_of_shapes
from fem_check.shell.cycle.speed import (
    FIRST_PHASES,
    MOST_PHASES,
    PHASE_SHARE,
    _phase_error,
    other_mesh,
)
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.material import Material
from fem_check.shell.scene import Scene
from linear_theory.friction import FrictionLaw
from linear_theory.sheet import Sheet
from linear_theory.waves import SineWave

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


class Cycle:
    """Static shapes of one scene, kept by their number of phases, and speeds from them."""

    def __init__(self, scene: Scene) -> None:
        mesh, self._gain = other_mesh(scene.discretisation().mesh)
        self._scenes = {"own": scene, "other": replace(scene, cells=None, mesh=mesh)}
        self._shapes: dict[tuple[str, int], Shapes] = {}

    def speed(self, load: str, rtol: float, atol: float) -> tuple[float, float]:
        """Mean speed under dry friction and its error, L/T: that of `cycle_speed`.

        Raises ConvergenceError and UnresolvedError as it does.
        """
        count, law = FIRST_PHASES, FrictionLaw("coulomb", None)
        while True:
            balance = CycleBalance.of(self._at("own", count), load, law, rtol)
            try:
                period = balance.average(rtol, atol)
                error = _phase_error(balance, period)
            except UnresolvedError:
                if count >= MOST_PHASES:
                    raise
            else:
                if error <= PHASE_SHARE * max(rtol * abs(period.mean), atol) or count >= MOST_PHASES:
                    return period.mean, period.error + error + self._mesh_error(balance, period)
            count *= 2

    def _at(self, mesh: str, count: int) -> Shapes:
        """Shapes at `count` phases on the scene's mesh or the other one."""
        if (mesh, count) not in self._shapes:
            known = self._shapes.get((mesh, count // 2))
            self._shapes[mesh, count] = cycle_of_shapes(self._scenes[mesh], count, known)
        return self._shapes[mesh, count]

    def _mesh_error(self, balance: CycleBalance, period: Period) -> float:
        shapes = self._at("other", len(balance.shapes.states))
        other = replace(balance, shapes=shapes, mirrored=is_mirrored(shapes)).balance(period.grid.times)
        mean, _ = period.grid.mean(other.leading[:, :, 1].mean(0))
        return abs(mean - period.mean) / self._gain

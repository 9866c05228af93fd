"""Errors of the mean speed from further runs: on a coarser mesh, and with longer steps."""

import numpy as np

from fem_check.mesh.elements import default_cells
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.further.progress import Whole
from fem_check.shell.stepping.run import Run
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.scene.scene import Scene

MESH_MARGIN = 2
"""Mesh error relative to the difference to a mesh 1.5 times coarser. The elastic part is far smaller;
with dry friction the quadrature of a discontinuous force dominates, which converges irregularly."""

SNAP_MARGIN = 2
"""Error of a speed with buckling or snap-throughs relative to the difference to a run with longer
steps, whose snaps start elsewhere and take another way."""

COARSER = "on a coarser mesh"
LONGER = "with longer steps"
"""Tasks of the further runs, in words."""

COARSER_WORK, LONGER_WORK = 0.5, 0.7
"""Their work relative to that of the first run: 4/9 of the elements, and steps sqrt 2 times as long."""


def mesh_error(run: Run, whole: Whole | None) -> float:
    """Mesh error of the mean speed of a finished run, from the same run on a coarser mesh."""
    coarse = Run(coarser(run.scene), run.settings)
    coarse.finish(None, None if whole is None else whole.of(COARSER))
    return mesh_change(run.trajectory(), coarse.trajectory())


def mesh_change(found: Trajectory, coarse: Trajectory) -> float:
    """Mesh error of the mean speed of a motion, from that on the coarser mesh."""
    return float(MESH_MARGIN * abs(coarse.mean_speed - found.mean_speed))


def snap_error(run: Run, whole: Whole | None) -> float:
    """Error of the mean speed of a sheet that may take another way, from a run with longer steps.

    NaN if no other way was open in the last period, infinite if that run fails.
    """
    found = run.trajectory()
    if not found.branches:
        return np.nan
    if whole is not None:
        whole.plan(LONGER, LONGER_WORK)
    try:
        rough = Run(run.scene, run.settings.rougher())
        rough.finish(None, None if whole is None else whole.of(LONGER))
    except (ConvergenceError, ValueError):
        return np.inf
    difference = rough.trajectory().mean_speed - found.mean_speed
    return float(SNAP_MARGIN * abs(difference))


def coarser(scene: Scene) -> Scene:
    """The scene on a mesh with elements about 1.5 times as long.

    Raises ValueError for a mesh that cannot be coarsened: a given one, or one with a single row.
    """
    if scene.mesh is not None:
        raise ValueError("mesh_error = True: must be False for a scene with its own mesh")
    across, along = scene.cells or default_cells(scene.drive, scene.planar)
    if min(across, along) < 2:
        raise ValueError(f"cells = {scene.cells}: must both be >= 2 if mesh_error = True")
    return scene.but(cells=(round(across / 1.5), round(along / 1.5)))

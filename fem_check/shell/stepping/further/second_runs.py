"""Errors of the mean speed from further runs: on a coarser mesh, and with other steps."""

from typing import NamedTuple

import numpy as np

from fem_check.mesh.elements import default_cells
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.further.progress import Whole
from fem_check.shell.stepping.run import Run
from fem_check.shell.stepping.step_control import fewest_steps
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.scene.scene import Scene

MESH_MARGIN = 2
"""Mesh error relative to the difference to a mesh 1.5 times coarser. The elastic part is far smaller;
with dry friction the quadrature of a discontinuous force dominates, which converges irregularly."""

SNAP_MARGIN = 2
"""Error of a speed with buckling or snap-throughs relative to the difference to a run with other
steps, whose snaps start elsewhere and take another way."""

FEEDBACK_MARGIN = 2
"""Error of the speeds by a wave that the strain acts back on, relative to the difference to a run with
half the tolerance or half as many steps. Of second order, errors there are twice to four times as
large."""

GAP_MARGIN, NARROWER = 4, 0.5
"""Error of the speed of a sheet that touches itself relative to the difference to a run with a NARROWER
gap, by that factor. V is not linear in the gap: in a strip that is rolled up it moves by 6, 5 and 5 of
1e-4 L/T from a gap of 0.02 to 0.01, 0.004 and 0.001, so that the whole way is some three such steps.
The stiffness of the contact is not varied."""

COARSER = "on a coarser mesh"
OTHER = "with other steps"
ROUGHER = "with a rougher wave"
TIGHTER = "with a narrower gap between layers"
"""Tasks of the further runs, in words."""

COARSER_WORK, LONGER_WORK, TIGHTER_WORK = 0.5, 0.7, 1.0
"""Their work relative to that of the first run: 4/9 of the elements, steps sqrt 2 times as long, and as
many of both."""


def mesh_error(run: Run, whole: Whole | None) -> float:
    """Mesh error of the mean speed of a finished run, from the same run on a coarser mesh.

    Infinite if that run fails: what the first one found is kept.
    """
    coarse = Run(coarser(run.scene), run.settings)
    try:
        coarse.finish(None, None if whole is None else whole.of(COARSER))
    except ConvergenceError:
        return np.inf
    return mesh_change(run.trajectory(), coarse.trajectory())


def mesh_change(found: Trajectory, coarse: Trajectory) -> float:
    """Mesh error of the mean speed of a motion, from that on the coarser mesh."""
    return float(MESH_MARGIN * abs(coarse.mean_speed - found.mean_speed))


def snap_error(run: Run, whole: Whole | None) -> float:
    """Error of the mean speed of a sheet that may take another way, from a run with other steps.

    NaN if no other way was open in the last period, infinite if that run fails.
    """
    found = run.trajectory()
    if not found.branches:
        return np.nan
    if whole is not None:
        whole.plan(OTHER, LONGER_WORK)
    try:
        rough = _with_other_steps(run)
        rough.finish(None, None if whole is None else whole.of(OTHER))
    except (ConvergenceError, ValueError):
        return np.inf
    difference = rough.trajectory().mean_speed - found.mean_speed
    return float(SNAP_MARGIN * abs(difference))


def _with_other_steps(run: Run, coarse: bool = False) -> Run:
    settings = run.settings.with_other_steps(fewest_steps(run.scene.drive.rates))
    return Run(run.scene, settings, coarse)


def contact_error(run: Run, whole: Whole | None) -> float:
    """Error of the mean speed of a sheet that touches itself, from a run with a narrower gap.

    NaN if it did not touch itself in the last period, infinite if that run fails.
    """
    found, contact = run.trajectory(), run.scene.find(SelfContact)
    if contact is None or not found.presses:
        return np.nan
    if whole is not None:
        whole.plan(TIGHTER, TIGHTER_WORK)
    narrower = SelfContact(contact.material, NARROWER * contact.gap, contact.stiffness)
    effects = tuple(narrower if effect is contact else effect for effect in run.scene.effects)
    try:
        tight = Run(run.scene.but(effects=effects), run.settings)
        tight.finish(None, None if whole is None else whole.of(TIGHTER))
    except (ConvergenceError, ValueError):
        return np.inf
    return float(GAP_MARGIN * abs(tight.trajectory().mean_speed - found.mean_speed))


class FeedbackErrors(NamedTuple):
    """Of the speeds, length per time, and of c."""

    speed: float = np.nan
    growth: float = np.nan


def feedback_errors(run: Run, whole: Whole | None) -> FeedbackErrors:
    """Errors by the feedback on the wave: that of the wave itself, and of the steps that both make.

    From a run with longer steps and larger elements of the wave: the largest differences over the
    periods, since one may be small by chance. NaN without feedback, infinite if that run fails.
    """
    if not run.scene.drive.has_state:
        return FeedbackErrors()
    try:
        rough = _with_other_steps(run, coarse=True)
        rough.finish(None, None if whole is None else whole.of(ROUGHER))
    except (ConvergenceError, ValueError):
        return FeedbackErrors(np.inf, np.inf)
    speeds = rough.trajectory().period_speeds - run.trajectory().period_speeds
    found = (
        FEEDBACK_MARGIN * abs(apart).max() for apart in (speeds, run.feedback.apart(rough.feedback))
    )
    return FeedbackErrors(*map(float, found))


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

"""Errors of speed and power from further runs: on a coarser mesh, and with other steps."""

import math
from collections.abc import Callable

from fem_check.mesh.elements import default_cells
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.further.errors import FAILED, FURTHER, Doubt
from fem_check.shell.stepping.further.progress import Whole
from fem_check.shell.stepping.power import energy_of
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

GAP_MARGIN, NARROWER = 2, 0.1
"""Error of the speed of a sheet that touches itself relative to the difference to a run with a NARROWER
gap, by that factor. V is not linear in the gap, and a step to half of it may change V little by chance:
see `figures.measure.self_contact`. The stiffness is not varied: it says where within the gap layers
come to rest, so that its effect is part of that of the gap (there from 0.1 to 10 times as stiff)."""

WORK = {"mesh": 0.5, "snaps": 0.7, "feedback": 0.7, "contact": 1.0}
"""Of the run that tells a part of the error, relative to that of the first one: 4/9 of the elements,
steps sqrt 2 times as long, or as many of both."""


def plan(whole: Whole, *parts: str) -> None:
    """Tell of runs that are needed for parts of the error."""
    for part in parts:
        whole.plan(FURTHER[part], WORK[part])


def _finished(part: str, whole: Whole | None, begin: Callable[[], Run]) -> Run | None:
    """The run for a part of the error; None if it fails: what the first run found is kept.

    begin: which makes the run, and may be refused what it asks for.
    """
    if whole is not None:
        plan(whole, part)
    try:
        run = begin()
        run.finish(None, None if whole is None else whole.of(FURTHER[part]))
    except (ConvergenceError, ValueError):
        return None
    return run


def mesh_error(run: Run, coarse: Scene, whole: Whole | None) -> Doubt:
    """Mesh error of a finished run, from the same run of the `coarser` scene."""
    return _told(run, _finished("mesh", whole, lambda: Run(coarse, run.settings)), MESH_MARGIN)


def mesh_change(found: Trajectory, coarse: Trajectory) -> Doubt:
    """Mesh error of a motion, from that on the coarser mesh."""
    return _apart(coarse, found, MESH_MARGIN)


def snap_error(run: Run, whole: Whole | None) -> Doubt:
    """Error of a sheet that may take another way, from a run with other steps.

    NaN if no other way was open in the last period.
    """
    if not run.trajectory().branches:
        return Doubt()
    return _told(run, _finished("snaps", whole, lambda: _with_other_steps(run)), SNAP_MARGIN)


def contact_error(run: Run, whole: Whole | None) -> Doubt:
    """Error of a sheet that touches itself, from a run with a narrower gap.

    NaN if it did not touch itself in the last period.
    """
    contact = run.scene.find(SelfContact)
    if contact is None or not run.trajectory().presses:
        return Doubt()
    narrower = SelfContact(contact.material, NARROWER * contact.gap, contact.stiffness)
    effects = tuple(narrower if effect is contact else effect for effect in run.scene.effects)
    tight = _finished("contact", whole, lambda: Run(run.scene.but(effects=effects), run.settings))
    return _told(run, tight, GAP_MARGIN)


def feedback_errors(run: Run, whole: Whole | None) -> tuple[Doubt, float]:
    """Errors by the feedback on the wave: that of the wave itself, and of the steps that both make.

    From a run with longer steps and larger elements of the wave; of the speed the largest difference
    over the periods, since one may be small by chance. To them the error of c. NaN without feedback.
    """
    if not run.scene.drive.has_state:
        return Doubt(), math.nan
    rough = _finished("feedback", whole, lambda: _with_other_steps(run, coarse=True))
    if rough is None:
        return FAILED, math.inf
    other, found = rough.trajectory(), run.trajectory()
    speed = FEEDBACK_MARGIN * abs(other.period_speeds - found.period_speeds).max()
    growth = FEEDBACK_MARGIN * abs(run.feedback.apart(rough.feedback)).max()
    return _apart(other, found, FEEDBACK_MARGIN)._replace(speed=float(speed)), float(growth)


def _with_other_steps(run: Run, coarse: bool = False) -> Run:
    settings = run.settings.with_other_steps(fewest_steps(run.scene.drive.rates))
    return Run(run.scene, settings, coarse)


def _told(run: Run, other: Run | None, margin: float) -> Doubt:
    """What another run tells of a finished one; infinite if that failed."""
    return FAILED if other is None else _apart(other.trajectory(), run.trajectory(), margin)


def _apart(other: Trajectory, found: Trajectory, margin: float) -> Doubt:
    powers = [_power(motion) for motion in (other, found)]
    speed, power = abs(other.mean_speed - found.mean_speed), abs(powers[0] - powers[1])
    return Doubt(float(margin * speed), float(margin * power))


def _power(motion: Trajectory) -> float:
    """Over mu times the weight; NaN for a scene that lacks friction or weight."""
    energy = energy_of(motion)
    return math.nan if energy is None else energy.power.value


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

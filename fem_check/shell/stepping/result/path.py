"""The path of a simulated motion, with its errors."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.frame import poses
from fem_check.shell.cycle.motion import is_mirrored
from fem_check.shell.stepping.result.kept import ROUNDOFF
from fem_check.shell.stepping.result.speeds import LATER
from linear_theory.common.tables import LENGTH, RADIANS, Column
from linear_theory.speed.path import Poses

if TYPE_CHECKING:
    from fem_check.shell.stepping.trajectory import Trajectory

Array = NDArray[np.float64]

SUMMED = 2.5
"""Error of a position over the sum of those of the steps. In 30 motions (random waves of two harmonics,
with and without mirror symmetry, 24 steps a period or rtol = 0.1 and 0.03) it was at most 1.9 at any
time, and 0.1 to 1.1 at the end."""


@dataclass(frozen=True)
class SteppedPath(Poses):
    """Poses of the body frame at the stored times, with their estimated errors, absolute, (N,).

    position_error: of the steps, summed since the start, and of what further runs tell (`SpeedErrors`:
    the mesh if `mesh_error` was asked for, other ways through snaps, feedback, contact), which grows in
    proportion to time. heading_error: the heading itself where symmetry keeps the sheet
    from turning, else NaN: the errors of the steps are known of the centre only.
    """

    position_error: Array
    heading_error: Array

    def _columns(self) -> Sequence[Column]:
        return [
            *super()._columns(),
            Column("position_error", self.position_error, "estimated error of the position", LENGTH),
            Column("heading_error", self.heading_error, "estimated error of the heading", RADIANS),
        ]


def stepped_path(motion: "Trajectory") -> SteppedPath:
    """See `Trajectory.path`."""
    model, times = motion.model, motion.stored_times
    found = poses(model.discretisation, times, motion.states)
    mirrored = is_mirrored(motion.scene, model.discretisation.mesh)
    straight = mirrored and motion.scene.contact.friction.mirrored
    turned = abs(found.heading) if straight else np.full(times.size, np.nan)
    parts = (found.times, found.position, found.heading)
    return SteppedPath(*parts, position_error(motion)[_rows(motion)], turned)


def position_error(motion: "Trajectory") -> Array:
    """Estimated error of the centre at the ends of all steps, (n,), length.

    Velocity errors of the steps times their lengths, summed without regard to sign, one step ahead:
    the estimate of a step lags behind the motion, above all while growth rises.
    """
    steps = np.diff(motion.times, prepend=0.0)
    each = steps * np.hypot(motion.table["step_x"], motion.table["step_y"])
    ahead = np.cumsum(each) + np.append(each[1:], 0.0)
    size = np.sqrt(motion.model.discretisation.interior.measure.sum())
    told = [getattr(motion.further, name).speed for name in ("mesh", *LATER)]
    return np.asarray(SUMMED * ahead + np.nansum(told) * motion.times + ROUNDOFF * size)


def _rows(motion: "Trajectory") -> NDArray[np.intp]:
    """Rows of the stored times."""
    return np.searchsorted(motion.times, motion.stored_times)

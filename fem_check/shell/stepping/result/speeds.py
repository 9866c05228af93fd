"""Mean velocities of a simulated motion over its periods, and their errors."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.wrinkling import wrinkling_words
from fem_check.shell.kinematics.crossing import crossing_words, touching_words
from fem_check.shell.stepping.further.errors import SpeedErrors
from fem_check.shell.stepping.power import energy_of
from fem_check.shell.stepping.sliding import COMPARED
from linear_theory.common.shown import Shown
from linear_theory.speed.result import CrawlSpeed, Estimate
from linear_theory.speed.words import model_words

if TYPE_CHECKING:
    from fem_check.shell.stepping.trajectory import Trajectory

Array = NDArray[np.float64]

MARGIN, UNCERTAIN, UNEQUAL = 1.25, 0.1, 0.65
"""Safety factor of the step error, whose estimate neglects higher orders, and fraction of its mean
absolute value, for the case that its mean over the period is 0 by chance. With steps that follow from
rtol the errors of neighbouring steps differ in size and cancel less than their mean says."""

LEFT, LEFT_COARSE = 0.3, 1.6
"""Error of a speed from which the step error was removed, relative to the mean absolute value of that
error: the first plus the second times the root of rtol, to which the steps are proportional. Measured
on 13 scenes, planar and bending, at rtol = 0.3, 0.1, 0.04 and 0.01: at most 1.1, 0.7, 0.5 and 0.3."""

DRY = 0.3
"""Largest slip ratio for which the distance to dry friction is estimated."""


LATER = ("snaps", "feedback", "contact")
"""Further runs that tell a part of the error by themselves, without being asked for."""


@dataclass(frozen=True, eq=False)
class MeanVelocity(Shown):
    """Means of the velocity of the centre along one axis, "x" or "y", over counted periods."""

    motion: "Trajectory"
    axis: str

    @property
    def value(self) -> float:
        """Over the last period, see `Trajectory.mean_speed`."""
        correction = last_mean(self.motion, f"step_{self.axis}") if self._corrected else 0.0
        return float(self.of_periods[-1]) + correction

    @property
    def of_periods(self) -> Array:
        """Over each counted period, (periods,)."""
        motion = self.motion
        ends = [motion.period_end(k) for k in range(motion.periods + 1)]
        return np.diff(motion.table[f"centre_{self.axis}"][ends]) / motion.scene.period

    @property
    def step_error(self) -> float:
        """That of `value` due to the steps."""
        each = last_mean(self.motion, f"step_{self.axis}", size=True)
        if self._corrected:
            return (LEFT + LEFT_COARSE * math.sqrt(self.motion.rtol or 0.0)) * each
        share = UNCERTAIN if self.motion.rtol is None else UNEQUAL
        return MARGIN * abs(last_mean(self.motion, f"step_{self.axis}")) + share * each

    @property
    def _corrected(self) -> bool:
        """Not where the sheet jumps: the error of such steps is not known."""
        return self.motion.corrects and not self.motion.snaps


def last_mean(motion: "Trajectory", name: str, size: bool = False) -> float:
    """Time average over the last period of a column (or of its absolute value)."""
    last = motion.last_period
    steps = np.diff(motion.times)[last.start - 1 :]
    values = motion.table[name][last]
    return float((np.abs(values) if size else values) @ steps / steps.sum())


def mean_across(motion: "Trajectory") -> Estimate:
    """See `Trajectory.mean_across`."""
    across, along, shared = MeanVelocity(motion, "x"), motion.errors, ("mesh", *LATER)
    own = abs(np.diff(across.of_periods[-2:])).sum() + across.step_error
    error = float(own + np.nansum([getattr(along, name) for name in shared]))
    return Estimate(across.value, error)


def speed_errors(motion: "Trajectory") -> SpeedErrors:
    """See `Trajectory.errors`."""
    speeds, further = motion.period_speeds, motion.further
    spread = abs(speeds[-1] - speeds[-2]) if speeds.size > 1 else np.nan
    dry = motion.slip_ratio <= DRY
    slip = abs(last_mean(motion, "slip_y")) / (1 - COMPARED) if dry else np.nan
    return SpeedErrors(
        MeanVelocity(motion, "y").step_error,
        float(spread),
        further.mesh.speed,
        slip,
        *(getattr(further, name).speed for name in LATER),
    )


def speed_of(motion: "Trajectory") -> CrawlSpeed:
    """See `Trajectory.speed`."""
    last, errors, mean = motion.last_period, motion.errors, motion.mean_speed
    crosses = motion.crossed is not None and bool(motion.crossed.any())
    wrinkles = bool(motion.wrinkled.any())
    error = float(np.nansum([e for name, e in errors._asdict().items() if name != "slip_speed"]))
    met = motion.rtol is not None and error <= motion.rtol * abs(mean)
    return CrawlSpeed(
        estimate=Estimate(mean, error),
        model_error=errors.slip_speed,
        converged=met and not (crosses or wrinkles),
        times=motion.times[last],
        velocity=motion.velocity[last],
        seconds=motion.seconds,
        model=_model(motion, errors),
        slip_ratio=motion.slip_ratio,
        energy=energy_of(motion),
    )


def _model(motion: "Trajectory", errors: SpeedErrors) -> str:
    """The model and all that is to be said about the motion, in words."""
    remarks = (
        "mesh error not estimated" if np.isnan(errors.mesh) else "",
        "snaps over" if motion.snaps else "",
        crossing_words(motion.crossed, motion.stored_times),
        wrinkling_words(motion.wrinkled, motion.stored_times),
        touching_words(motion.touching, motion.stored_times),
        errors.failed,
    )
    rubs, scene = any(effect.law for effect in motion.model.effects), motion.scene
    contact = scene.contact if rubs else None
    return model_words("Koiter shell stepped in time", scene.growth, contact, *remarks)

"""Shapes of a simulated motion at any time, from those that were kept."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.stepping.between import between, interpolation_error, motion_around
from fem_check.shell.stepping.step_control import LANDED
from linear_theory.common import validation
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]

SEEN = 1e-2
"""Default of the largest accepted error of an interpolated shape, as a fraction of the distance that
points of the sheet move in a period."""

ROUNDOFF = 1e-8
"""Error of any shape from the minimisations, relative to the size of the sheet (see `Minimiser`)."""


@dataclass(frozen=True, eq=False)
class KeptShapes(Shown):
    """Shapes at kept times, and the motion of a few points at all times.

    times (n,), probes (n, points, components), snapped (n,): of all steps; kept (k,), states (k, size):
    kept states and their times; period: of the wave; size: of the sheet, length.
    """

    times: Array
    probes: Array
    snapped: NDArray[np.bool_]
    kept: Array
    states: Array
    period: float
    size: float

    def error(self, t: float) -> float:
        """See `Trajectory.shape_error`."""
        return interpolation_error(self.times, self.probes, self.snapped, self.kept, self.within(t))

    def shape(self, t: float, rtol: float | None = SEEN) -> Array:
        """See `Trajectory.shape`."""
        t = self.within(t)
        exact = np.flatnonzero(self.kept == t)
        if exact.size:
            return np.asarray(self.states[exact[0]])
        if rtol is not None:
            self._check(t, validation.positive("rtol", rtol))
        return between(self.kept, self.states, t)

    def _check(self, t: float, rtol: float) -> None:
        error = self.error(t)
        motion = motion_around(self.times, self.probes, t, self.period)
        if error > rtol * motion + ROUNDOFF * self.size:
            raise ValueError(
                f"t = {t:g}: lies between kept states, where the error of positions, {error:.2g}, is "
                f"above rtol = {rtol:g} of the motion, {motion:.2g}. Use one of stored_times or a "
                "larger rtol, or simulate with a smaller keep_every or smaller steps"
            )

    def within(self, t: float) -> float:
        """A time with known shapes: snapped to a kept time if equal within roundoff.

        Raises ValueError for times outside of the kept ones.
        """
        t, kept = validation.real("t", t), self.kept
        nearest = float(kept[np.abs(kept - t).argmin()])
        if abs(nearest - t) <= LANDED * self.period:
            return nearest
        if not kept[0] <= t <= kept[-1]:
            raise ValueError(
                f"t = {t:g}: must be in [{kept[0]:g}, {kept[-1]:g}], where states were kept"
            )
        return t

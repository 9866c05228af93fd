"""The result of a simulation: motion, energy balance and speed of the sheet."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.cycle.wrinkling import wrinkled
from fem_check.shell.kinematics.crossing import crossed
from fem_check.shell.model import ShellModel
from fem_check.shell.stepping import columns
from fem_check.shell.stepping.further.branching import DECISIVE, may_branch
from fem_check.shell.stepping.further.errors import NO_FURTHER, Further, SpeedErrors
from fem_check.shell.stepping.power import Works
from fem_check.shell.stepping.result.kept import SEEN, KeptShapes
from fem_check.shell.stepping.result.path import SteppedPath, stepped_path
from fem_check.shell.stepping.result.speeds import (
    MeanVelocity,
    last_mean,
    mean_across,
    speed_errors,
    speed_of,
)
from fem_check.shell.stepping.stepper import amplitude
from linear_theory.common.drawable import Drawable
from linear_theory.common.tables import Column, Tabular
from linear_theory.friction.regime import Regime, regime_of
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed, Estimate, speed_in_words

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Trajectory(Drawable, Tabular):
    """A simulated motion.

    `speed` is the mean speed with its errors, `centre` and `path` are the positions of the sheet at
    `times`, `positions(t)` is its shape, and `power` the energy balance: work and energies (force times
    length), each summed from the start to `times`; their time derivatives are powers. `to_dataframe`
    and `to_xarray` export tables, `fem_check.write_paraview` writes a film for ParaView.

    model: the finite-element model of the scene. start: start of the first counted period, after the
    ramp of growth. table: columns of `record.COLUMNS`. stored_times (n,), states (n, size): kept
    states. probes (steps + 1, points, components): positions of a few points at all `times`. rejected:
    repeated steps. resumed_at: time of the snapshot from which the run resumed, NaN if none.
    further: what further runs tell, see `SpeedErrors`. corrects: whether the estimated step error is
    removed from the speed. seconds: computing time, that before the snapshot included.

    >>> from fem_check import Friction, Gravity, Material, Membrane, Scene, simulate
    >>> from linear_theory import Sheet, SineWave
    >>> effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, slip_speed=0.005)]
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(1, 2))
    >>> motion = simulate(scene, periods=1, rtol=0.1)
    >>> print(f"centre at y = {motion.centre[1, -1]:.2f} L at t = {motion.times[-1]:.1f} T")
    centre at y = 0.02 L at t = 1.5 T
    """

    model: ShellModel
    start: float
    table: dict[str, Array] = field(repr=False)
    stored_times: Array = field(repr=False)
    states: Array = field(repr=False)
    probes: Array = field(repr=False)
    rejected: int
    seconds: float
    resumed_at: float = np.nan
    rtol: float | None = None
    corrects: bool = False
    further: Further = NO_FURTHER

    @property
    def scene(self) -> Scene:
        """The simulated scene."""
        return self.model.scene

    @property
    def times(self) -> Array:
        """Ends of the steps, (n,), from 0, the start of the ramp."""
        return self.table["time"]

    @property
    def centre(self) -> Array:
        """Centre of mass, (components, n)."""
        rows = [self.table[f"centre_{axis}"] for axis in "xyz"[: self.scene.components]]
        return np.stack(rows)

    @property
    def velocity(self) -> Array:
        """Of the centre of mass along y, (n,)."""
        return np.gradient(self.centre[1], self.times)

    @property
    def power(self) -> Works:
        """Energies accumulated from the start to each of `times`, each (n,), force times length.

        See `Works`: work of growth = increase of elastic energy, weight, ground and kinetic energy +
        dissipation by friction and damping + residual. Despite its name not a rate:
        `numpy.gradient(w, times)` is the power.
        """
        return Works(*(np.cumsum(self.table[name]) for name in Works._fields))

    @property
    def buckled(self) -> NDArray[np.bool_]:
        """Whether a negative curvature of the energy was met in the step, (n,): buckling."""
        return self.table["buckled"] > 0

    @property
    def snapped(self) -> NDArray[np.bool_]:
        """Whether the sheet jumped in the step, (n,), in which its motion is not resolved."""
        return self.table["snapped"] > 0

    @cached_property
    def crossed(self) -> NDArray[np.bool_] | None:
        """Whether the sheet passes through itself at `stored_times`, (n,), see `Crossings`.

        None if that could not be found out, for lack of ipctk.
        """
        return crossed(self.model.discretisation, self.states)

    @cached_property
    def wrinkled(self) -> NDArray[np.bool_]:
        """Whether a sheet in the plane is compressed so much at `stored_times` that it would wrinkle.

        (n,), see `wrinkling`; of sheets that bend False, since they buckle instead.
        """
        return wrinkled(self.model, self.stored_times, self.states, self.amplitude)

    @cached_property
    def touching(self) -> NDArray[np.bool_]:
        """Whether parts of the sheet press on each other at `stored_times`, (n,); see `SelfContact`."""
        couplings = self.model.couplings
        return np.array([any(c.touches(u) for c in couplings) for u in self.states], bool)

    @property
    def presses(self) -> bool:
        """Whether the sheet touches itself within the last period."""
        late = self.stored_times >= self.times[self.last_period.start - 1]
        return bool(self.model.couplings) and bool(self.touching[late].any())

    @property
    def growth_error(self) -> float:
        """Estimated error of c where the strain acts back on it, else NaN.

        `model.growth` is then c as it was in this motion.
        """
        return self.further.growth

    @property
    def iterations(self) -> int:
        """Newton iterations of all accepted steps."""
        return int(self.table["iterations"].sum())

    @property
    def slip_ratio(self) -> float:
        """Slip speed over the largest speed along the ground in the last period (F4).

        NaN without friction.
        """
        if not any(effect.law for effect in self.model.effects):
            return np.nan
        fastest = float(self.table["fastest"][self.last_period].max())
        return self.scene.contact.friction.slip_ratio(fastest)

    @property
    def regime(self) -> Regime:
        """See `CrawlSpeed.regime`."""
        return regime_of(self.slip_ratio)

    @property
    def linear_share(self) -> float:
        """Fraction of the load that moves slower than the slip speed, mean over the last period."""
        return last_mean(self, "linear")

    def amplitude(self, t: float) -> float:
        """Fraction of the growth at time t: below 1 during the ramp."""
        return amplitude(t, self.start)

    def shape_error(self, t: float) -> float:
        """Estimated interpolation error of the positions at time t, length; 0 at kept times.

        The largest deviation over the sheet of a cubic through kept states from the motion of all
        steps; for the error of the steps see `errors`. Raises ValueError outside of the kept times.
        """
        return self._kept.error(t)

    def shape(self, t: float, rtol: float | None = SEEN) -> Array:
        """Unknowns (size,) at time t: of a kept state, or from a cubic through the four nearest.

        rtol: largest `shape_error` as a fraction of the distance that points move in the period around
        t; None for any. Raises ValueError if it is larger, and outside of the kept times.
        """
        return self._kept.shape(t, rtol)

    def positions(self, t: float, points: ArrayLike | None = None, rtol: float | None = SEEN) -> Array:
        """Positions (components, n) at time t of points (2, n) of the sheet; by default the vertices.

        rtol: as for `shape`. Raises ValueError outside the sheet and the kept times, and if the shape
        is not known to rtol.
        """
        discretisation, u = self.model.discretisation, self.shape(t, rtol)
        mesh = discretisation.mesh
        region = discretisation.points(mesh.p if points is None else points)
        return np.asarray(region.position(u, (0,))[0])

    @property
    def _kept(self) -> KeptShapes:
        size = float(np.sqrt(self.model.discretisation.interior.measure.sum()))
        kept, period = (self.stored_times, self.states), self.scene.period
        return KeptShapes(self.times, self.probes, self.snapped, *kept, period, size)

    @property
    def snaps(self) -> bool:
        """Whether the sheet jumps within the last period, where its path depends on the steps."""
        return bool(self.snapped[self.last_period].any())

    @property
    def branches(self) -> bool:
        """Whether it could have taken another way within the last period, see `may_branch`."""
        last = self.last_period
        return may_branch(self.model, *(self.table[name][last] for name in DECISIVE))

    @cached_property
    def path(self) -> SteppedPath:
        """Position along the ground and heading of the body frame at the stored times, with errors.

        The frame is that of `rigid_path`; the ramp is part of the path.
        """
        return stepped_path(self)

    @property
    def last_period(self) -> slice:
        """Rows of the last period, without the one at its start."""
        return self.period_rows(self.periods - 1)

    def period_rows(self, period: int) -> slice:
        """Rows of a counted period, 0 the first, without the one at its start."""
        return slice(self.period_end(period) + 1, self.period_end(period + 1) + 1)

    @cached_property
    def period_speeds(self) -> Array:
        """Mean velocity along y over each counted period, (periods,)."""
        return MeanVelocity(self, "y").of_periods

    @property
    def periods(self) -> int:
        """Counted periods, after the ramp."""
        return round((self.times[-1] - self.start) / self.scene.period)

    @property
    def mean_speed(self) -> float:
        """Mean velocity along y over the last period, without the estimated error of the steps.

        As far as that error is known (`corrects`): that of backward differences with steps that follow
        from rtol, if the sheet does not jump. Else the last of `period_speeds`.
        """
        return MeanVelocity(self, "y").value

    @property
    def mean_across(self) -> Estimate:
        """Mean velocity along x over the last period, as `mean_speed`, with its error.

        The errors of step and spread are those of x; the others, which are known along y, are taken to
        be as large.
        """
        return mean_across(self)

    @property
    def errors(self) -> SpeedErrors:
        """Estimated errors of the mean speed of the last period."""
        return speed_errors(self)

    @cached_property
    def speed(self) -> CrawlSpeed:
        """Mean velocity of the last period, see `mean_speed`.

        error: sum of the errors of step, mesh (if requested), spread between periods, path through
        snap-throughs, feedback on the wave and the gap of SelfContact; model_error: distance to dry
        friction, see `SpeedErrors`. The speed of a sheet that has passed through itself (`crossed`) or
        is compressed beyond stability (`wrinkled`), which no real sheet is, is never converged, nor is
        one whose error is infinite since a further run failed (`SpeedErrors.failed`, also in `model`).
        """
        return speed_of(self)

    def _title(self) -> str:
        found = self.speed
        return f"Trajectory: {speed_in_words(found.mean, found.error, found.converged)}"

    def _rows(self) -> Mapping[str, Any]:
        resumed = {} if np.isnan(self.resumed_at) else {"resumed_at": self.resumed_at}
        return {
            "scene": self.scene,
            "periods": f"{self.periods} after a ramp of {self.start:g}, {len(self.times) - 1} steps",
            "times": self.times,
            "centre": self.centre,
            "stored_times": self.stored_times,
            "regime": self.regime,
            "power": ", ".join(Works._fields),
            "buckled": f"at {np.count_nonzero(self.buckled)} of the times",
            "snapped": f"at {np.count_nonzero(self.snapped)} of the times",
            **resumed,
            "seconds": self.seconds,
        }

    def _contents(self) -> Mapping[str, Any]:
        found = self.speed
        answer = {name: getattr(found, name) for name in ("mean", "error", "converged", "regime")}
        parts = {**super()._contents(), "model": self.scene}
        named = {"scene" if name == "model" else name: value for name, value in parts.items()}
        return {**answer, "periods": self.periods, **named}

    def _columns(self) -> Sequence[Column]:
        return columns.columns(self)

    def _fields(self) -> Sequence[Column]:
        return columns.positions(self)

    def period_end(self, period: int) -> int:
        """Row at the end of counted period number `period` (1 the first; 0: at its start)."""
        return int(np.abs(self.times - self.start - period * self.scene.period).argmin())

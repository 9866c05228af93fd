"""Trajectories, prepared for pictures."""

from collections.abc import Iterator
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from fem_check.answer.wave_words import direction
from fem_check.mesh import location as triangles
from fem_check.output.moving import Course, Frame, turned
from fem_check.output.works import Energies, since
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Region
from fem_check.shell.kinematics.rest_state import RestState
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.friction.maps import FixedTo
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

AROUND = 1e-2
"""Half the interval, in periods, of the difference quotients for velocities."""

REGIONS = 4
"""Sets of points whose shape functions are kept: a film returns to the same ones in each frame."""


class Simulated:
    """See `moving.Moving`; phases and frames are counted from the end of the ramp of growth."""

    has_shape = True
    words = "simulated sheet"

    def __init__(self, trajectory: Trajectory) -> None:
        self._trajectory, self._scene = trajectory, trajectory.scene
        self._model = trajectory.model
        self.period, self.length = self._scene.period, self._scene.sheet.length
        self.components = self._scene.components
        self.most_periods: int | None = trajectory.periods
        self._regions = lru_cache(REGIONS)(self._region_of)

    @cached_property
    def speed(self) -> CrawlSpeed:
        """Speed of the last period."""
        return self._trajectory.speed

    @property
    def direction(self) -> int:
        """See Moving."""
        return direction(self._scene.drive)

    def covering(self) -> tuple[Array, Integers]:
        """See Moving."""
        return triangles.covering(self._model.discretisation.mesh)

    def course(self) -> Course:
        """V(t) over all counted periods; the mean is that of the last one."""
        run = self._trajectory
        velocity, counted = run.velocity, run.times >= run.start
        end = float(run.times[-1])
        last, shown = (end - self.period, end), (run.start, end)
        return Course(run.times[counted], velocity[counted], last, shown)

    def waves(self, points: Array, times: Array) -> Array:
        """See Moving."""
        return np.stack([self._model.growth(float(t), *points) for t in times])

    @property
    def energies(self) -> Energies:
        """Since the end of the ramp."""
        run = self._trajectory
        return since(run.times, {**run.power._asdict(), "residual": run.power.residual}, run.start)

    def way(self, periods: int, samples: int) -> tuple[Array, Array]:
        """Times at the ends of the steps, and the positions of the centre."""
        run = self._trajectory
        last = run.start + periods * self.period + 1e-9 * self.period
        shown = (run.times >= run.start - 1e-9 * self.period) & (run.times <= last)
        return run.times[shown], run.centre[:2, shown]

    def at(self, points: Array, phase: float) -> Frame:
        """See Moving."""
        return self._frame(self._region(points), points, self._time(phase))

    def friction(self, points: Array, phase: float) -> Array:
        """See Moving; 0 without friction."""
        t, region = self._time(phase), self._region(points)
        if not any(effect.law for effect in self._model.effects):
            return np.zeros((2, region.size))
        before, after = self._within(t - AROUND * self.period), self._within(t + AROUND * self.period)
        moved = self._place(region, after)[:2] - self._place(region, before)[:2]
        law, slip = self._scene.contact.friction, moved / (after - before)
        angle = self._frame(region, points, t).heading if law.follows_body else 0.0
        force = turned(law.force(turned(slip, -angle)), angle)
        return np.asarray(-self._load(region, t) * force)

    @property
    def presses(self) -> bool:
        """See Moving."""
        return self.components == 3 and any(e.pressed_by(3) for e in self._model.effects)

    def pressure(self, points: Array, phase: float) -> Array:
        """See Moving."""
        return self._pressure(self._region(points), self._time(phase))[0]

    def ground(self, x: Array, y: Array) -> Array:
        """See Moving."""
        found: Ground | None = self._model.find(Ground)
        if found is None or found.height is None:
            return np.zeros_like(y)
        return np.asarray(found.height.values(x, y))

    def frames(self, points: Array, periods: int, samples: int) -> "SimulatedFrames":
        """See Moving."""
        times = self._trajectory.start + self.period * np.arange(periods * samples + 1) / samples
        return SimulatedFrames(self, points, times)

    def _load(self, region: Region, t: float) -> Array:
        """Pressure on the ground over the weight per area, times the map of friction."""
        found, place = self._pressure(region, t)
        friction = self._scene.contact.friction
        if friction.map is None:
            return found
        on_body = friction.map.fixed_to is FixedTo.BODY
        return np.asarray(
            found * friction.map.values(*(region.reference[0, :2] if on_body else place), t)
        )

    def _pressure(self, region: Region, t: float) -> tuple[Array, Array]:
        """Pressure on the ground over the weight per area, and the positions (2, n) in the plane."""
        bearer = next(e for e in self._model.effects if e.pressed_by(self.components))
        u, rest = self._trajectory.shape(t, None), self._rest(region, t)
        area = PointState(region, u, (1, 2)).area
        state = PointState(region, u, (0,), rest, Step(area=area))
        found = bearer.normal_load(state) / self._model.find(Gravity).weight
        return np.asarray(found), state.position[:2]

    def _rest(self, region: Region, t: float) -> RestState:
        return self._model.rest(t, self._trajectory.amplitude(t), region)

    def _time(self, phase: float) -> float:
        t = self._trajectory.start + phase * self.period
        first, last = self._trajectory.stored_times[[0, -1]]
        if not first - 1e-9 * self.period <= t <= last + 1e-9 * self.period:
            raise ValueError(
                f"phase = {phase:g}: must be within the periods that were kept, "
                f"[{(first - self._trajectory.start) / self.period:.3g}, {self.most_periods}]"
            )
        return self._within(t)

    def _within(self, t: float) -> float:
        first, last = self._trajectory.stored_times[[0, -1]]
        return float(min(max(t, first), last))

    def _region(self, points: Array) -> Region:
        return self._regions(points.tobytes())

    def _region_of(self, points: bytes) -> Region:
        return self._model.discretisation.points(np.frombuffer(points).reshape(2, -1))

    def _place(self, region: Region, t: float) -> Array:
        return np.asarray(region.position(self._trajectory.shape(t, None), (0,))[0])

    def _frame(self, region: Region, points: Array, t: float) -> Frame:
        run, place = self._trajectory, self._place(region, t)
        wave = np.asarray(self._model.growth(t, *points))
        growth = run.amplitude(t) * self._scene.alpha * wave
        centre = np.array([np.interp(t, run.times, values) for values in run.centre])
        heading = float(np.interp(t, run.path.times, run.path.heading))
        flat = np.zeros_like(place)
        flat[:2] = points - self._middle[:, None]
        still = turned(flat, heading)
        still[:2] += centre[:2, None]
        return Frame(t, place, still, growth, wave, centre[:2], heading)

    @cached_property
    def _middle(self) -> Array:
        """Centre of mass of the undeformed sheet, (2,)."""
        region = self._model.discretisation.interior
        return np.asarray(region.reference[0, :2] @ region.measure / region.measure.sum())


class SimulatedFrames:
    """See `moving.Frames`."""

    def __init__(self, moving: Simulated, points: Array, times: Array) -> None:
        self._moving, self._points, self._times = moving, points, times
        self._region = moving._region(points)

    def __len__(self) -> int:
        return int(self._times.size)

    def __iter__(self) -> Iterator[Frame]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, index: int) -> Frame:
        t = self._moving._within(float(self._times[index]))
        return self._moving._frame(self._region, self._points, t)

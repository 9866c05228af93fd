"""Speeds from theory and cycles of shapes, prepared for pictures: one period, repeated on a path."""

from collections.abc import Iterator
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fem_check.answer.wave_words import direction
from fem_check.output.moving import CONSTANT, Course, Frame, closed, turned
from linear_theory.speed.drawn import Deformation
from linear_theory.speed.path import Poses, rigid_path
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Crawling:
    """See `moving.Moving`. Without a deformation only V(t) and the path can be drawn."""

    most_periods: int | None = None
    energies = None

    def __init__(self, speed: CrawlSpeed) -> None:
        self.speed = speed
        self.has_shape = speed.deformation is not None

    @property
    def _deformation(self) -> Deformation:
        assert self.speed.deformation is not None
        return self.speed.deformation

    @property
    def period(self) -> float:
        """Period of the wave; without a wave, the period of V(t)."""
        return self._deformation.drive.period if self.has_shape else _period(self.speed)

    @property
    def length(self) -> float:
        """Of the sheet."""
        return self._deformation.drive.sheet.length if self.has_shape else 1.0

    @property
    def words(self) -> str:
        """Description of the shape."""
        return self._deformation.words if self.has_shape else ""

    @property
    def direction(self) -> int:
        """See Moving."""
        return direction(self._deformation.drive) if self.has_shape else 0

    @cached_property
    def components(self) -> int:
        """2 in the plane, 3 in space."""
        if not self.has_shape:
            return 2
        points = self._deformation.covering()[0]
        return len(self._deformation.places(points[:, :1], np.zeros(1)))

    def covering(self) -> tuple[Array, Integers]:
        """See Moving."""
        return self._deformation.covering()

    def course(self) -> Course:
        """V(t) over the period that starts at 0."""
        return closed(self.speed.times, self.speed.velocity, self.period)

    def waves(self, points: Array, times: Array) -> Array:
        """See Moving."""
        return self._deformation.growth(points, times)

    def stress(self, points: Array, t: float) -> dict[str, Array]:
        """Components (n,) of the stress in the axes of the sheet by name, if the theory has them."""
        stress = self._deformation.stress(points, t)
        names = ("stress_xx", "stress_yy", "stress_xy")
        return {} if stress is None else dict(zip(names, stress, strict=True))

    def way(self, periods: int, samples: int) -> tuple[Array, Array]:
        """See Moving."""
        poses = self._poses(periods, samples)
        return poses.times, self._centre[:, None] + poses.position

    def at(self, points: Array, phase: float) -> Frame:
        """The sheet at a phase, in the frame of the body, whose position at that phase is arbitrary."""
        return self._frame(points, np.array([phase * self.period]))(0)

    def friction(self, points: Array, phase: float) -> Array:
        """See Moving: opposite to the slip, the velocity of deformation plus that of the body."""
        t = phase * self.period
        velocity, load = self._deformation.contact(points, t)
        v_x, v_y, omega = self._rigid(t)
        x, y = self._deformation.places(points, np.array([t]))[:2, 0]
        slip = velocity + np.stack([v_x - omega * y, v_y + omega * x])
        return -load * self._deformation.law.force(slip)

    @property
    def presses(self) -> bool:
        """See Moving."""
        return self.components == 3

    def pressure(self, points: Array, phase: float) -> Array:
        """See Moving."""
        t, law = phase * self.period, self._deformation.law
        load = self._deformation.contact(points, t).load
        return load if law.map is None else load / law.map.values(points[0], points[1], t)

    def ground(self, x: Array, y: Array) -> Array:
        """Level ground, the only one in the theories and the cycle of shapes."""
        return np.zeros_like(y)

    def frames(self, points: Array, periods: int, samples: int) -> "CrawlingFrames":
        """The shapes of one period, moved along the path."""
        return CrawlingFrames(self, points, self._poses(periods, samples), samples)

    def _frame(self, points: Array, times: Array) -> "_Shapes":
        return _Shapes(self._deformation, points, times)

    @property
    def _centre(self) -> Array:
        return self._deformation.centre if self.has_shape else np.zeros(2)

    def _rigid(self, t: float) -> Array:
        """V_x, V_y, Omega at one time, interpolated between those of the speed."""
        times, speed = self.speed.times, self.speed
        rigid = (
            np.multiply.outer([0.0, 1.0, 0.0], speed.velocity) if speed.rigid is None else speed.rigid
        )
        return np.array([np.interp(t, times, values, period=self.period) for values in rigid])

    def _poses(self, periods: int, samples: int) -> Poses:
        if self.speed.times.size >= 4 and self.speed.times.size % 4 == 0:
            return rigid_path(self.speed, periods, samples)
        times = self.speed.times[0] + self.period * np.arange(periods * samples + 1) / samples
        way = self.speed.mean * (times - times[0])
        return Poses(times, np.stack([0 * way, way]), 0 * way)


class _Shapes:
    """Shapes of the sheet at given times, in the frame of the body."""

    def __init__(self, deformation: Deformation, points: Array, times: Array) -> None:
        self.times, self.centre = times, deformation.centre
        self.place = deformation.places(points, times)
        self.wave = deformation.growth(points, times)
        self.growth = deformation.alpha * self.wave
        still = (points - self.centre[:, None])[:, None]
        self.still = np.broadcast_to(_raised(still, len(self.place)), self.place.shape)

    def __call__(self, index: int) -> Frame:
        at = np.zeros((len(self.place), 1))
        at[:2, 0] = self.centre
        place, still = (at + v[:, index] for v in (self.place, self.still))
        t, growth, wave = float(self.times[index]), self.growth[index], self.wave[index]
        return Frame(t, place, still, growth, wave, self.centre, 0.0)


class CrawlingFrames:
    """See `moving.Frames`."""

    def __init__(self, moving: Crawling, points: Array, poses: Poses, samples: int) -> None:
        self._poses, self._samples = poses, samples
        self._shapes = moving._frame(points, poses.times[:samples])

    def __len__(self) -> int:
        return int(self._poses.times.size)

    def __iter__(self) -> Iterator[Frame]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, index: int) -> Frame:
        shapes, heading = self._shapes, float(self._poses.heading[index])
        inside = index % self._samples
        centre = shapes.centre + self._poses.position[:, index]
        at = np.zeros((len(shapes.place), 1))
        at[:2, 0] = centre
        place, still = (at + turned(v[:, inside], heading) for v in (shapes.place, shapes.still))
        t, growth = float(self._poses.times[index]), shapes.growth[inside]
        return Frame(t, place, still, growth, shapes.wave[inside], centre, heading)


def _raised(places: Array, components: int) -> Array:
    """Positions in the plane extended to 2 or 3 components."""
    missing = np.zeros((components - 2, *places.shape[1:]))
    return np.concatenate([places, missing])


def _period(speed: CrawlSpeed) -> float:
    """Period of V(t): both ends if constant, else with the last interval equal to the one before."""
    times = speed.times
    if times.size <= CONSTANT:
        return float(np.ptp(times)) or 1.0
    return float(2 * times[-1] - times[-2] - times[0])

"""A motion as plain arrays, from which pictures and films are made without solving anything again.

It is what `fem_check.output` draws (see `moving.Moving`), at PHASES equidistant times of each period;
what lies between them is interpolated linearly. Speeds have one period, which repeats: each next one
starts where the last one ended, turned by as much.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator
from scipy.spatial import cKDTree
from skfem import MeshTri

from fem_check.mesh.location import TriangleFinder
from fem_check.output.moving import Course, Frame, turned
from fem_check.output.works import Energies
from linear_theory.common.drawable import Drawable
from linear_theory.common.shown import Shown
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

PHASES = 48
"""Recorded times to a period: twice those of a film."""


@dataclass(frozen=True, eq=False)
class Recording(Drawable, Shown):
    """The motion of a sheet at `times` (n,), the first and the last included.

    speed: the answer. points (2, p), triangles (m, 3): of the undeformed sheet. place (n, 2 or 3, p):
    positions in the frame of the ground. wave, growth (n, p): c and alpha c. centre (n, 2), heading
    (n,): of the body frame. middle (2,): centre of mass of the undeformed sheet. tails (2, a): points
    with arrows; friction (n, 2, a): force on them over mu times the weight, per undeformed area.
    floor_x (i,), floor_y (j,), floor (i, j): places around the sheet and the height of the ground.
    periods: recorded; repeats: whether they go on without end. words: about the shape. energies: of a
    motion in time, where the work of growth went. load (n, p): of a sheet in space, normal load over
    the weight per area; None of others. Lengths and times in units of the scene.

    >>> from fem_check.runs import recorded
    >>> from linear_theory import Scene, Sheet, SineWave, crawl_speed
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.2)
    >>> kept = recorded(crawl_speed(scene, rtol=1e-2), scene)
    >>> print(kept.place.shape, kept.components, abs(kept.growth).max().round(3))
    (49, 2, 637) 2 0.2
    """

    speed: CrawlSpeed
    period: float
    length: float
    words: str
    direction: int
    periods: int
    repeats: bool
    course_shown: Course = field(repr=False)
    points: Array = field(repr=False)
    triangles: Integers = field(repr=False)
    times: Array = field(repr=False)
    place: Array = field(repr=False)
    wave: Array = field(repr=False)
    growth: Array = field(repr=False)
    centre: Array = field(repr=False)
    heading: Array = field(repr=False)
    middle: Array = field(repr=False)
    tails: Array = field(repr=False)
    arrows: Array = field(repr=False)
    floor_x: Array = field(repr=False)
    floor_y: Array = field(repr=False)
    floor: Array = field(repr=False)
    energies: Energies | None = field(default=None, repr=False)
    load: Array | None = field(default=None, repr=False)

    has_shape = True

    @property
    def components(self) -> int:
        """2 in the plane, 3 in space."""
        return int(self.place.shape[1])

    @property
    def most_periods(self) -> int | None:
        """See Moving."""
        return None if self.repeats else self.periods

    def covering(self) -> tuple[Array, Integers]:
        """See Moving."""
        return self.points, self.triangles

    def waves(self, points: Array, times: Array) -> Array:
        """See Moving."""
        weights, phases = self._weights(points), (times - self.times[0]) / self.period
        rows = [self._lap(float(phase))[1] * PHASES for phase in phases]
        return np.stack([weights(_between(self.wave, row)) for row in rows])

    def course(self) -> Course:
        """See Moving."""
        return self.course_shown

    def way(self, periods: int, samples: int) -> tuple[Array, Array]:
        """See Moving."""
        shares = np.arange(periods * samples + 1) / samples
        return self.times[0] + self.period * shares, self._poses(shares)[0]

    def at(self, points: Array, phase: float) -> Frame:
        """See Moving."""
        frame = self._frame(self._weights(points), points, self._counted(phase))
        return frame._replace(time=phase * self.period) if self.repeats else frame

    def friction(self, points: Array, phase: float) -> Array:
        """See Moving; that of the nearest recorded arrow."""
        if not self.tails.size:
            return np.zeros_like(points)
        nearest = cKDTree(self.tails.T).query(points.T)[1]
        row = self._lap(self._counted(phase))[1] * PHASES
        return np.asarray(_between(self.arrows, row)[:, nearest])

    @property
    def presses(self) -> bool:
        """See Moving."""
        return self.load is not None

    def pressure(self, points: Array, phase: float) -> Array:
        """See Moving."""
        assert self.load is not None
        row = self._lap(self._counted(phase))[1] * PHASES
        return self._weights(points)(_between(self.load, row))

    @property
    def level(self) -> bool:
        """Whether the ground is."""
        return not np.ptp(self.floor)

    def ground(self, x: Array, y: Array) -> Array:
        """See Moving; that of the nearest place beyond those that are recorded."""
        near = [np.clip(v, a[0], a[-1]) for v, a in ((x, self.floor_x), (y, self.floor_y))]
        return np.asarray(self._heights(np.stack(near, axis=-1)))

    def frames(self, points: Array, periods: int, samples: int) -> "RecordedFrames":
        """See Moving."""
        return RecordedFrames(self, points, np.arange(periods * samples + 1) / samples)

    def _frame(self, weights: "Weights", points: Array, phase: float) -> Frame:
        row = self._lap(phase)[1] * PHASES
        place = weights(_between(self.place, row))
        growth, wave = (weights(_between(values, row)) for values in (self.growth, self.wave))
        centres, headings = self._poses(np.array([phase]))
        centre, heading = centres[:, 0], float(headings[0])
        start, before = self._pose(row)
        place[:2] -= start[:, None]
        place = turned(place, heading - before)
        place[:2] += centre[:, None]
        still = np.zeros_like(place)
        still[:2] = points - self.middle[:, None]
        still = turned(still, heading)
        still[:2] += centre[:, None]
        time = float(self.times[0] + phase * self.period)
        return Frame(time, place, still, growth, wave, centre, heading)

    def _counted(self, phase: float) -> float:
        """A phase of the wave as one of the record, which may begin at any; within it if it repeats."""
        if not self.repeats:
            return phase
        return float((phase - self.times[0] / self.period) % self.periods)

    def _lap(self, phase: float) -> tuple[int, float]:
        """Whole repetitions before a phase, and the phase within the recorded periods."""
        if not self.repeats:
            if not 0 <= phase <= self.periods * (1 + 1e-9):
                raise ValueError(f"phase = {phase:g}: must be in [0, {self.periods}], the periods kept")
            return 0, min(phase, float(self.periods))
        lap = int(np.floor(phase / self.periods + 1e-9))
        return lap, max(phase - lap * self.periods, 0.0)

    def _pose(self, row: float) -> tuple[Array, float]:
        """Centre (2,) and heading within the record."""
        return _between(self.centre, row), float(_between(self.heading, row))

    @property
    def _turn(self) -> float:
        """By which the sheet turns in all that is recorded."""
        return float(self.heading[-1] - self.heading[0])

    def _poses(self, phases: Array) -> tuple[Array, Array]:
        """Centres (2, k) and headings (k,) at phases."""
        step = complex(*(self.centre[-1] - self.centre[0]))
        turn = np.exp(1j * self._turn)
        first = complex(*self.centre[0])
        centres, headings = [], []
        for phase in phases:
            lap, inside = self._lap(float(phase))
            centre, heading = self._pose(inside * PHASES)
            before = sum(step * turn**k for k in range(lap))
            at = first + before + turn**lap * (complex(*centre) - first)
            centres.append((at.real, at.imag))
            headings.append(heading + lap * self._turn)
        return np.array(centres).T, np.array(headings)

    def inside(self, points: Array) -> "tuple[NDArray[np.bool_], Weights]":
        """Which of some points (2, k) of the plane are in the undeformed sheet, and their weights."""
        finder, corners = self._finder
        found, local = finder(*points)
        return found >= 0, Weights(corners[:, found], np.stack([1 - local.sum(0), *local]))

    def _weights(self, points: Array) -> "Weights":
        if points is self.points:
            return Weights(np.arange(points.shape[1])[None], np.ones((1, points.shape[1])))
        return self.inside(points)[1]

    @cached_property
    def _heights(self) -> Any:
        return RegularGridInterpolator((self.floor_x, self.floor_y), self.floor)

    @cached_property
    def _finder(self) -> tuple[TriangleFinder, Integers]:
        """With the corners (3, m) in the order of its local coordinates."""
        mesh = MeshTri(self.points, self.triangles.T.copy(), validate=False)
        return TriangleFinder(mesh), np.asarray(mesh.t, np.int64)


class RecordedFrames:
    """See `moving.Frames`."""

    def __init__(self, recording: Recording, points: Array, phases: Array) -> None:
        self._recording, self._points, self._phases = recording, points, phases
        self._weights = recording._weights(points)

    def __len__(self) -> int:
        return int(self._phases.size)

    def __iter__(self) -> Iterator[Frame]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, index: int) -> Frame:
        phase = float(self._phases[index])
        return self._recording._frame(self._weights, self._points, phase)


class Weights:
    """Values at points from those at vertices: corners and weights (1 or 3, points)."""

    def __init__(self, corners: Integers, weights: Array) -> None:
        self._corners, self._weights = corners, weights

    def __call__(self, values: Array) -> Array:
        """Values (..., vertices) at the points."""
        return np.asarray((values[..., self._corners] * self._weights).sum(-2))


def _between(values: Array, row: float) -> Array:
    """Linearly between rows."""
    first = min(int(np.floor(row + 1e-9)), len(values) - 1)
    share = max(row - first, 0.0)
    if share < 1e-9 or first + 1 == len(values):
        return np.array(values[first], float)
    return np.asarray((1 - share) * values[first] + share * values[first + 1])

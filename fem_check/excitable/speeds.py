"""Speeds of a sheet under a wave that does not repeat: one for each of its cycles."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.drives import CycleWave
from fem_check.excitable.excitation import Excitation
from fem_check.excitable.solution import SHARE
from linear_theory.balance.crawl import Crawl, first_resolution
from linear_theory.common import validation
from linear_theory.common.progress import track
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.common.shown import with_error
from linear_theory.common.tables import SPEED, TIME, Column, Tabular
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.load_cases import Snapshots
from linear_theory.deformation.ritz import RitzField, ritz_field
from linear_theory.line.piece import Piece
from linear_theory.line.samples import speeds_at
from linear_theory.scene.level import THEORY
from linear_theory.scene.scene import Scene
from linear_theory.wave.places import on_axis
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

FEWEST, LONGEST, DOUBLINGS, POINTS = 8, 4.0, 4, 4
"""Panels of a cycle at least, their largest length in units of time, how often they are doubled at
most, and Gauss points of each. c changes within a few units of time, and dry friction faster."""

CHANCE = 2.0
"""Of the last change. A change may be small by chance: a quarter of the one before counts as well."""

CELLS, MOST_CELLS = 128, 2048
"""Cells of a line at first and at most."""

BODIES = ("sheet", "line")


class Mean(NamedTuple):
    """Mean velocity along y over a cycle, and the error of the velocities, length/time."""

    value: float
    error: float


Velocities = Callable[[CycleWave, Array], tuple[Array, float]]
"""Velocities (T,) at times of a cycle, and their largest error by space."""


@dataclass(frozen=True, eq=False)
class CycleSpeeds(Tabular):
    """Mean velocity along y in each cycle of a wave, which need not be the same from cycle to cycle.

    cycles: their numbers; start, period: units of time; mean, error: velocity averaged over the cycle
    and its estimated error (numerical, and of the wave), length/time; model: assumptions, in words.
    settled: whether the last two agree within their errors: only then is there one speed.
    """

    cycles: NDArray[np.int64]
    start: Array
    period: Array
    mean: Array
    error: Array
    model: str

    @property
    def settled(self) -> bool:
        """Whether the last two speeds agree within their errors."""
        if self.mean.size < 2:
            return False
        return bool(abs(self.mean[-1] - self.mean[-2]) <= self.error[-1] + self.error[-2])

    @property
    def displacement(self) -> Array:
        """Per cycle, units of length."""
        return self.mean * self.period

    def _title(self) -> str:
        if not self.mean.size:
            return "CycleSpeeds: no cycle"
        last = with_error(float(self.mean[-1]), float(self.error[-1]))
        words = "settled" if self.settled else "NOT settled: no single speed"
        return f"CycleSpeeds: {self.mean.size} cycles, the last {last} length/time, {words}"

    def _rows(self) -> Mapping[str, Any]:
        rows = {
            str(k): f"{with_error(float(v), float(e))} in a cycle of {p:.4g}"
            for k, v, e, p in zip(self.cycles, self.mean, self.error, self.period, strict=True)
        }
        return {**rows, "model": self.model}

    def _columns(self) -> Sequence[Column]:
        return [
            Column("start", self.start, "start of the cycle", TIME),
            Column("period", self.period, "duration of the cycle", TIME),
            Column("mean", self.mean, "mean velocity along y", SPEED),
            Column("error", self.error, "its estimated error", SPEED),
        ]


@one_blas_thread
def speeds(
    scene: Scene, periods: Iterable[int] | None = None, rtol: float = 1e-2, body: str = "sheet"
) -> CycleSpeeds:
    """Speed of a flat sheet in each cycle of its wave, an `Excitation`, by the small-strain theory.

    The shape follows the wave at once, so that the velocity depends on c and dc/dt at the same time
    only, and its mean over a cycle has a meaning whether the wave repeats or not.
    periods: numbers of the cycles, all by default. rtol: of each mean, or of |alpha| times the growth
    rate where that vanishes. body: "sheet", or "line" for the one-dimensional body of its length, at
    any strain, with the growth law of the scene.

    Raises ValueError for a scene with another wave, for effects beyond the theory and for cycles that
    there are not.

    >>> from fem_check import excitable_preset, speeds
    >>> from linear_theory import Scene, Sheet
    >>> wave = excitable_preset("nu = -0.1").on(Sheet(), until=200.0, rtol=1e-2)
    >>> found = speeds(Scene(Sheet(), wave, alpha=0.1, growth_law="linear"), body="line")
    >>> print((found.displacement * 1e3).round(1), found.settled)
    [-14.9 -16.3 -15.1] False
    """
    wave = validation.instance("scene", scene, Scene).wave
    body = validation.choice("body", body, BODIES)
    if not isinstance(wave, Excitation):
        raise ValueError(
            f"wave = {validation.shown(wave)}: must be an Excitation, made by "
            "FitzHughNagumo(...).on(sheet, until)"
        )
    THEORY.require(scene)
    rtol = validation.tolerance(rtol)
    numbers = range(wave.cycles.count) if periods is None else [wave.cycle(k).number for k in periods]
    law = _on_line(scene) if body == "line" else _on_sheet(scene, rtol)
    found = [_cycle_mean(law, wave.cycle(k), rtol, _small(scene)) for k in track("cycles", numbers)]
    picked = np.array(numbers, dtype=np.int64)
    words = f"{body}, small strain" if body == "sheet" else "body on a line"
    return CycleSpeeds(
        picked,
        wave.cycles.start[picked],
        wave.cycles.period[picked],
        np.array([mean.value for mean in found]),
        np.array([mean.error for mean in found]),
        f"{words}, {scene.contact.load} load, {scene.contact.friction.words}",
    )


def _small(scene: Scene) -> float:
    """Below rtol times this, speeds are not resolved relative to themselves."""
    return 1e-2 * scene.alpha**2 * scene.unit


def _cycle_mean(law: Velocities, cycle: CycleWave, rtol: float, small: float) -> Mean:
    """By composite Gauss rules of twice as many panels until they agree."""
    panels = max(FEWEST, math.ceil(cycle.period / LONGEST))
    last, space = _average(law, cycle, panels)
    before = math.inf
    for _ in range(DOUBLINGS):
        panels *= 2
        mean, space = _average(law, cycle, panels)
        apart = abs(mean - last)
        in_time, before = CHANCE * max(apart, min(before, 16 * apart) / 4), apart
        last = mean
        if in_time <= rtol / 2 * max(abs(mean), small):
            break
    other, _ = _average(law, cycle.coarser, panels)
    return Mean(mean, in_time + space + SHARE * abs(other - mean))


def _average(law: Velocities, cycle: CycleWave, panels: int) -> tuple[float, float]:
    nodes, weights = gauss_legendre(POINTS)
    shares = (np.arange(panels)[:, None] + (nodes + 1) / 2) / panels
    velocity, error = law(cycle, cycle.period * shares.ravel())
    return float(np.tile(weights, panels) / (2 * panels) @ velocity), error


def _on_line(scene: Scene) -> Velocities:
    """Of the one-dimensional body, on cells that are doubled until the mean no longer changes."""
    length, piece = scene.sheet.length, Piece.of(scene.growth.law, scene.contact.load, "line")
    law = scene.contact.friction.scaled(length)

    def velocities(cycle: CycleWave, times: Array) -> tuple[Array, float]:
        on_line = drive(cycle, scene.sheet, on_axis(length))
        cells = CELLS
        coarse = speeds_at(on_line, scene.alpha, law, piece, times, cells)
        while True:
            fine = speeds_at(on_line, scene.alpha, law, piece, times, 2 * cells)
            error = abs(float(np.mean(fine - coarse)))
            if error <= 1e-3 * float(np.mean(abs(fine))) or cells >= MOST_CELLS:
                return length * fine, length * error
            cells, coarse = 2 * cells, fine

    return velocities


def _on_sheet(scene: Scene, rtol: float) -> Velocities:
    """Of the sheet in small-strain theory, by Ritz."""

    def velocities(cycle: CycleWave, times: Array) -> tuple[Array, float]:
        field = ritz_field(scene.sheet, cycle, rtol=max(0.1 * rtol, 1e-4))
        known = RitzField(field.drive, field.solver, Snapshots(field.drive, times))
        crawl = Crawl(known, scene.alpha, scene.contact, first_resolution(rtol))
        motion = crawl.balance(times)
        errors = crawl.quadrature_errors(times, motion).counted
        found = crawl.counted(motion)[1]
        return found, float(errors[1]) * float(np.mean(abs(found)) / max(abs(found).max(), 1e-300))

    return velocities

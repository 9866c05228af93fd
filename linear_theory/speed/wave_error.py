"""What the error of a wave that is not known exactly does to the speed.

A wave with an `uncertainty` (see `linear_theory.wave.uncertain`) offers others that could as well be
the true one. The speed is found for RESAMPLES of them, all with one coarse resolution, so that
differences to that of the given wave are free of its error; FACTOR times their root mean square is the
error. That takes friction as it is, not linearised, and counts the bias of noise, too, in speeds that
are quadratic in the wave.

A speed of the sheet takes the theory of small strain for the differences, whatever it is found by: what
counts is how V depends on c, of order alpha. It costs RESAMPLES + 1 balances, at most, at a few dozen
times.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl, first_resolution
from linear_theory.common import validation
from linear_theory.common.progress import track
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.load_cases import Snapshots
from linear_theory.deformation.ritz import RitzField, ritz_field
from linear_theory.motion.rigid import RigidNorm
from linear_theory.scene.level import THEORY
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed, Estimate
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import drive
from linear_theory.wave.uncertain import Uncertainty, doubt_of, error_words, uncertainty_of

Array = NDArray[np.float64]
Mean = Callable[[Wave], Array]
"""Means of V_x, V_y, Omega and the power of friction (4,) for a wave, by one resolution for all."""

RESAMPLES, FACTOR = 16, 3.5
"""Student's t with 16 degrees of freedom: 99.7 % of errors are within so many root mean squares."""

LEAST_SHARE = 0.01
"""Of c, by which waves are moved: smaller errors are scaled up, beyond what the resolution hides."""

HALVINGS = 6
"""Of a scale with which waves are moved so far that the sheet would vanish somewhere."""

COARSE, FEWEST_TIMES, MOST_TIMES = 3e-2, 24, 128
"""Tolerance of fields and cells for differences, and times per period."""

LARGEST_GROWTH = 0.3
"""|alpha c| up to which differences are found; beyond, they are scaled up with alpha."""

OF_WAVE = 0.1
"""Share of the error of the wave that the numbers may have: less would be in vain."""


class WaveError(NamedTuple):
    """Mean motion of the given wave, coarsely, and what the error of the wave does to it, (3,) each.

    power: what it does to the power of friction.
    """

    mean: Array
    error: Array
    power: float

    def leaves(self, tolerance: Tolerance, norm: RigidNorm) -> Tolerance:
        """Of the tolerance what the numbers may take, and OF_WAVE in any case."""
        size, error = norm.size(self.mean), norm.size(self.error)
        goal = max(tolerance.allowed(size) - error, OF_WAVE * error)
        rtol = goal / size if goal < OF_WAVE * size else OF_WAVE
        return Tolerance(max(rtol, validation.SMALLEST_RTOL), goal)

    def joins(self, found: CrawlSpeed, tolerance: Tolerance, norm: RigidNorm) -> CrawlSpeed:
        """The speed with this error in its own."""
        along = float(self.error[1])
        estimate = Estimate(found.mean, found.error + along)
        turning = found.turning
        if turning is not None:
            turning = replace(turning, error=turning.error + self.error)
            converged = norm.meets(turning.mean, turning.error, tolerance)
        else:
            converged = estimate.error <= tolerance.allowed(estimate.value)
        energy = found.energy
        return replace(
            found,
            energy=None if energy is None else energy.in_doubt(self.power),
            estimate=estimate,
            turning=turning,
            wave_error=along,
            converged=found.converged and converged,
        )


def wave_error(uncertainty: Uncertainty, wave: Wave, mean: Mean) -> WaveError:
    """The error of speeds that `mean` finds."""
    given, scale = mean(wave), max(1.0, LEAST_SHARE / uncertainty.share)
    for _ in range(HALVINGS):
        try:
            return _error(given, _spread(uncertainty, mean, given, scale))
        except ValueError:  # growth that no sheet could follow, where samples leave a wave wide open
            scale /= 2
    return _error(given, _spread(uncertainty, mean, given, scale))


def _error(given: Array, spread: Array) -> WaveError:
    return WaveError(given[:3], spread[:3], float(spread[3]))


def _spread(uncertainty: Uncertainty, mean: Mean, given: Array, scale: float) -> Array:
    """Error of the means by waves that are moved by `scale` times the error of the wave."""
    others = uncertainty.waves(RESAMPLES, scale)
    moved = np.stack([mean(other) for other in track("the error of the wave", others)])
    return np.asarray(FACTOR / scale * np.sqrt(np.mean((moved - given) ** 2, axis=0)))


def with_wave_error(
    scene: Scene, tolerance: Tolerance, solve: Callable[[Tolerance], CrawlSpeed]
) -> CrawlSpeed:
    """The speed by `solve`, with what the error of the wave does to it.

    That is not known of scenes that are beyond the theories of a flat rectangle, nor of waves that are
    in doubt: `model` says so.
    """
    return doubted(_with_wave_error(scene, tolerance, solve), scene.wave)


def doubted(found: CrawlSpeed, wave: Wave) -> CrawlSpeed:
    """The speed, not converged if the wave is in doubt."""
    doubt = doubt_of(wave)
    return replace(found, model=f"{found.model}; wave: {doubt}", converged=False) if doubt else found


def _with_wave_error(
    scene: Scene, tolerance: Tolerance, solve: Callable[[Tolerance], CrawlSpeed]
) -> CrawlSpeed:
    uncertainty = uncertainty_of(scene.wave)
    if uncertainty is None or scene.alpha == 0:
        return solve(tolerance)
    if THEORY.objections(scene):
        found = solve(tolerance)
        model = f"{found.model}; the {error_words(scene.wave)} is NOT counted"
        return replace(found, model=model, converged=False)
    tolerance = tolerance.of_speed(scene.alpha, scene.unit)
    scene.drive.check()
    norm = _norm(scene)
    error = _known_error(uncertainty, scene)
    return error.joins(solve(error.leaves(tolerance, norm)), tolerance, norm)


_LAST: "WeakKeyDictionary[Wave, tuple[object, WaveError]]" = WeakKeyDictionary()
"""Of each wave: sheet, growth and contact that it was last asked for, and the error."""


def _known_error(uncertainty: Uncertainty, scene: Scene) -> WaveError:
    """The error, found once for all levels that `predict` asks in turn."""
    question = scene.sheet, scene.alpha, scene.contact
    try:
        last = _LAST.get(scene.wave)
    except TypeError:  # a wave of a user that cannot be hashed
        return wave_error(uncertainty, scene.wave, _Coarse.of(scene).mean)
    if last is None or last[0] != question:
        last = question, wave_error(uncertainty, scene.wave, _Coarse.of(scene).mean)
        _LAST[scene.wave] = last
    return last[1]


def _norm(scene: Scene) -> RigidNorm:
    gyration = math.hypot(scene.sheet.width, scene.sheet.length) / math.sqrt(12)
    return RigidNorm(gyration, scene.drive.mirrored)


class _Coarse(NamedTuple):
    """Small strain with polynomials of one degree, at the same times and cells for all waves."""

    scene: Scene
    alpha: float
    times: Array
    field: RitzField

    @classmethod
    @one_blas_thread
    def of(cls, scene: Scene) -> "_Coarse":
        found = ritz_field(scene.sheet, scene.wave, rtol=COARSE)
        times = equidistant_times(scene)
        largest = float(abs(scene.extremes).max())
        alpha = math.copysign(min(abs(scene.alpha), LARGEST_GROWTH / largest), scene.alpha)
        return cls(scene, alpha, times, found)

    @one_blas_thread
    def mean(self, wave: Wave) -> Array:
        """Means at the growth of the scene."""
        driven = drive(wave, self.scene.sheet)
        times = self.times * (driven.period / self.scene.period)
        field = RitzField(driven, self.field.solver, Snapshots(driven, times))
        crawl = Crawl(field, self.alpha, self.scene.contact, first_resolution(COARSE))
        motion = crawl.balance(times)
        works = motion.works[:, 0] + self.alpha * motion.works[:, 1]
        means = [*crawl.counted(motion).mean(1), abs(self.alpha) * works.mean()]
        return np.array(means) * (self.scene.alpha / self.alpha)


def equidistant_times(scene: Scene) -> Array:
    """Times of a period that resolve the wave."""
    highest = scene.drive.rates.highest(0.1)
    count = min(max(FEWEST_TIMES, 5 * min(highest, MOST_TIMES)), MOST_TIMES)
    return np.asarray(scene.period / count * np.arange(int(count)))

"""The largest stretch that growth asks for.

A wave that travels takes every point of the sheet through all of its phases: the largest growth is
that of its profile, whose turning values are known to rounding. Any other wave is surveyed over the
sheet and a period, and the highest places of the survey are climbed from.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from fem_check.optimisation.objectives import OfScene
from linear_theory.common.estimate import Estimate
from linear_theory.line.profile import Profile
from linear_theory.line.roots import EPS
from linear_theory.optimisation.problem import Unusable
from linear_theory.scene.scene import Scene
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

FEWEST, PER_WAVE, MOST, TIMES = 33, 6, 129, 48
"""Points of the survey along a side of the sheet, and times of a period."""

CLIMBS = 3
"""From the highest places of the survey that are apart."""


@dataclass(frozen=True)
class Stretch(OfScene):
    """The largest that growth asks for, at any point and time: 1.1 is a tenth longer.

    Of a sheet of another outline it is that of the rectangle around it.

    >>> from fem_check.optimisation.options.stretch import Stretch
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> print(f"{Stretch().of_scene(Scene(Sheet(), SineWave(), alpha=0.1)).value:.6f}")
    1.105171
    """

    name: ClassVar[str] = "stretch"
    unit: ClassVar[str] = ""

    def of_scene(self, scene: Scene) -> Estimate:
        """See OfScene. Raises `Unusable` where growth leaves the range of its law."""
        largest, error = largest_growth(scene.drive, -1.0 if scene.alpha < 0 else 1.0)
        ends = abs(scene.alpha) * np.array([largest, largest - error, largest + error])
        with np.errstate(invalid="ignore"):
            value, low, high = np.asarray(scene.growth.law.stretch(ends), float)
        if not np.isfinite([value, low, high]).all():
            raise Unusable("stretch: growth leaves the range of its law")
        return Estimate(float(value), float(max(value - low, high - value) + 4 * EPS * value))


def largest_growth(drive: Drive, sign: float) -> Estimate:
    """Largest value of sign c at any point of the sheet and any time; sign: 1 or -1.

    >>> from fem_check.optimisation.options.stretch import largest_growth
    >>> from linear_theory import Sheet, pulse_wave
    >>> print(f"{largest_growth(pulse_wave(0.02).on(Sheet()), 1.0).value:.9f}")
    1.000000000
    """
    if drive.series is None:
        return _surveyed(drive.alone, sign)
    profile, mean = Profile.of(drive.series, sign), sign * drive.series.mean
    error = 8 * EPS * (profile.scale + abs(mean))
    return Estimate(mean + float(profile.values.max()), error)


def _surveyed(drive: Drive, sign: float) -> Estimate:
    """The error is what the climbs have added to the survey."""
    half = np.array([drive.sheet.width, drive.sheet.length]) / 2
    counts = [min(max(FEWEST, PER_WAVE * waves + 1), MOST) for waves in drive.short_waves]
    x, y = (np.linspace(-size, size, count) for size, count in zip(half, counts, strict=True))
    axes = (drive.period / TIMES * np.arange(TIMES), x, y)
    values = sign * drive.value(x[:, None], y, axes[0][:, None, None])
    values = np.broadcast_to(values, tuple(map(len, axes)))
    unit = np.array([drive.period, *half])

    def lower(place: Array) -> float:
        t, at_x, at_y = unit * place
        return -sign * float(drive.value(at_x, at_y, t))

    found = best = float(values.max())
    for place in _highest(values):
        start = np.array([axis[i] for axis, i in zip(axes, place, strict=True)]) / unit
        around = [(start[0] - 1, start[0] + 1), (-1.0, 1.0), (-1.0, 1.0)]
        climbed = minimize(lower, start, method="L-BFGS-B", bounds=around)
        best = max(best, -float(climbed.fun))
    return Estimate(best, best - found + 1e-9 * float(abs(values).max()))


def _highest(values: Array) -> list[tuple[int, ...]]:
    """Places of the highest values, (times, x, y), of which none is next to another."""
    found: list[tuple[int, ...]] = []
    left = values.copy()
    for _ in range(CLIMBS):
        place = tuple(map(int, np.unravel_index(int(left.argmax()), left.shape)))
        found.append(place)
        near = [slice(max(i - 2, 0), i + 3) for i in place]
        left[tuple(near)] = -np.inf
    return found

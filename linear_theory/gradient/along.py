"""Derivatives of a motion along directions, from its sensitivities at every point.

Of a motion known over half a period by its reversal in time, V(t_0 - t) = V(t), what a change dc(y, t)
does in the other half is what dc(-y, t_0 - t) does in this one: the mean of both is taken.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl
from linear_theory.gradient.direction import Direction, GrowthChange, Harmonic
from linear_theory.gradient.sensitivity import Sensitivity
from linear_theory.wave.fractional import count_of

Array = NDArray[np.float64]


def along(at: Sensitivity, times: Array, directions: Sequence[Direction], crawl: Crawl) -> Array:
    """Derivatives of quantities at times (T,), (k, directions, T).

    The alpha of the load counts, too: that of `at.alpha`.
    """
    found = np.zeros((at.alpha.shape[0], len(directions), times.size))
    laws, maps = iter(at.laws), iter(at.maps)
    waves = _Waves(at, times, directions, crawl)
    for p, d in enumerate(directions):
        slip = d.alpha / crawl.alpha - d.slip - d.period
        found[:, p] = d.alpha * at.alpha + slip * at.slip
        found[:, p] += d.width * at.width + d.poisson * at.poisson
        for harmonic in d.harmonics:
            found[:, p] += waves.by(harmonic)
        if d.growth is not None:
            found[:, p] += _by_growth(at, times, d.growth, crawl)
        if d.law is not None:
            found[:, p] += next(laws)
        if d.map is not None:
            found[:, p] += next(maps)
    return found


def _by_growth(at: Sensitivity, times: Array, change: GrowthChange, crawl: Crawl) -> Array:
    x, y, t = at.x[:, None], at.y, times[:, None, None]
    shape = times.size, at.x.size, at.y.size
    value, rate = (np.broadcast_to(f(x, y, t), shape) for f in (change.value, change.rate))
    if (reversal := crawl.reversal_time) is not None:
        value = (value + change.value(x, -y, reversal - t)) / 2
        rate = (rate - change.rate(x, -y, reversal - t)) / 2
    return np.einsum("ktxy,txy->kt", at.value, value) + np.einsum("ktxy,txy->kt", at.rate, rate)


class _Waves:
    """Sensitivities to harmonics of a travelling wave, by products of functions of y and of t."""

    def __init__(
        self, at: Sensitivity, times: Array, directions: Sequence[Direction], crawl: Crawl
    ) -> None:
        ks = sorted({one.k for d in directions for one in d.harmonics})
        self._place = {k: i for i, k in enumerate(ks)}
        if not ks:
            return
        wave, self._reversal = crawl.drive.wave, crawl.reversal_time
        self._frequency = 2 * np.pi / wave.period
        angle = np.multiply.outer(2 * np.pi * count_of(wave) / crawl.field.sheet.length * at.y, ks)
        turn = np.multiply.outer(self._frequency * times, ks)
        cosine, sine = np.cos(turn), np.sin(turn)
        # of cos(k phi), sin(k phi) = (even or odd in y) times (cosine or sine in t)
        self._parts = []
        for one in (at.value.sum(2), at.rate.sum(2)):
            even, odd = one @ np.cos(angle), one @ np.sin(angle)
            self._parts.append((even * cosine + odd * sine, odd * cosine - even * sine))

    def by(self, harmonic: Harmonic) -> Array:
        """(k, T)."""
        k, a, b = harmonic
        if self._reversal is not None:
            shift = k * self._frequency * self._reversal
            a, b = (
                (a * (1 + np.cos(shift)) - b * np.sin(shift)) / 2,
                (b * (1 - np.cos(shift)) - a * np.sin(shift)) / 2,
            )
        (cosine, sine), (cosine_rate, sine_rate) = (
            (part[0][..., self._place[k]], part[1][..., self._place[k]]) for part in self._parts
        )
        rate = k * self._frequency * (a * sine_rate - b * cosine_rate)
        return np.asarray(a * cosine + b * sine + rate)

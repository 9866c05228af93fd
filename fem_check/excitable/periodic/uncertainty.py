"""How far the true wave may be from a solution: along the difference to a coarser one."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.periodic.nodal import NodalWave
from linear_theory.common.shown import Shown
from linear_theory.wave.measured.polynomial import PolynomialWave
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]

PHASES, POINTS = 48, 65


@dataclass(frozen=True, eq=False)
class OrbitUncertainty(Shown):
    """Of a periodic orbit: shape and period differ from the true ones as from those of a coarser mesh.

    share of that difference counts; see `linear_theory.wave.uncertain`.
    """

    wave: PolynomialWave | NodalWave
    other: PolynomialWave | NodalWave
    part: float

    def _contents(self) -> Mapping[str, Any]:
        return {"share": self.share}

    @property
    def words(self) -> str:
        """What the error is."""
        return "numerical error of the excitable wave"

    @property
    def share(self) -> float:
        """Root mean square of the error of c over that of c."""
        c, apart = (self._sampled(scale) for scale in (0.0, 1.0))
        return float(max(np.sqrt(np.mean((apart - c) ** 2) / np.mean(c**2)), 1e-12))

    def waves(self, count: int, scale: float = 1.0) -> list[Wave]:
        """Two waves, moved along the difference by `part` times `scale` either way.

        In this one direction two have the variance of any number of normal random multiples.
        """
        return [self._moved(shift) for shift in (-scale, scale)[:count]]

    def _moved(self, shift: float) -> "Wave":
        amount, known = self.part * shift, self.wave.period
        period = known * np.exp(amount * (known - self.other.period) / known)
        return _Between(self.wave, self.other, amount, float(period))

    def _sampled(self, scale: float) -> Array:
        along = np.linspace(-0.5, 0.5, POINTS)
        moved = self._moved(scale)
        low, high = self._range()
        y = low + (high - low) * (along + 0.5)
        return moved.value(0 * y, y, moved.period * np.arange(PHASES)[:, None] / PHASES)

    def _range(self) -> tuple[float, float]:
        if isinstance(self.wave, NodalWave):
            y = self.wave.space.nodes[1]
            return float(y.min()), float(y.max())
        return self.wave.basis.along


class _Between(Shown):
    """wave + amount (wave - other) at the same phase, with a period of its own."""

    def __init__(self, wave: Any, other: Any, amount: float, period: float) -> None:
        self.wave, self.other, self.amount, self.period = wave, other, amount, period

    def _contents(self) -> Mapping[str, Any]:
        return {"amount": self.amount, "period": self.period}

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast."""
        phase = np.asarray(t) / self.period
        one, other = (w.value(x, y, w.period * phase) for w in (self.wave, self.other))
        return np.asarray(one + self.amount * (one - other))

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt likewise."""
        phase = np.asarray(t) / self.period
        waves = self.wave, self.other
        one, other = (w.period / self.period * w.rate(x, y, w.period * phase) for w in waves)
        return np.asarray(one + self.amount * (one - other))

"""How far the wave of a fit may be from the true one, as waves that fit the samples as well."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.wave.measured.fit import Fit
from linear_theory.wave.measured.polynomial import PolynomialWave

Array = NDArray[np.float64]

SEED = 20240607

COHERENT = 2.0
"""A part that was missed may move as one wave, which crawls faster than random functions do."""


@dataclass(frozen=True, eq=False)
class FitUncertainty(Shown):
    """Of a fitted wave: the covariance of its coefficients and the error of its period.

    wave: as fitted. larger: a fit with some of the functions that were dropped, whose coefficients are
    as uncertain as those that were kept: what is dropped is below the noise, not known to be 0. noise:
    of one sample; missed: root mean square of a part of the wave that the fit missed, which may be any
    of these functions (see `misfit`); count: of the samples; size: root mean square of c; period_error:
    standard error.
    """

    wave: PolynomialWave
    larger: Fit
    noise: float
    missed: float
    count: int
    size: float
    period_error: float

    @property
    def words(self) -> str:
        """What the error is."""
        return "noise of the measured wave"

    def _rows(self) -> Mapping[str, Any]:
        functions = {"basis": self.wave.basis, "larger": self.larger.basis}
        return {"share": self.share, "noise": self.noise, "missed": self.missed, **functions}

    @property
    def share(self) -> float:
        """Root mean square of the error of c over that of c, at the samples."""
        fit = self.noise * np.sqrt(self.larger.basis.size / self.count)
        return float(
            np.hypot(np.hypot(fit, self.missed) / self.size, self.period_error / self.wave.period)
        )

    def waves(self, count: int, scale: float = 1.0) -> list[PolynomialWave]:
        """The fitted wave with coefficients and period moved by their errors, times `scale`."""
        shifts = self._shifts(count)
        return [self._moved(scale * shift[:-1], scale * shift[-1]) for shift in shifts]

    def _shifts(self, count: int) -> Array:
        """Errors of the coefficients and, last, of the period, (count, size + 1)."""
        from scipy.linalg import solve_triangular  # here: scipy takes long to import

        size = self.larger.basis.size
        random = np.random.default_rng(SEED)
        normal = random.standard_normal((count, size + 1))
        coefficients = self.noise * solve_triangular(self.larger.factor, normal[:, :-1].T).T
        still = size // self.larger.basis.shape[0]  # what was missed varies in time
        missed = random.standard_normal((count, size - still)) / np.sqrt(max(size - still, 1))
        coefficients[:, still:] += COHERENT * self.missed * missed
        return np.concatenate([coefficients, self.period_error * normal[:, -1:]], axis=1)

    def _moved(self, shift: Array, later: float) -> PolynomialWave:
        basis = self.larger.basis.lasting(self.wave.period * np.exp(later / self.wave.period))
        coefficients = self._embedded + shift.reshape(basis.shape)
        return PolynomialWave(basis, coefficients, self.wave.margins)

    @cached_property
    def _embedded(self) -> Array:
        return self.wave.basis.embed(self.wave.coefficients, self.larger.basis)

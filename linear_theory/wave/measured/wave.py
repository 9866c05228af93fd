"""A wave of growth from measured samples, as smooth as their noise asks for."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.progress import Report, watched
from linear_theory.common.shown import Shown
from linear_theory.identity import content_key
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.measured.bounds import most
from linear_theory.wave.measured.checks import check_covered, margin, numbers_asked
from linear_theory.wave.measured.choice import chosen
from linear_theory.wave.measured.doubts import doubts, remarks
from linear_theory.wave.measured.error import FitUncertainty
from linear_theory.wave.measured.fit import Fit, fitted
from linear_theory.wave.measured.misfit import EXACT, MOST_OF, Misfit
from linear_theory.wave.measured.period import estimated, refined
from linear_theory.wave.measured.polynomial import PolynomialDrive, PolynomialWave
from linear_theory.wave.measured.samples import NAMES, Samples
from linear_theory.wave.measured.sources import Sources
from linear_theory.wave.places import Places

Array = NDArray[np.float64]

MORE = (1, 1, 2), (1, 0, 1), (1, 0, 0), (0, 0, 1)
"""Harmonics and degrees (across, along) that were dropped, but that the error of the wave counts: the
first for which there are enough samples."""

LARGEST_PART = 2 / 3
"""Functions of the larger fit for each sample, at the most."""


class SampledWave(Sources, Shown):
    """A wave c(y, t), or c(x, y, t), from samples with noise: SampledWave(y, t, c) or (x, y, t, c).

    x, y: in the coordinates of the sheet (origin at its centre, units of its length), which they must
    cover; t: units of time, over one period or more. c: on the grid of their values, axes in that order
    (of any spacing), or scattered, all of one shape.
    period: units of time; None to find it (see `measured.period`). harmonics, degree (along, or
    (across, along)): numbers of the functions that c is fitted by, harmonics in time times polynomials
    in space; None to choose what the noise leaves by cross-validation (see `measured.choice`).
    progress: True prints on stderr, a function is called with a `Progress`; samples of c(x, y, t) take
    seconds.

    The wave is that fit by least squares: analytic, of exactly that period. What is dropped says
    `dropped`. noise: standard deviation of a sample; residual: root mean square of what the fit leaves.
    Speeds count the error of the wave in theirs (`uncertainty`), as if the errors of the samples were
    independent and all of one size: drift and outliers are not seen. So do they what the fit may have
    `missed`; where that is much, `doubt` says why, and speeds are not converged.

    Raises ValueError, with what to do, for shapes that do not fit, values that are not finite, too few
    samples and a period that is not covered.

    >>> import numpy as np
    >>> from linear_theory import SampledWave, line_balance
    >>> y, t = np.linspace(-0.5, 0.5, 40), np.arange(20) / 20
    >>> c = np.sin(2 * np.pi * (y[:, None] - t)) + 0.02 * np.random.default_rng(1).normal(size=(40, 20))
    >>> wave = SampledWave(y, t, c, period=1.0)
    >>> print(wave.harmonics, f"{wave.noise:.2f}")
    1 0.02
    >>> speed = line_balance(wave, alpha=0.25, length=1.0)  # of the sine: 0.0601
    >>> print(abs(speed.mean - 0.0601) < speed.error < 0.01)
    True
    """

    def __init__(
        self,
        *samples: ArrayLike,
        period: float | None = None,
        harmonics: int | None = None,
        degree: int | tuple[int, int] | None = None,
        progress: bool | Report | None = None,
    ) -> None:
        if len(samples) not in (3, 4):
            raise ValueError(f"{len(samples)} arrays: must be y, t, c or x, y, t, c")
        with watched(progress, type(self).__name__):
            self._fit_to(samples, period, harmonics, degree)

    def _fit_to(self, samples: tuple[Any, ...], period: Any, harmonics: Any, degree: Any) -> None:
        names = NAMES[4 - len(samples) :]
        self._given = {n: np.array(a) for n, a in zip((*names, "c"), samples, strict=True)}
        self._asked = {"period": period, "harmonics": harmonics, "degree": degree}
        data = Samples.of({n: samples[i] for i, n in enumerate(names)}, samples[-1])
        wanted = numbers_asked(harmonics, degree, data.x is not None)
        first = estimated(data) if period is None else validation.positive("period", period)
        basis = _chosen_basis(data, first, wanted)
        self.period_error = 0.0
        if period is None:
            first, self.period_error = refined(data, basis)
            basis = _chosen_basis(data, first, wanted)
        self._period, self._fit = first, fitted(data, basis)
        self._larger = self._fit_with_more(data)
        self._misfit = Misfit.of(data, self._fit)
        self._doubt = "; ".join(doubts(data, self._fit, self._misfit))
        self._remarks = "; ".join(remarks(data, self._fit, self._given["c"].size - data.size))
        self._margins = tuple(margin(v) for v in (data.x, data.y))
        self._size = float(np.sqrt(np.mean(data.c**2)))
        self._count = data.size

    @property
    def period(self) -> float:
        """Units of time."""
        return self._period

    @property
    def harmonics(self) -> int:
        """In time, of the fit."""
        return self._fit.basis.harmonics

    @property
    def degree(self) -> tuple[int, int]:
        """Of the polynomials across and along."""
        return self._fit.basis.degree

    @property
    def noise(self) -> float:
        """Standard deviation of a sample, as estimated from what the fit leaves."""
        return self._fit.noise

    @property
    def residual(self) -> float:
        """Root mean square of what the fit leaves of the samples."""
        return self._fit.residual

    @property
    def dropped(self) -> str:
        """What was left out of the samples, in words."""
        degrees = f"degree {self.degree[1]} along"
        if self._fit.basis.degree[0] or "x" in self._given:
            degrees = f"degree {self.degree[0]} across and {self.degree[1]} along"
        share = self.residual / self._size if self._size else 0.0
        what = f"rms {self.residual:.3g}, {_per_cent(share)} of c"
        if self._misfit.dropped > MOST_OF:
            what += (
                f"; that is MOST of the wave, {_per_cent(self._misfit.dropped)} of its variance in time"
            )
        return f"all above harmonic {self.harmonics} and {degrees}: {what}"

    @property
    def missed(self) -> float:
        """Root mean square of what of the wave the fit may have missed, see `measured.misfit`."""
        return self._misfit.missed

    @property
    def doubt(self) -> str:
        """Why no speed of this wave is converged, in words; empty if there is no such reason."""
        return self._doubt

    @property
    def remarks(self) -> str:
        """What else is odd about the samples, in words."""
        return self._remarks

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The samples know the sheet: `length` has no effect."""
        return self.smooth.value(x, y, t)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt, exact; x, y, t broadcast. `length` has no effect."""
        return self.smooth.rate(x, y, t)

    def on(self, sheet: Sheet, places: Places | None = None) -> PolynomialDrive:
        """The wave on a body within that rectangle; places: of another outline, see `protocol.Wave`."""
        return PolynomialDrive(self.smooth, sheet, places)

    @cached_property
    def smooth(self) -> PolynomialWave:
        """The fit alone, without the samples and their noise."""
        return PolynomialWave(self._fit.basis, self._fit.coefficients, self._margins)

    @property
    def uncertainty(self) -> FitUncertainty | None:
        """How far the true wave may be; None where nothing but roundoff was dropped."""
        if max(self.noise, self.missed) <= EXACT * self._size and not self.period_error:
            return None
        return FitUncertainty(
            self.smooth,
            self._larger,
            self.noise,
            self.missed,
            self._count,
            self._size,
            self.period_error,
        )

    def _fit_with_more(self, data: Samples) -> Fit:
        """With MORE functions, as far as the samples can tell them."""
        largest, numbers = most(data, self._period), (self.harmonics, *self.degree)
        for extras in MORE:
            more = [
                max(n, min(n + extra, top))
                for n, extra, top in zip(numbers, extras, largest, strict=True)
            ]
            basis = self._fit.basis.but(more[0], (more[1], more[2]))
            if basis.size <= LARGEST_PART * data.size:
                with suppress(ValueError):  # scattered samples may not tell them apart
                    return fitted(data, basis)
        return self._fit

    def identified_by(self) -> object:
        """What its content key is made of."""
        return self._given, self._asked

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SampledWave):
            return NotImplemented
        return self is other or content_key(self) == content_key(other)

    def __hash__(self) -> int:
        return hash((self._period, self._count, self.noise))

    def _contents(self) -> Mapping[str, Any]:
        return {**self._given, "asked": list(self._asked.values()), **self._rows()}

    def _rows(self) -> Mapping[str, Any]:
        words = " x ".join(map(str, self._given["c"].shape))
        error = {"period_error": self.period_error} if self.period_error else {}
        found = {"samples": words, "period": self.period, **error, "harmonics": self.harmonics}
        found |= {"degree": self.degree, "noise": self.noise, "dropped": self.dropped}
        odd = {"DOUBTFUL": self.doubt, "remarks": self.remarks}
        return found | {name: words for name, words in odd.items() if words}

    @classmethod
    def from_data(cls, asked: Sequence[Any], **data: Any) -> "SampledWave":
        """The wave of what `to_dict` has written; asked: period, harmonics and degree."""
        period, harmonics, degree = asked
        named = [name for name in (*NAMES, "c") if name in data]
        samples = [validation.real_array(name, data[name]) for name in named]
        return cls(*samples, period=period, harmonics=harmonics, degree=degree)


def _per_cent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 0.99 else f"{100 * share:.0f} %"


def _chosen_basis(data: Samples, period: float, wanted: tuple[int | None, ...]) -> Basis:
    check_covered(data, period)
    harmonics, across, along = chosen(data, period, wanted)
    return Basis.over(data, period, harmonics, (across, along))

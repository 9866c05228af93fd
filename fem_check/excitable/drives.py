"""Solutions of the equation as waves on a body: the drives that levels read."""

import math
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import Places
from linear_theory.wave.sampled import SampledDrive
from linear_theory.wave.spectrum import Spectrum

if TYPE_CHECKING:
    from fem_check.excitable.record import Record
    from fem_check.excitable.solution import Solution

Array = NDArray[np.float64]

POINTS, FEWEST, SPACING = 48, 64, 0.5
"""Points, number of times and their distance, for the spectrum of dc/dt."""

SAME = 1e-9
"""Relative difference of lengths that count as the same."""


class ExcitationDrive(SampledDrive):
    """A solution on the body that it was solved on; its rates are those of all the time it is known."""

    wave: "Solution | CycleWave"

    def __init__(
        self, wave: "Solution | CycleWave", sheet: Sheet, places: Places | None = None
    ) -> None:
        super().__init__(wave, sheet, places)
        check_body(wave.body, wave.equation.start.depends_on_x, sheet)

    @property
    def mirrored(self) -> bool:  # type: ignore[override]
        """Whether c does not depend on x: a rectangle with such a start."""
        return not self.depends_on_x

    @cached_property
    def depends_on_x(self) -> bool:
        """Whether c was solved for in the plane."""
        return not isinstance(self.wave.body, Sheet) or self.wave.equation.start.depends_on_x

    @property
    def changes_sign(self) -> bool:
        """Never: it does not repeat."""
        return False

    @cached_property
    def rates(self) -> Spectrum:
        """Spectrum of dc/dt, faded in and out, since the ends of the time do not fit together."""
        span = self.wave.known
        count = max(FEWEST, 2 * math.ceil(span / SPACING))
        shares = (np.arange(count) + 0.5) / count
        fade = math.sqrt(8 / 3) * np.sin(np.pi * shares) ** 2  # of mean square 1
        x, y = self.x[:POINTS], self.y[:POINTS]
        rate = self.rate(x, y, span * shares[:, None]) * fade[:, None]
        power = 2 * np.mean(abs(np.fft.rfft(rate, axis=0) / count) ** 2, axis=1)
        harmonics = np.ceil(np.arange(power.size) * self.period / span - 1e-9).astype(int)
        return Spectrum(np.sqrt(np.bincount(np.maximum(harmonics, 1), power)[1:]), 0.0)

    def check_period(self) -> None:
        """Raise ValueError unless the last cycles are alike: a mean over a period has no meaning
        else."""
        self.wave.check_repeats()

    def check_until(self, end: float) -> None:
        """Raise ValueError unless c is known up to that time."""
        self.wave.check_until(end)

    def _check_rate(self) -> None:
        """Nothing to check: the rate is the derivative of the interpolation."""


def check_body(body: Any, depends_on_x: bool, sheet: Sheet) -> None:
    """Raise ValueError for another body than that of the wave."""
    sides = ("length", "width") if depends_on_x or not isinstance(body, Sheet) else ("length",)
    for side in sides:
        known, asked = getattr(body, side), getattr(sheet, side)
        if not np.isclose(known, asked, rtol=SAME, atol=0):
            raise ValueError(
                f"wave: was solved on a body of {side} {known:.6g}, but that of the sheet is "
                f"{asked:.6g}; solve the equation on this sheet"
            )


class CycleWave(Shown):
    """One cycle of a solution: c(x, y, start + t) for 0 <= t <= period, which need not repeat."""

    def __init__(
        self,
        whole: "Solution",
        start: float,
        period: float,
        number: int,
        record: "Record | None" = None,
    ) -> None:
        self.whole, self.start, self._period, self.number = whole, start, period, number
        self._record = whole._fine if record is None else record

    def _contents(self) -> Mapping[str, Any]:
        return {"whole": self.whole, "start": self.start, "period": self.period, "number": self.number}

    @property
    def equation(self) -> Any:
        """That of the whole solution."""
        return self.whole.equation

    @property
    def body(self) -> Any:
        """Likewise."""
        return self.whole.body

    @property
    def period(self) -> float:
        """Duration of the cycle, units of time."""
        return self._period

    @property
    def known(self) -> float:
        """Time for which c is known, from 0 on."""
        return self._period

    @property
    def coarser(self) -> "CycleWave":
        """The same time of the coarser solution."""
        return CycleWave(self.whole, self.start, self._period, self.number, self.whole._pair.coarse)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The body is known: `length` has no effect."""
        return self._record.value(x, y, self.start + np.asarray(t))

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt likewise."""
        return self._record.rate(x, y, self.start + np.asarray(t))

    def on(self, sheet: Sheet, places: Places | None = None) -> ExcitationDrive:
        """The wave on a body within that rectangle."""
        return ExcitationDrive(self, sheet, places)

    def check_repeats(self) -> None:
        """Raise ValueError unless the whole solution repeats."""
        self.whole.check_repeats()

    def check_until(self, end: float) -> None:
        """Raise ValueError unless c is known up to that time."""
        self.whole.check_until(self.start + end)

"""Solutions of the equation as waves on a body: the drives that levels read."""

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import Places
from linear_theory.wave.sampled import SampledDrive

if TYPE_CHECKING:
    from fem_check.excitable.excitation import Excitation

Array = NDArray[np.float64]

SAME = 1e-9
"""Relative difference of lengths that count as the same."""


class ExcitationDrive(SampledDrive):
    """A solution on the body that it was solved on; its spectra are those of its first cycle."""

    wave: "Excitation | CycleWave"

    def __init__(
        self, wave: "Excitation | CycleWave", sheet: Sheet, places: Places | None = None
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

    def check_period(self) -> None:
        """Raise ValueError unless the last cycles are alike: a mean over a period has no meaning else."""
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

    def __init__(self, whole: "Excitation", start: float, period: float, number: int) -> None:
        self.whole, self.start, self._period, self.number = whole, start, period, number

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

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The body is known: `length` has no effect."""
        return self.whole.value(x, y, self.start + np.asarray(t))

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt likewise."""
        return self.whole.rate(x, y, self.start + np.asarray(t))

    def on(self, sheet: Sheet, places: Places | None = None) -> ExcitationDrive:
        """The wave on a body within that rectangle."""
        return ExcitationDrive(self, sheet, places)

    def check_repeats(self) -> None:
        """Raise ValueError unless the whole solution repeats."""
        self.whole.check_repeats()

    def check_until(self, end: float) -> None:
        """Raise ValueError unless c is known up to that time."""
        self.whole.check_until(self.start + end)

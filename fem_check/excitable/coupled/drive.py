"""A wave that the strain acts back on, as scenes have it: what is known of it before it is followed."""

from typing import TYPE_CHECKING, Never

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.coupled.followed import FollowedWave
from linear_theory.wave.places import Places
from linear_theory.wave.protocol import Drive
from linear_theory.wave.spectrum import Spectrum

if TYPE_CHECKING:
    from fem_check.excitable.solution import Solution
    from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

REFUSAL = (
    "wave: the strain acts back on it (StrainFeedback), so that c is known together with the motion "
    "only; take `simulate`, or equation.but(feedback=None)"
)
"""Of all that take c as given."""


class FeedbackDrive(Drive):
    """Size, spectrum and shortest waves are those of the wave on which nothing acts back."""

    has_state = True
    wave: "Solution"

    def __init__(self, wave: "Solution", sheet: "Sheet", places: Places | None = None) -> None:
        super().__init__(wave, sheet)
        self._alone: Drive = wave.alone.on(sheet, places)

    @property
    def alone(self) -> Drive:
        """Without the feedback."""
        return self._alone

    def followed(self, coarse: bool = False) -> "FollowedDrive":
        """See Drive."""
        return FollowedDrive(self, coarse)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Never:
        """Raises ValueError: c is not known yet."""
        raise ValueError(REFUSAL)

    rate = value

    @property
    def changes_sign(self) -> bool:
        """Never: it does not repeat."""
        return False

    @property
    def depends_on_x(self) -> bool:
        """Always: strains do."""
        return True

    @property
    def size(self) -> float:
        """Root mean square of c without feedback."""
        return self._alone.size

    @property
    def rates(self) -> Spectrum:
        """Likewise the spectrum of dc/dt."""
        return self._alone.rates

    @property
    def short_waves(self) -> tuple[int, int]:
        """Likewise."""
        return self._alone.short_waves

    @property
    def waves_along(self) -> int:
        """Likewise."""
        return self._alone.waves_along

    def degree_along(self, share: float) -> float:
        """Likewise."""
        return self._alone.degree_along(share)

    def growths(self, x: Array, y: Array) -> Array:
        """Likewise."""
        return self._alone.growths(x, y)

    def check_period(self) -> None:
        """Raise ValueError: there is no period to average over."""
        raise ValueError(REFUSAL)

    def check_until(self, end: float) -> None:
        """Raise ValueError unless the equation was asked for up to that time."""
        self._alone.check_until(end)


class FollowedDrive(FeedbackDrive):
    """The drive of one run, with the wave as far as that has come: see `FollowedWave`."""

    def __init__(self, drive: FeedbackDrive, coarse: bool) -> None:
        super().__init__(drive.wave, drive.sheet)
        self._alone = drive.alone
        self.course = FollowedWave.of(drive.wave, coarse)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:  # type: ignore[override]
        """c at points and times up to that of the run, and one step beyond."""
        return self.course.value(x, y, t)

"""Errors of the mean speed of a motion, and the further runs that tell them."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from linear_theory.common.shown import Shown

FURTHER = {
    "mesh": "on a coarser mesh",
    "snaps": "with other steps",
    "feedback": "with a rougher wave",
    "contact": "with a narrower gap between layers",
}
"""What differs in the further run that tells a part of the error, by the name in `SpeedErrors`; its
task in words."""


class _Doubt(NamedTuple):
    speed: float = math.nan
    power: float = math.nan


class Doubt(Shown, _Doubt):
    """Errors that a further run tells: of the mean speed, and of the power over mu times the weight
    (`Energy`); length per time, NaN where it tells nothing, infinite where it failed."""


FAILED, NO_DOUBT = Doubt(math.inf, math.inf), Doubt()


class _Further(NamedTuple):
    mesh: Doubt = NO_DOUBT
    snaps: Doubt = NO_DOUBT
    feedback: Doubt = NO_DOUBT
    contact: Doubt = NO_DOUBT
    growth: float = math.nan


class Further(Shown, _Further):
    """What the further runs tell, by the names of `FURTHER`; growth: error of c, by feedback."""

    @property
    def power(self) -> float:
        """Error of the power by all of them."""
        return float(np.nansum([getattr(self, name).power for name in FURTHER]))


NO_FURTHER = Further()
"""Of a motion without further runs."""


class _Errors(NamedTuple):
    step: float
    spread: float
    mesh: float
    slip_speed: float
    snaps: float
    feedback: float = np.nan
    contact: float = np.nan


class SpeedErrors(Shown, _Errors):
    """Estimated errors of the mean speed, absolute, length per time.

    step: of the time integration; what is left where its estimate was removed, see `mean_speed`.
    spread: difference between the last two periods, NaN if there is only one. mesh: from a run on a
    coarser mesh if requested, else NaN. slip_speed: distance to dry friction, twice the change on
    halving the slip speed (it decreases at least proportionally), NaN if the slip ratio is above 0.3
    and friction far from dry; not part of the error of the speed at the given slip speed. snaps: of the
    way that a sheet took which may take another one in the last period (see `may_branch`), from a run
    with other steps; NaN if there is none. feedback: of a wave that the strain acts back on, by its
    own error and the steps, from a run with longer steps and larger elements of the wave; NaN without.
    contact: of a sheet that touched itself in the last period, by the gap of `SelfContact`, from a run
    with a tenth of the gap; NaN if it did not. A part is infinite where the run that would have told it
    failed, see `failed`.
    """

    @property
    def failed(self) -> str:
        """Which of the further runs failed, in words; empty if none did."""
        return failed_words(self._asdict())


def failed_words(errors: Mapping[str, float]) -> str:
    """Which further runs failed, for parts of the error by name; empty if none did.

    >>> from fem_check.shell.stepping.further.errors import failed_words
    >>> print(failed_words({"step": 0.1, "mesh": float("inf"), "snaps": float("inf")}))
    the runs on a coarser mesh and with other steps failed
    >>> failed_words({"step": 0.1, "mesh": float("nan")})
    ''
    """
    named = [words for name, words in FURTHER.items() if math.isinf(errors.get(name, math.nan))]
    if not named:
        return ""
    *before, last = named
    listed = f"{', '.join(before)} and {last}" if before else last
    return f"the run{'s' * bool(before)} {listed} failed"

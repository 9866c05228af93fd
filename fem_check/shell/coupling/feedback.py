"""The wave of a run and the strains that it is told, for waves that these act back on."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.coupled.drive import FollowedDrive
from fem_check.excitable.coupled.followed import FollowedWave
from fem_check.shell.coupling.dilation import Dilation
from fem_check.shell.model import ShellModel

Array = NDArray[np.float64]

COMPARED = 65
"""Times at which two runs are compared."""


class Feedback:
    """Nothing, for a wave that is a function of time.

    past: what a run returns to, with its history, after an interruption.
    """

    past: Any = None

    @classmethod
    def of(cls, model: ShellModel) -> "Feedback":
        """For the wave of a model."""
        return _OnStrain(model, model.drive.course) if isinstance(model.drive, FollowedDrive) else cls()

    def begin(self, state: Array) -> None:
        """Take the unknowns of the sheet at time 0."""

    def accept(self, t: float, state: Array, kept: bool, jumped: bool) -> None:
        """Take them at the end of a step; kept: for good; jumped: in a snap-through."""

    def apart(self, other: "Feedback") -> Array:
        """Differences of c to another run."""
        return np.zeros(1)

    def arrays(self) -> dict[str, Array]:
        """The past of the wave, for a snapshot."""
        return {}

    def restore(self, found: dict[str, Array]) -> None:
        """The past from those arrays."""


class _OnStrain(Feedback):
    """Feedback of tr ε at the nodes of the wave."""

    def __init__(self, model: ShellModel, wave: FollowedWave) -> None:
        self.wave, self.dilation = wave, Dilation(model.discretisation, wave.places)

    @property
    def past(self) -> Any:
        """The course of the wave, which is replaced, never changed."""
        return self.wave.course

    @past.setter
    def past(self, course: Any) -> None:
        self.wave.course = course

    def begin(self, state: Array) -> None:
        """See Feedback."""
        self.wave.begin(self.dilation.at(state))

    def accept(self, t: float, state: Array, kept: bool, jumped: bool) -> None:
        """See Feedback."""
        self.wave.accept(t, self.dilation.at(state), kept, jumped)

    def apart(self, other: Feedback) -> Array:
        """See Feedback: at the nodes and COMPARED times, (COMPARED, n)."""
        assert isinstance(other, _OnStrain)
        times = np.linspace(0.0, self.wave.time, COMPARED)
        x, y = self.wave.places
        pair = [np.stack([w.value(x, y, t) for t in times]) for w in (self.wave, other.wave)]
        return np.asarray(pair[0] - pair[1])

    def arrays(self) -> dict[str, Array]:
        """See Feedback."""
        return self.wave.arrays()

    def restore(self, found: dict[str, Array]) -> None:
        """See Feedback."""
        self.wave.restore(found)

"""Scene files of comparisons, read, and answered as `sheetcrawl speed` answers them."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from fem_check.choice.result import Prediction
from fem_check.choice.solving import solve
from fem_check.files import read
from figures.validation.comparison import SCENES
from linear_theory import Estimate, Scene
from linear_theory.common.errors import ViscousRegimeWarning


def scene_of(name: str) -> Scene:
    """What stands in a file of SCENES."""
    return read(SCENES / name).scene


def answer(name: str | Path, rtol: float | None = None) -> Prediction:
    """To a file of SCENES, or another one, by the level that stands in it; rtol: instead of its own."""
    said = read(SCENES / name)
    run = said.run
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)
        return solve(
            said.scene,
            run.level,
            run.rtol if rtol is None else rtol,
            periods=run.periods,
            steps=run.steps if rtol is None else None,
        )


@dataclass(frozen=True)
class BySceneFiles:
    """Speeds of scene files, one number each, by the level and to the tolerance that stand in them.

    unit: what they are divided by; coarse: tolerance of the cheap form.
    """

    names: tuple[str, ...]
    coarse: float
    unit: float = 1.0

    def full(self) -> Sequence[Estimate]:
        """See Calculation."""
        return [self._number(answer(name)) for name in self.names]

    def cheap(self) -> Sequence[Estimate]:
        """See Calculation."""
        return [self._number(answer(name, self.coarse)) for name in self.names]

    def _number(self, found: Prediction) -> Estimate:
        return Estimate(found.mean / self.unit, found.error / self.unit)

    @property
    def inputs(self) -> str:
        """See Calculation."""
        return f"speeds {self.names} {self.unit!r}"

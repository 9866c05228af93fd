"""The record of every accepted step."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.stepping.power import Works
from fem_check.shell.stepping.sliding import Sliding

Array = NDArray[np.float64]

COLUMNS = (
    "time",
    *("centre_x", "centre_y", "centre_z"),
    *Works._fields,
    *("fastest", "linear", "step_x", "step_y", "slip_x", "slip_y"),
    *("iterations", "repeats", "buckled", "snapped"),
)
"""time and centre at the end of the step; increments of each of `power.Works`; `sliding.Sliding` at its
end; `Counts`."""


class Counts(NamedTuple):
    """Newton iterations, minimisations, whether negative curvature was met, and whether the sheet
    jumped: the step does not resolve its motion."""

    iterations: int = 0
    repeats: int = 0
    buckled: bool = False
    snapped: bool = False


NO_COUNTS = Counts()


@dataclass
class Record:
    """Rows of COLUMNS, one for the start and one per accepted step, and some of the states.

    probes: positions (points, components) of a few points, for each row. times, states: of the kept
    states. rejected: steps repeated because of their error or because no minimum was found.
    """

    rows: list[Array] = field(default_factory=list)
    probes: list[Array] = field(default_factory=list)
    times: list[float] = field(default_factory=list)
    states: list[Array] = field(default_factory=list)
    rejected: int = 0

    def add(
        self,
        time: float,
        centre: Array,
        works: Works,
        slide: Sliding,
        probes: Array,
        counts: Counts,
    ) -> None:
        """Append a row; centre (components,)."""
        place = np.zeros(3)
        place[: centre.size] = centre
        numbers = [slide.fastest, slide.linear, *slide.step, *slide.slip, *counts]
        self.rows.append(np.array([time, *place, *(float(w) for w in works), *numbers]))
        self.probes.append(np.array(probes))

    def keep(self, time: float, state: Array) -> None:
        """Append a state."""
        self.times.append(time)
        self.states.append(state)

    def cut(self, rows: int, kept: int) -> None:
        """Drop everything beyond `rows` rows and `kept` states."""
        for entries, count in (
            (self.rows, rows),
            (self.probes, rows),
            (self.times, kept),
            (self.states, kept),
        ):
            del entries[count:]

    @property
    def table(self) -> dict[str, Array]:
        """Columns by name, each (steps + 1,)."""
        return dict(zip(COLUMNS, np.array(self.rows).T, strict=True))

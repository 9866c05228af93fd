"""A sweep in a few numbers."""

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

from fem_check.sweeps.records.record import Record, State
from fem_check.sweeps.records.result import Sweep
from linear_theory.common.shown import Shown


@dataclass
class Summary(Shown):
    """Counts of different scenes, the range of their speeds, and processor seconds.

    missed: answers that miss their tolerance. failures: by state. first_failure: where, and why.
    """

    scenes: int = 0
    answered: int = 0
    missed: int = 0
    open: int = 0
    failures: Counter[str] = field(default_factory=Counter)
    first_failure: str = ""
    lowest: float = math.inf
    highest: float = -math.inf
    seconds: float = 0.0

    def add(self, record: Record, where: str) -> None:
        """A record, and the point that it is of, in words."""
        self.seconds += record.cpu_seconds or 0.0
        if record.state != State.ANSWERED:
            self.failures[record.state] += 1
            self.first_failure = self.first_failure or f"{where}: {record.reason}"
            return
        self.answered += 1
        self.missed += not record.converged
        if record.mean is not None:
            self.lowest, self.highest = min(self.lowest, record.mean), max(self.highest, record.mean)


def summary(sweep: Sweep) -> Summary:
    """Of all its records."""
    found, seen = Summary(scenes=sum(sweep.counts.values())), set()
    found.open = sweep.counts.get("open", 0)
    for point, record in sweep.rows():
        if record is not None and record.key not in seen:
            seen.add(record.key)
            found.add(record, _where(sweep, point))
    return found


def _where(sweep: Sweep, point: tuple[Any, ...]) -> str:
    if not sweep.axes:
        return f"scene {point[0]}"
    said = (
        f"{axis.path} = {value}{axis.unit and ' '}{axis.unit}"
        for axis, value in zip(sweep.axes, point, strict=True)
    )
    return ", ".join(said)

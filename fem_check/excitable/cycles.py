"""The cycles of a solution: how long they last, how far they are alike, and how the phase runs along
y."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.record import Record
from fem_check.excitable.space import Body
from linear_theory.common.tables import TIME, Column, Tabular

Array = NDArray[np.float64]

STATIONS, PHASES = 33, 48
"""Points along y, and phases of a cycle, at which cycles are compared."""

FAINT = 0.05
"""Share of the largest range of c, below which the late part of a solution does not oscillate."""

LATE = 0.5
"""Share of the time that sets the level of crossings."""


@dataclass(frozen=True, eq=False)
class Cycles(Tabular):
    """One entry for each cycle, from one rise of c through `level` at the rear end to the next one.

    start, period: units of time. low, high: of c. lag: cycles by which the phase at the front end is
    behind that at the rear, > 0 for a phase wave towards +y; over the length it is the mean phase
    gradient. NaN where some part of the body has no rise within the cycle. drift: largest difference of
    c to the cycle before at the same phase, NaN for the first one. level: c.

    >>> from fem_check import excitable_preset
    >>> from linear_theory import Sheet
    >>> cycles = excitable_preset("printed").on(Sheet(), until=120.0, rtol=1e-2).cycles
    >>> print(cycles.period.round(1), cycles.lag.round(1))
    [20.9 27.7 28.6 28.9] [nan 0.5 0.6 0.6]
    """

    start: Array
    period: Array
    low: Array
    high: Array
    lag: Array
    drift: Array
    level: float

    @property
    def count(self) -> int:
        """Whole cycles."""
        return int(self.start.size)

    @property
    def relative_drift(self) -> Array:
        """drift over the range of c in the cycle."""
        return self.drift / (self.high - self.low)

    def in_words(self, repeats: bool, length: float) -> str:
        """Period or that there is none, phase gradient and drift of the last cycle."""
        if not self.count:
            return "no cycle, no period"
        last = f"{self.period[-1]:.4g}"
        if self.count == 1:
            return f"one cycle of {last}; whether it repeats is not known"
        drift = f"c drifts by {100 * self.relative_drift[-1]:.2g} % a cycle"
        start = f"period {last}" if repeats else f"not periodic, last cycle {last}"
        return f"{start}; {drift}; lag {self.lag[-1] / length:.2g} cycles per length"

    def _title(self) -> str:
        return f"Cycles: {self.count}"

    def _columns(self) -> Sequence[Column]:
        return [
            Column("start", self.start, "start of the cycle", TIME),
            Column("period", self.period, "duration of the cycle", TIME),
            Column("low", self.low, "smallest c", "1"),
            Column("high", self.high, "largest c", "1"),
            Column("lag", self.lag, "phase lag of the front end, in cycles", "1"),
            Column("drift", self.drift, "largest change of c since the cycle before", "1"),
        ]


def cycles_of(record: Record, body: Body) -> Cycles:
    """The cycles along the middle line x = 0 of a body (of the nearest points, beside a hole)."""
    y = np.linspace(-body.length / 2, body.length / 2, STATIONS)
    x, times = np.zeros_like(y), record.times
    c = record.value(x, y, times[:, None])
    late = c[times >= LATE * times[-1]]
    level = float(late.max() + late.min()) / 2
    rises = [_rises(record, (x[i], y[i]), c[:, i], level) for i in range(STATIONS)]
    if np.ptp(late, axis=0).max() < FAINT * np.ptp(c) or rises[0].size < 2:
        none = np.empty(0)
        return Cycles(none, none, none, none, none, none, level)
    start, period = rises[0][:-1], np.diff(rises[0])
    phases = np.arange(PHASES) / PHASES
    seen = record.value(x, y, (start[:, None] + period[:, None] * phases)[..., None])
    drift = np.append(np.nan, abs(np.diff(seen, axis=0)).max(axis=(1, 2)))
    lag = np.array([_lag(rises, *pair) for pair in zip(start, period, strict=True)])
    return Cycles(start, period, seen.min((1, 2)), seen.max((1, 2)), lag, drift, level)


def _rises(record: Record, point: tuple[float, float], c: Array, level: float) -> Array:
    """Times at which c rises through the level at a point."""
    before = np.flatnonzero((c[:-1] < level) & (c[1:] >= level))
    early, late = record.times[before], record.times[before + 1]
    t = early + (level - c[before]) / (c[before + 1] - c[before]) * (late - early)
    for _ in range(3):  # Newton, from the chord
        rate = record.rate(*point, t)
        step = np.where(rate > 0, (record.value(*point, t) - level) / np.where(rate > 0, rate, 1), 0)
        t = np.clip(t - step, early, late)
    return np.asarray(t)


def _lag(rises: list[Array], start: float, period: float) -> float:
    """Cycles between the rise at the rear end and that at the front end which belongs to it.

    From station to station the nearest rise is followed.
    """
    follow = start
    for station in rises:
        if not station.size:
            return np.nan
        nearest = station[abs(station - follow).argmin()]
        if abs(nearest - follow) > period / 2:
            return np.nan
        follow = nearest
    return float((follow - start) / period)

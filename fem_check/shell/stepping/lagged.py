"""The quantities that a step holds fixed, iterated until they agree with the state that they lead to.

Load, areas and normals are functions of the position without a potential: a step is a fixed point
x = g(x) of "hold x fixed, minimise, evaluate". Plain repetition contracts for a flat sheet; it diverges
for one that stands on few points, whose load shifts as friction tilts it. Anderson's mixing (J. ACM
12:547, 1965) takes the combination of the last repetitions whose residuals g(x) - x cancel best. It
equals plain repetition for the first two, so that easy steps cost what they did.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.rates import Step

Array = NDArray[np.float64]

NAMES = ("load", "area", "normal")
"""Entries of a Step that are held fixed."""

DEPTH = 5
"""Repetitions that are combined: about the number of soft motions of a sheet on a few points."""

RECENT, PROGRESS = 3, 0.5
"""Repetitions that must reduce the change to this fraction of the smallest before them."""


class Mixing:
    """Combines the repetitions of one step; keeps those of the last DEPTH."""

    def __init__(self) -> None:
        self._values: list[Array] = []
        self._residuals: list[Array] = []
        self._changes: list[float] = []

    def stalls(self, changed: float) -> bool:
        """Whether repetition is of no use, after one more with that `change`."""
        self._changes.append(changed)
        late, early = self._changes[-RECENT:], self._changes[:-RECENT]
        return len(early) >= RECENT - 1 and min(late) > PROGRESS * min(early)

    def next(self, held: Step, found: Step) -> Step:
        """What to hold fixed next, if holding `held` led to `found`."""
        units = _units(found)
        value, image = _packed(held, units), _packed(found, units)
        self._values = [*self._values[-DEPTH:], value]
        self._residuals = [*self._residuals[-DEPTH:], image - value]
        return _unpacked(self._mixed(), found, units)

    def _mixed(self) -> Array:
        value, residual = self._values[-1], self._residuals[-1]
        if len(self._values) < 3:
            return value + residual
        moved, changed = (np.diff(np.array(v), axis=0).T for v in (self._values, self._residuals))
        weights = np.linalg.lstsq(changed, residual, rcond=1e-6)[0]
        return np.asarray(value + residual - (moved + changed) @ weights)


def change(before: Step, after: Step) -> float:
    """Largest relative change of the quantities held fixed in two steps, summed over the points."""
    pairs = [(getattr(before, name), getattr(after, name)) for name in NAMES]
    return max((_relative(old, new) for old, new in pairs if old is not None), default=0.0)


def _relative(before: Array, after: Array) -> float:
    """Sum of absolute changes over the sum of absolute new values; 0 if nothing changes."""
    moved, size = float(np.abs(after - before).sum()), float(np.abs(after).sum())
    if moved == 0:
        return 0.0
    return moved / size if size > 0 else np.inf


def _units(step: Step) -> dict[str, float]:
    """Of the quantities that the step holds: sums of absolute values, 1 where that is 0."""
    held = {name: getattr(step, name) for name in NAMES}
    return {name: float(np.abs(v).sum()) or 1.0 for name, v in held.items() if v is not None}


def _packed(step: Step, units: dict[str, float]) -> Array:
    return np.concatenate([getattr(step, name).ravel() / unit for name, unit in units.items()])


def _unpacked(values: Array, like: Step, units: dict[str, float]) -> Step:
    """A step with these values; a load that pushes everywhere goes on doing so."""
    found: dict[str, Any] = {}
    start = 0
    for name, unit in units.items():
        old = getattr(like, name)
        new = values[start : start + old.size].reshape(old.shape) * unit
        found[name] = np.maximum(new, min(0.0, float(old.min()))) if name == "load" else new
        start += old.size
    return replace(like, **found)

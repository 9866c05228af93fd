"""The frames of a film of two motions: one below the other, on one ground, clock and scale."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.film.stage import Stage
from fem_check.output.moving import Moving

Pixels = NDArray[np.uint8]


class Race:
    """Two stages as one.

    movings: two motions, the first one above; names: how each is called in the picture; periods: of the
    first, of `frames` frames each; stage: of both. Colours, ground and time are those of both, so that
    equal lengths on the page are equal lengths, and frames of one picture of one time after the start.
    """

    def __init__(
        self,
        movings: Sequence[Moving],
        names: Sequence[str],
        units: Units,
        periods: int,
        frames: int,
        width: int,
        stage: type[Stage],
    ) -> None:
        self._total = periods * frames
        step = movings[0].period / frames
        self._stages, self._orders = [], []
        for moving, name in zip(movings, names, strict=True):
            samples = max(2, round(moving.period / step))
            order = np.rint(np.arange(self._total) * step * samples / moving.period).astype(int)
            needed = max(1, math.ceil((int(order[-1]) + 1) / samples))
            self._stages.append(stage(moving, units, needed, samples, width, 1.0, name))
            self._orders.append(order.tolist())
        Stage.joined(self._stages)

    def __len__(self) -> int:
        return self._total

    def pictures(self) -> Iterator[Pixels]:
        """RGB pictures (height, width, 3)."""
        both: Any = (one.pictures(order) for one, order in zip(self._stages, self._orders, strict=True))
        for upper, lower in zip(*both, strict=True):
            yield np.concatenate([upper, lower])

"""What the effects of a scene cost: seconds and evaluations of each, while a meter runs."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from linear_theory.common.shown import Shown


@dataclass
class Meter(Shown):
    """Seconds spent in each effect, and how often it was asked, by the name of its class."""

    seconds: dict[str, float] = field(default_factory=dict)
    calls: dict[str, int] = field(default_factory=dict)

    def add(self, name: str, seconds: float) -> None:
        """One evaluation."""
        self.seconds[name] = self.seconds.get(name, 0.0) + seconds
        self.calls[name] = self.calls.get(name, 0) + 1


_running: ContextVar[Meter | None] = ContextVar("meter", default=None)


@contextmanager
def metered() -> Iterator[Meter]:
    """Count what is evaluated in the block, in this thread.

    >>> from fem_check import Material, Membrane, Scene, cycle_speed
    >>> from fem_check.shell.statics.meter import metered
    >>> from linear_theory import Sheet, SineWave
    >>> scene = Scene(Sheet(), SineWave(), 0.1, effects=[Membrane(Material(0.03, 0.5))], cells=(1, 2))
    >>> with metered() as meter:
    ...     speed = cycle_speed(scene, rtol=0.1)
    >>> print(*meter.calls, meter.calls["Membrane"] > 16)
    Membrane True
    """
    meter = Meter()
    token = _running.set(meter)
    try:
        yield meter
    finally:
        _running.reset(token)


def asked(effect: Effect, what: str, state: PointState) -> Any:
    """The energy, gradient or hessian of an effect, counted if a meter runs."""
    meter = _running.get()
    if meter is None:
        return getattr(effect, what)(state)
    start = time.perf_counter()
    found = getattr(effect, what)(state)
    meter.add(type(effect).__name__, time.perf_counter() - start)
    return found

"""Settings of a run, checked and normalised."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.stepping.schemes import Scheme
from linear_theory.common import validation
from linear_theory.common.validation import shown

Array = NDArray[np.float64]


LONGER = 0.75
"""Number of equal steps relative to that of a run, above which steps count as no longer than there."""


@dataclass(frozen=True, eq=False)
class Settings:
    """Arguments of `simulate` that determine its results; numpy numbers become plain ones.

    rtol, steps and a step of the scheme: at most one of them; by default rtol is 1e-2. velocity: array
    or None.
    Raises ValueError for values out of range.
    """

    periods: int = 2
    rtol: float | None = None
    steps: int | None = None
    ramp: float = 0.5
    velocity: ArrayLike | None = None
    keep_every: int = 1
    scheme: Scheme | None = None

    def __post_init__(self) -> None:
        self._set("periods", validation.integer("periods", self.periods, 1))
        self._set("keep_every", validation.integer("keep_every", self.keep_every, 1))
        self._set("ramp", validation.real("ramp", self.ramp))
        if self.ramp < 0:
            raise ValueError(f"ramp = {self.ramp:g}: must be >= 0")
        if self.velocity is not None:
            self._set("velocity", np.array(validation.real_array("velocity", self.velocity)))
        if self.scheme is not None:
            hint = "write Newmark() or BackwardDifferences()"
            validation.instance("scheme", self.scheme, Scheme, hint)  # type: ignore[type-abstract]
            if self.scheme.step is not None:
                return self._check_step(self.scheme.step)
        if self.steps is None:
            self._set("rtol", validation.tolerance(1e-2 if self.rtol is None else self.rtol))
            return
        if self.rtol is not None:
            raise ValueError(
                f"steps = {shown(self.steps)}: must be None if rtol = {shown(self.rtol)} is given"
            )
        self._set("steps", validation.integer("steps", self.steps, 4))

    def _check_step(self, step: float) -> None:
        """Raise ValueError if the lengths of the steps are given twice."""
        for name in ("rtol", "steps"):
            if getattr(self, name) is not None:
                raise ValueError(
                    f"{name} = {getattr(self, name)!r}: must be None if the scheme has step = {step:g}"
                )

    def steps_of(self, period: float) -> int | None:
        """Equal steps per period, as given or by the scheme; None if they follow from rtol."""
        step = None if self.scheme is None else self.scheme.step
        return self.steps if step is None else math.ceil(period / step * (1 - 1e-9))

    def with_other_steps(self, fewest: int) -> "Settings":
        """The same with steps about twice as long; a third shorter if the wave allows no longer ones.

        fewest: equal steps per period that resolve the wave.
        """
        if self.rtol is not None:
            return replace(self, rtol=min(2 * self.rtol, 0.9))
        if self.steps is not None:
            longer = max(self.steps // 2, fewest)
            found = longer if longer <= LONGER * self.steps else math.ceil(1.5 * self.steps)
            return replace(self, steps=found)
        assert self.scheme is not None
        assert self.scheme.step is not None
        return replace(self, scheme=replace(self.scheme, step=2 * self.scheme.step))  # type: ignore

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)

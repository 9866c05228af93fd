"""What a friction balance on a line is asked, and what it answers."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory import validation

Array = NDArray[np.float64]

LOADS = ("current", "grown", "material")
FRICTIONS = ("coulomb", "tanh", "viscous")

REST_SPEED = 1e-3
"""Slower than this part of the range of speeds counts as at rest (for `sticks` only)."""

REST_PART = 0.1
"""The body sticks if at least this part of it is at rest. (At the median, sin(phi)^3 has 8 % of the
body at rest in this sense, a sine 0.13 %, a Gaussian pulse train with gaps half of it or more.)"""


@dataclass(frozen=True)
class LineLaw:
    """Load and friction law, checked.

    load: "current" (1 + alpha c; on a line the grown length is the current one, so "grown" is the
    same) or "material" (weight conserved). friction: "coulomb", "tanh" (with its slip_speed > 0,
    length/time) or "viscous". Raises ValueError otherwise.
    """

    load: str = "current"
    friction: str = "coulomb"
    slip_speed: float | None = None

    def __post_init__(self) -> None:
        validation.choice("load", self.load, LOADS)
        validation.choice("friction", self.friction, FRICTIONS)
        if self.friction == "tanh":
            object.__setattr__(self, "slip_speed", validation.positive("slip_speed", self.slip_speed))
        elif self.slip_speed is not None:
            raise ValueError(
                f"slip_speed = {self.slip_speed!r}: must be None for friction={self.friction!r}"
            )

    @property
    def grows(self) -> bool:
        """Whether the load on a piece grows with its length."""
        return self.load != "material"

    def slip_ratio(self, fastest: float) -> float:
        """Slip speed over the largest speed relative to the ground."""
        if self.friction == "coulomb":
            return 0.0
        if self.slip_speed is None or fastest == 0:
            return np.inf
        return self.slip_speed / fastest

    @property
    def words(self) -> str:
        """The assumptions, in words."""
        load = "load on the current length" if self.grows else "weight conserved"
        law = {"coulomb": "dry", "viscous": "viscous"}.get(
            self.friction, f"tanh(v/v0), v0 = {self.slip_speed}"
        )
        return (
            "one-dimensional body, stretch 1 + alpha c, quasi-static, shape not affected by "
            f"friction; {law} friction, {load}"
        )


class Balance(NamedTuple):
    """Speeds of a balanced body: mean and its error, V(t), the largest |velocity| over the ground.

    first, second: coefficients of alpha and alpha^2; sticks: see `CrawlSpeed`.
    """

    mean: float
    error: float
    times: Array
    velocity: Array
    fastest: float
    first: float
    second: float
    sticks: bool

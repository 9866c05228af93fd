"""The numbers of a bending sheet on its ground: rigidity, weight, stiffness of the ground."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.friction.load import Load


@dataclass(frozen=True)
class Foundation(Value):
    """A plate that rests on a ground with pressure stiffness * depth^2 (eq. 2).

    rigidity: D = E h^3/(12 (1 - nu^2)), force times length. weight: rho g, force per area. stiffness: k
    of the ground, force per length^4. load: the reference area of weight and pressure. Raises
    ValueError for numbers that are not positive.

    >>> from linear_theory.deformation.plate import Foundation
    >>> paper = Foundation(rigidity=3e-6, weight=2.5e-4, stiffness=0.5)
    >>> print(round(paper.depth, 4), round(paper.spring, 4), round(paper.layer, 3))
    0.0224 0.0224 0.108
    """

    rigidity: float
    weight: float
    stiffness: float
    load: Load = Load.GROWN

    def __post_init__(self) -> None:
        for name in ("rigidity", "weight", "stiffness"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))
        object.__setattr__(self, "load", Load.named(self.load))

    @property
    def depth(self) -> float:
        """Depth at which the ground carries the flat sheet, sqrt(rho g/k), units of length."""
        return math.sqrt(self.weight / self.stiffness)

    @property
    def spring(self) -> float:
        """s = 2 sqrt(k rho g), the rate of the pressure with the depth there, force per length^3."""
        return 2 * self.stiffness * self.depth

    @property
    def layer(self) -> float:
        """(D/s)^(1/4), the length over which bending spreads a load on the ground."""
        return (self.rigidity / self.spring) ** 0.25


def foundation(effects: Iterable[Any]) -> Foundation:
    """That of the effects of a scene that the level PLATE accepts, from their `plate_numbers`."""
    found: dict[str, Any] = {}
    for effect in effects:
        found |= getattr(effect, "plate_numbers", {})
    return Foundation(**found)

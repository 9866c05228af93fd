"""Forces between distant parts of the sheet, which no sum over its points can represent.

An effect is a sum over points (`Effect`); one that acts between parts of the sheet that are far from
each other along it gives a `Coupling` as well, which acts on all unknowns at once.
"""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Coupling(Protocol):
    """A potential of all unknowns u (size,), with states that it does not let the sheet pass."""

    def begin(self, u: Array) -> None:
        """Forget what earlier states have left: all else then follows from u and what is asked next."""

    def touches(self, u: Array) -> bool:
        """Whether distant parts of the sheet press on each other at u."""

    def energy_and_gradient(self, u: Array) -> tuple[float, Array]:
        """Energy, force times length, infinite where the sheet may not be; its derivative, (size,)."""

    def hessian(self, u: Array, convex: bool = False) -> Any:
        """Second derivative, sparse (size, size); None if it is 0. convex: its semidefinite part."""

    def reach(self, u: Array, change: Array) -> float:
        """Fraction of a change of the unknowns, in [0, 1], up to which the sheet may go from u."""

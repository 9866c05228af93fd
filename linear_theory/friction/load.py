"""What rests on a piece of the sheet: the area by which its weight is counted."""

from collections.abc import Collection
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation

Array = NDArray[np.float64]


class Load(StrEnum):
    """The area that the normal load is proportional to.

    CURRENT, of the deformed sheet (J of eq. 11); GROWN, of the grown reference (appendix A.2);
    MATERIAL, of the undeformed sheet: weight is conserved; GROUND: not weight but the reaction of the
    ground, for sheets in space alone. Raises ValueError for another name.

    >>> import numpy as np
    >>> from linear_theory import Load
    >>> print(Load("grown").rate(dilation=np.array([0.3]), growth=np.array([0.2])))
    [0.4]
    """

    CURRENT = "current"
    GROWN = "grown"
    MATERIAL = "material"
    GROUND = "ground"

    @classmethod
    def named(
        cls, value: object, allowed: "Collection[Load] | None" = None, name: str = "load"
    ) -> "Load":
        """One of WEIGHTS unless other loads are allowed, or of its name. Raises ValueError
        otherwise."""
        return cls(validation.choice(name, value, tuple(WEIGHTS if allowed is None else allowed)))

    def rate(self, dilation: Array, growth: Array) -> Array:
        """e of the load 1 + alpha e per undeformed area, from tr(strain) and c per unit alpha."""
        rates = {Load.CURRENT: dilation, Load.GROWN: 2 * growth, Load.MATERIAL: np.zeros_like(growth)}
        return rates[self]


WEIGHTS = (Load.CURRENT, Load.GROWN, Load.MATERIAL)
"""Loads that are weight."""

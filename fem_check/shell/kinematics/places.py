"""Which numbers of a set are the same but for roundoff, whatever the unit they are in."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

ROUNDOFF = 1e-9
"""Share of the extent of a set, as of a sheet, below which a distance is none."""


def distinct(values: Array) -> tuple[Array, Integers]:
    """The distinct ones among values (n,) in rising order, and which of them each value is, (n,).

    Of values that differ by roundoff the least stands for all.

    >>> import numpy as np
    >>> from fem_check.shell.kinematics.places import distinct
    >>> lines, which = distinct(1e-9 * np.array([0.3, 0.1 + 0.2, 0.0]))
    >>> print(lines, which)
    [0.e+00 3.e-10] [1 1 0]
    """
    order = np.argsort(values, kind="stable")
    ordered = values[order]
    new = np.ones(values.size, bool)
    new[1:] = np.diff(ordered) > ROUNDOFF * np.ptp(values)
    which = np.empty(values.size, np.int64)
    which[order] = np.cumsum(new) - 1
    return ordered[new], which

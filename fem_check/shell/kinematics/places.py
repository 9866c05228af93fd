"""Grouping of numbers that are equal up to roundoff, independent of their unit."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

ROUNDOFF = 1e-9
"""Distance, relative to the extent of a set, below which numbers count as equal."""


def distinct(values: Array) -> tuple[Array, Integers]:
    """Ascending distinct numbers among values (n,), and the index of each value among them, (n,).

    Values that differ by roundoff are represented by the smallest.

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

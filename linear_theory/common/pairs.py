"""Symmetric tensors stored by their component pairs c <= d.

In this order: xx for 1 component, xx, xy, yy for 2, and xx, xy, xz, yy, yz, zz for 3.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PAIRS = {
    1: ((0,), (0,)),
    2: ((0, 0, 1), (0, 1, 1)),
    3: ((0, 0, 0, 1, 1, 2), (0, 1, 2, 1, 2, 2)),
}
"""Component pairs c <= d for 1, 2 and 3 components, as index arrays (c's, d's)."""

_FIRST = {k: np.array(v[0]) for k, v in PAIRS.items()}
_SECOND = {k: np.array(v[1]) for k, v in PAIRS.items()}


def outer(u: Array, v: Array) -> Array:
    """u_c v_d for the pairs c <= d: (..., components, points) -> (..., pairs, points)."""
    count = u.shape[-2]
    return np.asarray(u[..., _FIRST[count], :] * v[..., _SECOND[count], :])


def identity(components: int) -> Array:
    """delta_cd for the pairs c <= d, (pairs, 1)."""
    first, second = PAIRS[components]
    return np.equal(first, second).astype(float)[:, None]


def pairs_among(components: int, kept: slice) -> list[int]:
    """Places of the pairs whose components are both among those that are kept.

    >>> from linear_theory.common.pairs import pairs_among
    >>> print(pairs_among(3, slice(1, 3)))  # yy, yz, zz
    [3, 4, 5]
    """
    some = range(components)[kept]
    return [k for k, (c, d) in enumerate(zip(*PAIRS[components], strict=True)) if {c, d} <= {*some}]


def product(tensor: Array, v: Array) -> Array:
    """sum_d T_cd v_d: (pairs, points), (components, points or 1) -> (components, points).

    >>> import numpy as np
    >>> from linear_theory.common.pairs import product
    >>> print(product(np.array([[1.0], [2.0], [3.0]]), np.array([[1.0], [1.0]])).ravel())
    [3. 5.]
    """
    out = np.zeros((len(v), *np.broadcast_shapes(tensor.shape[1:], v.shape[1:])))
    for entry, c, d in zip(tensor, *PAIRS[len(v)], strict=True):
        out[c] += entry * v[d]
        if c != d:
            out[d] += entry * v[c]
    return out

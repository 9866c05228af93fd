"""Places of element Hessians in the matrix of the free unknowns, computed once for all steps."""

from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.csgraph import reverse_cuthill_mckee

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.places import distinct
from fem_check.shell.kinematics.region import Region
from fem_check.shell.statics.potential import Blocks
from linear_theory.common.pairs import PAIRS

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Sparsity:
    """Numbering of the free unknowns and the lower triangle of their matrix.

    free: (size,) which unknowns may move. order (n,): the free unknowns after a reverse Cuthill-McKee
    numbering of the scalar degrees of freedom. rows, columns: places of the stored entries of the
    lower triangle, `values` of a matrix being in this order. half_width: of the band.
    """

    def __init__(self, discretisation: Discretisation, free: NDArray[np.bool_]) -> None:
        self.components = discretisation.components
        region = discretisation.interior
        scalar = _narrowest(region.dofs, discretisation.locations)
        unknowns = (scalar[:, None] * self.components + np.arange(self.components)).ravel()
        self.order = unknowns[free[unknowns]]
        self.place = np.full(discretisation.size, -1)
        self.place[self.order] = np.arange(self.order.size)
        keys, _ = self._keys(region)
        self._stored = np.unique(keys[keys >= 0])
        self.rows, self.columns = np.divmod(self._stored, max(1, self.order.size))
        self._maps: dict[int, tuple[Region, Any]] = {}

    @property
    def size(self) -> int:
        """Number of free unknowns n."""
        return int(self.order.size)

    @cached_property
    def half_width(self) -> int:
        """Largest distance of a stored entry from the diagonal."""
        return int((self.rows - self.columns).max(initial=0))

    @cached_property
    def diagonal(self) -> Integers:
        """Indices of the diagonal among the stored entries, (n,)."""
        return np.flatnonzero(self.rows == self.columns)

    @cached_property
    def _mirror(self) -> tuple[Any, Integers]:
        """Pattern of the full matrix in compressed rows and the stored entry of each of its places."""
        below = self.rows != self.columns
        source = np.arange(self.rows.size)
        rows = np.concatenate([self.rows, self.columns[below]])
        columns = np.concatenate([self.columns, self.rows[below]])
        full = sp.csr_array(
            (np.concatenate([source, source[below]]) + 1, (rows, columns)), (self.size,) * 2
        )
        full.sort_indices()
        return full, full.data.astype(np.int64) - 1

    def matrix(self, values: Array) -> Any:
        """The full symmetric matrix, scipy.sparse.csr_array (n, n)."""
        pattern, source = self._mirror
        return sp.csr_array((values[source], pattern.indices, pattern.indptr), shape=pattern.shape)

    def assemble(self, blocks: list[Blocks]) -> Array:
        """Stored entries of the sum of element Hessians, (entries,)."""
        total = np.zeros(self.rows.size)
        for region, values in blocks:
            total += self._map(region) @ values.reshape(-1)
        return total

    def _map(self, region: Region) -> Any:
        """Sparse matrix that adds the element Hessians of a region into the stored entries."""
        if id(region) not in self._maps:
            keys, _ = self._keys(region)
            source = np.flatnonzero(keys >= 0)
            target = np.searchsorted(self._stored, keys[source])
            ones = np.ones(source.size)
            shape = (self._stored.size, keys.size)
            # The region is kept with its map so that its id cannot be reused for another one.
            self._maps[id(region)] = region, sp.csr_array((ones, (target, source)), shape=shape)
        return self._maps[id(region)][1]

    def _keys(self, region: Region) -> tuple[Integers, Integers]:
        """row * n + column of every entry of the element Hessians, -1 for those not stored."""
        first, second = (np.array(c) for c in PAIRS[self.components])
        dofs = region.dofs * self.components
        rows = self.place[dofs[:, :, None, None] + first[:, None]]
        columns = self.place[dofs[:, None, None, :] + second[:, None]]
        rows, columns = np.broadcast_arrays(rows, columns)
        # Pairs c < d represent themselves and their transpose; c = d appear twice.
        wanted = (rows >= 0) & (columns >= 0) & ((rows >= columns) | (first != second)[:, None])
        low, high = np.minimum(rows, columns), np.maximum(rows, columns)
        return np.where(wanted, high * self.size + low, -1).ravel(), dofs


def _narrowest(dofs: Integers, places: Array) -> Integers:
    """The numbering of the scalar degrees of freedom with the narrowest band, out of three.

    On a rectangle, sorting along its longer side is better than reverse Cuthill-McKee, which starts at
    a corner and proceeds along diagonals.
    """
    shapes, count = dofs.shape[1], places.shape[1]
    rows, columns = np.repeat(dofs, shapes, axis=1).ravel(), np.tile(dofs, (1, shapes)).ravel()
    graph = sp.csr_matrix((np.ones(rows.size), (rows, columns)), shape=(count, count))
    x, y = (distinct(along)[1] for along in places)
    candidates = [
        reverse_cuthill_mckee(graph, symmetric_mode=True),
        np.lexsort((x, y)),
        np.lexsort((y, x)),
    ]
    return min((np.asarray(c, np.int64) for c in candidates), key=lambda order: _width(order, dofs))


def _width(order: Integers, dofs: Integers) -> int:
    place = np.empty(order.size, np.int64)
    place[order] = np.arange(order.size)
    return int(np.ptp(place[dofs], axis=1).max())

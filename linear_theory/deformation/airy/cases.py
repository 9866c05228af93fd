"""The load cases of an Airy series anywhere: held sheet plus the terms that free its edges."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy import loads
from linear_theory.deformation.airy.system import Pair
from linear_theory.deformation.airy.terms import pair_displacement, pair_stress
from linear_theory.motion.cells import gauss
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

_BLOCK = 2**20  # numbers in one temporary array when points do not form a grid


@dataclass(frozen=True)
class Cases:
    """Solved cases in the order: cosines cos(2 pi r y/L), sines, uniform growth 1.

    orders: (K,), r; tail: whether the sines were solved without their line and with tails;
    even, odd: amplitudes for the cosines and the sines.
    """

    sheet: Sheet
    orders: NDArray[np.int64]
    tail: bool
    even: Pair
    odd: Pair

    def displacements(self, x: Array, y: Array) -> Array:
        """(2K + 1, 2, *broadcast(x, y).shape), without mean displacement and rotation."""
        odd_x, odd_y = self._odd_in(x, y)
        even_case = np.stack([odd_x, odd_y])
        odd_case = np.stack([odd_x * odd_y, np.ones_like(odd_x)])
        return self._reflected(self._quarter_displacements, x, y, even_case, odd_case)

    def stresses(self, x: Array, y: Array) -> Array:
        """(2K + 1, 3, *broadcast(x, y).shape), components (xx, yy, xy)."""
        odd_x, odd_y = self._odd_in(x, y)
        one = np.ones_like(odd_x)
        even_case = np.stack([one, one, odd_x * odd_y])
        odd_case = np.stack([odd_y, odd_y, odd_x])
        return self._reflected(self._quarter_stresses, x, y, even_case, odd_case)

    def growths(self, y: Array) -> Array:
        """c of the cases, (2K + 1, *y.shape)."""
        waves = loads.growth(self.sheet, self.orders, y)
        return np.concatenate([waves, np.ones((1, *y.shape))])

    def mean_squares(self, amplitudes: Array) -> Array:
        """Mean over the sheet of |u|^2 of combinations, amplitudes (2K + 1, N) -> (N,); to a few %.

        By Gauss quadrature over a quarter, tails left out. Cosines and sines are orthogonal over the
        sheet, though not over its quarter.
        """
        x, weights_x = gauss(4)[:2]
        y, weights_y = gauss(5 + 2 * int(self.orders[-1]))[:2]
        without = replace(self, even=self.even.without_tail(), odd=self.odd.without_tail())
        u = without._quarter_displacements(
            (x + 1) * self.sheet.width / 4, (y + 1) * self.sheet.length / 4, grid=True
        )
        weights = np.multiply.outer(weights_x, weights_y) / 4
        count = self.orders.size
        total = np.zeros(amplitudes.shape[1])
        for part in ([*range(count), 2 * count], [*range(count, 2 * count)]):
            squares = np.tensordot(amplitudes[part].T, u[part], 1) ** 2
            total += np.einsum("ncxy,xy->n", squares, weights)
        return total

    def _quarter_displacements(self, x: Array, y: Array, grid: bool) -> Array:
        terms = [pair_displacement(pair, self.sheet, x, y, grid) for pair in (self.even, self.odd)]
        x = x[:, None] if grid else x
        held = loads.held_displacement(self.sheet, self.orders, x, y, without_line=self.tail)
        uniform = np.stack(np.broadcast_arrays(x, y))
        return np.concatenate([held + np.concatenate(terms), uniform[None]])

    def _quarter_stresses(self, x: Array, y: Array, grid: bool) -> Array:
        terms = [pair_stress(pair, self.sheet, x, y, grid) for pair in (self.even, self.odd)]
        stress = np.concatenate([*terms, np.zeros_like(terms[0][:1])])
        held = loads.held_stress(self.sheet, self.orders, y, without_line=self.tail)
        stress[:-1, 0] += held[:, None] if grid else held
        return stress

    def _odd_in(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Signs of x and of y, broadcast: factors of what is odd in x, in y."""
        x, y = np.broadcast_arrays(x, y)
        return np.sign(x), np.sign(y)

    def _reflected(
        self,
        quarter: Callable[[Array, Array, bool], Array],
        x: Array,
        y: Array,
        even_signs: Array,
        odd_signs: Array,
    ) -> Array:
        """Values at (x, y) from those at (|x|, |y|) and the signs of the two kinds of cases."""
        values = self._at(quarter, abs(x), abs(y))
        count = self.orders.size
        values[:count] *= even_signs
        values[count : 2 * count] *= odd_signs
        values[2 * count] *= even_signs
        return values

    def _at(self, quarter: Callable[[Array, Array, bool], Array], x: Array, y: Array) -> Array:
        """Evaluate on the grid of the distinct x and y where that is cheaper than point by point."""
        shape = np.broadcast(x, y).shape
        distinct_x, at_x = np.unique(x, return_inverse=True)
        distinct_y, at_y = np.unique(y, return_inverse=True)
        size = math.prod(shape)
        if distinct_x.size * distinct_y.size <= 4 * size:
            values = quarter(distinct_x, distinct_y, True)
            return values[..., at_x.reshape(np.shape(x)), at_y.reshape(np.shape(y))]
        all_x, all_y = (a.ravel() for a in np.broadcast_arrays(x, y))
        modes = sum(family.count for family in self.even.families)
        step = max(_BLOCK // (modes * 2 * self.orders.size), 1)
        blocks = [slice(i, i + step) for i in range(0, size, step)]
        values = np.concatenate([quarter(all_x[b], all_y[b], False) for b in blocks], axis=-1)
        return values.reshape(*values.shape[:-1], *shape)

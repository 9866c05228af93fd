"""The load cases of an Airy series anywhere: held sheet plus the terms that free its edges."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.airy import loads, terms
from linear_theory.deformation.airy.system import Solution
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

_BLOCK = 2**20  # numbers in one temporary array when points do not form a grid


@dataclass(frozen=True)
class Cases:
    """Solved cases in the order: cosines cos(2 pi r y/L), sines, uniform growth 1.

    orders: (K,), r; tail: whether the sines were solved without their line and with tails;
    solution: amplitudes for the cosines (even) and the sines (odd).
    """

    sheet: Sheet
    orders: NDArray[np.int64]
    tail: bool
    solution: Solution

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

    def mean_squares(self, factors: Array, mean: float) -> Array:
        """Mean over the sheet of |u|^2, (times,), to a few %, for a growth of that mean.

        factors: of the cosines and of the sines, (2, K, times). By Gauss quadrature over a quarter,
        tails left out. Cosines and sines are orthogonal over the sheet, though not over its quarter.
        """
        x, weights_x = gauss_legendre(4)
        y, weights_y = gauss_legendre(5 + 2 * int(self.orders[-1]))
        x, y = (x + 1) * self.sheet.width / 4, (y + 1) * self.sheet.length / 4
        waves = replace(self, solution=self.solution.without_tail())._quarter_waves(x, y, grid=True)
        u = factors.swapaxes(1, 2) @ waves.reshape(2, self.orders.size, -1)
        if mean:
            u[0] += mean * _uniform(x[:, None], y).ravel()
        weights = np.multiply.outer(weights_x, weights_y).ravel() / 4
        return np.einsum("ancp,p->n", (u * u).reshape(2, -1, 2, weights.size), weights)

    def _quarter_displacements(self, x: Array, y: Array, grid: bool) -> Array:
        uniform = _uniform(x[:, None] if grid else x, y)
        return np.concatenate([self._quarter_waves(x, y, grid), uniform[None]])

    def _quarter_waves(self, x: Array, y: Array, grid: bool) -> Array:
        """Of the cosines and the sines alone."""
        free = terms.displacement(self.solution, self.sheet.poisson, x, y, grid)
        x = x[:, None] if grid else x
        held = loads.held_displacement(self.sheet, self.orders, x, y, without_line=self.tail)
        return held + free.reshape(held.shape)

    def _quarter_stresses(self, x: Array, y: Array, grid: bool) -> Array:
        free = terms.stress(self.solution, x, y, grid)
        free = free.reshape(-1, *free.shape[2:])
        stress = np.concatenate([free, np.zeros_like(free[:1])])
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
        modes = sum(family.count for family in self.solution.families)
        step = max(_BLOCK // (modes * 2 * self.orders.size), 1)
        blocks = [slice(i, i + step) for i in range(0, size, step)]
        values = np.concatenate([quarter(all_x[b], all_y[b], False) for b in blocks], axis=-1)
        return values.reshape(*values.shape[:-1], *shape)


def _uniform(x: Array, y: Array) -> Array:
    """Displacement by uniform growth 1, (2, *broadcast(x, y).shape)."""
    return np.stack(np.broadcast_arrays(x, y))

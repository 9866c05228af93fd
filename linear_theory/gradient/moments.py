"""Moments of weights at the points of cells against the polynomials of the Ritz method."""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.ritz import RitzField, legendre
from linear_theory.motion.cells import gauss
from linear_theory.motion.motion import CellGrid
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


def gauss_counts(field: RitzField, waves: float) -> tuple[int, int]:
    """Gauss points across and along for a change of growth, exact for degrees 3/2 of the field's.

    waves: along, of a change that may be shorter than the field resolves: a wave needs pi degrees, and
    some more, both against polynomials of the field's degree and as a load of its own.
    """
    across, along = field.degree
    return (
        across + across // 4 + 12,
        max(along + along // 4 + 12, math.ceil(1.2 * math.pi * waves) + 20),
    )


def moments(crawl: Crawl, weights: Array, counts: tuple[int, int], exact: int | None) -> Array:
    """Sums of weights (..., cells, n, n) times p_i p_j at their points, (..., *counts).

    exact: see `Wanted`.
    """
    grid, n = crawl.grid, crawl.resolution.order
    across, along = _tables(crawl.field.sheet, grid, n, counts, exact)
    columns, rows = len(grid.x_edges) - 1, len(grid.y_edges) - 1
    table = weights.reshape(*weights.shape[:-3], columns, rows, n, n).swapaxes(-3, -2)
    table = table.reshape(*weights.shape[:-3], columns * n, rows * n)
    return np.asarray(across.T @ table @ along)


@lru_cache(maxsize=8)
def _tables(
    sheet: Sheet, grid: CellGrid, order: int, counts: tuple[int, int], exact: int | None
) -> tuple[Array, Array]:
    """p_i(2 x/W) and p_j(2 y/L) at the points of all cells, (points, degrees)."""
    rows = len(grid.y_edges) - 1
    x, y, _ = grid.points(order)
    places = x[::rows].ravel() * 2 / sheet.width, y[:rows].ravel() * 2 / sheet.length
    across, along = (legendre.orthonormal(c, p) for c, p in zip(counts, places, strict=True))
    if exact is not None and exact + 1 < counts[1]:
        along[:, exact + 1 :] = _projected(sheet, grid, order, counts[1])[:, exact + 1 :]
    return across, along


def _projected(sheet: Sheet, grid: CellGrid, order: int, count: int) -> Array:
    """Of p_j, the polynomials of the degree of a cell that have the same moments there, (points, j)."""
    rule = gauss(order)
    places, weights = gauss_legendre((count + order) // 2 + 1)
    shapes = np.polynomial.legendre.legvander(places, order - 1) @ rule.inverse
    to_points = (shapes * weights[:, None]).T / rule.weights[:, None]
    edges = np.array(grid.y_edges) * 2 / sheet.length
    middle, half = (edges[1:] + edges[:-1]) / 2, np.diff(edges) / 2
    table = legendre.orthonormal(count, middle[:, None] + half[:, None] * places)
    return np.asarray((to_points @ table).reshape(-1, count))

"""The derivatives of the rigid motion at given times, by the wave at every point and by the scene.

    dJ(t) = sum over x, y of value(x, y, t) dc + rate(x, y, t) dc/dt + ...,

at Gauss points x, y of the sheet, with their weights: the adjoint of the friction balance (`adjoint`)
gives weights of velocity and load, that of the elastic problem (`elastic`) the growth that makes them.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import BATCH, Crawl
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.ritz import RitzField, legendre
from linear_theory.friction.load import Load
from linear_theory.friction.maps import FrictionMap
from linear_theory.gradient import elastic
from linear_theory.gradient.adjoint import AdjointBalance, LawChange, Weights
from linear_theory.gradient.quantity import Quantity
from linear_theory.motion.motion import CellGrid

Array = NDArray[np.float64]


class MapChange(NamedTuple):
    """The derivative of a map of friction by one of its numbers, by a central difference.

    mirrored: whether to take the part alone that is mirror symmetric in x.
    """

    ahead: FrictionMap
    behind: FrictionMap
    apart: float
    mirrored: bool = False

    def share(self, own: FrictionMap, x: Array, y: Array, times: Array) -> Array:
        """What the map changes by over its value, per unit of the number, (times, *x.shape) or less."""
        t = times.reshape(-1, *(1,) * np.ndim(x))
        ahead, behind, here = (one.values(x, y, t) for one in (self.ahead, self.behind, own))
        found = (ahead - behind) / (self.apart * here)
        if self.mirrored:
            found = (found + self._replace(mirrored=False).share(own, -x, y, times)) / 2
        return np.asarray(found)


class Wanted(NamedTuple):
    """Which derivatives are asked for.

    sheet: by its width and Poisson ratio; across: by growth that depends on x; laws, maps: by those of
    their numbers.
    """

    quantities: Sequence[Quantity]
    sheet: bool = False
    across: bool = False
    laws: Sequence[LawChange] = ()
    maps: Sequence[MapChange] = ()


class Sensitivity(NamedTuple):
    """Derivatives of quantities (k,) at times (T,).

    x (X,), y (Y,): Gauss points, units of length; value, rate (k, T, X, Y): by c and dc/dt there, with
    the weights of the quadrature; X = 1 for growth that does not depend on x. alpha, slip, width: by
    alpha in the load, by the logarithms of all velocities in the law and of the width; poisson;
    laws, maps (n, k, T): by their numbers; the others (k, T). flat (T,): see `adjoint.Weights`.
    """

    x: Array
    y: Array
    value: Array
    rate: Array
    alpha: Array
    slip: Array
    width: Array
    poisson: Array
    laws: Array
    maps: Array
    flat: NDArray[np.bool_]


def sensitivities(crawl: Crawl, times: Array, q: Array, alpha: float, wanted: Wanted) -> Sensitivity:
    """Derivatives at motions q (times, 3), in batches; alpha: that of the load, 0 or the crawl's."""
    size = max(BATCH // crawl.work, 1)
    parts = [
        _batch(crawl, times[i : i + size], q[i : i + size], alpha, wanted)
        for i in range(0, times.size, size)
    ]
    first = parts[0]
    if len(parts) == 1:
        return first
    axis = {"value": 1, "rate": 1, "flat": 0}
    joined = {
        name: np.concatenate([getattr(part, name) for part in parts], axis.get(name, -1))
        for name in Sensitivity._fields[2:]
    }
    return Sensitivity(first.x, first.y, **joined)


def _batch(crawl: Crawl, times: Array, q: Array, alpha: float, wanted: Wanted) -> Sensitivity:
    balance = crawl.balance_of(AdjointBalance, times)
    found = balance.weights(
        balance.polished(q, alpha), alpha, wanted.quantities, wanted.laws, bool(wanted.maps)
    )
    elastic_part = _Elastic.of(crawl, times, found)
    x, y, (value, rate) = elastic_part.at_points(wanted.across)
    none = np.zeros_like(found.alpha)
    width, poisson = elastic_part.by_sheet() if wanted.sheet else (none, none)
    return Sensitivity(
        x=x,
        y=y,
        value=value,
        rate=rate,
        alpha=found.alpha if alpha else none,
        slip=found.slip,
        width=width + found.arms,
        poisson=poisson,
        laws=found.laws,
        maps=_by_maps(crawl, times, found, wanted.maps),
        flat=found.flat,
    )


def _by_maps(crawl: Crawl, times: Array, found: Weights, maps: Sequence[MapChange]) -> Array:
    own = crawl.contact.friction.map
    position = crawl.field._on_cells(crawl.grid, crawl.resolution.order)[0]
    by = [(found.area * one.share(own, *position, times)).sum((-3, -2, -1)) for one in maps]
    return np.array(by).reshape(-1, *found.alpha.shape)


class _Elastic(NamedTuple):
    """The adjoint of the elastic problem for weights at times (T,), cases (k T,).

    moving, growing: z of the weights of velocity and of load, the latter None for a load that does not
    depend on the strain; moments: of the weights of load against p_i p_j.
    """

    crawl: Crawl
    field: RitzField
    times: Array
    moving: Array
    growing: Array | None
    moments: Array

    @classmethod
    def of(cls, crawl: Crawl, times: Array, found: Weights) -> "_Elastic":
        """For weights at the points of cells."""
        field = crawl.field._for_times(times)
        assert isinstance(field, RitzField)
        counts = tuple(d + 1 for d in field.degree)
        solver, mirrored = field.solver, crawl.mirrored
        velocity = _moments(crawl, found.velocity, counts).swapaxes(1, 2)
        velocity = velocity.reshape(-1, *velocity.shape[2:])
        moving = elastic.adjoint(solver, elastic.displacement_load(velocity), mirrored)
        grown = crawl.contact.load is Load.GROWN
        moments = _moments(crawl, found.load, _points(field) if grown else counts)
        moments = moments.reshape(-1, *moments.shape[2:])
        growing = None
        if crawl.contact.load is Load.CURRENT and moments.any():
            load = elastic.dilation_load(moments, field.sheet)
            growing = elastic.adjoint(solver, load, mirrored)
        return cls(crawl, field, times, moving, growing, moments)

    def at_points(self, across: bool) -> tuple[Array, Array, tuple[Array, Array]]:
        """Gauss points, and derivatives by c and dc/dt there, with the weights of the quadrature."""
        sheet, load = self.field.sheet, self.crawl.contact.load
        rate = elastic.density(sheet, self.moving)
        if self.growing is not None:
            value = elastic.density(sheet, self.growing)
        else:
            value = 2 * self.moments if load is Load.GROWN else np.zeros_like(rate)
        if self.crawl.mirrored:
            value[:, 1::2] = 0.0  # of the integrals over half a sheet
        (x, weights_x), (y, weights_y) = (gauss_legendre(n) for n in _points(self.field))
        if not across:
            x, weights_x = np.zeros(1), np.full(1, 2.0)
            value, rate = value[:, :1], rate[:, :1]
        found = tuple(
            np.einsum("xi,cij,yj->cxy", *(_basis(x, weights_x, one, 1), one, _basis(y, weights_y, one, 2)), optimize=True).reshape(-1, self.times.size, x.size, y.size)
            for one in (value, rate)
        )
        return x * sheet.width / 2, y * sheet.length / 2, found

    def by_sheet(self) -> tuple[Array, Array]:
        """Derivatives by the logarithm of the width and by Poisson's ratio, (k, T) each."""
        field, sheet = self.field, self.field.sheet
        repeats = len(self.moving) // self.times.size
        factors = field._amplitudes(self.times), field._amplitude_rates(self.times)
        width = poisson = np.zeros(len(self.moving))
        for z, factor in zip((self.growing, self.moving), factors, strict=True):
            if z is None:
                continue
            c, u = (
                np.tile(np.tensordot(factor.T, basis, 1), (repeats, *(1,) * (basis.ndim - 1)))
                for basis in (field._growth, field._solution)
            )
            width = width + elastic.by_width(sheet, c, u, z)
            poisson = poisson + elastic.by_poisson(sheet, c, u, z)
            if z is self.growing:
                width = width + elastic.dilation_by_width(sheet, self.moments, u)
        return tuple(one.reshape(repeats, -1) for one in (width, poisson))


def _points(field: RitzField) -> tuple[int, int]:
    """Gauss points across and along for a change of growth, exact for degrees 3/2 of the field's."""
    across, along = field.degree
    return across + across // 4 + 12, along + along // 4 + 12


def _basis(places: Array, weights: Array, factors: Array, axis: int) -> Array:
    """Polynomials p_i at points times the weights there, (points, degrees)."""
    return weights[:, None] * legendre.orthonormal(factors.shape[axis], places)


def _moments(crawl: Crawl, weights: Array, counts: tuple[int, int]) -> Array:
    """Sums of weights (..., cells, n, n) times p_i p_j at their points, (..., *counts)."""
    sheet, grid, n = crawl.field.sheet, crawl.grid, crawl.resolution.order
    columns, rows = len(grid.x_edges) - 1, len(grid.y_edges) - 1
    x, y, _ = grid.points(n)
    places = x[::rows].ravel() * 2 / sheet.width, y[:rows].ravel() * 2 / sheet.length
    across, along = (legendre.orthonormal(c, p) for c, p in zip(counts, places, strict=True))
    table = weights.reshape(*weights.shape[:-3], columns, rows, n, n).swapaxes(-3, -2)
    table = table.reshape(*weights.shape[:-3], columns * n, rows * n)
    return np.asarray(across.T @ table @ along)

"""The derivatives of the rigid motion at given times, by the wave at every point and by the scene.

    dJ(t) = sum over x, y of value(x, y, t) dc + rate(x, y, t) dc/dt + ...,

at Gauss points x, y of the sheet, with their weights: the adjoint of the friction balance (`adjoint`)
gives weights of velocity and load, that of the elastic problem (`elastic`) the growth that makes them.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import BATCH, Crawl
from linear_theory.common.progress import track
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.ritz import RitzField, legendre
from linear_theory.friction.load import Load
from linear_theory.friction.maps import FrictionMap
from linear_theory.gradient import elastic
from linear_theory.gradient.adjoint import AdjointBalance, LawChange, Weights
from linear_theory.gradient.moments import gauss_counts, moments
from linear_theory.gradient.quantity import Quantity

Array = NDArray[np.float64]
Kind = TypeVar("Kind", "_Parts", "Sensitivity")

DEFORMATIONS = 200_000
"""Coefficients of deformations that are solved for at once."""


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

    sheet: by its width and Poisson ratio; across: by growth that depends on x; waves: along the sheet,
    of the shortest harmonic; laws, maps: by those of their numbers. exact: degree of polynomials along
    the sheet up to which points of the cells resolve them, None for all; moments of higher ones are
    those of the polynomials that interpolate the weights in each cell.
    """

    quantities: Sequence[Quantity]
    sheet: bool = False
    across: bool = False
    waves: float = 0.0
    laws: Sequence[LawChange] = ()
    maps: Sequence[MapChange] = ()
    exact: int | None = None


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


class Linearised(NamedTuple):
    """Motions about which to take derivatives.

    q: (times, 3), per unit alpha; alpha: that of their load 1 + alpha e; near: whether they are only
    near the balance, so that a Newton step is due.
    """

    q: Array
    alpha: float
    near: bool = False


def sensitivities(
    crawl: Crawl, times: Array, motions: Sequence[Linearised], wanted: Wanted
) -> list[Sensitivity]:
    """Derivatives at each of the motions, at times (T,)."""
    size = max(BATCH // crawl.points, 1)
    batches = [slice(i, i + size) for i in range(0, times.size, size)]
    parts = [
        _batch(crawl, times[some], _some(motions, some), wanted)
        for some in track("adjoint of the friction balance", batches)
    ]
    found = [_joined(part, _TIME_AXES) for part in zip(*parts, strict=True)]
    assert isinstance(crawl.field, RitzField)
    across, along = crawl.field.degree
    size = max(DEFORMATIONS // (len(wanted.quantities) * across * along), 1)
    pieces = [slice(i, i + size) for i in range(0, times.size, size)]
    made: list[list[Sensitivity]] = [[] for _ in motions]
    for some in track("adjoint of the deformation", pieces):
        for own, one, motion in zip(made, found, motions, strict=True):
            own.append(_sensitivity(crawl, times[some], one.at(some), motion.alpha, wanted))
    return [_joined(own, _SENSITIVITY_AXES) for own in made]


def _some(motions: Sequence[Linearised], some: slice) -> list[Linearised]:
    return [motion._replace(q=motion.q[some]) for motion in motions]


class _Parts(NamedTuple):
    """Of one motion, with times (T,) on the last axis but of moments, where they are on the second.

    velocity (k, T, 2, i, j), load (k, T, i, j): moments of weights against p_i p_j; maps (n, k, T).
    """

    velocity: Array
    load: Array
    alpha: Array
    slip: Array
    arms: Array
    laws: Array
    maps: Array
    flat: NDArray[np.bool_]

    def at(self, some: slice) -> "_Parts":
        """At some of the times."""
        own = self._asdict().items()
        return _Parts(*(v[:, some] if name in _TIME_AXES else v[..., some] for name, v in own))


_TIME_AXES = {"velocity": 1, "load": 1}
_SENSITIVITY_AXES = {"x": None, "y": None, "value": 1, "rate": 1}


def _batch(crawl: Crawl, times: Array, motions: Sequence[Linearised], wanted: Wanted) -> list[_Parts]:
    """Of every motion, at a few times."""
    balance = crawl.balance_of(AdjointBalance, times)
    field = crawl.field
    assert isinstance(field, RitzField)
    across, along = field.degree
    counts = (
        gauss_counts(field, wanted.waves)
        if crawl.contact.load is Load.GROWN
        else (across + 1, along + 1)
    )
    found = []
    for q, alpha, near in motions:
        q = balance.polished(q, alpha) if near else q
        at = balance.weights(q, alpha, wanted.quantities, wanted.laws, bool(wanted.maps))
        velocity = moments(crawl, at.velocity, (across + 1, along + 1), wanted.exact).swapaxes(1, 2)
        load = moments(crawl, at.load, counts, wanted.exact)
        maps = _by_maps(crawl, times, at, wanted.maps)
        found.append(_Parts(velocity, load, at.alpha, at.slip, at.arms, at.laws, maps, at.flat))
    return found


def _joined(parts: Sequence[Kind], axes: Mapping[str, int | None]) -> Kind:
    """Of all times, which are on the last axis but for those of `axes`; None for none."""
    if len(parts) == 1:
        return parts[0]
    first = parts[0]
    joined = {
        name: np.concatenate([getattr(part, name) for part in parts], axis)
        for name in first._fields
        if (axis := axes.get(name, -1)) is not None
    }
    return first._replace(**joined)


def _by_maps(crawl: Crawl, times: Array, found: Weights, maps: Sequence[MapChange]) -> Array:
    own, area = crawl.contact.friction.map, found.area
    if area is None:
        return np.zeros((0, *found.alpha.shape))
    x, y = crawl.field._on_cells(crawl.grid, crawl.resolution.order)[0]
    return np.stack([(area * one.share(own, x, y, times)).sum((-3, -2, -1)) for one in maps])


def _sensitivity(
    crawl: Crawl, times: Array, parts: _Parts, alpha: float, wanted: Wanted
) -> Sensitivity:
    elastic_part = _Elastic.of(crawl, parts)
    x, y, (value, rate) = elastic_part.atgauss_counts(wanted.across, wanted.waves)
    none = np.zeros_like(parts.alpha)
    width, poisson = elastic_part.by_sheet(times) if wanted.sheet else (none, none)
    return Sensitivity(
        x=x,
        y=y,
        value=value,
        rate=rate,
        alpha=parts.alpha if alpha else none,
        slip=parts.slip,
        width=width + parts.arms,
        poisson=poisson,
        laws=parts.laws,
        maps=parts.maps,
        flat=parts.flat,
    )


class _Elastic(NamedTuple):
    """The adjoint of the elastic problem for weights at T times, cases (k T,).

    moving, growing: z of the weights of velocity and of load, the latter None for a load that does not
    depend on the strain; load: moments of the weights of load, (k T, i, j); shape: (k, T).
    """

    crawl: Crawl
    field: RitzField
    moving: Array
    growing: Array | None
    load: Array
    shape: tuple[int, ...]

    @classmethod
    def of(cls, crawl: Crawl, parts: _Parts) -> "_Elastic":
        """For moments of weights."""
        field, mirrored = crawl.field, crawl.mirrored
        assert isinstance(field, RitzField)
        velocity = parts.velocity.reshape(-1, *parts.velocity.shape[2:])
        load = parts.load.reshape(-1, *parts.load.shape[2:])
        moving = elastic.adjoint(field.solver, elastic.displacement_load(velocity), mirrored)
        growing = None
        if crawl.contact.load is Load.CURRENT and load.any():
            dilation = elastic.dilation_load(load, field.sheet)
            growing = elastic.adjoint(field.solver, dilation, mirrored)
        return cls(crawl, field, moving, growing, load, parts.alpha.shape)

    def atgauss_counts(self, across: bool, waves: float) -> tuple[Array, Array, list[Array]]:
        """Gauss points, and derivatives by c and dc/dt there, with the weights of the quadrature.

        across, waves: see `Wanted`.
        """
        sheet = self.field.sheet
        rate = elastic.density(sheet, self.moving)
        if self.growing is not None:
            value = elastic.density(sheet, self.growing)
        else:
            grown = self.crawl.contact.load is Load.GROWN
            value = 2 * self.load if grown else np.zeros_like(rate)
        if self.crawl.mirrored:
            value[:, 1::2] = 0.0  # of the integrals over half a sheet
        (x, weights_x), (y, weights_y) = (gauss_legendre(n) for n in gauss_counts(self.field, waves))
        if not across:
            x, weights_x = np.zeros(1), np.full(1, 2.0)
            value, rate = value[:, :1], rate[:, :1]
        found = []
        for one in (value, rate):
            by_x = weights_x[:, None] * legendre.orthonormal(one.shape[1], x)
            by_y = weights_y[:, None] * legendre.orthonormal(one.shape[2], y)
            found.append((by_x @ one @ by_y.T).reshape(*self.shape, x.size, y.size))
        return x * sheet.width / 2, y * sheet.length / 2, found

    def by_sheet(self, times: Array) -> tuple[Array, Array]:
        """Derivatives by the logarithm of the width and by Poisson's ratio, (k, T) each."""
        sheet = self.field.sheet
        field = self.field._for_times(times)
        width, poisson = np.zeros((2, *self.shape))
        factors = field._amplitudes(times), field._amplitude_rates(times)
        for z, factor in zip((self.growing, self.moving), factors, strict=True):
            if z is None:
                continue
            c, u = (np.tensordot(factor.T, one, 1) for one in (field._growth, field._solution))
            for i, own in enumerate(z.reshape(*self.shape, *z.shape[1:])):
                width[i] += elastic.by_width(sheet, c, u, own)
                poisson[i] += elastic.by_poisson(sheet, c, u, own)
                if z is self.growing:
                    load = self.load.reshape(*self.shape, *self.load.shape[1:])[i]
                    width[i] += elastic.dilation_by_width(sheet, load, u)
        return width, poisson

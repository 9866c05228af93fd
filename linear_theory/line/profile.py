"""The distribution of the values of a travelling wave: the fraction of the body below a level.

For a travelling wave all velocities are multiples of g = c - mean c, so dry friction requires a
weighted median of g over one period. Cut at its extrema and inflections, g is monotone and
convex or concave on every cell between two nodes; a level then crosses a cell at most once, and the
measure of a set {a < g < b} follows from the ends of its arcs, without quadrature.

g is stored as its Taylor series at the nodes. Besides being fast for hundreds of harmonics, this gives
g(node + d) - g(node) without cancellation, so that a small rise of the level, measured from nodes on
the old level, keeps its digits: speeds of order alpha^2 remain accurate for tiny alpha. Functions of g
are integrated by Gauss quadrature, over cells on which they vary little.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.quadrature import gauss_legendre
from linear_theory.line.roots import EPS, bracketed_newton
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

OVERSAMPLING = 16
"""Equal cells per wavelength of the highest harmonic."""

TERMS = 15
"""Terms of the Taylor series: the first one neglected is < (2 pi/16)^15/15! = 1e-18 of the highest
harmonic at the far end of a cell."""

COARSE_TERMS = 9
"""Terms for an error of 2e-8 of the highest harmonic."""

GAUSS_NODES, GAUSS_WEIGHTS = gauss_legendre(10)
"""Gauss points per cell, on which g is a sixteenth of a wave, stretches vary by MOST_VARIATION and the
argument of tanh by at most 1 (poles at distance pi/2 or more): errors below 1e-16."""

NEAR_STEPS = 3
"""Newton steps from a parabola, which a sixteenth of a wave is within 1 %: 1e-4, 1e-8 and rounding."""

MOST_VARIATION = 0.25
"""Largest variation of the logarithm of the stretch over a cell. Complex zeros of the stretch and of
its square are then further away than the length of the cell."""

MOST_HALVINGS = 60
"""Number of halvings after which a cell is narrower than the rounding of its ends."""


class Rise(NamedTuple):
    """The set swept over when the level rises, in fractions of the period.

    part: integral of dphi/(2 pi); gain: integral of f(g) dphi/(2 pi); part_rate: derivative of part
    with respect to the level; that of gain is f times as large.
    """

    part: float
    gain: float
    part_rate: float


class Integrals(NamedTuple):
    """A function f(g) and its integrals over the cells of a profile, in fractions of the period."""

    function: Callable[[Array], Array]
    cells: Array


@dataclass(frozen=True)
class Profile:
    """g(phi), of mean 0, on monotone cells between ascending nodes over one period.

    nodes: (n,) radians; taylor: (TERMS, n), derivatives of g at the nodes over factorials; scale:
    sum of the amplitudes (values have a rounding error of about EPS * scale); symmetric: whether
    the median is 0 by symmetry.
    """

    nodes: Array
    taylor: Array
    scale: float
    symmetric: bool

    @classmethod
    def of(cls, wave: TravellingWave, sign: float) -> "Profile":
        """The profile sign (c - mean c) of a wave, sign = +-1."""
        amplitude: Complex = np.asarray(sign * (wave.cosine - 1j * wave.sine), complex)
        points = max(64, OVERSAMPLING * amplitude.size)
        spectrum = np.zeros((TERMS, points // 2 + 1), complex)
        row: Complex = amplitude * (points / 2)
        for j in range(TERMS):
            spectrum[j, 1 : amplitude.size + 1] = row
            row = row * (1j * wave.harmonics / (j + 1))
        taylor = np.fft.irfft(spectrum, points)
        taylor = np.concatenate([taylor, taylor[:, :1]], axis=1)
        nodes = np.linspace(0, 2 * math.pi, points + 1)
        # g(phi + pi) = -g(phi), or g(-phi) = -g(phi)
        symmetric = not amplitude[1::2].any() or not wave.cosine.any()
        profile = cls(nodes, taylor, float(abs(amplitude).sum()), symmetric)
        for derivative in (2, 1):
            noise = 8 * EPS * float(abs(amplitude) @ wave.harmonics ** float(derivative))
            profile = profile._with_zeros(derivative, noise)
        return profile

    @property
    def values(self) -> Array:
        """g at the nodes, (n,)."""
        return self.taylor[0]

    def anchored(self, level: float) -> "Profile":
        """The same profile with nodes, of exactly the value `level`, wherever it crosses that level."""
        near = abs(self.values - level) <= 4 * EPS * self.scale
        taylor = self.taylor.copy()
        taylor[0, near] = level
        profile = replace(self, taylor=taylor)
        _, start, span, low, high = profile._cells(above=-math.inf)
        cut = (low < level) & (level < high)
        reach = _reach(taylor[:, start[cut]], span[cut], level - low[cut])
        profile = profile._with_nodes(start[cut], reach)
        profile.taylor[0, self.nodes.size :] = level
        return profile._sorted()

    def resolved(self, function: Callable[[Array], Array]) -> "Profile":
        """The same profile with cells on which a positive, monotone function of g varies little.

        function: the stretch; see MOST_VARIATION.
        """
        profile = self
        for _ in range(MOST_HALVINGS):
            change = abs(np.diff(np.log(function(profile.values))))
            wide = np.flatnonzero(change > MOST_VARIATION)
            if not wide.size:
                break
            middle = np.diff(profile.nodes)[wide] / 2
            profile = profile._with_nodes(wide, middle)._sorted()
        return profile

    def integrals(self, function: Callable[[Array], Array]) -> Integrals:
        """Integrals, for `rise`, of a function of g that is smooth on every cell."""
        return Integrals(function, _weighed(function(self._inside), np.diff(self.nodes)))

    def mean(self, function: Callable[[Array], Array]) -> float:
        """Mean over the period of a function of g that is smooth on every cell."""
        return float(self.integrals(function).cells.sum())

    def mean_with_kink(self, function: Callable[[Array], Array], level: float) -> float:
        """Mean over the period of a function of g that is smooth but for a kink at g = level."""
        cell, start, span, low, high = self._cells(above=-math.inf)
        cut = np.flatnonzero((low < level) & (level < high))
        series, span, length = self.taylor[:, start[cut]], span[cut], np.diff(self.nodes)
        reach = _near_reach(series[:COARSE_TERMS], span, level - low[cut])
        length[cell[cut]] = 0.0
        parts, begin = np.concatenate([reach, span - reach]), np.concatenate([0 * reach, reach])
        arcs = _at_points(np.concatenate([series, series], 1), parts, begin)
        values = function(np.concatenate([self._inside, arcs], 1))
        return float(_weighed(values, np.concatenate([length, parts])).sum())

    def points(self) -> tuple[Array, Array, Array]:
        """Phases, weights (of the period) and g at the Gauss points of all cells, each (points,)."""
        width = np.diff(self.nodes)
        phases = self.nodes[:-1] + width / 2 * (1 + GAUSS_NODES[:, None])
        weights = GAUSS_WEIGHTS[:, None] * width / (4 * math.pi)
        return phases.ravel(), weights.ravel(), self._inside.ravel()

    @cached_property
    def _inside(self) -> Array:
        """g at the Gauss points of all cells, (points, cells)."""
        return _at_points(self.taylor[:, :-1], np.diff(self.nodes))

    def rise(self, base: float, height: float, integrals: Integrals | None = None) -> Rise:
        """The set between the levels base and base + height, height >= 0.

        integrals: of f(g), made by this profile; f = 0 if None. No cell may cross `base` in its
        interior: it is the minimum, or the profile is `anchored`.
        """
        cell, start, span, low, high = self._cells(above=base)
        whole, cut = high - base <= height, (high - base > height) & (low - base < height)
        reach = np.where(whole, span, 0.0)
        series = self.taylor[:, start[cut]]
        reach[cut] = _reach(series, span[cut], height - (low[cut] - base))
        gain = 0.0
        if integrals is not None:
            partial = _integral(series, reach[cut], integrals.function)
            gain = float(integrals.cells[cell[whole]].sum() + partial.sum())
        with np.errstate(divide="ignore"):
            rate = float(np.sum(1 / abs(polynomial(_derivative(series), reach[cut])))) / (2 * math.pi)
        return Rise(float(abs(reach).sum()) / (2 * math.pi), gain, rate)

    def mean_deviation(self, level: float) -> float:
        """Mean of |g - level| over the period; the profile must be `anchored` there."""
        return float(abs(self.integrals(lambda g: g - level).cells).sum())

    def density(self, level: float) -> float:
        """Density of the values at a level where the profile is `anchored`: sum of 1/|2 pi g'|."""
        slope = self.taylor[1, :-1][self.values[:-1] == level]
        with np.errstate(divide="ignore"):
            return float(np.sum(1 / abs(slope))) / (2 * math.pi)

    def turns(self, level: float) -> bool:
        """Whether a level where the profile is `anchored` is an extremum or inflection, to rounding."""
        slope = abs(self.taylor[1][self.values == level])
        return bool(np.any(slope <= 16 * EPS * float(abs(self.taylor[1]).max())))

    def around(self, level: float, tolerance: float) -> float:
        """Fraction of the period with |g - level| <= tolerance."""
        base = max(level - tolerance, float(self.values.min()))
        return self.anchored(base).rise(base, level + tolerance - base).part

    def quantile(self, share: float = 0.5) -> float:
        """The level below which g lies for a share of the period: by default the median."""
        if self.symmetric and share == 0.5:
            return 0.0
        lower, upper = float(self.values.min()), float(self.values.max())

        def excess(height: Array) -> tuple[Array, Array]:
            rise = self.rise(lower, float(height))
            return np.array(rise.part - share), np.array(rise.part_rate)

        return lower + float(
            bracketed_newton(excess, 0.0, upper - lower, -lower, atol=4 * EPS * self.scale)
        )

    def _cells(self, above: float) -> tuple[NDArray[np.intp], NDArray[np.intp], Array, Array, Array]:
        """Cells not below a level: node at the lower end, signed width upwards, both end values."""
        left = np.arange(self.nodes.size - 1)
        rising = self.values[:-1] <= self.values[1:]
        start = np.where(rising, left, left + 1)
        low, high = self.values[start], self.values[np.where(rising, left + 1, left)]
        span = np.where(rising, 1.0, -1.0) * np.diff(self.nodes)
        keep = low >= above
        return left[keep], start[keep], span[keep], low[keep], high[keep]

    def _with_zeros(self, derivative: int, noise: float) -> "Profile":
        """Add nodes where a derivative changes sign between two nodes, by more than noise."""
        series = self.taylor
        for _ in range(derivative):
            series = _derivative(series)
        sign = np.where(abs(series[0]) > noise, np.sign(series[0]), 0.0)
        cell = np.flatnonzero(sign[:-1] * sign[1:] < 0)
        series = series[:, cell] * sign[cell + 1]
        slope = _derivative(series)
        width = np.diff(self.nodes)[cell]

        def excess(distance: Array) -> tuple[Array, Array]:
            return polynomial(series, distance), polynomial(slope, distance)

        distance = bracketed_newton(excess, 0.0, width, width / 2)
        return self._with_nodes(cell, distance)._sorted()

    def _with_nodes(self, start: NDArray[np.intp], distance: Array) -> "Profile":
        """Append nodes at a signed distance from given ones, with the series re-expanded there."""
        series = self.taylor[:, start].copy()
        for first in range(TERMS - 1):
            for j in range(TERMS - 2, first - 1, -1):
                series[j] += distance * series[j + 1]
        nodes = np.concatenate([self.nodes, self.nodes[start] + distance])
        return replace(self, nodes=nodes, taylor=np.concatenate([self.taylor, series], axis=1))

    def _sorted(self) -> "Profile":
        order = np.argsort(self.nodes, kind="stable")
        return replace(self, nodes=self.nodes[order], taylor=self.taylor[:, order])


def polynomial(series: Array, distance: Array) -> Array:
    """sum_j series[j] distance**j."""
    total = series[-1]
    for term in series[-2::-1]:
        total = total * distance + term
    return np.asarray(total)


def _derivative(series: Array) -> Array:
    return np.asarray(series[1:] * np.arange(1.0, series.shape[0])[:, None])


def _integral(
    series: Array, distance: Array, function: Callable[[Array], Array], start: Array | float = 0.0
) -> Array:
    """Integral of function(g) over arcs of a signed length, in fractions of the period.

    start: signed distance of the arcs from the nodes.
    """
    return _weighed(function(_at_points(series, distance, start)), distance)


def _at_points(series: Array, distance: Array, start: Array | float = 0.0) -> Array:
    """g at the Gauss points of arcs, (points, arcs)."""
    return polynomial(series, start + distance / 2 * (1 + GAUSS_NODES[:, None]))


def _weighed(values: Array, distance: Array) -> Array:
    """Integrals over arcs of values at their Gauss points, in fractions of the period."""
    return GAUSS_WEIGHTS @ values * abs(distance) / (4 * math.pi)


def _reach(series: Array, span: Array, gap: Array) -> Array:
    """Signed d between 0 and `span` with g(start + d) - g(start) = gap > 0, g rising along span."""
    sign = np.sign(span)
    slope = _derivative(series)

    def excess(distance: Array) -> tuple[Array, Array]:
        d = sign * distance
        return d * polynomial(series[1:], d) - gap, sign * polynomial(slope, d)

    return sign * bracketed_newton(excess, 0.0, abs(span), abs(span) / 2)


def _near_reach(series: Array, span: Array, gap: Array) -> Array:
    """`_reach` to some 1e-8: the root of the parabola at the start, and Newton steps from there.

    Enough for the place of a kink, whose error counts by its square.
    """
    sign, order = np.sign(span), np.arange(1, len(series))[:, None]
    rising = series[1:] * sign**order
    steep = rising[0] + np.sqrt(np.maximum(rising[0] ** 2 + 4 * rising[1] * gap, 0.0))
    d = 2 * gap / np.where(steep > 0, steep, math.inf)
    for _ in range(NEAR_STEPS):
        d = np.clip(d, 0.0, abs(span))
        terms = rising * d ** (order - 1)
        slope = (order * terms).sum(0)
        d = d - ((terms * d).sum(0) - gap) / np.where(slope > 0, slope, math.inf)
    return sign * np.clip(d, 0.0, abs(span))

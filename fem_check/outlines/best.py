"""The outline of largest speed, by gradients."""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.outlines.gradient import Problem, outline_gradient
from fem_check.outlines.shapes import LegendreShape, Shape
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.friction.contact import Contact
from linear_theory.optimisation.certificate import GAIN, Certificate, certificate
from linear_theory.optimisation.problem import Evaluation, Linear, Region, Unusable
from linear_theory.optimisation.search import Ascent, climb
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]

SLIM, STOUT = 0.2, 2.0
"""Least and largest width of a `LegendreShape` over its mean, by default."""

CHANGE = 1e-5
"""Of the speed, relative, at which a climb ends: gradients are known to about 1e-3."""

FEW = 3
"""Parameters up to which second derivatives are computed, two gradients for each."""


class NoOutline(SheetcrawlError):
    """No outline between the bounds has a speed; says why not."""


@dataclass(frozen=True)
class BestOutline(Shown):
    """The outline of largest speed between bounds, `best_outline`.

    shape; speed: its V, towards +y or -y as asked; start: that of the outline as given; certificate: of
    the maximum, per range of each parameter; evaluations: speeds with gradients; words: how the search
    ended; seconds.
    """

    shape: Shape
    speed: Estimate
    start: Estimate
    certificate: Certificate
    evaluations: int
    words: str
    seconds: float

    @property
    def gain(self) -> float:
        """V over that of the outline as given."""
        return self.speed.value / self.start.value

    @property
    def converged(self) -> bool:
        """Whether no more than 2 % can be gained nearby, errors included."""
        return self.certificate.holds(GAIN)

    def _rows(self) -> Mapping[str, Any]:
        proof = self.certificate
        return {
            "shape": self.shape,
            "speed": with_error(*self.speed),
            "start": with_error(*self.start),
            "slope": with_error(proof.slope, proof.doubt),
            "held": proof.held,
            "left": proof.gain / abs(self.speed.value),
            "evaluations": self.evaluations,
            "words": self.words,
            "seconds": self.seconds,
        }


@one_blas_thread
def best_outline(
    shape: Shape,
    wave: Wave,
    alpha: float,
    over: Mapping[str, tuple[float, float]],
    contact: Contact | None = None,
    poisson: float = 0.5,
    *,
    towards: int = 1,
    slim: float = SLIM,
    stout: float = STOUT,
    rtol: float = 1e-3,
    cells: tuple[int, int] | None = None,
    how: Ascent | None = None,
) -> BestOutline:
    """The outline of largest V (towards = 1) or -V (towards = -1) in small-strain theory.

    shape: the outline to begin with, between the bounds; over: parameters by name, each between two
    bounds. slim, stout: least and largest width of a `LegendreShape` over its mean. The others as for
    `outline_gradient`.
    Dry friction may have kinks where part of the sheet is at rest: then the certificate does not hold.

    Raises ValueError for bad input, by name; `NoOutline` where no outline has a speed.

    >>> from fem_check import LegendreShape, best_outline
    >>> from linear_theory import Contact, SineWave, Tanh
    >>> start, contact = LegendreShape(0.5, 1.0, [0.1]), Contact(friction=Tanh(0.05))
    >>> over = {"coefficients.0": (-0.6, 0.6)}
    >>> found = best_outline(start, SineWave(), 0.1, over, contact, rtol=5e-3)
    >>> print(found.converged, abs(found.shape.coefficients[0]) < 0.02)  # of trapezoids the rectangle
    True True
    """
    if towards not in (1, -1):
        raise ValueError(f"towards = {validation.shown(towards)}: must be 1 or -1")
    Problem.of(shape, wave, alpha, contact, poisson, cells)
    validation.positive("rtol", rtol)
    space = Space.of(shape, over, slim, stout)

    def objective(point: Array) -> Evaluation:
        try:
            found = outline_gradient(
                space.shape(point), wave, alpha, space.names, contact, poisson, rtol, cells
            )
        except (SheetcrawlError, ValueError, ArithmeticError) as problem:
            raise Unusable(" ".join(str(problem).split())) from None
        if found.speed.beyond_reach:
            raise Unusable(found.speed.beyond_reach)
        value, slopes = towards * found.speed.mean, towards * space.ranges * found.values
        doubts, kink = space.ranges * found.errors, "; ".join(found.kinks)
        return Evaluation(value, found.speed.error, slopes, doubts, kink)

    begin, region = time.perf_counter(), space.region()
    known = _Remembered(objective)
    climbed = climb([known], known, region, space.point(shape), how or Ascent(change=CHANGE))
    if climbed.found is None:
        raise NoOutline(f"no outline has a speed; {climbed.words}")
    first, best = known(space.point(shape)), climbed.found
    few = len(space.names) <= FEW
    proof = certificate(known, region, climbed.point, space.names, few)
    return BestOutline(
        shape=space.shape(climbed.point),
        speed=Estimate(best.value, best.error),
        start=Estimate(first.value, first.error),
        certificate=proof,
        evaluations=known.count,
        words=climbed.words,
        seconds=time.perf_counter() - begin,
    )


class _Remembered:
    """An objective that is asked once for each point; count: how often it was."""

    def __init__(self, objective: Any) -> None:
        self._objective, self._known = objective, dict[bytes, Evaluation]()
        self.count = 0

    def __call__(self, point: Array, /) -> Evaluation:
        key = np.asarray(point, float).tobytes()
        if key not in self._known:
            self.count += 1
            self._known[key] = self._objective(point)
        return self._known[key]


@dataclass(frozen=True, eq=False)
class Space(Shown):
    """Parameters of a shape as unknowns from 0 to 1 between their bounds."""

    start: Shape
    names: tuple[str, ...]
    low: Array
    ranges: Array
    slim: float
    stout: float

    @classmethod
    def of(cls, shape: Shape, over: Any, slim: float, stout: float) -> "Space":
        """Checked. Raises ValueError, by name, for bounds that are no pairs, out of order, or without
        the shape that is given."""
        if not isinstance(over, Mapping) or not over:
            raise ValueError(f"over = {validation.shown(over)}: must map parameters to bounds")
        if not 0 < validation.real("slim", slim) < 1:
            raise ValueError(f"slim = {slim:g}: must be in (0, 1)")
        if not validation.real("stout", stout) > 1:
            raise ValueError(f"stout = {stout:g}: must be > 1")
        known, lows, highs = shape.parameters, [], []
        for name, bounds in over.items():
            validation.choice("over", name, known)
            pair = validation.real_array(f"over[{name!r}]", bounds)
            if pair.shape != (2,) or not pair[0] < pair[1]:
                raise ValueError(
                    f"over[{name!r}] = {validation.shown(bounds)}: must be (low, high), low < high"
                )
            low, high = pair.tolist()
            if not low <= known[name] <= high:
                raise ValueError(f"shape: {name} = {known[name]:g}: must be in [{low:g}, {high:g}]")
            lows.append(low)
            highs.append(high)
        return cls(shape, tuple(over), np.array(lows), np.array(highs) - np.array(lows), slim, stout)

    def shape(self, point: Array) -> Shape:
        """At a point. Raises ValueError where there is none."""
        shape = self.start
        for name, value in zip(self.names, (self.low + point * self.ranges).tolist(), strict=True):
            shape = shape.changed(name, value)
        return shape

    def point(self, shape: Shape) -> Array:
        """Of a shape."""
        values = np.array([shape.parameters[name] for name in self.names])
        return np.asarray((values - self.low) / self.ranges)

    def region(self) -> Region:
        """Between the bounds, and nowhere too slim or too stout."""
        count = len(self.names)
        constraints = self._widths() if isinstance(self.start, LegendreShape) else ()
        ends = np.zeros(count), np.ones(count)
        return Region(*ends, self.point(self.start), np.full(count, 0.25), constraints)

    def _widths(self) -> tuple[Linear, Linear]:
        """Bounds of the sum of Legendre's polynomials, which is linear in their coefficients."""
        shape = self.start
        assert isinstance(shape, LegendreShape)
        eta = np.linspace(-1, 1, shape.sides + 1)
        columns = np.polynomial.legendre.legvander(eta, len(shape.coefficients))[:, 1:]
        free = {n: int(n.partition(".")[2]) for n in self.names if n.startswith("coefficients.")}
        rows, fixed = np.zeros((eta.size, len(self.names))), 1 + columns @ shape.coefficients
        for place, name in enumerate(self.names):
            if name in free:
                column = columns[:, free[name]]
                rows[:, place] = column * self.ranges[place]
                fixed += column * (self.low[place] - shape.coefficients[free[name]])
        return (
            Linear(f"width >= {self.slim:g} of its mean", -rows, fixed - self.slim),
            Linear(f"width <= {self.stout:g} of its mean", rows, self.stout - fixed),
        )

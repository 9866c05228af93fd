"""What small strain answers within a fraction of a second: shape, friction, speed, V(alpha).

The friction balance of the sheet costs 30 ms for a sine and seconds for a narrow pulse, so that the
answers come one after the other, the quick ones first; whoever is told may stop after each.
"""

import functools
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.choice.prediction import predict
from fem_check.explorer.question import SMALL_STRAIN_RTOL, Question
from linear_theory.common.errors import SheetcrawlError
from linear_theory.deformation.airy import AirySeries, airy_series
from linear_theory.speed.crawl import SHOWN_RTOL, crawl_speed
from linear_theory.speed.friction_field import friction_field

Array = NDArray[np.float64]

STRIP, FIRST = "strip", "first order"
"""Names of the levels, as in `levels.LEVELS`."""

ACROSS, ALONG, PER_WAVE = 6, 48, 24
"""Cells of the picture: across the sheet, along it at least, and along each wavelength at least."""

ARROWS = 5, 15
"""Points with a friction arrow across and along the sheet."""

EDGE = 0.94
"""Fraction of the sheet on which the arrows stand."""

FRICTION_RTOL = 1e-2
"""Relative error of the friction forces, below the width of an arrow."""

KEPT = 256
"""Speeds that are kept: a slider that comes back, or moves alpha alone, finds them again."""

CURVE = (0.1, 0.2, 0.3, 0.4, 0.5)
"""|alpha| of the curves V(alpha), up to the reach of small strain."""


class Picture(NamedTuple):
    """The deformed sheet at one time.

    corners (4, 2, n): x, y of the corners of n cells; growth (n,): c in their centres; place (2, m),
    force (2, m): points and the friction on them, over mu times the weight per area; extent (2,): half
    the size of the undeformed sheet in x and y; seconds: spent.
    """

    corners: Array
    growth: Array
    place: Array
    force: Array
    extent: Array
    seconds: float


class Answer(NamedTuple):
    """A speed at one level: V and its numerical error, length per period; model_error: distance to the
    nonlinear sheet, NaN where unknown; problem: why there is none or what to mind, in words."""

    level: str
    alpha: float
    mean: float
    error: float
    model_error: float
    seconds: float
    problem: str = ""


@dataclass(frozen=True)
class Curve:
    """V(alpha) as far as it is known, in order of alpha; level: as in Answer."""

    level: str
    alphas: list[float] = field(default_factory=list)
    means: list[float] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)

    def with_point(self, alpha: float, mean: float, error: float) -> "Curve":
        """A copy with another point; unchanged where there is no speed."""
        if not np.isfinite(mean) or alpha in self.alphas:
            return self
        rows = sorted([*zip(self.alphas, self.means, self.errors, strict=True), (alpha, mean, error)])
        return Curve(self.level, *(list(column) for column in zip(*rows, strict=True)))


def answers(question: Question, phase: float) -> Iterator[Picture | Answer | Curve]:
    """The picture, then speed and curve of a narrow strip, then those of the sheet at small strain.

    phase: time of the picture in periods. The curve of the sheet comes once per point. Work that is
    already known costs nothing. Raises ValueError for a question out of range.

    >>> from fem_check.explorer.question import Question
    >>> from fem_check.explorer.small_strain import answers
    >>> picture, strip, *_ = answers(Question(), phase=0.0)
    >>> print(f"{strip.level}: V = {strip.mean:.4f} +- {strip.error + strip.model_error:.4f}")
    strip: V = 0.0208 +- 0.0031
    """
    yield picture(question, phase)
    yield strip(question)
    *_, whole = _curve(question, STRIP, strip)
    yield whole
    yield first_order(question)
    yield from _curve(question, FIRST, first_order)


def _curve(question: Question, level: str, solve: Callable[[Question], Answer]) -> Iterator[Curve]:
    """V(alpha) on the side of the question, after each point."""
    curve, sign = Curve(level, [0.0], [0.0], [0.0]), -1.0 if question.alpha < 0 else 1.0
    for alpha in CURVE:
        found = solve(question.but(sign * alpha))
        curve = curve.with_point(found.alpha, found.mean, found.error)
        yield curve


def picture(question: Question, phase: float) -> Picture:
    """The sheet at a time in periods, with the friction on it. Raises ValueError as `answers` does."""
    start, scene = time.perf_counter(), question.scene
    sheet, solved = scene.sheet, _deformation(question.but(0.0))
    t = phase * scene.period
    half = np.array([sheet.width, sheet.length]) / 2
    cells = (ACROSS, max(ALONG, PER_WAVE * abs(question.count)))
    nodes = np.stack(_grid(half, [n + 1 for n in cells]))
    moved = nodes + scene.alpha * solved.displacement(nodes[0], nodes[1], t)
    pieces = moved[:, :-1, :-1], moved[:, 1:, :-1], moved[:, 1:, 1:], moved[:, :-1, 1:]
    middle = (nodes[:, :-1, :-1] + nodes[:, 1:, 1:]) / 2
    growth = np.broadcast_to(scene.drive.value(middle[0], middle[1], t), middle.shape[1:])
    place, force = _friction(solved, question, half, t)
    corners = np.stack([piece.reshape(2, -1) for piece in pieces])
    return Picture(corners, growth.ravel(), place, force, half, time.perf_counter() - start)


def _friction(solved: AirySeries, question: Question, half: Array, t: float) -> tuple[Array, Array]:
    """Displaced points (2, m) and the friction on them; none where small strain has no friction."""
    x, y = (part.ravel() for part in _grid(EDGE * half, ARROWS))
    alpha, contact = question.alpha, question.contact
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the speed beside the picture says so
            load, law = contact.load, contact.friction
            found = friction_field(solved, alpha, x, y, t, load, law, rtol=FRICTION_RTOL)
    except (SheetcrawlError, ValueError):  # the speed beside the picture says why
        return np.zeros((2, 0)), np.zeros((2, 0))
    return np.stack([x, y]) + alpha * solved.displacement(x, y, t), found.force


def _grid(half: Array, points: list[int] | tuple[int, ...]) -> tuple[Array, Array]:
    """x, y of a grid over |x| <= half[0], |y| <= half[1]."""
    x, y = (s * np.linspace(-1, 1, n) for s, n in zip(half, points, strict=True))
    across, along = np.meshgrid(x, y, indexing="ij")
    return across, along


@functools.lru_cache(8)
def _deformation(question: Question) -> AirySeries:
    return airy_series(question.scene.sheet, question.wave, rtol=SHOWN_RTOL)


@functools.lru_cache(KEPT)
def strip(question: Question) -> Answer:
    """`predict` by the level "strip": finite strain, as if the sheet were narrow."""
    return _answered(STRIP, question, _strip)


def _strip(question: Question) -> Answer:
    found = predict(question.scene, rtol=question.rtol, level=STRIP)
    model_error, problem = found.speed.model_error, found.speed.beyond_reach
    return Answer(
        STRIP, question.alpha, found.mean, found.speed.error, model_error, found.seconds, problem
    )


@functools.lru_cache(KEPT)
def first_order(question: Question) -> Answer:
    """`crawl_speed` of the sheet at small strain, to SMALL_STRAIN_RTOL."""
    return _answered(FIRST, question, _first_order)


def _first_order(question: Question) -> Answer:
    found = crawl_speed(question.scene, rtol=SMALL_STRAIN_RTOL)
    errors = found.error, found.model_error
    return Answer(FIRST, question.alpha, found.mean, *errors, found.seconds, found.beyond_reach)


def _answered(level: str, question: Question, solve: Callable[[Question], Answer]) -> Answer:
    """The answer, or the reason that there is none, as an answer without a number."""
    start = time.perf_counter()
    try:
        with warnings.catch_warnings(record=True, action="always") as seen:
            found = solve(question)
    except (SheetcrawlError, ValueError) as problem:
        spent, none = time.perf_counter() - start, float("nan")
        return Answer(level, question.alpha, none, none, none, spent, " ".join(str(problem).split()))
    said = found.problem or "; ".join(str(warning.message) for warning in seen)
    return found._replace(problem=said)

"""A scene whose motion is known to first order, and the directions of the parameters asked for."""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Crawl
from linear_theory.balance.period import resolved
from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.ritz import ritz_field
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.means import Derivatives, Means
from linear_theory.gradient.parameters.names import parameters
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.quantity import Quantity
from linear_theory.gradient.resting import rests
from linear_theory.gradient.result import kinks_of
from linear_theory.scene.level import PLATE, THEORY
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import completed, speed_of
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.wave_error import with_wave_error
from linear_theory.wave.fractional import count_of

Array = NDArray[np.float64]

METHOD = "ritz"
"""The deformation of which there is an adjoint."""

MOST_WAVES = 150
"""On the sheet, of a harmonic that the wave need not have: six seconds of computing."""

FIELD_SHARE = 0.1
"""Fraction of rtol allotted to the deformation."""


def asked(scene: Any, over: Any, order: int = 1) -> tuple[tuple[Parameter, ...], list[Direction]]:
    """Parameters and their directions. Raises ValueError as `speed_gradient` does."""
    scene = validation.instance("scene", scene, Scene)
    (PLATE if order == 2 and not scene.planar else THEORY).require(scene)
    if scene.alpha == 0:
        raise ValueError(
            "alpha = 0: must not be 0, where V = 0 whatever the wave; second_order gives V/alpha"
        )
    chosen = parameters(over)
    directions = [one.direction(scene) for one in chosen]
    _check_waves(scene, chosen, directions)
    return chosen, directions


def _check_waves(scene: Scene, chosen: Sequence[Parameter], directions: Sequence[Direction]) -> None:
    """Raise ValueError for a harmonic that is too short."""
    series = scene.drive.series
    for one, direction in zip(chosen, directions, strict=True):
        if not direction.highest:
            continue
        count = abs(count_of(scene.wave))
        own = count * int(series.harmonics[-1]) if series is not None else 0.0
        if (waves := direction.highest * count) > max(MOST_WAVES, own):
            raise ValueError(
                f"over = {one.name!r}: the harmonic has {waves:.0f} waves on the sheet, must have at "
                f"most {MOST_WAVES}, or as many as the wave of the scene: work grows with their cube"
            )


class Solved(NamedTuple):
    """A scene whose motion is known, and the directions of its parameters."""

    speed: CrawlSpeed
    course: Course
    parameters: tuple[Parameter, ...]
    directions: Sequence[Direction]
    rtol: float

    @classmethod
    def of(cls, scene: Scene, over: Any, rtol: float) -> "Solved":
        """Raises ValueError as `speed_gradient` does."""
        chosen, directions = asked(scene, over)
        tolerance = Tolerance(rtol)
        courses: list[Course] = []

        def solve(tolerance: Tolerance) -> CrawlSpeed:
            start = time.perf_counter()
            own = tolerance.of_speed(scene.alpha, scene.unit)
            least = max(FIELD_SHARE * own.rtol, validation.SMALLEST_RTOL)
            field = ritz_field(scene.sheet, scene.wave, rtol=least)
            found = resolved(Crawl.to(own.rtol, field, scene.alpha, scene.contact), own)
            courses.append(found.course)
            speed = speed_of(found, own)
            return replace(speed, seconds=time.perf_counter() - start)

        speed = completed(with_wave_error(scene, tolerance, solve), scene, 1, METHOD)
        return cls(speed, courses[-1], chosen, directions, tolerance.rtol)

    def means(self, quantities: Sequence[Quantity]) -> Means:
        """Derivatives of the means of quantities."""
        return Derivatives(self.course, self.directions, quantities, self.rtol**0.5).means()

    def kinks(self, means: Means) -> tuple[str, ...]:
        """Why derivatives are subgradients only."""
        dry = self.course.crawl.contact.friction.width == 0
        still = dry and (self.course.motion.fastest == 0 or rests(self.course))
        return kinks_of(self.speed.sticks or still, means.flat)

    def by_motion(
        self, means: Means, which: int, own: Estimate, sign: float = 1.0
    ) -> tuple[Array, Array]:
        """Of a speed that is alpha times a quantity, or |alpha| times that with its sign; own: it."""
        alpha = self.course.crawl.alpha
        explicit = np.array([one.alpha / alpha - one.period for one in self.directions])
        values = sign * alpha * means.values[which] + own.value * explicit
        return values, abs(alpha) * means.errors[which] + own.error * abs(explicit)

"""V on a frozen grid of times and cells, whose derivative is exact, and central differences of it."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from figures.measure.gradient.scenes import names_of
from linear_theory import Directional, Scene, Sheet
from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Crawl, joint_resolution
from linear_theory.balance.time_grid import first_grid
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.ritz import ritz_field
from linear_theory.gradient import Parameter, parameters
from linear_theory.gradient.means import Derivatives
from linear_theory.gradient.quantity import ALONG
from linear_theory.motion.motion import CellGrid

Array = NDArray[np.float64]

DEGREE, CELLS_RTOL, PANELS = (9, 17), 1e-4, 5
"""Of the frozen grid: degrees, tolerance of its cells, panels of its times."""

STEP, SHORT = 4e-4, 1e-5
"""Of the central difference, relative; its error is of the fourth power. The latter for friction
that is not smooth: over longer ones points of the grid pass through rest, or through a crease."""


@dataclass(frozen=True)
class FrozenCrawl(Crawl):
    """A crawl with cells that keep their places as shares of the width, those of another sheet."""

    of: Sheet = field(kw_only=True)

    @property
    def grid(self) -> CellGrid:
        """See Crawl."""
        own = replace(self, field=ritz_field(self.of, self.field.wave, degree=3)).cells
        stretch = self.field.sheet.width / self.of.width
        return replace(own, x_edges=tuple(stretch * x for x in own.x_edges))

    @property
    def cells(self) -> CellGrid:
        """Of the own sheet."""
        return super().grid


@dataclass(frozen=True)
class Frozen:
    """V of scenes at the times and cells of one; tolerance: of the balance."""

    scene: Scene
    tolerance: float = 1e-12

    def course(self, scene: Scene) -> Course:
        """The motion of a scene near the own one."""
        deformation = ritz_field(scene.sheet, scene.wave, degree=DEGREE)
        smooth = not scene.contact.friction.limited
        cells = joint_resolution(CELLS_RTOL, smooth)
        cells = replace(cells, halvings=0, tolerance=self.tolerance)
        crawl = FrozenCrawl(deformation, scene.alpha, scene.contact, cells, of=self.scene.sheet)
        grid = first_grid(0.0, scene.period, PANELS)
        return Course(crawl, grid, crawl.balance(grid.times))

    def speed(self, scene: Scene) -> float:
        """Its mean speed."""
        return float(self.course(scene).mean[1])

    def by_adjoint(self, over: Sequence[Parameter]) -> Array:
        """Derivatives by each parameter."""
        course = self.course(self.scene)
        directions = [one.direction(self.scene) for one in over]
        found = Derivatives(course, directions, [ALONG], np.inf).means().values[0]
        explicit = np.array([one.alpha / self.scene.alpha for one in directions])
        return np.asarray(self.scene.alpha * found + float(course.mean[1]) * explicit)

    def along(self, over: Sequence[Parameter], direction: Array) -> float:
        """Derivative along a direction by a central difference of fourth order."""

        def at(step: float) -> float:
            scene = self.scene
            for one, part in zip(over, direction, strict=True):
                scene = one.changed(scene, one.value(self.scene) + step * part)
            return self.speed(scene)

        friction = self.scene.contact.friction
        smooth = friction.width > 0 and not isinstance(friction, Directional)
        step = STEP if smooth else SHORT
        near, far = (at(k * step) - at(-k * step) for k in (1, 2))
        return (8 * near - far) / (12 * step)


@one_blas_thread
def difference(scene: Scene, random: np.random.Generator) -> float:
    """Of both derivatives along a random direction, over the size of all parts of it."""
    over, frozen = parameters(names_of(scene)), Frozen(scene)
    sizes = [max(abs(one.value(scene)), 0.1) for one in over]
    direction = random.uniform(-1, 1, len(over)) * sizes
    slopes = frozen.by_adjoint(over) * direction
    size = float(np.sqrt(np.sum(slopes**2)))
    return abs(float(slopes.sum()) - frozen.along(over, direction)) / (size or 1.0)

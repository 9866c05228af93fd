"""The gradient of the speed against central differences, at random scenes, and what it costs.

    python -m figures.measure.gradient [--out FILE] [--scenes 100]

Writes figures/data/gradient.csv: ten minutes of computing. Random scenes: a sheet, a travelling wave of
2 to 5 harmonics with a mean, a coupling of either sign, a load, and a law of friction. Of each:

* V on a frozen grid of times and cells, along a random direction in the space of all parameters: the
  derivative by the adjoint, and by central differences of fourth order (but for dry friction);
* the errors that `speed_gradient` states, against those it has: the derivatives of a speed that is 10
  to 30 times as accurate are the truth.

Then the cost of 40 parameters, for a wave of 18 harmonics: seconds of the processor for the gradient
over those for the speed.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FrictionLaw,
    Scene,
    Sheet,
    Tanh,
    TravellingWave,
    Viscous,
    crawl_speed,
)
from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Crawl, joint_resolution
from linear_theory.balance.time_grid import first_grid
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.ritz import ritz_field
from linear_theory.gradient import Parameter, parameters, speed_gradient
from linear_theory.gradient.means import Derivatives
from linear_theory.gradient.quantity import ALONG
from linear_theory.motion.motion import CellGrid

Array = NDArray[np.float64]

LAWS = ("viscous", "tanh", "directional", "coulomb")
"""Of the scenes in turn; "directional" is tanh friction with a direction."""

SEED = 20261126

DEGREE, CELLS_RTOL, PANELS = (9, 17), 1e-4, 5
"""Of the frozen grid: degrees, tolerance of its cells, panels of its times."""

STEP = 4e-4
"""Of the central difference, relative; its error is of the fourth power."""

LOOSE, TIGHT, TIGHT_DRY = 1e-3, 3e-5, 1e-4
"""Relative tolerances of the speeds whose gradients are compared; the last for dry friction."""

MANY = 18
"""Harmonics of the waves with 40 parameters."""

DIGITS = 4


@dataclass(frozen=True)
class Row:
    """One scene.

    kind: "accuracy" or "cost"; friction, load, harmonics, alpha, width, poisson: of the scene; count:
    of parameters; difference: of both derivatives on a frozen grid, over the size of the derivative;
    rtol: of the speed; share: largest true error over the stated one; ratio: seconds of the gradient
    over those of the speed. NaN where not measured.
    """

    kind: str
    friction: str
    load: str
    harmonics: int
    alpha: float
    width: float
    poisson: float
    count: int
    difference: float
    rtol: float
    share: float
    ratio: float


TABLE = Table(
    DATA / "gradient.csv",
    Row,
    "python -m figures.measure.gradient",
    "difference: of the derivative by the adjoint and by central differences on a frozen grid, "
    "relative; share: largest error of a derivative over the stated one; ratio: processor time of the "
    "gradient over that of the speed",
    DIGITS,
)


def law(name: str, random: np.random.Generator) -> FrictionLaw:
    """One of that kind; of slip speeds from dry to viscous."""
    slip = Tanh(float(np.exp(random.uniform(np.log(0.02), np.log(0.5)))))
    if name == "directional":
        forward, backward, sideways = random.uniform(0.5, 1.5, 3).tolist()
        return Directional(forward, backward, sideways, form=slip)
    return {"viscous": Viscous(), "tanh": slip, "coulomb": Coulomb()}[name]


def scene_of(name: str, random: np.random.Generator, harmonics: int | None = None) -> Scene:
    """A random scene with friction of that kind; harmonics: 2 to 5 unless given."""
    count = int(random.integers(2, 6)) if harmonics is None else harmonics
    k = np.arange(1, count + 1)
    cosine, sine = random.normal(size=(2, count)) / k**1.5
    size = np.hypot(cosine, sine).sum()
    wave = TravellingWave(
        cosine / size, sine / size, int(random.choice([-1, 1, 2])), 1.0, random.uniform(-0.2, 0.2)
    )
    sheet = Sheet(width=float(random.uniform(0.2, 1.0)), poisson=float(random.uniform(-0.3, 0.5)))
    alpha = float(random.choice([-1, 1]) * random.uniform(0.05, 0.25))
    load = str(random.choice(["current", "grown", "material"]))
    if name == "viscous" and load == "material":
        load = "current"  # V = 0 otherwise, whatever the wave
    return Scene(sheet, wave, alpha=alpha, contact=Contact(load, law(name, random)))


def names_of(scene: Scene) -> list[str]:
    """All parameters of a random scene but its period."""
    assert isinstance(scene.wave, TravellingWave)
    waves = [f"wave.{part}.{k}" for k in range(scene.wave.cosine.size) for part in ("cosine", "sine")]
    friction = scene.contact.friction
    names = ["growth.alpha", "sheet.width", "sheet.poisson", "wave.mean", *waves]
    if isinstance(friction, Directional):
        names += [f"friction.{name}" for name in ("forward", "backward", "sideways")]
    return names + (["friction.slip_speed"] if friction.regularised else [])


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

        near, far = (at(k * STEP) - at(-k * STEP) for k in (1, 2))
        return (8 * near - far) / (12 * STEP)


@one_blas_thread
def difference(scene: Scene, random: np.random.Generator) -> float:
    """Of both derivatives along a random direction, over the size of all parts of it."""
    over, frozen = parameters(names_of(scene)), Frozen(scene)
    sizes = [max(abs(one.value(scene)), 0.1) for one in over]
    direction = random.uniform(-1, 1, len(over)) * sizes
    slopes = frozen.by_adjoint(over) * direction
    size = float(np.sqrt(np.sum(slopes**2)))
    return abs(float(slopes.sum()) - frozen.along(over, direction)) / (size or 1.0)


def share(scene: Scene) -> float:
    """Largest error over the stated one, of all parameters; errors below rounding do not count."""
    finer = TIGHT if scene.contact.friction.width > 0 else TIGHT_DRY
    loose, tight = (speed_gradient(scene, names_of(scene), rtol=rtol) for rtol in (LOOSE, finer))
    errors = abs(loose.values - tight.values)
    floor = 1e-12 * abs(tight.values).max()
    return float(np.max((errors - floor) / np.maximum(loose.errors, floor), initial=0.0))


def accuracy(name: str, random: np.random.Generator) -> Row:
    """A row of the first kind."""
    scene = scene_of(name, random)
    smooth = scene.contact.friction.width > 0
    off = difference(scene, random) if smooth else np.nan
    return _row("accuracy", name, scene, off, share(scene), np.nan)


def cost(name: str, random: np.random.Generator) -> Row:
    """A row of the second kind."""
    scene = scene_of(name, random, MANY)
    chosen = [one for one in names_of(scene) if not one.startswith("friction")]
    start = time.process_time()
    speed_gradient(scene, chosen, rtol=LOOSE)
    middle = time.process_time()
    crawl_speed(scene, rtol=LOOSE, method="ritz")
    speed = time.process_time() - middle
    ratio = (middle - start - speed) / speed
    return _row("cost", name, scene, np.nan, np.nan, ratio, len(chosen))


def _row(
    kind: str, name: str, scene: Scene, off: float, part: float, ratio: float, count: int | None = None
) -> Row:
    assert isinstance(scene.wave, TravellingWave)
    return Row(
        kind,
        name,
        str(scene.contact.load),
        scene.wave.cosine.size,
        scene.alpha,
        scene.sheet.width,
        scene.sheet.poisson,
        len(names_of(scene)) if count is None else count,
        off,
        LOOSE,
        part,
        ratio,
    )


def compute(scenes: int = 100) -> list[Row]:
    """All rows, saying how far it is."""
    random = np.random.default_rng(SEED)
    chosen = [(accuracy, LAWS[i % len(LAWS)]) for i in range(scenes)] + [(cost, n) for n in LAWS]
    return [make(name, random) for make, name in tracked("gradient", chosen)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, scenes=(100, "random scenes"))
    TABLE.write(compute(options.scenes), options.out)

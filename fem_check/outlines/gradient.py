"""The gradient of the speed with respect to the numbers of an outline.

At a fixed point of a fixed grid of the square (see `shapes`) a parameter changes place, area, velocity,
dilation and growth. These changes are smooth in it: they are central differences of the deformation
alone, one solve per parameter with the kept factor. What they change in V is the adjoint of the balance
(`linear_theory.gradient.adjoint`), one linear solve for all of them:

    dV = alpha mean over the period of int psi_v . dv + psi_e de + psi_A d(log A).

Motion, grid and outline are mirror symmetric in x: moment arms do not matter.
"""

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.outlines.field import Cells, HalfField, Setting
from fem_check.outlines.shapes import Shape
from linear_theory.balance.course import Course
from linear_theory.balance.crawl import BATCH, Crawl
from linear_theory.balance.period import resolved
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.common import validation
from linear_theory.common.shown import Shown, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.contact import Contact
from linear_theory.gradient.adjoint import AdjointBalance
from linear_theory.gradient.means import CHECKED
from linear_theory.gradient.quantity import ALONG
from linear_theory.gradient.result import kinks_of
from linear_theory.motion.motion import Motion
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.crawl import speed_of
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave import arguments
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

STEP = 1e-4
"""Of a parameter, relative to it or to the mean width or 1: differences are off by its square."""

CELLS = Cells(1, 8)
"""Of trapezoids; curved outlines have sides enough."""


@dataclass(frozen=True)
class OutlineGradient(Shown):
    """Derivatives of V with respect to parameters of a shape, `outline_gradient`.

    shape; speed: by small-strain theory; names; values, errors (parameters,): length per time and unit
    of each parameter, the latter estimated and absolute; kinks: why they are subgradients only, in
    words; seconds: for the derivatives.
    """

    shape: Shape
    speed: CrawlSpeed
    names: tuple[str, ...]
    values: Array
    errors: Array
    kinks: tuple[str, ...]
    seconds: float

    def __getitem__(self, name: str) -> float:
        """The derivative by a parameter. Raises KeyError for another one."""
        return float(dict(zip(self.names, self.values, strict=True))[name])

    def _rows(self) -> Mapping[str, Any]:
        each = zip(self.names, self.values, self.errors, strict=True)
        rows = {name: with_error(value, error) for name, value, error in each}
        return {"shape": self.shape, "kinks": self.kinks, **rows, "seconds": self.seconds}


@one_blas_thread
def outline_gradient(
    shape: Shape,
    wave: Wave,
    alpha: float,
    over: Iterable[str] | None = None,
    contact: Contact | None = None,
    poisson: float = 0.5,
    rtol: float = 1e-3,
    cells: tuple[int, int] | None = None,
) -> OutlineGradient:
    """Speed of an outline in small-strain theory, and its derivatives by parameters of the outline.

    shape: see `shapes`; wave: c(y, t), of the length of the outline; alpha: growth coupling, not 0;
    over: names among `shape.parameters`, all by default; contact: normal load and friction, without a
    map and the same for slip to either side, "current" and dry by default; rtol: of the speed;
    cells: of the mesh, pairs across and along each side of the outline.

    Raises ValueError for bad input, by name, and where growth is too large for the theory.

    >>> from fem_check import Trapezoid, outline_gradient
    >>> from linear_theory import Contact, SineWave
    >>> shape = Trapezoid(rear=0.6, front=0.4, length=1.0)
    >>> found = outline_gradient(shape, SineWave(), 0.1, ["rear"], Contact(friction="viscous"))
    >>> print(f"V = {found.speed.mean:.5f}, dV/d(rear) = {found['rear']:.5f}")
    V = 0.01024, dV/d(rear) = 0.00062
    """
    names = _names(shape, over)
    problem = Problem.of(shape, wave, alpha, contact, poisson, cells)
    tolerance = Tolerance(validation.tolerance(rtol)).of_speed(
        problem.alpha, shape.length / wave.period
    )
    crawl = Crawl.to(tolerance.rtol, problem.field(), problem.alpha, problem.contact)
    found = resolved(crawl, tolerance)
    begin, speed = time.perf_counter(), speed_of(found, tolerance)
    values, errors, flat = _means(problem, found.course, names)
    dry = problem.contact.friction.width == 0
    kinks = kinks_of(speed.sticks or (dry and speed.energy is None), flat)
    return OutlineGradient(shape, speed, names, values, errors, kinks, time.perf_counter() - begin)


def _names(shape: Any, over: Iterable[str] | None) -> tuple[str, ...]:
    """Checked. Raises ValueError for none, unknown ones and one that is named twice."""
    known = validation.instance("shape", shape, Shape).parameters  # type: ignore[type-abstract]
    names = tuple(known) if over is None else (over,) if isinstance(over, str) else tuple(over)
    if not names:
        raise ValueError("over = []: must name at least one parameter")
    for name in names:
        validation.choice("over", name, known)
        if names.count(name) > 1:
            raise ValueError(f"over: {name!r} is named twice, must be named once")
    return names


class Problem(NamedTuple):
    """An outline and all that its speed depends on."""

    shape: Shape
    wave: Wave
    alpha: float
    contact: Contact
    poisson: float
    cells: Cells

    @classmethod
    def of(
        cls,
        shape: Shape,
        wave: Wave,
        alpha: float,
        contact: Contact | None,
        poisson: float,
        cells: tuple[int, int] | None,
    ) -> "Problem":
        """Checked. Raises ValueError, by name."""
        wave, alpha = arguments.wave(wave), validation.real("alpha", alpha)
        if alpha == 0:
            raise ValueError("alpha = 0: must not be 0, where V = 0 whatever the outline")
        contact = validation.instance("contact", contact or Contact(), Contact)
        law = contact.friction
        if law.map is not None or law.on_lower_face or not law.mirrored or contact.slope:
            raise ValueError(
                f"contact = {validation.shown(contact)}: must be level, on the mid-surface, without a "
                "map and the same for slip to either side"
            )
        chosen = CELLS if shape.sides == 1 else Cells(1, 1)
        if cells is not None:
            chosen = Cells(*(validation.integer("cells", count, 1) for count in cells))
        box = Sheet(shape.length, float(shape.widths().max()), poisson)
        if not (driven := drive(wave, box)).mirrored or driven.depends_on_x:
            raise ValueError(f"wave = {validation.shown(wave)}: must be known not to depend on x")
        return cls(shape, wave, alpha, contact, box.poisson, chosen)

    @property
    def setting(self) -> Setting:
        """What the deformation depends on beside the outline."""
        return Setting(self.wave, self.poisson, self.cells)

    def field(self) -> HalfField:
        """The deformation."""
        return self.setting.field(self.shape)

    def beside(self, name: str) -> tuple[Shape, Shape, float]:
        """Outlines on either side of a parameter, and by how much it differs."""
        value = self.shape.parameters[name]
        step = STEP * (1.0 if "." in name else abs(value) or 1.0)
        ahead, behind = (self.shape.changed(name, value + sign * step) for sign in (1, -1))
        return ahead, behind, 2 * step


def _means(problem: Problem, course: Course, names: tuple[str, ...]) -> tuple[Array, Array, bool]:
    """Derivatives of V, their errors, and whether at some time friction does not resist the motion.

    The error is that of the mean over time, and what a mesh of twice the size, and finer quadrature,
    change at three times.
    """
    crawl, times, motion = course.crawl, course.grid.times, course.motion
    pairs = [problem.beside(name) for name in names]
    values, flat = _Frozen(crawl, problem.setting, pairs).derivatives(times, motion)
    means, errors = course.grid.means(values)
    some = np.unique((np.array(CHECKED) * times.size).astype(int))
    coarse = problem.setting._replace(coarse=True)
    rough = replace(crawl, field=coarse.field(problem.shape), resolution=crawl.resolution.finer())
    part = motion._replace(leading=motion.leading[some], remainder=motion.remainder[some])
    other, _ = _Frozen(rough, coarse, pairs).derivatives(times[some], part)
    change = abs(other - values[:, some]).max(1)
    return crawl.alpha * means, abs(crawl.alpha) * (errors + change), flat


class _Frozen:
    """A crawling sheet and its neighbours along each parameter, on one grid."""

    def __init__(
        self, crawl: Crawl, setting: Setting, pairs: Sequence[tuple[Shape, Shape, float]]
    ) -> None:
        self.crawl, self.setting, self.pairs = crawl, setting, pairs
        self._kept: list[tuple[HalfField, HalfField, float]] = []

    def _beside(self, times: Array) -> list[tuple[HalfField, HalfField, float]]:
        """Deformations of the neighbours; those of a wave that is a series serve all times."""
        field = self.crawl.field
        assert isinstance(field, HalfField)
        if not self._kept or field.drive.series is None:
            self._kept = [
                (*self.setting.beside(field, times, ahead, behind), apart)
                for ahead, behind, apart in self.pairs
            ]
        return self._kept

    def derivatives(self, times: Array, motion: RigidMotion) -> tuple[Array, bool]:
        """Of q at times (T,), (parameters, T); of q - q_0 where q_0 has no mean, by symmetry."""
        size = max(BATCH // self.crawl.points, 1)
        parts = [
            self._batch(times[i : i + size], motion, slice(i, i + size))
            for i in range(0, times.size, size)
        ]
        found, flat = zip(*parts, strict=True)
        return np.concatenate(found, axis=1), any(flat)

    def _batch(self, times: Array, motion: RigidMotion, some: slice) -> tuple[Array, bool]:
        crawl = self.crawl
        balance = crawl.balance_of(AdjointBalance, times)
        changes = [self._change(one, times) for one in self._beside(times)]
        leading, remainder = motion.leading[some], motion.remainder[some]
        whole = leading + crawl.alpha * remainder
        found, flat = self._along(balance, whole, crawl.alpha, changes)
        if crawl.starts_at_second_order:
            found = found - self._along(balance, leading, 0.0, changes)[0]
        return found, flat

    def _along(
        self, balance: AdjointBalance, q: Array, alpha: float, changes: list[Motion]
    ) -> tuple[Array, bool]:
        """Derivatives of a motion q (T, 3) with the load 1 + alpha e, (parameters, T)."""
        q = balance.polished(q, alpha) if self.setting.coarse else q
        at = balance.weights(q, alpha, [ALONG], maps=True)
        assert at.area is not None
        rows = []
        for change in changes:
            rate = self.crawl.contact.load.rate(change.dilation, change.growth)
            by_area = (at.area[0] * change.area).sum((1, 2, 3))
            by_load = (at.load[0] * rate).sum((1, 2, 3)) if alpha else 0.0
            rows.append((at.velocity[0] * change.velocity).sum((0, 2, 3, 4)) + by_area + by_load)
        return np.stack(rows), bool(at.flat.any())

    def _change(self, one: tuple[HalfField, HalfField, float], times: Array) -> Motion:
        """What a parameter changes per unit, at fixed points; of the area the logarithm."""
        *fields, apart = one
        order = self.crawl.resolution.order
        ahead, behind = (field.motion(times, self.crawl.grid, order) for field in fields)
        return replace(
            ahead,
            area=np.log(ahead.area / behind.area) / apart,
            velocity=(ahead.velocity - behind.velocity) / apart,
            dilation=(ahead.dilation - behind.dilation) / apart,
            growth=(ahead.growth - behind.growth) / apart,
        )

"""The speed of a sheet that is not deformed by friction: a cycle of shapes and the friction balance.

The balance is that of linear theory, with absolute velocities: at every time the rigid motion V, Omega
is found for which friction exerts no net force and no net moment (eq. 11 with the velocities and the
area element of the nonlinear sheet).
"""

import math
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.shell.abilities import CYCLE
from fem_check.shell.cycle.balance import CycleBalance, PairedPeriod
from fem_check.shell.cycle.contact import creep, held_contact
from fem_check.shell.cycle.deformation import CycleDeformation
from fem_check.shell.cycle.motion import UnresolvedError
from fem_check.shell.cycle.shapes import Shapes, cycle_of_shapes
from fem_check.shell.effects.friction import friction_over_growth
from fem_check.shell.kinematics.crossing import crossing_words
from fem_check.shell.kinematics.places import distinct
from fem_check.shell.model import ShellModel
from linear_theory.common import validation
from linear_theory.common.progress import Report, watched
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.energy.energy import Energy
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.scene.dragged import mean_map_of
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed, Estimate, RigidSpeed
from linear_theory.speed.wave_error import with_wave_error
from linear_theory.speed.words import model_words

Array = NDArray[np.float64]

FIRST_PHASES, MOST_PHASES = 16, 128

PHASE_SHARE = 0.2
"""Fraction of the tolerance allotted to the interpolation between phases."""

MESH_ORDER = 2
"""Lower bound of the convergence order of V in the element size: at square corners u ~ distance**2.74.
The difference to a mesh r times coarser is at least r**2 - 1 times the error."""


def cycle_speed(
    scene: Scene,
    load: Load | str | None = None,
    friction: FrictionLaw | str | None = None,
    slip_speed: float | None = None,
    rtol: float = 1e-3,
    atol: float | None = None,
    *,
    progress: bool | Report | None = None,
) -> CrawlSpeed:
    """Mean speed of a sheet too stiff for friction to change its shape.

    Normal load and friction law are those of the scene. In the plane, Gravity defines the load:
    "current" (area of the deformed sheet), "grown" (sqrt det abar) or "material" (weight conserved);
    with Ground it is "ground", its reaction. Friction has the law tanh(v/slip_speed). If the scene
    names none of these, the arguments apply: load, "current" by default; friction, "coulomb" by
    default, "tanh" with its slip_speed (length/time), or "viscous". On an incline (Gravity in the
    plane, with Friction) weight pulls the sheet downhill: the balance is then at a shifted quantile,
    and V of first order in alpha. rtol, atol: the result is converged if error <= max(rtol |mean|,
    atol), atol = 1e-3 rtol alpha^2 L/T unless given; without mirror symmetry the norms of rigid_error
    and rigid_mean are used (see `rigid.RigidNorm`).

    Phases and times are added until they meet the tolerance. The mesh is that of the scene; its error
    is estimated from another mesh (`other_mesh`) and can leave a result unconverged. So can a sheet
    that passes through itself (`model` says so, see `Shapes.crossed`), growth so strong that the shape
    would not exist on finer meshes (UnstableError if it does not exist on this mesh), or so small that
    alpha^2 is below roundoff, 1e-15 L/T (alpha < 3e-7 at rtol = 1e-2): for such speeds use
    `linear_theory.crawl_speed` with order = 2.
    model_error is 0 for a scene that only stretches in the plane, which is the target: the nonlinear
    sheet with the stated growth law, area measure and load; NaN for other scenes, such as those with
    Friction, which deforms the sheet slightly.
    progress: True prints on stderr, a function is called with a `Progress`.

    Raises ValueError for bad input, for a scene with effects that a cycle of shapes cannot represent
    (see `abilities.CYCLE`), for arguments that contradict the scene and for a slope on which friction
    cannot hold the sheet, ConvergenceError if a shape is not found or not stable (see
    `cycle_of_shapes`), UnresolvedError if the shapes change too fast for the largest number of
    phases. Warns (ViscousRegimeWarning) if friction = "tanh" acts as viscous: see
    `CrawlSpeed.regime`.

    >>> from fem_check import Material, Membrane, Scene, cycle_speed
    >>> from linear_theory import Sheet, SineWave
    >>> stretching = Membrane(Material(thickness=0.03, poisson=0.5))
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.25, effects=[stretching], cells=(2, 4))
    >>> speed = cycle_speed(scene, load="current", rtol=1e-2)
    >>> print(f"V = {speed.mean:.3f} L/T, converged {speed.converged}")
    V = 0.091 L/T, converged True
    """
    hint = "make one by Scene(sheet, wave, alpha, effects=...)"
    scene = validation.instance("scene", scene, Scene, hint).resting(load, friction, slip_speed)
    with watched(progress, "cycle_speed"):
        found = with_wave_error(scene, Tolerance(rtol, atol), Cycle(scene).speed)
    warn_if_viscous(scene.contact.friction, found.slip_ratio)
    return found


class Cycle(Shown):
    """A cycle of static shapes, independent of the normal load and of friction.

    Computed on first use and kept, so that speeds for several contacts share it. Raises ValueError for
    a scene with effects that it cannot represent.
    """

    def __init__(self, scene: Scene) -> None:
        CYCLE.require(scene)
        self.scene = scene
        self._shapes = KeptShapes(ShellModel(scene))
        self.solved: tuple[CycleBalance, PairedPeriod] | None = None
        """Of the last speed, for its derivatives."""

    def _contents(self) -> Mapping[str, Any]:
        return {"scene": self.scene}

    @one_blas_thread
    def speed(self, tolerance: Tolerance, contact: Contact | None = None) -> CrawlSpeed:
        """As `cycle_speed`, without the warning; `seconds` includes the shapes if computed here.

        contact: replaces that of the scene.
        """
        start = time.perf_counter()
        scene = self.scene if contact is None else self.scene.but(contact=contact)
        contact, tolerance = held_contact(scene), tolerance.of_speed(scene.alpha, scene.unit)
        scene.drive.check_period()
        if scene.alpha == 0 and (scene.planar or scene.curvature_coupling == 0):
            return _without_growth(scene, contact)
        balance, period, phase_error = _with_enough_phases(self._shapes, contact, tolerance)
        self.solved = balance, period
        mesh_error, work_error = self._mesh_errors(balance, period)
        error = period.error + phase_error[:3] + mesh_error
        times, rigid, spent = balance.whole_period(period)
        distance = 0.0 if _is_target(scene) else math.nan
        power, work_error = period.power, work_error + float(phase_error[3])
        power = Estimate(power.value, power.error + work_error)
        fastest = period.fastest if period.fastest > balance.noise else 0.0
        return CrawlSpeed(
            estimate=Estimate(float(period.mean[1]), float(error[1])),
            model_error=distance,
            converged=self._sound(balance) and balance.norm.meets(period.mean, error, tolerance),
            times=times,
            velocity=rigid[1],
            seconds=time.perf_counter() - start,
            model=_words(scene, contact, balance.shapes),
            slip_ratio=contact.friction.slip_ratio(fastest),
            first_order=0.0 if _starts_at_second_order(scene, contact) else math.nan,
            sticks=period.sticks,
            turning=None if balance.mirrored else RigidSpeed(rigid, period.mean, error),
            energy=Energy(power, spent, contact.friction, mean_map_of(scene), contact.slope, distance),
            deformation=CycleDeformation(balance.shapes, contact, self.other(balance)),
        )

    @cached_property
    def _compared(self) -> tuple["KeptShapes", float]:
        """Shapes on the other mesh, and the smallest ratio of the difference to the error."""
        mesh, gain = other_mesh(self._shapes.model.discretisation.mesh)
        return KeptShapes(ShellModel(self.scene.but(cells=None, mesh=mesh))), gain

    def other(self, balance: CycleBalance) -> tuple[Shapes, float]:
        """Shapes at the same phases on the other mesh, and the gain."""
        kept, gain = self._compared
        return kept.at(len(balance.shapes.states)), gain

    def _mesh_errors(self, balance: CycleBalance, period: PairedPeriod) -> tuple[Array, float]:
        """Mesh errors of the mean motion and of the power, from another mesh at the same times."""
        shapes, gain = self.other(balance)
        other = balance.on(shapes).balance(period.grid.times)
        power = balance.power(period.grid, other.works).value - period.power.value
        return abs(balance.mean(period.grid, other.leading) - period.mean) / gain, abs(power) / gain

    def _sound(self, balance: CycleBalance) -> bool:
        """Whether a real sheet has these shapes: they do not cross themselves, nor need this mesh."""
        crossed = balance.shapes.crossed
        return (crossed is None or not crossed.any()) and self._stable(balance)

    def _stable(self, balance: CycleBalance) -> bool:
        """Whether the shapes exist on finer meshes, from the stability margin on two meshes."""
        kept, gain = self._compared
        own = balance.shapes.reserve
        change = kept.at(len(balance.shapes.states)).reserve - own
        return math.isinf(own) or own > abs(change) / gain


class KeptShapes:
    """Shapes of a model at FIRST_PHASES phases times powers of two, each computed once."""

    def __init__(self, model: ShellModel) -> None:
        self.model = model
        self._found: dict[int, Shapes] = {}

    def at(self, count: int) -> Shapes:
        """Shapes at `count` phases, from those at half as many if known."""
        if count not in self._found:
            self._found[count] = cycle_of_shapes(self.model, count, self._found.get(count // 2))
        return self._found[count]


def _with_enough_phases(
    kept: KeptShapes, contact: Contact, tolerance: Tolerance
) -> tuple[CycleBalance, PairedPeriod, Array]:
    """Double the phases until the interpolation error meets its share of the tolerance.

    Or until it is below the noise of the shapes, which more phases do not reduce; or not at all if the
    wave has harmonics that even the largest number of phases does not resolve.
    """
    count = FIRST_PHASES
    while True:
        last = count >= MOST_PHASES
        balance = CycleBalance.of(kept.at(count), contact, tolerance.rtol)
        try:
            period = balance.average(tolerance)
            hidden = _hidden(balance, count)
            error = _phase_error(balance, period) + np.append(balance.norm.each(hidden), hidden)
        except UnresolvedError:
            if last:
                raise
        else:
            goal = max(PHASE_SHARE * balance.norm.allowed(period.mean, tolerance), balance.noise)
            if last or balance.norm.size(error[:3]) <= goal or _hidden(balance, MOST_PHASES) > goal:
                return balance, period, error
        count *= 2


def _phase_error(balance: CycleBalance, period: PairedPeriod) -> Array:
    """Error of the mean motion and of the power from the interpolation between phases, (4,).

    The change on omitting every second phase, times the ratio of the unresolved harmonics, estimated
    as twice the highest ones, to those omitted.
    """
    thinned = replace(balance, shapes=balance.shapes.thinned())
    change, works = thinned.step(period.grid.times, period.leading)
    power = balance.power(period.grid, works).value - period.power.value
    changes = abs(np.array([*balance.mean(period.grid, change), power]))
    speeds = speeds_of_harmonics(balance.shapes)
    lost, beyond = np.linalg.norm(speeds[speeds.size // 2 - 1 :]), 2 * speeds[-2:].max()
    return np.asarray(changes * (min(1.0, beyond / lost) if lost > 0 else 0.0))


def _hidden(balance: CycleBalance, count: int) -> float:
    """Largest V from harmonics of the wave that alias to lower ones at `count` phases.

    Minus the estimate for them in `_phase_error`, twice the highest resolved ones.
    """
    rates, highest = balance.shapes.scene.drive.rates, count // 2 - 1
    seen = 2 * float(rates.sizes[max(highest - 2, 0) : highest].max(initial=0.0))
    return balance.speed_per_rate * max(rates.beyond(highest) - seen, 0.0)


def speeds_of_harmonics(shapes: Shapes) -> Array:
    """Magnitude of the velocity of each harmonic 1 ... K, (K,), in any unit."""
    count, sheet = len(shapes.states) // 2, shapes.discretisation
    size = np.linalg.norm(shapes.harmonics[1:] / np.repeat(sheet.units, sheet.components), axis=1)
    return np.hypot(size[:count], size[count:]) * np.arange(1, count + 1)


def other_mesh(mesh: Any) -> tuple[Any, float]:
    """A mesh for comparison, and the smallest ratio of the difference to the error.

    For a grid of rectangles one with half as many lines, at a quarter of the cost; for any other mesh
    its refinement, which costs more than the speed itself.
    """
    lines = [distinct(p)[0] for p in mesh.p]
    counts = np.array([line.size - 1 for line in lines])
    if (
        mesh.t.shape[0] != 4
        or mesh.nelements != counts.prod()
        or mesh.p.shape[1] != (counts + 1).prod()
    ):
        return mesh.refined(), 1.0
    fewer = np.maximum(np.round(counts / 2), 1)
    grid = [
        np.interp(np.linspace(0, count, int(few) + 1), np.arange(count + 1), line)
        for count, few, line in zip(counts, fewer, lines, strict=True)
    ]
    # A single cell is too coarse for a convergence estimate.
    gain = float((counts / fewer).min() ** MESH_ORDER - 1) if fewer.min() > 1 else 1.0
    return skfem.MeshQuad.init_tensor(*grid), gain


def _without_growth(scene: Scene, contact: Contact) -> CrawlSpeed:
    """The speed without growth: 0, except that a sheet with tanh friction creeps down a slope."""
    words, slide = _words(scene, contact), creep(contact)
    found = CrawlSpeed.steady(slide, words, contact.friction.slip_ratio(abs(slide)))
    return replace(found, energy=Energy.at_rest(contact.friction))


def _is_target(scene: Scene) -> bool:
    """Whether the scene is the nonlinear sheet deformed by growth alone."""
    deforming = [e for e in scene.effects if not (e.stretches or e.pressed_by(2) or e.moves)]
    return scene.planar and not deforming and not any(e.law for e in scene.effects)


def _starts_at_second_order(scene: Scene, contact: Contact) -> bool:
    """Whether c(t + T/2) = -c(t), on level ground: the first order then has no mean."""
    drive, opposed = scene.drive, contact.slope == 0 and contact.friction.reversible
    return opposed and drive.series is not None and drive.changes_sign


def _words(scene: Scene, contact: Contact, shapes: Shapes | None = None) -> str:
    where = "in the plane" if scene.planar else "in space"
    weak = friction_over_growth(scene)
    ratio = f" (its strain is {weak:.1g} of that by growth)" if 0 < weak < math.inf else ""
    static = f"static shapes not deformed by friction{ratio}"
    crossing = "" if shapes is None else crossing_words(shapes.crossed, shapes.times)
    return model_words(f"nonlinear sheet {where}", scene.growth, contact, static, crossing)

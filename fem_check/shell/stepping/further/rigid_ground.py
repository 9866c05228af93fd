"""Speed on a ground that is rigid: the limit of runs on ever stiffer ones.

A sheet of weight q per area sinks into ground of stiffness k by (q/k)^(1/2), 0.022 L on the paper's. V
differs from that on rigid ground, to first order in that depth where it is small.
"""

import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.ground import Ground
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.further.errors import FAILED, Doubt
from fem_check.shell.stepping.further.progress import Listener, Progress, printed
from fem_check.shell.stepping.further.second_runs import coarser, mesh_change
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.energy.energy import Energy
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed, Estimate, speed_in_words

Array = NDArray[np.float64]

FEWEST = 3
"""Runs from which a law of V over the stiffness can be measured."""

HALF = 0.5
"""Ratio of the changes of V from one stiffness to the next, if V is linear in the depth to which the
sheet sinks and the stiffness grows four times. A smaller one cannot be relied on to last."""

MARGIN = 2
"""Safety factor of what is left: on a mesh of finite size the changes fall off irregularly."""

SLOWEST = 0.9
"""Largest such ratio, above which the changes do not fall off: nothing is then extrapolated."""


class Limit(Shown):
    """The limit of a sequence whose changes shrink like a geometric series, with its error.

    values: (n,), n >= 3. The ratio of the last two changes is measured; what is left is added to the
    last value as far as the ratio is at most HALF. The error is MARGIN times all that is left by the
    measured ratio, at least the last change, and the larger of the two where they differ in sign.

    >>> from fem_check.shell.stepping.further.rigid_ground import Limit
    >>> limit = Limit([1.5, 1.25, 1.125])
    >>> print(f"{limit.value:g} ± {limit.error:g}")
    1 ± 0.25
    """

    def __init__(self, values: Any) -> None:
        self.values = validation.real_array("values", values)
        if self.values.size < FEWEST:
            raise ValueError(f"values: has {self.values.size} entries, must have >= {FEWEST}")
        before, last = np.diff(self.values)[-2:]
        ratio = abs(last / before) if before else np.inf if last else 0.0
        alternates, left = before * last < 0, min(ratio, SLOWEST)
        grows = alternates or ratio > SLOWEST
        self.value = float(self.values[-1] + (0.0 if grows else last * _rest(min(left, HALF))))
        sizes = max(abs(before), abs(last)) if alternates else abs(last)
        self.error = float(MARGIN * sizes * _rest(max(left, HALF)))

    def _contents(self) -> Mapping[str, Any]:
        return {"values": self.values, "value": self.value, "error": self.error}


def _rest(ratio: float) -> float:
    """Sum of r + r^2 + ..."""
    return ratio / (1 - ratio)


@dataclass(frozen=True, eq=False)
class RigidGround(Shown):
    """Speeds of a scene on grounds of growing stiffness, and their limit.

    motions: one simulation for each stiffness, the softest first. `speed`: the limit; its error is that
    of the last run (steps, periods, mesh if requested, snap-throughs) plus `ground_error`.
    stopped: why no stiffer ground was tried although `ground_error` misses rtol; empty if it meets it.
    rtol: asked for. seconds: of all runs. Raises ValueError for fewer than three motions, and for a
    scene without Ground.

    >>> from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, RigidGround, Scene
    >>> from fem_check import simulate
    >>> from linear_theory import Sheet, SineWave
    >>> bends = [Membrane(Material(0.03, 0.5)), Bending(Material(0.03, 0.5))]
    >>> contact = [Gravity(2.5e-4), Ground(8.0), Friction(1.0, slip_speed=0.002)]
    >>> scene = Scene(Sheet(), SineWave(), 0.02, effects=[*bends, *contact], cells=(1, 2))
    >>> motion = simulate(scene, periods=1, rtol=0.5)
    >>> print(RigidGround((motion, motion, motion), rtol=0.5, seconds=0.0).ground_error)
    0.0
    """

    motions: tuple[Trajectory, ...]
    rtol: float
    seconds: float
    stopped: str = ""

    def __post_init__(self) -> None:
        if len(self.motions) < FEWEST:
            raise ValueError(f"motions: has {len(self.motions)} entries, must have >= {FEWEST}")

    @property
    def stiffnesses(self) -> Array:
        """Of the grounds, (n,), force per length^4."""
        return np.array([_ground(motion.scene).stiffness for motion in self.motions])

    @property
    def speeds(self) -> Array:
        """Mean speeds on them, (n,)."""
        return np.array([motion.speed.mean for motion in self.motions])

    @cached_property
    def limit(self) -> Limit:
        """Of `speeds`."""
        return Limit(self.speeds)

    @property
    def ground_error(self) -> float:
        """Estimated distance of `speed.mean` to the limit of a rigid ground, length per time."""
        return self.limit.error

    @cached_property
    def speed(self) -> CrawlSpeed:
        """Mean speed on rigid ground; converged if its error meets rtol and no run crosses itself."""
        last = self.motions[-1].speed
        mean, error = self.limit.value, last.error + self.ground_error
        crosses = any(m.crossed is not None and bool(m.crossed.any()) for m in self.motions)
        first, end = self.stiffnesses[[0, -1]]
        words = f"{last.model}, limit of a rigid ground from stiffnesses {first:.3g} to {end:.3g}"
        return replace(
            last,
            estimate=Estimate(mean, error),
            converged=error <= self.rtol * abs(mean) and not crosses,
            model=f"{words} ({self.stopped})" if self.stopped else words,
            seconds=self.seconds,
            energy=self._energy,
        )

    @property
    def _energy(self) -> Energy | None:
        """That of the last motion, with the power in the limit; None for scenes without friction or
        weight."""
        last = self.motions[-1].speed.energy
        if last is None:
            return None
        powers = [m.speed.energy.power.value for m in self.motions if m.speed.energy is not None]
        limit = Limit(np.array(powers))
        return replace(last, power=Estimate(limit.value, last.power.error + limit.error))

    def _title(self) -> str:
        found = self.speed
        return f"RigidGround: {speed_in_words(found.mean, found.error, found.converged)}"

    def _contents(self) -> Mapping[str, Any]:
        names = ("stiffnesses", "speeds", "ground_error", "seconds", "stopped")
        return {name: getattr(self, name) for name in names}


def rigid_ground(
    scene: Scene,
    periods: int = 2,
    rtol: float = 1e-2,
    *,
    factor: float = 4.0,
    most: int = 6,
    mesh_error: bool = False,
    progress: bool | Listener = False,
) -> RigidGround:
    """Speed of a scene on a ground that does not give, and its error.

    The scene is simulated on its own `Ground` and on stiffer ones, each `factor` times as stiff as the
    one before, three at least and `most` at most, until V at infinite stiffness is known to rtol. The
    law by which V tends to it is measured, see `Limit`. periods, rtol, mesh_error (of the stiffest
    ground only), progress: as for `simulate`; the task of a `Progress` names the stiffness, and its
    share is of `most` runs.

    Raises ValueError for a scene without Ground, for factor <= 1 or most < 3, and what `simulate`
    raises; ConvergenceError if one of the first three runs fails.

    >>> from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Scene
    >>> from fem_check import rigid_ground
    >>> from linear_theory import Sheet, SineWave
    >>> bends = [Membrane(Material(0.03, 0.5)), Bending(Material(0.03, 0.5))]
    >>> contact = [Gravity(2.5e-4), Ground(8.0), Friction(1.0, slip_speed=0.02)]
    >>> scene = Scene(Sheet(), SineWave(), 0.05, 1.0, [*bends, *contact], cells=(1, 2))
    >>> found = rigid_ground(scene, periods=1, rtol=0.3, most=3)
    >>> print([round(k) for k in found.stiffnesses])
    [8, 32, 128]
    """
    scene = validation.instance("scene", scene, Scene, "make one by Scene(sheet, wave, alpha, ...)")
    if validation.real("factor", factor) <= 1:
        raise ValueError(f"factor = {factor:g}: must be > 1")
    most, rtol = validation.integer("most", most, FEWEST), validation.tolerance(rtol)
    begin, report = time.perf_counter(), printed if progress is True else progress or None
    scenes = [_on(scene, _ground(scene).stiffness * factor**k) for k in range(most)]
    coarse = [coarser(asked) for asked in scenes] if mesh_error else []
    try:
        motions, stopped = _stiffened(scenes, periods, rtol, report)
    finally:
        if progress is True:
            print(file=sys.stderr)
    if mesh_error:
        rough = coarse[len(motions) - 1]
        last = motions[-1]
        further = last.further._replace(mesh=_mesh_error(last, rough, periods, rtol))
        motions[-1] = replace(last, further=further)
    return RigidGround(tuple(motions), rtol, time.perf_counter() - begin, stopped)


def _mesh_error(found: Trajectory, coarse: Scene, periods: int, rtol: float) -> Doubt:
    """That of a motion, infinite where the one of the coarser scene fails."""
    try:
        return mesh_change(found, simulate(coarse, periods, rtol))
    except (ConvergenceError, ValueError):
        return FAILED


def _stiffened(
    scenes: Sequence[Scene], periods: int, rtol: float, report: Listener | None
) -> tuple[list[Trajectory], str]:
    """Motions on ever stiffer grounds until their limit is known, and why it is not."""
    motions: list[Trajectory] = []
    for k, scene in enumerate(scenes):
        stiffness = _ground(scene).stiffness
        heard = None if report is None else _part(report, k, len(scenes), f"on k = {stiffness:.3g}")
        try:
            motions.append(simulate(scene, periods, rtol, progress=heard or False))
        except ConvergenceError as error:
            if k < FEWEST:
                raise
            return motions, f"none on {stiffness:.3g}: {error}"
        if k + 1 >= FEWEST and _known(motions, rtol):
            return motions, ""
    return motions, f"{len(scenes)} stiffnesses tried"


def _ground(scene: Scene) -> Ground:
    found: Ground | None = scene.find(Ground)
    if found is None:
        names = ", ".join(type(e).__name__ for e in scene.effects)
        raise ValueError(f"effects = {names}: must include Ground")
    return found


def _on(scene: Scene, stiffness: float) -> Scene:
    """The scene on a ground of that stiffness, else the same."""
    ground = _ground(scene)
    stiffer = replace(ground, stiffness=stiffness)
    return scene.but(effects=tuple(stiffer if e is ground else e for e in scene.effects))


def _part(report: Listener, k: int, most: int, task: str) -> Listener:
    """Tells of run number k, of `most` that take about as long."""

    def heard(progress: Progress) -> None:
        share = (k + progress.share) / most
        left = progress.left + (most - 1 - k) * (progress.seconds + progress.left)
        report(progress._replace(share=share, left=left, task=task))

    return heard


def _known(motions: list[Trajectory], rtol: float) -> bool:
    limit = Limit([motion.speed.mean for motion in motions])
    return limit.error <= rtol * abs(limit.value)

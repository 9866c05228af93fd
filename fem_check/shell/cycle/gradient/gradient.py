"""The gradient of the speed of a cycle of shapes.

The cycle as it is computed, with mesh, phases, times and cells frozen, is differentiated: the friction
balance (`friction`), the motion at its points (`kinematics`) and the shapes in equilibrium (`statics`),
each by its adjoint. The errors are those of the speed: what the derivatives change by with half the
phases, on another mesh, by a coarser rule in time and on finer cells.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.balance import CycleBalance, PairedPeriod
from fem_check.shell.cycle.gradient.changes import Changes
from fem_check.shell.cycle.gradient.statics import StaticAdjoint
from fem_check.shell.cycle.gradient.sums import FrictionAdjoint, Sums
from fem_check.shell.cycle.shapes import Shapes, phases
from fem_check.shell.cycle.speed import FIRST_PHASES, MOST_PHASES, Cycle, speeds_of_harmonics
from linear_theory.balance.time_grid import TimeGrid
from linear_theory.common import validation
from linear_theory.common.progress import Report, watched
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.means import CHECKED, PER_HARMONIC, SAFETY
from linear_theory.gradient.parameters.names import parameters
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.result import SpeedGradient, kinks_of
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed
from linear_theory.speed.wave_error import with_wave_error

Array = NDArray[np.float64]

MEAN, COARSE, SINGLE = 0, 1, 2
"""Rows of the rule in time: the mean over the period, that by a coarser rule; then single times."""

LEAST_SHARE = 0.5
"""Of the relative error of the speed, below which that of a derivative by the mesh is not believed: the
difference to another mesh may vanish by accident."""

ROUNDOFF = 1e-12
"""Of the largest derivative."""


@one_blas_thread
def cycle_gradient(
    scene: Scene, over: Any, rtol: float = 1e-2, *, progress: bool | Report | None = None
) -> SpeedGradient:
    """Derivatives of the mean speed V of `cycle_speed` with respect to parameters, by its adjoint.

    scene: as for `cycle_speed`, with growth. over: parameters, objects or names of fields as in scene
    files: those of `linear_theory.speed_gradient`, of the wave, of friction, "growth.alpha" and
    "sheet.width"; "sheet.poisson", "sheet.thickness", "growth.curvature_coupling", "gravity.weight" and
    "ground.stiffness". Forty harmonics cost little more than one; each of those that are not of the
    wave or of friction costs two evaluations of the forces per phase. rtol: of the speed; the errors
    of the derivatives follow from it and are estimated each. progress: True prints on stderr, a
    function is called with a `Progress`.

    Where V has a kink, as where part of the sheet is at rest under dry friction, the result is a
    subgradient, and `kinks` says why. Errors do not count that of a measured wave.

    Raises ValueError for parameters that are not known or that the scene does not have, for harmonics
    that the largest number of phases does not resolve, and as `cycle_speed` does; UnstableError where a
    shape is no strict minimum.

    >>> from fem_check import Scene, cycle_gradient
    >>> from linear_theory import Sheet, SineWave
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.25, cells=(2, 4))
    >>> found = cycle_gradient(scene, ["alpha", "sheet.width", "wave.cosine.1"])
    >>> for name, value in zip(found.names, found.values, strict=True):
    ...     print(f"{name:13} {value:6.2f}")
    growth.alpha    0.70
    sheet.width    -0.01
    wave.cosine.1   0.18
    """
    hint = "make one by Scene(sheet, wave, alpha, effects=...)"
    scene = validation.instance("scene", scene, Scene, hint)
    if scene.alpha == 0 and (scene.planar or scene.curvature_coupling == 0):
        raise ValueError("alpha = 0: must not be 0, where V = 0 whatever the wave")
    chosen = parameters(over)
    directions = [one.direction(scene) for one in chosen]
    _check_harmonics(chosen, directions)
    with watched(progress, "cycle_gradient"):
        cycle = Cycle(scene)
        speed = with_wave_error(scene, Tolerance(rtol), cycle.speed)
        return _Gradient(cycle, speed, chosen, directions).found()


def _check_harmonics(chosen: Sequence[Parameter], directions: Sequence[Direction]) -> None:
    most = MOST_PHASES // 2 - FIRST_PHASES // 4
    for one, d in zip(chosen, directions, strict=True):
        if d.highest > most:
            raise ValueError(
                f"over = {one.name!r}: is harmonic {d.highest}, must be at most {most}, which "
                f"{MOST_PHASES} phases resolve"
            )


@dataclass(frozen=True)
class _Gradient:
    """Of the speed that a cycle has just found."""

    cycle: Cycle
    speed: CrawlSpeed
    parameters: Sequence[Parameter]
    directions: Sequence[Direction]

    def found(self) -> SpeedGradient:
        """The derivatives, their errors and kinks."""
        start = time.perf_counter()
        rows, flat = self._rows()
        mean, coarse, thinned, *cells = rows
        error = SAFETY * (abs(coarse - mean) + abs(np.array(cells)).max(0))
        error += self._unresolved * abs(thinned - mean)
        error += np.maximum(self._by_mesh(mean), LEAST_SHARE * self._relative * abs(mean))
        if self._balance.shapes is not self._solved.shapes:
            error += self._relative * abs(mean)  # shapes in between are as accurate as the speed
        error += self.speed.error * np.array([abs(d.period) for d in self.directions])
        error += ROUNDOFF * abs(mean).max()
        seconds, period = time.perf_counter() - start, self._period
        still = self._solved.contact.friction.width == 0 and period.fastest == 0
        kinks, over = kinks_of(period.sticks or still, flat), tuple(self.parameters)
        return SpeedGradient(self.speed, over, mean, error, kinks, seconds, self.speed.seconds)

    def _rows(self) -> tuple[Array, bool]:
        """Derivatives of V, by a coarser rule in time, by half the phases; changes by finer cells."""
        own = self._sums(self._balance, self._changes, self._leading, self._rule)
        thinned, finer = self._thinned, self._finer
        states = [own.states[:SINGLE], thinned.states, finer.states - own.states[SINGLE:]]
        explicit = [own.explicit[:SINGLE], thinned.explicit, finer.explicit - own.explicit[SINGLE:]]
        statics = StaticAdjoint(self._balance.shapes).along(np.concatenate(states), self._changes)
        return np.concatenate(explicit) + statics, own.flat

    @cached_property
    def _solved(self) -> CycleBalance:
        assert self.cycle.solved is not None
        return self.cycle.solved[0]

    @cached_property
    def _period(self) -> PairedPeriod:
        assert self.cycle.solved is not None
        return self.cycle.solved[1]

    @cached_property
    def _highest(self) -> int:
        return max(d.highest for d in self.directions)

    @cached_property
    def _balance(self) -> CycleBalance:
        """On phases that resolve the harmonics of the parameters beside those of the motion."""
        return self._solved.on(self._on_more_phases(self._solved.shapes))

    def _on_more_phases(self, known: Shapes) -> Shapes:
        """Shapes that are interpolated to more phases, as the speed's resolve them, if need be."""
        count = own = len(known.states)
        while count < min(2 * self._highest + own // 2, MOST_PHASES):
            count *= 2
        if count == own:
            return known
        return replace(known, states=known.at(phases(known.scene.period, count)))

    @cached_property
    def _changes(self) -> Changes:
        return self._changes_on(self._balance)

    def _changes_on(self, balance: CycleBalance) -> Changes:
        return Changes.of(self.parameters, self.directions, balance, self.cycle.scene)

    @cached_property
    def _grid(self) -> TimeGrid:
        """Times of the speed, and more where the parameters have higher harmonics."""
        grid = self._period.grid
        if not self._highest:
            return grid
        return grid.with_steps(self.cycle.scene.period / (PER_HARMONIC * self._highest))

    @cached_property
    def _leading(self) -> Array:
        """Motion on the grid and half a period later, (2, times, 3)."""
        known = self._period
        if self._grid is known.grid and self._balance.shapes is self._solved.shapes:
            return known.leading
        rows = known.grid.interpolated(known.leading.swapaxes(1, 2), self._grid.times)
        return self._balance.balance(self._grid.times, rows.swapaxes(1, 2)).leading

    @cached_property
    def _checked(self) -> NDArray[np.int64]:
        """Places of the times at which finer cells are tried."""
        return np.unique((np.array(CHECKED) * self._grid.times.size).astype(int))

    @cached_property
    def _rule(self) -> Array:
        """Factors (rules, 2 times) of the times and of those half a period later."""
        eye, grid = np.eye(self._grid.times.size), self._grid
        means = [[grid.mean(row)[0] for row in eye], [grid.coarse_mean(row) for row in eye]]
        rows = np.concatenate([np.array(means), eye[self._checked]]) / 2
        return np.concatenate([rows, rows], axis=1)

    def _sums(
        self, balance: CycleBalance, changes: Changes, leading: Array, rule: Array, which: Any = ...
    ) -> Sums:
        """Derivatives of sums over the times `which` of the grid."""
        times = self._grid.times[which]
        both = np.concatenate([times, times + self.cycle.scene.period / 2])
        return FrictionAdjoint(balance, changes).sums(both, leading.reshape(-1, 3), rule)

    @cached_property
    def _thinned(self) -> Sums:
        """Of the mean from every second phase, as sums over all phases."""
        shapes = self._balance.shapes
        thinned = self._balance.on(shapes.thinned())
        leading = self._leading + thinned.step(self._grid.times, self._leading).leading
        found = self._sums(thinned, self._changes, leading, self._rule[:1])
        states = np.zeros((1, *shapes.states.shape))
        states[:, ::2] = found.states
        return found._replace(states=states)

    @cached_property
    def _finer(self) -> Sums:
        """Of single times, on finer cells."""
        finer, some = self._balance.finer(), self._checked
        near = self._leading[:, some]
        leading = near + finer.step(self._grid.times[some], near).leading
        single = np.eye(some.size) / 2
        return self._sums(finer, self._changes, leading, np.concatenate([single, single], 1), some)

    def _by_mesh(self, mean: Array) -> Array:
        """What another mesh changes, over the least ratio of that to the error, (parameters,)."""
        known, gain = self.cycle.other(self._solved)
        shapes = self._on_more_phases(known)
        other = self._balance.on(shapes)
        changes, leading = (
            self._changes_on(other),
            other.balance(self._grid.times, self._leading).leading,
        )
        sums = self._sums(other, changes, leading, self._rule[:1])
        found = sums.explicit + StaticAdjoint(shapes).along(sums.states, changes)
        return np.asarray(abs(found[0] - mean) / gain)

    @property
    def _relative(self) -> float:
        """Relative error of the speed, at most 1."""
        return min(self.speed.error / abs(self.speed.mean), 1.0) if self.speed.mean else 1.0

    @cached_property
    def _unresolved(self) -> Array:
        """Share of what half the phases change that all of them leave, (parameters,).

        For a parameter without harmonics as for the speed itself. A harmonic k makes shapes at k and,
        through those of the motion, at their distances from k, with their sizes.
        """
        speeds = speeds_of_harmonics(self._balance.shapes)
        most, found = speeds.size, []
        for k in (d.highest for d in self.directions):
            lost = np.linalg.norm(speeds[most // 2 - k - 1 :] if k < most // 2 else speeds)
            end = max(most - k, 2)
            beyond = 2 * speeds[end - 2 : end].max()
            found.append(min(1.0, beyond / lost) if lost > 0 else 0.0)
        return np.array(found)

"""A cycle of shapes: the static shapes over one period of a sheet that is not deformed by friction.

At every phase the sheet is in static equilibrium with its growth (and its weight on the ground), so
that a period is a closed series of minimisations, each started from the previous ones. In between, and
for velocities, the unknowns are interpolated by the trigonometric polynomial through the phases.
"""

import time
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.depth import laid_down
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.kinematics.crossing import crossed
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.extrapolation import extrapolated
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.ellipticity import Ellipticity
from fem_check.shell.statics.equilibrium import ConvergenceError, Equilibrium, UnstableError
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import follow_mode, ramp
from linear_theory.common import validation
from linear_theory.common.progress import track
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

TOLERANCE = 1e-10
"""Tolerance of the static shapes relative to the size of the sheet: the speed of a sine wave is of
order alpha^2, and 1e-10 is 3e-7 of that at alpha = 0.02. Newton's last step is cheap."""

EXTRAPOLATED = 4
"""Number of shapes from which the initial guess of the next one is extrapolated."""

PUSH = 1e-3
"""Amplitude, relative to the length of the sheet, of the push along the mode of a buckled shape."""

MOST_PERIODS = 4
CLOSED = 1e-7
"""A cycle is closed when the first shape recurs to this fraction of the size of the sheet; shapes that
buckle may need a period to synchronise with the wave."""


class NotPeriodicError(ConvergenceError):
    """The shapes did not become periodic within a few periods of the wave."""


@dataclass(frozen=True, eq=False)
class Shapes(Shown):
    """Static shapes of a model at equidistant phases t = 0, T/N, ... of one period T.

    states: (N, size), displacement unknowns of its discretisation; iterations: total number of Newton
    iterations; buckled: phases (of N) at which a buckled state was met and left; seconds: computing
    time; reserve: smallest stability margin against short waves, see `ellipticity.Reserve`, inf in
    space.
    """

    model: ShellModel
    states: Array
    iterations: int
    buckled: int
    seconds: float
    reserve: float = np.inf

    @property
    def scene(self) -> Scene:
        """The scene of the model."""
        return self.model.scene

    @property
    def discretisation(self) -> Discretisation:
        """Of the model."""
        return self.model.discretisation

    @property
    def times(self) -> Array:
        """The phases, (N,), in units of the wave's period."""
        return phases(self.scene.period, len(self.states))

    @cached_property
    def crossed(self) -> NDArray[np.bool_] | None:
        """Whether the sheet passes through itself at each phase, (N,); None without ipctk."""
        return crossed(self.discretisation, self.states)

    @property
    def harmonics(self) -> Array:
        """Coefficients of 1, cos wt, cos 2wt, ..., sin wt, sin 2wt, ...: (2K + 1, size), K = N/2."""
        return harmonics(self.states)

    def at(self, times: ArrayLike) -> Array:
        """Unknowns at any times, (*times.shape, size)."""
        values, _ = time_factors(times, self.scene.period, len(self.states) // 2)
        return np.asarray(values @ self.harmonics)

    def thinned(self) -> "Shapes":
        """The same cycle from every second phase."""
        return replace(self, states=self.states[::2])


def phases(period: float, count: int) -> Array:
    """Equidistant times of one period, (count,)."""
    return period / count * np.arange(float(count))


def harmonics(values: Array) -> Array:
    """Coefficients of 1, cos, ..., sin, ... in time of values (N, ...), N even: (N + 1, ...)."""
    count = len(values)
    spectrum = np.fft.rfft(values, axis=0) * (2 / count)
    spectrum[0] /= 2
    spectrum[-1] /= 2  # the highest cosine has no partner at negative frequency
    return np.concatenate([spectrum.real, -spectrum.imag[1:]])


def time_factors(times: ArrayLike, period: float, highest: int) -> tuple[Array, Array]:
    """1, cos wt, ..., cos Kwt, sin wt, ..., sin Kwt and their time derivatives.

    Each (*times.shape, 2K + 1), K = highest.
    """
    rates = 2 * np.pi / period * np.arange(highest + 1)
    angle = np.multiply.outer(validation.real_array("times", times), rates)
    cosine, sine = np.cos(angle), np.sin(angle)
    values = np.concatenate([cosine, sine[..., 1:]], axis=-1)
    slopes = np.concatenate([-rates * sine, (rates * cosine)[..., 1:]], axis=-1)
    return values, slopes


@one_blas_thread
def cycle_of_shapes(scene: Scene | ShellModel, count: int = 16, known: Shapes | None = None) -> Shapes:
    """Static shapes at `count` equidistant phases of one period, with growth ramped up at the first.

    scene: a scene, or its model, which is then reused. count: even, >= 4. known: shapes at half as
    many phases, which are kept and interpolated as initial guesses of the new ones. Friction and
    inertia do not act on a static shape and are neglected.

    Raises ValueError for an odd count, ConvergenceError (with its last state) if no equilibrium is
    found, NotPeriodicError if the shapes of a buckling sheet do not repeat, UnstableError if a planar
    sheet is compressed so much that its shape would not exist on finer meshes, see `ellipticity`.
    """
    if validation.integer("count", count, 4) % 2:
        raise ValueError(f"count = {count}: must be even")
    start = time.perf_counter()
    solver = _Solver(scene if isinstance(scene, ShellModel) else ShellModel(scene))
    if known is None:
        found = _closed(solver, count) if solver.may_buckle else solver.period(count, solver.first())
    else:
        found = _between(solver, count, known)
    return replace(found, seconds=time.perf_counter() - start + (known.seconds if known else 0.0))


def _between(solver: "_Solver", count: int, known: Shapes) -> Shapes:
    """The known shapes and new ones halfway between them."""
    if len(known.states) * 2 != count:
        raise ValueError(f"known: has {len(known.states)} phases, must be half of count = {count}")
    states = np.empty((count, known.states.shape[1]))
    states[::2] = known.states
    times = phases(solver.scene.period, count)[1::2]
    guesses = known.at(times)
    for i in track("shapes between those known", range(times.size)):
        states[2 * i + 1] = solver.shape(times[i], guesses[i], states[2 * i]).state
    return solver.shapes(states, known)


def _closed(solver: "_Solver", count: int) -> Shapes:
    """Shapes of consecutive periods, until a shape equals that of a period before."""
    state = solver.first()
    for _ in range(MOST_PERIODS):
        found = solver.period(count, state)
        again = solver.shape(0.0, found.states[0], found.states[-1])
        gap = solver.minimiser.rms(again.state - found.states[0]) / solver.minimiser.length
        if gap < CLOSED:
            return found
        state = again.state
    raise NotPeriodicError(
        f"shapes differ by {gap:.2g} of the sheet's size after {MOST_PERIODS} periods", state
    )


class _Solver:
    """Minimisations of one model at given times, with a count of their cost."""

    def __init__(self, model: ShellModel) -> None:
        self.model, self.scene, self.discretisation = model, model.scene, model.discretisation
        self.may_buckle = not model.planar
        self.effects = working_effects(model)
        self.minimiser = minimiser_of(model)
        self.ellipticity = None if self.may_buckle else _ellipticity(model)
        self.iterations = self.buckled = 0
        self.reserve = np.inf

    def first(self) -> Array:
        """The shape at t = 0, with growth ramped up from the undeformed sheet at its static depth."""

        def problem(share: float) -> Potential:
            return Potential(self.discretisation, self.effects, self.model.rest(0.0, share))

        push = PUSH * self.scene.sheet.length if self.may_buckle else 0.0
        start = laid_down(self.model)
        return self._count(
            ramp(self.minimiser, problem, start, follow=push, report=self._require_at_start)
        ).state

    def period(self, count: int, state: Array) -> Shapes:
        """Shapes at `count` phases from the first one on."""
        states = [state]
        for t in track("shapes through the period", phases(self.scene.period, count)[1:].tolist()):
            states.append(self.shape(t, _next(states[-EXTRAPOLATED:]), states[-1]).state)
        return self.shapes(np.array(states))

    def shapes(self, states: Array, known: Shapes | None = None) -> Shapes:
        """The states as shapes, with their cost and that of the known ones among them."""
        iterations, buckled, reserve = self.iterations, self.buckled, self.reserve
        if known is not None:
            iterations, buckled = iterations + known.iterations, buckled + known.buckled
            reserve = min(reserve, known.reserve)
        return Shapes(self.model, states, iterations, buckled, 0.0, reserve)

    def shape(self, t: float, guess: Array, before: Array) -> Equilibrium:
        """The shape at time t near a guess, or near the previous shape if the guess fails."""
        potential = Potential(self.discretisation, self.effects, self.model.rest(t))
        try:
            result = self._left(potential, self._found(potential, guess, before))
        except ConvergenceError as error:
            text = f"t = {t:g}: no equilibrium near the previous one (snap-through?): {error}"
            raise ConvergenceError(text, error.state, t) from error
        self._require_stable(result.state, t)
        return self._count(result)

    def _found(self, potential: Potential, guess: Array, before: Array) -> Equilibrium:
        try:
            return self.minimiser.minimise(potential, guess)
        except ConvergenceError:
            return self.minimiser.minimise(potential, before)

    def _left(self, potential: Potential, result: Equilibrium) -> Equilibrium:
        """The minimum near a buckled shape, or the shape itself if it is a minimum."""
        if not result.buckled:
            return result
        self.buckled += 1
        return follow_mode(self.minimiser, potential, result, PUSH * self.scene.sheet.length)

    def _require_at_start(self, share: float, result: Equilibrium) -> None:
        self._require_stable(result.state, 0.0, share)

    def _require_stable(self, state: Array, t: float, share: float = 1.0) -> None:
        """Raise UnstableError if a planar shape at time t is unstable against short waves."""
        if self.ellipticity is None:
            return
        reserve = self.ellipticity.reserve(state, lambda r: self.model.rest(t, share, r))
        self.reserve = min(self.reserve, reserve.value)
        if reserve.value > 0:
            return
        x, y = reserve.place
        where = f"x = {x:.3g}, y = {y:.3g}, t = {t:.3g}" + f", {share:.3g} of the growth" * (share < 1)
        text = f"the sheet is compressed beyond material stability at {where}: {reserve.words}"
        raise UnstableError(text, state, t)

    def _count(self, result: Equilibrium) -> Equilibrium:
        self.iterations += result.iterations
        return result


def minimiser_of(model: ShellModel) -> Minimiser:
    """That of the static shapes of a model: without rigid motions, and stable in space."""
    motions = "xyz" if model.find(Ground) is None else "xy"
    supports = Supports(model.discretisation).anchor(motions=motions)
    return Minimiser(supports, TOLERANCE, check_stability=not model.planar)


def _ellipticity(model: ShellModel) -> Ellipticity:
    return Ellipticity(model.discretisation, model.find(Membrane).material.poisson)


def working_effects(model: ShellModel) -> tuple[Effect, ...]:
    """Effects that determine the shape; in the plane weight, the normal load of friction, does not."""
    effects = model.static_effects
    return tuple(e for e in effects if not (model.planar and e.pressed_by(2)))


def _next(states: list[Array]) -> Array:
    """The polynomial through equidistant states, one step on."""
    return extrapolated(np.arange(float(len(states))), states, float(len(states)))

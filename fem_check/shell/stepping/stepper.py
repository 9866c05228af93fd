"""One implicit time step of a scene as a minimisation over the positions at its end.

    elastic(x) + ground(x) + weight(x) + dt integral mu N v0 log cosh(|v|/v0) + (damping) + (inertia)

with v = rate (x - base) from the two-step rule (second order), or from Newmark's if the scene has
inertia. The load N, areas and normals of the ground are those of the predicted state, and then of the
last solution, until they no longer change.
"""

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.abilities import STEPPED
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.lower_face import LowerFace
from fem_check.shell.effects.restraint import Restraint
from fem_check.shell.kinematics.heading import heading
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Affine, Face, Step
from fem_check.shell.kinematics.rest_state import RestState
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.equilibrium import ConvergenceError, Equilibrium
from fem_check.shell.statics.newton import Factorised, Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import follow_mode
from fem_check.shell.stepping.lagged import Mixing, change
from fem_check.shell.stepping.schemes import History
from linear_theory.friction.load import Load
from linear_theory.friction.maps import FixedTo, FrictionMap

Array = NDArray[np.float64]

LOAD_TOLERANCE = 1e-3
"""Largest relative change of the load, summed over the sheet, between the last two minimisations of a
step: it changes V by far less, because V is independent of a common factor of all loads."""

MOST_REPEATS = 12
"""Largest number of minimisations of one step for a converged load; the step is else too long."""

PUSH = 0.01
"""Root mean square of the push off a saddle, in thicknesses."""


@dataclass(frozen=True, eq=False)
class StepResult:
    """The end of a step: unknowns, quantities held fixed, rest state and cost.

    buckled: whether negative curvature was met during the step or at a saddle that was then left.
    """

    state: Array
    time: float
    rest: RestState
    step: Step
    iterations: int
    repeats: int
    buckled: bool


@dataclass(eq=False)
class WatchedMinimiser(Minimiser):
    """A minimiser that counts the Hessians that were not positive definite (`shifts`)."""

    shifts: int = field(init=False, default=0)

    def factorised(
        self, potential: Potential, u: Array, shift: float, convex: bool = True
    ) -> Factorised:
        """See Minimiser."""
        found = super().factorised(potential, u, shift, convex)
        self.shifts += found.shift > 0
        return found


class Stepper:
    """Makes time steps of a model; reuses symbolic factorisation and factor.

    Growth is multiplied by a smooth function of time that rises from 0 to 1 over `ramp`. shortest:
    shortest step, which sets the accuracy of the minimisations.
    Raises ValueError for a scene that time steps cannot represent, see `abilities.STEPPED`, including
    one with neither friction nor inertia.
    """

    def __init__(self, model: ShellModel, ramp: float, shortest: float) -> None:
        STEPPED.require(model.scene)
        self.model, self.ramp = model, ramp
        self.region = model.discretisation.interior
        self.minimiser = self._minimiser(shortest)
        self.holds_area = any(effect.load is Load.CURRENT for effect in model.effects)
        self.bearer = self._bearer()

    def _bearer(self) -> Effect | None:
        """The effect that gives the normal load of friction; None without friction."""
        effects, components = self.model.effects, self.model.components
        if not any(effect.law for effect in effects):
            return None
        return next(effect for effect in effects if effect.pressed_by(components))

    def _minimiser(self, shortest: float) -> WatchedMinimiser:
        """A minimiser so accurate that errors over a step are far below the slip speed."""
        tolerance, size = 1e-8, np.sqrt(self.region.measure.sum())
        for law in (effect.law for effect in self.model.effects if effect.law):
            tolerance = min(tolerance, max(1e-3 * law.width * shortest / size, 1e-12))
        supports = Supports(self.model.discretisation)
        return WatchedMinimiser(supports, tolerance, keep_factor=True, check_stability=False)

    @property
    def shape_changes_load(self) -> bool:
        """Whether load, area or normals depend on the position of the sheet."""
        return self.holds_area or self._load_follows_shape

    @property
    def _load_follows_shape(self) -> bool:
        on_ground = self.map is not None and self.map.fixed_to is FixedTo.GROUND
        return self.bearer is not None and (self.bearer.load_follows_shape or on_ground)

    def amplitude(self, t: float) -> float:
        """Fraction of the growth at time t, a ramp with two continuous derivatives."""
        return amplitude(t, self.ramp)

    def rest(self, t: float) -> RestState:
        """Rest state at time t, counted from the start of the ramp."""
        return self.model.rest(t, self.amplitude(t))

    def attempt(
        self, history: History, dt: float, restraint: float = 0.0, check: bool = False
    ) -> StepResult:
        """Try one step of length dt.

        restraint: stiffness of a `Restraint` to the last state, in which a snap-through is then made.
        check: test for negative curvature at its end even if no Hessian during the step had any.

        Raises ConvergenceError if no minimum is found.
        """
        t, shifts = history.time + dt, self.minimiser.shifts
        self.minimiser.check_stability = check
        rest = self.rest(t)
        for coupling in self.model.couplings:
            coupling.begin(history.state)
        velocity, acceleration = history.rules(dt)
        moving = Step(
            self.at_points(velocity),
            None if acceleration is None else self.at_points(acceleration),
            face=self.face(history, dt),
        )
        effects = self.model.effects
        if restraint > 0:
            effects = (*effects, Restraint(restraint))
            moving = replace(moving, anchor=self.region.position(history.state, (0,))[0])
        guess = history.state if restraint > 0 else self._start(history, dt)
        step, count, mixing = self.held(moving, guess, rest, t), 0, Mixing()
        for repeat in range(1, MOST_REPEATS + 1):
            result = self._minimum(self.model.potential(rest, step, effects), guess)
            count, guess = count + result.iterations, result.state
            after = self.held(moving, guess, rest, t)
            moved = change(step, after) if self.shape_changes_load else 0.0
            if moved <= LOAD_TOLERANCE:
                buckled = self.minimiser.shifts > shifts
                return StepResult(guess, t, rest, step, count, repeat, buckled)
            if mixing.stalls(moved):
                break
            step = mixing.next(step, after)
        text = f"the load still changes by {moved:.1%} after {repeat} minimisations"
        raise ConvergenceError(text, guess)

    def _start(self, history: History, dt: float) -> Array:
        """The predicted state, or the last one if the prediction is inverted.

        A sheet that would pass through itself on the way stops in front of that.
        """
        orientation, guess = self.minimiser.orientation, history.prediction(dt)
        for coupling in self.model.couplings:
            way = guess - history.state
            share = coupling.reach(history.state, way)
            guess = guess if share == 1 else history.state + share * way
        before, after = orientation.directors(history.state), orientation.directors(guess)
        return guess if orientation.keeps(before, after) else history.state

    def _minimum(self, potential: Potential, guess: Array) -> Equilibrium:
        result = self.minimiser.minimise(potential, guess)
        if not result.buckled:
            return result
        return follow_mode(self.minimiser, potential, result, PUSH * self.model.scene.sheet.thickness)

    def at_points(self, rule: Affine) -> Affine:
        """A rule for the unknowns converted to one for the positions of the points."""
        base = self.region.displacement(rule.base, (0,))[0]
        return Affine(rule.rate, base + self.region.reference[0])

    def face(self, history: History, dt: float) -> Face | None:
        """The face on which friction acts during a step; None for the mid-surface."""
        if not self.on_lower_face:
            return None
        past = np.stack([self._lower(u).position for u in history.states[:2]])
        return Face(self._depth, history.slope(past, dt))

    def face_moving(self, u: Array, velocity: Array) -> Face | None:
        """Likewise of a sheet at u with a velocity (size,) of its unknowns."""
        if not self.on_lower_face:
            return None
        lower = self._lower(u)
        moved = lower.moved(self.region.displacement(velocity, LowerFace.entries))
        return Face(self._depth, Affine(1.0, lower.position - moved))

    @property
    def on_lower_face(self) -> bool:
        """Whether friction acts there."""
        return any(effect.law.on_lower_face for effect in self.model.effects if effect.law)

    @property
    def _depth(self) -> float:
        return self.model.scene.sheet.thickness / 2

    def _lower(self, u: Array) -> LowerFace:
        return LowerFace(PointState(self.region, u, LowerFace.entries), self._depth)

    def held(self, moving: Step, u: Array, rest: RestState, t: float) -> Step:
        """Quantities held fixed in a step to time t, for the sheet at u: rules, area, load, normals.

        The load is that of friction: with the map of its coefficient, if it has one.
        """
        area = self.area(u) if self.holds_area else None
        step = replace(moving, area=area)
        if self.bearer is None:
            return step
        state = PointState(self.region, u, (0,), rest, step)
        load, normal = self.bearer.normal_load(state), self.bearer.ground_normal(state)
        if self.map is not None:
            load = load * self.map_at(state, t)
        return replace(step, load=load, normal=normal, heading=self.heading(u))

    @property
    def map(self) -> FrictionMap | None:
        """Of the coefficient of friction, if it differs from place to place."""
        return next((effect.law.map for effect in self.model.effects if effect.law), None)

    def map_at(self, state: PointState, t: float) -> Array:
        """Values of the map at the points, (points,)."""
        assert self.map is not None
        on_body = self.map.fixed_to is FixedTo.BODY
        x, y = self.region.reference[0, :2] if on_body else state.position[:2]
        return self.map.values(x, y, t)

    def heading(self, u: Array) -> float:
        """Of the sheet as a whole, if the axes of friction turn with it; else 0."""
        if not any(effect.law.follows_body for effect in self.model.effects if effect.law):
            return 0.0
        return heading(self.model.discretisation, u)

    def area(self, u: Array) -> Array:
        """Quadrature weight times current area, (points,)."""
        return PointState(self.region, u, (1, 2)).area


def amplitude(t: float, ramp: float) -> float:
    """0 at t = 0 and before, 1 from t = ramp on, with two continuous derivatives."""
    s = min(max(t, 0.0) / ramp, 1.0) if ramp > 0 else 1.0
    return s**3 * (10 - 15 * s + 6 * s**2)

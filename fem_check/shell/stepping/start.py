"""The initial state of a simulation: the ungrown sheet at rest, or in uniform motion."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.depth import laid_down
from fem_check.shell.effects.ground import Ground
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rates import Affine, Step
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.stepping.schemes import BackwardDifferences, History, Newmark, Scheme
from fem_check.shell.stepping.stepper import Stepper
from linear_theory.common import validation
from linear_theory.common.validation import shown

Array = NDArray[np.float64]


def translation(discretisation: Discretisation, shift: ArrayLike) -> Array:
    """Unknowns (size,) of a uniform displacement (components,)."""
    vertices = np.zeros(discretisation.scalars)
    vertices[discretisation.dofs_values()] = 1
    return np.multiply.outer(vertices, validation.real_array("shift", shift)).ravel()


def resting_state(stepper: Stepper) -> Array:
    """The ungrown sheet, (size,): undeformed, or sunk into the ground under its weight."""
    model, state = stepper.model, laid_down(stepper.model)
    if model.find(Ground) is None:
        return state
    rest = stepper.rest(0.0)
    minimiser = Minimiser(Supports(model.discretisation).anchor(motions="xy"))
    for _ in range(3):  # a weight per current area lags one state behind
        step = Step(area=stepper.area(state)) if stepper.holds_area else None
        potential = model.potential(rest, step, model.static_effects)
        state = minimiser.minimise(potential, state).state
        if step is None:
            break
    return state


def default_scheme(model: ShellModel) -> Scheme:
    """Newmark's for a sheet with inertia that vibrates freely, whose energy it keeps.

    One on a ground bounces and snaps through in times that steps do not resolve: backward differences.
    """
    heavy = any(effect.areal_mass for effect in model.effects)
    return Newmark() if heavy and model.find(Ground) is None else BackwardDifferences()


def first_history(
    stepper: Stepper, dt: float, velocity: ArrayLike | None, scheme: Scheme | None = None
) -> History:
    """The history before the first step: at rest, or (with inertia) moving with `velocity`.

    velocity: (components,), length per time. scheme: None for `default_scheme`. Raises ValueError for a
    velocity or Newmark's scheme without inertia.
    """
    model = stepper.model
    scheme = default_scheme(model) if scheme is None else scheme
    history = History.at_rest(resting_state(stepper), dt, scheme)
    if not any(effect.areal_mass for effect in model.effects):
        if velocity is not None:
            raise ValueError(f"velocity = {shown(velocity)}: must be None without Inertia")
        if isinstance(scheme, Newmark):
            raise ValueError(f"scheme = {scheme}: must be BackwardDifferences without Inertia")
        return history
    if stepper.on_lower_face and isinstance(scheme, Newmark):
        raise ValueError(
            f"scheme = {scheme}: must be BackwardDifferences for friction on the lower face, whose "
            "points have no acceleration here"
        )
    wanted = np.zeros(model.components) if velocity is None else velocity
    speed = validation.real_array("velocity", wanted)
    if speed.shape != (model.components,):
        raise ValueError(f"velocity has shape {speed.shape}: must be ({model.components},)")
    moving = translation(model.discretisation, speed)
    acceleration = first_acceleration(stepper, history.state, moving)
    return history.thrown(moving, acceleration)


def first_acceleration(stepper: Stepper, state: Array, velocity: Array) -> Array:
    """Initial acceleration, which balances the forces at the start, (size,)."""
    rest, minimiser = stepper.rest(0.0), stepper.minimiser
    # Any rate works: v = rate (x - base) with the base that gives the velocity at this x.
    moving = stepper.at_points(Affine(1.0, state - velocity))
    at_rest = stepper.at_points(Affine(1.0, state))
    face = stepper.face_moving(state, velocity)
    step = stepper.held(Step(moving, at_rest, face=face), state, rest, 0.0)
    model = stepper.model
    force = -model.potential(rest, step).gradient(state)
    inertia = tuple(effect for effect in model.effects if effect.areal_mass)
    mass = minimiser.factorised(model.potential(rest, step, inertia), state, 0.0)
    acceleration = np.zeros_like(state)
    acceleration[minimiser.sparsity.order] = mass.factor.solve(force[minimiser.sparsity.order])
    return acceleration

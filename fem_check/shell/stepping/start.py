"""The state that a simulation starts from: the ungrown sheet at rest, or in uniform motion."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rates import Affine, Step
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.stepping.step_control import History
from fem_check.shell.stepping.stepper import Stepper
from linear_theory.common import validation

Array = NDArray[np.float64]


def translation(discretisation: Discretisation, shift: ArrayLike) -> Array:
    """Unknowns (size,) of the same displacement (components,) everywhere."""
    vertices = np.zeros(discretisation.scalars)
    vertices[discretisation.dofs_values()] = 1
    return np.multiply.outer(vertices, validation.real_array("shift", shift)).ravel()


def resting_state(stepper: Stepper) -> Array:
    """The ungrown sheet, (size,): as it was made, or sunk into the ground under its weight."""
    scene, discretisation = stepper.scene, stepper.scene.discretisation()
    ground: Ground | None = scene.find(Ground)
    if ground is None:
        return discretisation.zeros()
    rest = stepper.rest(0.0)
    weight = next(e.weight for e in scene.effects if hasattr(e, "weight"))
    state = sunk(discretisation, ground, float(np.sqrt(weight / ground.stiffness)))
    minimiser = Minimiser(Supports(discretisation).anchor(motions="xy"))
    for _ in range(3):  # a weight per current area is that of the state before
        step = Step(area=stepper.area(state)) if "current" in stepper.kinds else None
        potential = scene.potential(rest, step, scene.static_effects)
        state = minimiser.minimise(potential, state).state
        if step is None:
            break
    return state


def sunk(discretisation: Discretisation, ground: Ground, depth: float) -> Array:
    """Unknowns (size,) of a flat sheet that was laid on the ground and pressed in by `depth`."""
    state = translation(discretisation, (0.0, 0.0, -depth))
    if ground.height is None:
        return state
    height = ground.height

    def jets(x: Array, y: Array) -> Array:
        out = np.zeros((6, 3, x.size))
        # The ground's derivatives come as x, y, xx, yy, xy, as those of a surface do.
        out[:, 2] = height(x, y)
        return out

    return state + discretisation.interpolate(jets)


def first_history(stepper: Stepper, dt: float, velocity: ArrayLike | None) -> History:
    """The past before the first step: at rest, or (with inertia) in motion with `velocity`.

    velocity: (components,), length per time. Raises ValueError for one without inertia, which alone
    keeps it.
    """
    scene = stepper.scene
    history = History.at_rest(resting_state(stepper), dt)
    if scene.find(Inertia) is None:
        if velocity is not None:
            raise ValueError(f"velocity = {velocity!r}: must be None without Inertia, which keeps it")
        return history
    wanted = np.zeros(scene.components) if velocity is None else velocity
    speed = validation.real_array("velocity", wanted)
    if speed.shape != (scene.components,):
        raise ValueError(f"velocity has shape {speed.shape}: must be ({scene.components},)")
    moving = translation(scene.discretisation(), speed)
    acceleration = first_acceleration(stepper, history.state, moving)
    return replace(history, velocity=moving, acceleration=acceleration)


def first_acceleration(stepper: Stepper, state: Array, velocity: Array) -> Array:
    """That by which the forces at the start are balanced, (size,)."""
    rest, minimiser = stepper.rest(0.0), stepper.minimiser
    # Any rate will do: v = rate (x - base) with the base that gives the velocity at this x.
    moving = stepper.at_points(Affine(1.0, state - velocity))
    at_rest = stepper.at_points(Affine(1.0, state))
    step = stepper.held(Step(moving, at_rest), state, rest)
    force = -stepper.scene.potential(rest, step).gradient(state)
    inertia: tuple[Effect, ...] = (stepper.scene.find(Inertia),)
    mass = minimiser.factorised(stepper.scene.potential(rest, step, inertia), state, 0.0)
    acceleration = np.zeros_like(state)
    acceleration[minimiser.sparsity.order] = mass.factor.solve(force[minimiser.sparsity.order])
    return acceleration

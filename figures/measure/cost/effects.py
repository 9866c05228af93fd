"""What each effect costs: the same sheet, mesh and steps, with more and more effects named.

A scene builds and evaluates what it names and nothing else. For every scene stand here what was built
(components, unknowns, derivatives), what a step evaluated (by effect) and what that took.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.shell.cycle.shapes import working_effects
from fem_check.shell.depth import laid_down
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.kinematics.extrapolation import extrapolated
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.start import first_history
from fem_check.shell.stepping.stepper import Stepper
from figures.measure.cost.cases import SHEET, WAVE
from figures.measure.meters import calls, held_memory, timed
from linear_theory import line_speed
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

ALPHA, COUPLING = 0.02, 2.0
"""A bilayer (beta = 100 alpha) that bends without snapping over."""

CELLS, STEPS, SHAPES = (6, 12), 64, 32
"""Bicubic elements (BFS), also in the plane, where simpler ones would do, so that all scenes have the
same; steps per period, and static shapes in a row, of the scenes that have no motion in time."""

QUICK_STEPS = 16
"""Steps per period in the short run."""

MATERIAL = Material(SHEET.thickness, SHEET.poisson)
MEMBRANE, BENDING = Membrane(MATERIAL), Bending(MATERIAL)
WEIGHT, GROUND, FRICTION = Gravity(2.5e-4), Ground(0.5), Friction(1.0, 0.02)
INERTIA = Inertia(1e-4, MATERIAL)

CLOSED = "closed form, 1D"
PLANAR = "planar"
SCENES: dict[str, tuple[Effect, ...]] = {
    PLANAR: (MEMBRANE,),
    "planar with friction": (MEMBRANE, WEIGHT, FRICTION),
    "bending": (MEMBRANE, BENDING),
    "ground": (MEMBRANE, BENDING, WEIGHT, GROUND),
    "friction": (MEMBRANE, BENDING, WEIGHT, GROUND, FRICTION),
    "inertia": (MEMBRANE, BENDING, WEIGHT, GROUND, FRICTION, INERTIA),
}
"""Each after the first two adds to the one before; "planar with friction" stands apart."""

KINDS = (Membrane, Bending, Gravity, Ground, Friction, Inertia)

WATCHED: dict[str, Callable[..., Any]] = {
    "gradients": Potential.energy_and_gradient,
    "hessians": Potential.hessian_blocks,
    "factors": Minimiser.factorised,
    **{kind.__name__.lower(): kind.gradient for kind in KINDS},
}
"""What is counted, by column of `EffectRow`: of the sum, and of every effect."""


@dataclass(frozen=True)
class EffectRow:
    """What a scene built, evaluated and cost.

    effects: that it names; components of the position, unknowns, highest derivative that is built.
    Per step: iterations, gradients (with energies), Hessians and factors of the sum, and gradients of
    each effect over the whole sheet, 0 where it is not named. memory_mb: all arrays kept for the
    evaluations, hessian_mb: element Hessians among them. Seconds of one gradient, one Hessian and one
    step, with the range of the last over its repeats; ratio: of a step, to that of the planar scene.
    """

    scene: str
    effects: str
    components: int
    unknowns: int
    derivative: int
    iterations: float
    gradients: float
    hessians: float
    factors: float
    membrane: float
    bending: float
    gravity: float
    ground: float
    friction: float
    inertia: float
    memory_mb: float
    hessian_mb: float
    gradient_seconds: float
    hessian_seconds: float
    step_seconds: float
    fastest: float
    slowest: float
    ratio: float


def rows(quick: bool, patience: float, advance: Callable[[], None] = lambda: None) -> list[EffectRow]:
    """All scenes, from the closed form, which builds nothing, to the one that names all effects."""
    found = [closed_form(patience)]
    for name, effects in SCENES.items():
        found.append(Named(name, effects, QUICK_STEPS if quick else STEPS).row(patience))
        advance()
    planar = next(row.step_seconds for row in found if row.scene == PLANAR)
    return [replace(row, ratio=row.step_seconds / planar) for row in found]


def closed_form(patience: float) -> EffectRow:
    """The speed of one alpha by the one-dimensional closed form: no unknowns, no steps."""
    timing = timed(partial(line_speed, ALPHA), patience)
    times = timing.median, timing.fastest, timing.slowest
    return EffectRow(CLOSED, "none", 0, 0, 0, *(0.0,) * 14, *times, np.nan)


@dataclass(frozen=True)
class Named:
    """A scene with these effects, and its motion in steps of 1/`steps` of a period."""

    name: str
    effects: tuple[Effect, ...]
    steps: int

    def row(self, patience: float) -> EffectRow:
        """All that is told of it."""
        (potential, u, _), memory = held_memory(self.evaluated)
        blocks = sum(block.values.nbytes for block in potential.hessian_blocks(u)) / 1e6
        gradient = timed(partial(potential.energy_and_gradient, u), patience)
        hessian = timed(partial(potential.hessian_blocks, u), patience)
        run = timed(self.run, patience)
        count, iterations = run.result
        region = potential.discretisation
        return EffectRow(
            self.name,
            " ".join(type(effect).__name__ for effect in self.effects),
            region.components,
            region.size,
            highest_derivative(self.effects),
            iterations / count,
            **self.evaluations(),
            memory_mb=memory,
            hessian_mb=blocks,
            gradient_seconds=gradient.median,
            hessian_seconds=hessian.median,
            step_seconds=run.median / count,
            fastest=run.fastest / count,
            slowest=run.slowest / count,
            ratio=np.nan,
        )

    def scene(self) -> Scene:
        """A new one, with nothing computed."""
        element = skfem.ElementQuadBFS()
        bends = any(isinstance(effect, Bending) for effect in self.effects)
        coupling = COUPLING if bends else 0.0
        return Scene(SHEET, WAVE, ALPHA, coupling, self.effects, cells=CELLS, element=element)

    @property
    def moves(self) -> bool:
        """Whether it is stepped in time; else a step is the next static shape."""
        return any(isinstance(effect, Friction | Inertia) for effect in self.effects)

    def evaluated(self) -> tuple[Potential, Array, object]:
        """The energy of a step, a state, and what one gradient and Hessian there leave in memory."""
        potential, u = self.problem()
        potential.gradient(u)
        return potential, u, potential.hessian_blocks(u)

    def problem(self) -> tuple[Potential, Array]:
        """Energy of a step and a state to evaluate it at."""
        model = ShellModel(self.scene())
        rest = model.rest(0.1)
        if not self.moves:
            energy = Potential(model.discretisation, working_effects(model), rest)
            return energy, laid_down(model)
        dt = model.scene.period / self.steps
        stepper = Stepper(model, 0.5, dt)
        history = first_history(stepper, dt, None)
        velocity, acceleration = history.rules(dt)
        moving = Step(stepper.at_points(velocity), acceleration and stepper.at_points(acceleration))
        step = stepper.held(moving, history.state, rest, history.time)
        return model.potential(rest, step), history.state

    def run(self) -> tuple[int, int]:
        """Make the steps; their number and that of their iterations."""
        scene = self.scene()
        if not self.moves:
            return static_shapes(ShellModel(scene), self.steps)
        run = simulate(scene, periods=1, steps=self.steps)
        return run.times.size - 1, run.iterations

    def evaluations(self) -> dict[str, float]:
        """Calls per step of WATCHED, those of effects as evaluations over the whole sheet.

        An effect is called once for each part of the elements; the membrane is in every scene.
        """
        steps: list[int] = []
        counts = calls(lambda: steps.append(self.run()[0]), WATCHED)
        parts = {kind.__name__.lower(): counts["membrane"] / counts["gradients"] for kind in KINDS}
        return {name: count / parts.get(name, 1.0) / steps[0] for name, count in counts.items()}


def static_shapes(model: ShellModel, steps: int) -> tuple[int, int]:
    """One shape after the other, phases 1/steps apart; their number and that of iterations."""
    motions = "xyz" if model.find(Ground) is None else "xy"
    supports = Supports(model.discretisation).anchor(motions=motions)
    minimiser = Minimiser(supports, keep_factor=True, check_stability=False)
    states, iterations = [laid_down(model)], 0
    for i in range(SHAPES):
        potential = Potential(model.discretisation, working_effects(model), model.rest(i / steps))
        guess = extrapolated(range(4), states[-4:], 4.0) if len(states) > 4 else states[-1]
        result = minimiser.minimise(potential, guess)
        states.append(result.state)
        iterations += result.iterations
    return SHAPES, iterations


def highest_derivative(effects: Sequence[Effect]) -> int:
    """Of the position, that the effects read: entries 1 and 2 are first, 3 to 5 second derivatives."""
    return max(0 if e == 0 else 1 if e < 3 else 2 for effect in effects for e in effect.entries)

"""Weight, ground, friction, inertia: what their potentials mean."""

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Affine, Step, backward_euler, newmark, two_step
from fem_check.shell.kinematics.rest_state import RestState, grown_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import ramp
from linear_theory import SineWave
from linear_theory.friction.load import Load
from linear_theory.growth.growth import Growth
from tests.shell.shell_cases import affine, koiter, shell

Array = NDArray[np.float64]
PAPER = Material(0.03, 0.5)
WEIGHT, STIFFNESS = 2.5e-4, 0.5


def lying(d: Discretisation) -> Array:
    """The flat sheet at its static depth."""
    return affine(d, np.zeros((3, 2)), np.array([0, 0, -np.sqrt(WEIGHT / STIFFNESS)]))


def at_rest(d: Discretisation, u: Array, rest: RestState, step: Step | None = None) -> PointState:
    return PointState(d.interior, u, (0,), rest, step)


@pytest.mark.parametrize("area", ["grown", "material"])
def test_a_sheet_lies_at_its_static_depth(area: str) -> None:
    """sqrt(rho g/k) = 0.022 L = 0.75 h with the paper's numbers (F5); the ground carries the weight."""
    d = shell("bfs", (-0.25, 0.25, 2), (-0.5, 0.5, 4))
    gravity, ground = Gravity(WEIGHT, area), Ground(STIFFNESS, load=area)
    rest = grown_state(d.interior)
    start = 1.3 * lying(d)
    minimiser = Minimiser(Supports(d).anchor(motions="xy"))
    result = minimiser.minimise(Potential(d, (*koiter(PAPER), gravity, ground), rest), start)
    state = at_rest(d, result.state, rest)
    np.testing.assert_allclose(state.position[2], -np.sqrt(5e-4), rtol=1e-8)
    assert np.sqrt(5e-4) == pytest.approx(0.75 * 0.03, rel=7e-3)
    assert ground.normal_load(state).sum() == pytest.approx(gravity.normal_load(state).sum(), rel=1e-10)
    assert not result.buckled


def test_the_ground_carries_the_weight_of_a_bent_sheet() -> None:
    d = shell("bfs", (-0.25, 0.25, 3), (-0.5, 0.5, 6))
    c = SineWave().value(*d.interior.parameters.reshape(2, -1), 0.25)
    gravity, ground = Gravity(WEIGHT), Ground(STIFFNESS)
    effects = (*koiter(PAPER), gravity, ground)
    minimiser = Minimiser(Supports(d).anchor(motions="xy"))

    def rest(s: float) -> RestState:
        return grown_state(d.interior, c, Growth(0.05 * s, curvature_coupling=2.0 * s))

    result = ramp(minimiser, lambda s: Potential(d, effects, rest(s)), lying(d))
    state = at_rest(d, result.state, rest(1))
    heights = state.position[2]
    assert np.ptp(heights) > 0.02
    load, weight = ground.normal_load(state), gravity.normal_load(state)
    assert load.sum() == pytest.approx(weight.sum(), rel=1e-9)
    for moment in state.position[:2]:  # and stands below its centre of weight
        assert moment @ load == pytest.approx(moment @ weight, abs=1e-9 * WEIGHT)


def points(z: Array, velocity: Array | None = None, rate: float = 100.0) -> PointState:
    """A flat sheet whose quadrature points are at heights z and move upwards at `velocity`."""
    d = shell("bfs", (0, 1, 1), (0, 1, 1))
    position = np.array(d.interior.reference[0])
    position[2] = z
    base = position.copy()
    base[2] -= 0 if velocity is None else velocity / rate
    state = PointState(d.interior, d.zeros(), (0,), grown_state(d.interior), Step(Affine(rate, base)))
    state._jet[0] = position
    return state


def test_pressure_of_the_ground_is_that_of_equation_2() -> None:
    z = np.linspace(-0.2, 0.1, 16)
    for v in (-0.3, 0.0, 0.3):
        state = points(z, v * np.ones(16))
        expected = np.where(z <= 0, 2 * z**2 - 0.1 * v, 0)
        np.testing.assert_allclose(
            Ground(2.0, 0.1, form="printed").pressure(state), expected, atol=1e-15
        )
        clipped = Ground(2.0, 0.1).pressure(state)
        np.testing.assert_allclose(clipped, np.maximum(expected, 0), atol=1e-15)
        assert (v > 0) == bool(np.any(expected < 0))


@pytest.mark.parametrize("form", ["clipped", "printed"])
@pytest.mark.parametrize("base", [-0.1, 0.0, 0.05])
def test_the_potential_of_the_ground_is_the_integral_of_its_pressure(form: str, base: float) -> None:
    """From the height z to above the ground, also where damping has its kinks."""
    ground, rate = Ground(2.0, 0.01, form=form), 30.0
    z = np.linspace(-0.3, 0.1, 16)
    state = points(z)
    state.step.velocity.base[2] = base
    state.step = Step(Affine(rate, state.step.velocity.base))
    found = ground.energy(state) / state.rest.grown_area
    for height, energy in zip(z, found, strict=True):
        s = np.linspace(min(height, 0), 0, 20001)
        pressure = 2 * s**2 - 0.01 * rate * (s - base)
        if form == "clipped":
            pressure = np.maximum(pressure, 0)
        assert energy == pytest.approx(np.trapezoid(pressure, s), abs=1e-8)


def sliding(slip: float, velocity: Array) -> tuple[Friction, PointState]:
    d = shell("bfs", (0, 1, 1), (0, 1, 1))
    base = d.interior.reference[0] - velocity / 50
    step = Step(Affine(50.0, base), load=np.linspace(1, 2, d.interior.size))
    return Friction(0.7, slip), PointState(d.interior, d.zeros(), (0,), None, step)


def test_friction_is_the_law_of_equation_3() -> None:
    velocity = np.random.default_rng(0).normal(size=(3, 16))
    friction, state = sliding(0.4, velocity)
    speed = np.hypot(velocity[0], velocity[1])
    expected = -0.7 * state.step.load * np.tanh(speed / 0.4) * velocity / speed
    expected[2] = 0
    np.testing.assert_allclose(friction.force(state), expected, rtol=1e-10, atol=1e-15)


def test_limits_of_friction_are_coulomb_and_viscous() -> None:
    velocity = np.random.default_rng(0).normal(size=(3, 16)) + 1
    speed = np.hypot(velocity[0], velocity[1])
    dry, state = sliding(1e-8, velocity)
    limit = 0.7 * state.step.load
    np.testing.assert_allclose(dry.energy(state) * 50, limit * speed, rtol=1e-7)
    np.testing.assert_allclose(dry.force(state)[:2], -limit * velocity[:2] / speed, rtol=1e-12)
    viscous, state = sliding(1e6, velocity)
    np.testing.assert_allclose(viscous.force(state)[:2], -limit * velocity[:2] / 1e6, rtol=1e-10)
    assert np.all(np.isfinite(dry.hessian(state)))


def test_rules_for_rates_are_exact_where_they_should_be() -> None:
    """x = 1 + 2t + 3t^2 from t = 1 to 1 + dt."""
    dt, x = 0.1, lambda t: np.array([[1 + 2 * t + 3 * t**2]])
    v = 2 + 6 * 1.1
    assert two_step(x(1.0), x(0.9), dt)(x(1.1))[0, 0] == pytest.approx(v, rel=1e-12)
    assert backward_euler(x(1.0), dt)(x(1.1))[0, 0] == pytest.approx(v - 0.3, rel=1e-12)
    velocity, acceleration = newmark(x(1.0), np.array([[8.0]]), np.array([[6.0]]), dt)
    assert velocity(x(1.1))[0, 0] == pytest.approx(v, rel=1e-12)
    assert acceleration(x(1.1))[0, 0] == pytest.approx(6, rel=1e-10)


def test_a_falling_sheet() -> None:
    """One step of Newmark's rule from rest: -g dt^2/2, of the whole sheet, without deforming it."""
    d = shell("bfs", (-0.25, 0.25, 2), (-0.5, 0.5, 2))
    density, dt = 2.0, 0.1
    fall = -WEIGHT / (density * PAPER.thickness)
    x, zero = d.interior.reference[0], np.zeros((3, d.interior.size))
    start = zero + np.array([[0], [0], [fall]])
    velocity, acceleration = newmark(x, zero, start, dt)
    effects = (*koiter(PAPER), Gravity(WEIGHT), Inertia(density, PAPER))
    potential = Potential(d, effects, grown_state(d.interior), Step(velocity, acceleration))
    result = Minimiser(Supports(d)).minimise(potential, d.zeros())
    moved = d.interior.displacement(result.state, (0,))[0]
    np.testing.assert_allclose(moved[:2], 0, atol=1e-12)
    np.testing.assert_allclose(moved[2], fall * dt**2 / 2, rtol=1e-8)


def test_a_planar_block_is_slowed_down_by_its_friction() -> None:
    """Gravity does no work in the plane but bears on the ground: dv = -mu g dt for dry friction."""
    mesh = skfem.MeshQuad.init_tensor(np.linspace(0, 1, 3), np.linspace(0, 1, 3))
    d = Discretisation(mesh, skfem.ElementQuad2(), components=2)
    density, dt, speed, mu = 2.0, 0.01, 0.5, 0.7
    g = WEIGHT / (density * PAPER.thickness)
    rest, x = grown_state(d.interior), d.interior.reference[0]
    v0 = np.zeros_like(x) + np.array([[speed], [0.0]])
    a0 = np.zeros_like(x) + np.array([[-mu * g], [0.0]])
    velocity, acceleration = newmark(x, v0, a0, dt)
    gravity = Gravity(WEIGHT)
    assert gravity.pressed_by(2) is Load.GROWN
    load = gravity.normal_load(PointState(d.interior, d.zeros(), (0,), rest))
    effects = (Membrane(PAPER), gravity, Friction(mu, 1e-4), Inertia(density, PAPER))
    potential = Potential(d, effects, rest, Step(velocity, acceleration, load))
    start = d.zeros().reshape(-1, 2)
    start[:, 0] = speed * dt
    result = Minimiser(Supports(d)).minimise(potential, start.ravel())
    moved = d.interior.position(result.state, (0,))[0]
    np.testing.assert_allclose(velocity(moved)[0], speed - mu * g * dt, rtol=1e-9)


def test_weight_may_count_three_areas() -> None:
    """A sheet of stretch 1.2, its rest state grown by 1.1: 1, 1.21 and 1.44 of the undeformed area."""
    d = shell("bfs", (0, 1, 2), (0, 1, 2))
    rest = grown_state(d.interior, 1.0, Growth(0.1, law="linear"))
    u = affine(d, 0.2 * np.eye(3)[:, :2], np.zeros(3))
    current = PointState(d.interior, u, (1, 2)).area
    state = PointState(d.interior, u, (0,), rest, Step(area=current))
    for area, expected in (("material", 1.0), ("grown", 1.21), ("current", 1.44)):
        assert Gravity(3.0, area).normal_load(state).sum() == pytest.approx(3 * expected, rel=1e-10)

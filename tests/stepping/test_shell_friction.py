"""A block on an incline, a block that slides to a stop, and motions that cancel."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.simulation import simulate
from linear_theory import SineWave
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import (
    MATERIAL,
    PAPER,
    STIFFNESS,
    WEAK,
    WEIGHT,
    lying,
    planar,
    pulsating,
)

MU, SLIP, DENSITY = 0.5, 1e-3, 2.0


def block(incline: float = 0.0, inertia: bool = False, weight: float = WEAK) -> Scene:
    """The sheet without growth."""
    effects: tuple[Effect, ...] = (
        Membrane(MATERIAL),
        Gravity(weight, incline=incline),
        Friction(MU, SLIP),
    )
    if inertia:
        effects = (*effects, Inertia(DENSITY, MATERIAL))
    return Scene(PAPER, SineWave(), 0.0, effects=effects, cells=(1, 2))


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
@pytest.mark.parametrize("share", [-0.9, 0.3, 0.9, 0.99])
def test_a_block_on_an_incline_creeps(share: float) -> None:
    """Below tan theta = mu it sticks, but for the creep v0 artanh(tan theta/mu) of the tanh law."""
    trajectory = simulate(block(np.arctan(share * MU)), steps=20, periods=2)
    expected = -SLIP * np.arctanh(share)
    # the start, at which the load sets in at once, is forgotten by 3 with every step
    assert trajectory.speed.mean == pytest.approx(expected, rel=1e-6)
    assert trajectory.power.friction[-1] == pytest.approx(-trajectory.power.weight[-1], rel=0.02)


def test_without_inertia_nothing_holds_a_block_that_slides() -> None:
    """Beyond tan theta = mu no speed balances the force: it says so and keeps the state."""
    scene = block(np.arctan(1.01 * MU))
    with pytest.raises(ConvergenceError, match="no time step from t = 0 converges") as caught:
        simulate(scene, steps=20)
    assert caught.value.state.shape == (ShellModel(scene).discretisation.size,)
    assert caught.value.parameter == 0


def test_with_inertia_it_slides_down() -> None:
    """The equation of motion v' = g (sin theta - mu cos theta tanh(v/v0)), weight g rho h per area."""
    theta, weight = np.arctan(1.5 * MU), 0.01
    g = weight / (DENSITY * MATERIAL.thickness)
    trajectory = simulate(block(theta, True, weight), periods=1, steps=128, ramp=0)
    way = trajectory.centre[1, -1] - trajectory.centre[1, 0]

    def motion(_: float, state: np.ndarray) -> list[float]:
        return [state[1], g * (np.sin(theta) - MU * np.cos(theta) * np.tanh(state[1] / SLIP))]

    expected = solve_ivp(motion, (0, 1), [0, 0], method="LSODA", rtol=1e-9, atol=1e-12).y[0, -1]
    dry = g * (np.sin(theta) - MU * np.cos(theta)) / 2
    # v0 is reached within 2 steps of 1/128, in which the law is not resolved
    assert -way == pytest.approx(expected, rel=5e-3)
    assert dry < expected < 1.1 * dry
    assert abs(trajectory.power.residual[-1]) < 0.01 * trajectory.power.friction[-1]


@pytest.mark.parametrize("direction", [(0.0, 1.0), (0.6, -0.8)])
def test_a_sliding_block_stops_after_the_way_of_dry_friction(direction: tuple[float, float]) -> None:
    """v^2/(2 mu g), and v0-small creep after it."""
    speed, weight = 0.05, 0.01
    g = weight / (DENSITY * MATERIAL.thickness)
    velocity = speed * np.array(direction)
    trajectory = simulate(block(0.0, True, weight), periods=1, steps=128, ramp=0, velocity=velocity)
    way = trajectory.centre[:, -1] - trajectory.centre[:, 0]
    expected = speed**2 / (2 * MU * g) * np.array(direction)
    assert speed / (MU * g) < 0.7  # it stops well before the end
    # tanh law: the way is longer by (v0/v)^2 pi^2/12; the step of 1/128 resolves the stop to 1 %
    np.testing.assert_allclose(way, expected, rtol=0.01, atol=1e-9)
    lost = trajectory.power.friction[-1]
    kinetic = DENSITY * MATERIAL.thickness * PAPER.area * speed**2 / 2
    assert lost == pytest.approx(kinetic, rel=1e-3)
    assert trajectory.power.kinetic[-1] == pytest.approx(-kinetic, rel=1e-3)


def test_no_growth_no_motion() -> None:
    trajectory = simulate(planar(0.0), steps=16, periods=1)
    np.testing.assert_array_equal(trajectory.centre[:, 1:], trajectory.centre[:, :-1])
    assert trajectory.speed.mean == 0
    assert trajectory.slip_ratio == np.inf


ALPHA = 0.1


@pytest.mark.parametrize(
    "profile",
    [lambda y: np.cos(2 * np.pi * y), lambda y: np.exp(-((y / 0.15) ** 2))],
    ids=["standing wave", "two equal bodies and an actuator between them"],
)
def test_mirror_symmetric_motions_go_nowhere(profile: object) -> None:
    """At any friction; to the tolerance of the solver, 1e-3 of the slip speed."""
    trajectory = simulate(planar(ALPHA, pulsating(profile)), steps=32, periods=2)
    assert np.abs(trajectory.centre[1] - trajectory.centre[1, 0]).max() < 1e-6
    assert np.abs(trajectory.period_speeds).max() < 1e-3 * 1e-3


@pytest.mark.parametrize(
    "profile",
    [
        lambda y: np.sin(2 * np.pi * y),
        lambda y: np.cos(2 * np.pi * y + 0.7) + 0.5 * np.sin(4 * np.pi * y),
    ],
    ids=["odd", "without symmetry"],
)
def test_time_symmetric_motions_of_a_stiff_sheet_go_nowhere(profile: object) -> None:
    """Dry friction does not know the speed: there and back again. The wave would make 1.5 alpha^2.

    What is left is the error of the step, as stated, and friction/stiffness times the motion.
    """
    scene = planar(ALPHA, pulsating(profile))
    trajectory = simulate(scene, steps=64, periods=2)
    assert np.abs(trajectory.period_speeds).max() < 1e-3 * ALPHA**2
    assert np.ptp(trajectory.centre[1]) > 1e-3 * ALPHA  # it does move to and fro
    assert trajectory.errors.step < 1e-3 * ALPHA**2


def test_a_mirrored_wave_crawls_the_other_way() -> None:
    there, back = (simulate(planar(0.25, SineWave(n)), steps=32, periods=1) for n in (1, -1))
    # 1e-3 of the slip speed of 1e-3 is what the minimisations leave
    np.testing.assert_allclose(there.centre[1], -back.centre[1], atol=1e-6)
    np.testing.assert_allclose(there.period_speeds, -back.period_speeds, atol=1e-6)
    assert there.speed.mean > 0.05


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_a_mirrored_wave_crawls_the_other_way_on_the_ground() -> None:
    options = {"steps": 24, "periods": 1}
    there = simulate(lying(), **options)
    wave = SineWave(-1)
    back = simulate(Scene(PAPER, wave, 0.02, 2.0, lying().effects, cells=lying().cells), **options)
    # 1e-3 of the slip speed of 0.1, and what the repeated loads leave (1e-3 of what they balance)
    np.testing.assert_allclose(there.period_speeds, -back.period_speeds, atol=1e-4)
    assert abs(there.speed.mean) > 1e-3


class Slope:
    """The ground z = rise y."""

    def __init__(self, rise: float) -> None:
        self.rise = rise

    def __call__(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        zero = np.zeros_like(x)
        return np.stack([self.rise * y, zero, zero + self.rise, zero, zero, zero])


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_a_sheet_creeps_down_a_slope_of_the_ground() -> None:
    """Ground given by its height, vertical weight: the same creep, along the slope."""
    rise = 0.5 * MU
    effects = (
        Membrane(MATERIAL),
        Bending(MATERIAL),
        Gravity(WEIGHT),
        Ground(STIFFNESS, height=Slope(rise)),
        Friction(MU, SLIP),
    )
    scene = Scene(PAPER, SineWave(), 0.0, effects=effects, cells=(1, 2))
    trajectory = simulate(scene, steps=20, periods=2)
    theta = np.arctan(rise)
    # the normal load carries cos theta of the weight along a sheet that sank by about 0.02
    expected = -SLIP * np.arctanh(0.5) * np.cos(theta)
    assert trajectory.speed.mean == pytest.approx(expected, rel=1e-3)
    way = trajectory.centre[:, -1] - trajectory.centre[:, -20]
    assert way[2] / way[1] == pytest.approx(rise, rel=1e-3)


def test_an_incline_is_less_than_a_right_angle() -> None:
    for incline in (np.pi / 2, -2.0):
        with pytest.raises(ValueError, match=r"incline = .*must be in \(-pi/2, pi/2\)"):
            Gravity(1.0, incline=incline)

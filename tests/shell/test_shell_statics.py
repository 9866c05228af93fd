"""Newton's method: saddles, inversion, failure, and that a scene pays only for what it names."""

from collections.abc import Callable

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics import region
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rest_state import grown_state, tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics import newton
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.orientation import Orientation
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.ramp import follow_mode, ramp
from linear_theory import SineWave
from linear_theory.growth.growth import Growth
from tests.shell.shell_cases import at, displacement, end_shear, koiter, shell

Array = NDArray[np.float64]
PAPER = Material(0.03, 0.5)


def wave(d: Discretisation, phase: float) -> Array:
    return SineWave().value(*d.interior.parameters.reshape(2, -1), phase)


def free_shell(alpha: float, n: int = 4) -> tuple[Minimiser, Callable[[float], Potential]]:
    d = shell("bfs", (-0.25, 0.25, n), (-0.5, 0.5, 2 * n))
    c = wave(d, 0.25)
    return Minimiser(Supports(d).anchor()), lambda s: Potential(
        d, koiter(PAPER), grown_state(d.interior, c, Growth(alpha * s))
    )


def planar(area: str = "grown") -> tuple[Minimiser, Callable[[float], Potential]]:
    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.25, 0.25, 7), np.linspace(-0.5, 0.5, 13))
    d = Discretisation(mesh, skfem.ElementQuad2(), components=2)
    c = wave(d, 0.25)
    return Minimiser(Supports(d).anchor()), lambda s: Potential(
        d, (Membrane(PAPER),), grown_state(d.interior, c, Growth(0.25 * s, energy_area=area))
    )


def test_a_free_sheet_under_growth_buckles_and_the_saddle_is_reported() -> None:
    minimiser, problem = free_shell(0.1)
    flat = ramp(minimiser, problem, minimiser.supports.discretisation.zeros())
    assert flat.buckled
    assert flat.negative_curvature < -1e-5
    assert np.abs(flat.state.reshape(-1, 3)[:, 2]).max() < 1e-12  # it stayed in the plane: a saddle
    mode = flat.mode.reshape(-1, 3)
    assert np.abs(mode[:, :2]).max() < 1e-6 * np.abs(mode[:, 2]).max()


def test_buckling_is_followed_to_either_side() -> None:
    minimiser, problem = free_shell(0.1)
    flat = ramp(minimiser, problem, minimiser.supports.discretisation.zeros())
    up, down = (follow_mode(minimiser, problem(1.0), flat, side) for side in (1e-3, -1e-3))
    for side in (up, down):
        assert not side.buckled
        assert side.energy < 0.95 * flat.energy
    assert up.energy == pytest.approx(down.energy, rel=1e-8)
    mirrored = up.state.reshape(-1, 3) * [1, 1, -1]
    np.testing.assert_allclose(mirrored, down.state.reshape(-1, 3), atol=1e-5)
    with pytest.raises(ValueError, match=r"buckled\.mode = None"):
        follow_mode(minimiser, problem(1.0), up, 1e-3)


def test_a_strip_between_walls_buckles_at_the_load_of_euler() -> None:
    """Both ends clamped, nu = 0: critical growth (pi h)^2/(3 L^2)."""
    h = 0.01
    critical = (np.pi * h) ** 2 / 3
    d = shell("bfs", (0, 1, 12), (-0.05, 0.05, 1))
    minimiser = Minimiser(Supports(d).clamp(at(0, 0)).clamp(at(0, 1)))
    for share, buckles in ((0.99, False), (1.01, True)):
        rest = tensor_state(d.interior, [(1 + share * critical) ** 2, 1, 0], [0, 0, 0])
        result = minimiser.minimise(Potential(d, koiter(Material(h, 0.0)), rest), d.zeros())
        assert result.buckled is buckles


@pytest.mark.parametrize("area", ["grown", "undeformed"])
def test_no_point_is_turned_inside_out(area: str) -> None:
    """Full growth at once from the flat state: the trap of the undeformed measure at alpha = 0.25."""
    minimiser, problem = planar(area)
    d = minimiser.supports.discretisation
    ramped = ramp(minimiser, problem, d.zeros(), first=0.25)
    determinant = Orientation(d.interior).directors(ramped.state)
    assert determinant.min() > 0.4
    try:
        direct = minimiser.minimise(problem(1.0), d.zeros())
    except ConvergenceError:
        return
    assert Orientation(d.interior).directors(direct.state).min() > 0
    assert direct.energy == pytest.approx(ramped.energy, rel=1e-6)


def test_an_inverted_start_is_refused() -> None:
    minimiser, problem = planar()
    d = minimiser.supports.discretisation
    mirrored = d.zeros().reshape(-1, 2)
    mirrored[:, 0] = -2 * d.locations[0]
    with pytest.raises(ConvergenceError, match="initial state is inverted"):
        minimiser.minimise(problem(1.0), mirrored.ravel())


def test_a_failure_keeps_the_last_state_and_its_parameter() -> None:
    """A load that no longer has an equilibrium beyond 0.6 of the ramp: its potential becomes NaN."""
    d = shell("bfs", (0, 1, 3), (-0.1, 0.1, 1))
    tip, rest = d.point((1.0, 0.0)), grown_state(d.interior)
    minimiser = Minimiser(Supports(d).clamp(at(0, 0)), iterations=25)

    def problem(s: float) -> Potential:
        if s > 0.6:
            raise ConvergenceError("no equilibrium", d.zeros())
        return Potential(d, koiter(PAPER), rest, loads=(Load(tip, DeadLoad((0.0, 0.0, 1e-7 * s))),))

    with pytest.raises(
        ConvergenceError, match=r"continuation failed at load factor 0\.\d+: no equilibrium"
    ) as failure:
        ramp(minimiser, problem, d.zeros(), first=0.5)
    assert 0.59 < failure.value.parameter <= 0.6
    lift = displacement(d, failure.value.state, (1.0, 0.0))[2]
    again = ramp(minimiser, lambda s: problem(s * failure.value.parameter), d.zeros())
    assert lift == pytest.approx(displacement(d, again.state, (1.0, 0.0))[2], rel=1e-6)


def test_too_few_iterations_are_a_failure() -> None:
    minimiser, problem = planar()
    minimiser.iterations = 2
    with pytest.raises(ConvergenceError, match="no minimum within 2 iterations"):
        minimiser.minimise(problem(1.0), minimiser.supports.discretisation.zeros())


def test_newton_converges_quadratically_to_its_tolerance() -> None:
    """The residual is the last correction; what is left after it is its square, or roundoff."""
    minimiser, problem = planar()
    loose = Minimiser(minimiser.supports, tolerance=1e-4)
    start = loose.supports.discretisation.zeros()
    rough, fine = loose.minimise(problem(0.4), start), minimiser.minimise(problem(0.4), start)
    assert rough.residual <= 1e-4 * loose.length
    distance = loose.rms(rough.state - fine.state)
    assert distance < 100 * rough.residual**2 + 1e-12
    assert fine.residual <= 1e-8 * minimiser.length


def test_a_kept_factor_saves_factorisations(monkeypatch: pytest.MonkeyPatch) -> None:
    """A series of similar problems, as in time: the same states for less than half of the factors."""
    counts, states = [], []
    for keep in (False, True):
        minimiser, problem = planar()
        minimiser = Minimiser(minimiser.supports, keep_factor=keep, check_stability=False)
        state, calls = minimiser.supports.discretisation.zeros(), []
        original = newton.factorise
        monkeypatch.setattr(newton, "factorise", lambda *a, c=calls, f=original: c.append(1) or f(*a))
        for s in np.linspace(0.5, 0.6, 11):
            state = minimiser.minimise(problem(s), state).state
        monkeypatch.setattr(newton, "factorise", original)
        counts.append(len(calls))
        states.append(state)
    np.testing.assert_allclose(states[0], states[1], atol=1e-7)
    assert counts[1] < counts[0] / 2


def test_a_planar_scene_computes_no_second_derivatives(monkeypatch: pytest.MonkeyPatch) -> None:
    orders: list[int] = []
    original = region.shape_functions
    monkeypatch.setattr(region, "shape_functions", lambda *a: orders.append(a[4]) or original(*a))
    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.25, 0.25, 3), np.linspace(-0.5, 0.5, 5))
    d = Discretisation(mesh, skfem.ElementQuadBFS(), components=2)
    minimiser = Minimiser(Supports(d).anchor())
    minimiser.minimise(
        Potential(d, (Membrane(PAPER),), grown_state(d.interior, 0.5, Growth(0.1))), d.zeros()
    )
    assert orders
    assert max(orders) == 1
    assert not any(max(entries) > 2 for entries in d.interior._shapes)


def test_effects_that_are_not_named_are_not_evaluated(monkeypatch: pytest.MonkeyPatch) -> None:
    """Kinematics of a membrane scene in space: metric and tangents, no normal, no curvature."""
    from fem_check.shell.kinematics.point_state import PointState

    seen: set[str] = set()
    for name in ("normal", "dual", "curvature", "christoffel", "second", "metric", "tangents"):
        original = PointState.__dict__[name]

        def spy(self: PointState, n: str = name, f: object = original) -> object:
            seen.add(n)
            return f.func(self)

        monkeypatch.setattr(PointState, name, property(spy))
    d = shell("bfs", (-0.25, 0.25, 2), (-0.5, 0.5, 4))
    potential = Potential(d, (Membrane(PAPER),), grown_state(d.interior))
    potential.energy_and_gradient(d.zeros())
    potential.hessian_blocks(d.zeros())
    assert seen == {"metric", "tangents"}


def test_equal_runs_are_equal_bit_for_bit() -> None:
    first, second = (end_shear("bfs", 4, (0.5,)).result.state for _ in range(2))
    np.testing.assert_array_equal(first, second)

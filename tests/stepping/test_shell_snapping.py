"""Snap-through: the load that a step holds fixed, restrained steps, schemes, random bending gaits."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest

from fem_check import BackwardDifferences, Newmark, simulate
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.stepping.lagged import Mixing, change
from fem_check.shell.stepping.schemes import History
from fem_check.shell.stepping.snapping import RELEASED, SHORTENED, STIFFEST, Snap
from fem_check.shell.stepping.step_control import JUMP, StepSize
from figures.measure import schemes
from figures.measure.gaits import FRICTIONS, GROUNDS, RTOL, TABLE, WAVES, gait, tried
from tests.shell.shell_scenes import MATERIAL, planar

CHEAP = (1, 3, 4, 6)
"""Numbers of random gaits: two heavy sheets that bend strongly, two that bend little."""


@pytest.mark.parametrize("slope", [0.5, -0.9, -1.8, 3.0])
def test_mixing_finds_the_fixed_point_of_affine_maps(slope: float) -> None:
    """x = b + A x, of which plain repetition diverges if A has an eigenvalue beyond 1."""
    rng = np.random.default_rng(0)
    basis = np.linalg.qr(rng.normal(size=(40, 40)))[0]
    matrix = basis[:, :3] @ np.diag([slope, -0.4, 0.2]) @ basis[:, :3].T
    exact = rng.uniform(1, 2, 40)
    wanted = Step(load=exact)
    held, mixing = Step(load=exact + 0.05 * rng.normal(size=40)), Mixing()
    for _ in range(8):
        held = mixing.next(held, Step(load=exact + matrix @ (held.pressed - exact)))
    assert change(held, wanted) < 1e-6


def test_mixing_leaves_the_first_two_repetitions_as_they_are() -> None:
    mixing, loads = Mixing(), [np.full(4, v) for v in (1.0, 2.0, 2.5)]
    for held, found in itertools.pairwise(loads):
        assert np.allclose(mixing.next(Step(load=held), Step(load=found)).pressed, found)


def test_a_mixed_load_does_not_pull() -> None:
    rng = np.random.default_rng(1)
    mixing, held = Mixing(), Step(load=rng.uniform(0, 1, 30))
    for _ in range(10):
        held = mixing.next(held, Step(load=np.maximum(rng.normal(size=30), 0)))
        assert held.pressed.min() >= 0


def test_repetitions_that_do_not_help_are_given_up() -> None:
    slow, fast = Mixing(), Mixing()
    assert [slow.stalls(0.3) for _ in range(5)] == [False] * 4 + [True]
    assert not any(fast.stalls(0.3 * 0.2**k) for k in range(12))


def test_a_snap_is_restrained_and_released() -> None:
    snap = Snap(1.0)
    assert [snap.failed(shortest=False) for _ in range(SHORTENED - 1)] == [True] * (SHORTENED - 1)
    assert not snap.restrained
    assert snap.failed(shortest=False)
    assert snap.stiffness == 1.0
    assert snap.failed(shortest=False)
    assert snap.stiffness > 1
    for _ in range(20):
        snap.succeeded()
    assert not snap.restrained
    assert snap.steps == 0
    assert RELEASED < 1 < STIFFEST
    while snap.failed(shortest=True):
        pass
    assert snap.stiffness > STIFFEST


def test_jumps_neither_count_for_the_scale_nor_as_resolved() -> None:
    size = StepSize(0.1, 0.01, 0.2, rtol=0.1, scale=1.0, natural=0.1)
    assert size.judge(0.1, 0.05, 1.0)
    assert size.resolved
    assert not size.judge(0.1, 60.0, 100.0)
    assert size.judge(0.01, 60.0, 100.0)  # it cannot be shorter
    assert not size.resolved
    assert size.scale == 1.0
    given = StepSize(0.1, 1e-4, 0.1, scale=1.0)
    assert given.judge(0.1, 0.5 * JUMP, 1.0)
    assert given.resolved
    assert given.judge(0.1, 60.0, 100.0)
    assert not given.resolved


def test_after_a_jump_the_past_is_forgotten() -> None:
    history = History.at_rest(np.zeros(3), 0.1).advanced(np.ones(3), 0.01, jumped=True)
    velocity, _ = history.rules(0.02)
    assert np.allclose(velocity(np.full(3, 1.2)), 10)  # the difference quotient, without the jump
    assert np.allclose(history.prediction(0.02), 1)
    again = history.advanced(np.full(3, 1.2), 0.02)
    assert again.times.size == 2
    assert np.allclose(again.prediction(0.01), 1.3)


@pytest.mark.parametrize("scheme", [BackwardDifferences(), Newmark(), Newmark(0.3, 0.6)])
def test_schemes_are_exact_for_constant_acceleration(scheme: Newmark | BackwardDifferences) -> None:
    x = lambda t: np.array([1.0 + 2 * t - 1.5 * t**2])  # noqa: E731
    history = History.at_rest(x(0.0), 0.1, scheme).thrown(np.array([2.0]), np.array([-3.0]))
    for dt in (0.1, 0.05, 0.08):
        t = history.time + dt
        velocity, acceleration = history.rules(dt)
        assert acceleration is not None
        assert velocity(x(t)) == pytest.approx(2 - 3 * t)
        assert acceleration(x(t)) == pytest.approx(-3.0)
        assert history.prediction(dt) == pytest.approx(x(t))
        assert history.velocity_error(x(t), dt) == pytest.approx(0, abs=1e-12)
        history = history.advanced(x(t), dt)


def vibration(scheme: Newmark | BackwardDifferences, steps: int, periods: int) -> float:
    """Amplitude left of x'' = -x after some periods, by the rules of a scheme."""
    dt = 2 * np.pi / steps
    history = History.at_rest(np.ones(1), dt, scheme).thrown(np.zeros(1), -np.ones(1))
    for _ in range(steps * periods):
        rule = history.rules(dt)[1]
        assert rule is not None
        history = history.advanced(rule.rate * rule.base / (1 + rule.rate), dt)
    assert history.velocity is not None
    return float(np.hypot(history.state[0], history.velocity[0]))


def test_newmark_keeps_vibrations_and_backward_differences_damp_those_not_resolved() -> None:
    assert vibration(Newmark(), 8, 50) == pytest.approx(1, rel=1e-10)
    # The larger root of the characteristic polynomial of y' = iy, one step an eighth of a period.
    root = np.abs(np.roots([1.5 - 2j * np.pi / 8, -2, 0.5])).max()
    rest = vibration(BackwardDifferences(), 8, 9) / vibration(BackwardDifferences(), 8, 4)
    assert rest == pytest.approx(root**40, rel=0.3)
    losses = [1 - vibration(BackwardDifferences(), n, 1) for n in (64, 128)]
    assert losses[0] / losses[1] == pytest.approx(8, rel=0.2)  # third order in the step


def test_a_scheme_can_give_the_steps() -> None:
    scene = planar(0.1, slip=0.02, cells=(1, 2), extra=(Inertia(1e-4, MATERIAL),))
    motion = simulate(scene, periods=1, scheme=Newmark(step=1 / 20))
    assert len(motion.times) == 31
    equal = simulate(scene, periods=1, scheme=Newmark(), steps=20)
    assert motion.speed.mean == equal.speed.mean
    damped = simulate(scene, periods=1, scheme=BackwardDifferences(), steps=20)
    assert damped.speed.mean == pytest.approx(equal.speed.mean, rel=0.1)
    assert damped.speed.mean != equal.speed.mean


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"scheme": Newmark()}, r"scheme = Newmark.*: must be BackwardDifferences without Inertia"),
        ({"scheme": "newmark"}, r"scheme = 'newmark'.*write Newmark\(\)"),
        ({"scheme": BackwardDifferences(0.1), "steps": 8}, r"steps = 8: must be None if the scheme"),
        ({"scheme": BackwardDifferences(0.1), "rtol": 0.1}, r"rtol = 0.1: must be None if the scheme"),
        ({"scheme": BackwardDifferences(0.5)}, r"steps = 2: must be >= 4"),
    ],
)
def test_bad_schemes(options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        simulate(planar(0.1, cells=(1, 2)), periods=1, **options)  # type: ignore[arg-type]


def test_bad_parameters_of_schemes() -> None:
    for make in (lambda: Newmark(beta=0), lambda: Newmark(gamma=0.4), lambda: Newmark(step=-1)):
        with pytest.raises(ValueError, match=r"must be > 0|must be >= 0.5"):
            make()


def test_too_much_work_is_an_error_with_the_state_reached(monkeypatch: pytest.MonkeyPatch) -> None:
    from fem_check.shell.statics.equilibrium import ConvergenceError
    from fem_check.shell.stepping import run

    monkeypatch.setattr(run, "MOST_WORK", 0.5)
    with pytest.raises(
        ConvergenceError, match=r"\d+ steps .* of 1.5: the motion is too rough"
    ) as found:
        simulate(planar(0.1, cells=(1, 2)), periods=1, steps=16)
    assert found.value.state.size
    assert 0 < found.value.parameter < 1.5


def test_random_gaits_are_what_they_are_said_to_be() -> None:
    gaits = [gait(number) for number in range(300)]
    assert gait(7) == gaits[7]
    assert max(abs(g.alpha) for g in gaits) <= 0.4
    assert 19 < max(abs(g.kappa) for g in gaits) <= 20
    for name, kinds in (("wave", WAVES), ("ground", GROUNDS), ("friction", FRICTIONS)):
        counts = [sum(getattr(g, name) == kind for g in gaits) for kind in kinds]
        assert min(counts) > 0.7 * len(gaits) / len(kinds)
    assert 100 < sum(g.inertia for g in gaits) < 200


@pytest.mark.parametrize("number", CHEAP)
def test_random_gaits_end_with_a_speed_or_a_reason(number: int) -> None:
    """Some of the table, at lower accuracy."""
    row = tried(gait(number), 30, rtol=0.3, mesh_error=False, periods=1)
    assert row.outcome in ("converged", "stated")
    assert np.isfinite(row.speed)
    assert row.error > 0
    if row.crossed > 0:
        assert row.outcome == "stated"
        assert "passes through itself" in row.said


def test_no_random_gait_ends_without_a_word() -> None:
    for row in TABLE.read():
        assert row.said
        if row.outcome in ("stopped", "late"):
            assert np.isnan(row.speed)
        else:
            assert np.isfinite(row.speed)
            assert np.isfinite(row.error) or row.snapped > 0
        if row.outcome == "converged":
            assert row.error <= RTOL * abs(row.speed)
            assert row.crossed == 0


def test_the_page_has_the_speeds_of_the_table() -> None:
    """docs/howto/bending.md against figures/data/schemes.csv."""
    text = (Path(__file__).parents[2] / "docs" / "howto" / "bending.md").read_text(encoding="utf-8")
    cells: dict[str, list[str]] = {}
    for found in schemes.TABLE.read():
        sign = "+" if found.sheet == "snapping" else ""
        fixed = found.scheme == "Newmark, 5e-3"
        told = f"{found.speed:.4f}" if fixed else f"{found.speed:{sign}.3f} ± {found.error:.3f}"
        told = "stops" if math.isnan(found.speed) else told.replace("-", "\N{MINUS SIGN}")
        cells.setdefault(found.sheet, []).append(told)
    for row in cells.values():
        assert "| " + " | ".join(row) in text

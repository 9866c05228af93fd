"""Further runs: of sheets that could have taken another way, and on a coarser mesh."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from fem_check import BackwardDifferences, Friction, Ground, simulate
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.further import rigid_ground, second_runs
from fem_check.shell.stepping.further.branching import may_branch
from fem_check.shell.stepping.run import Run
from fem_check.shell.stepping.settings import Settings
from fem_check.shell.stepping.trajectory import Trajectory
from figures.measure.paper import decisive
from linear_theory import Sheet, SineWave, Viscous
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import MATERIAL, planar

FAST, SLOW = 0.1, 1e-4


def lying(friction: object = None, *more: object) -> ShellModel:
    """A sheet on its ground; friction with a slip speed of 0.01 unless given."""
    law = Friction(1.0, slip_speed=0.01) if friction is None else friction
    effects = [Membrane(MATERIAL), Bending(MATERIAL), Gravity(1e-4), Ground(0.5), law, *more]
    return ShellModel(Scene(Sheet(), SineWave(), 0.1, 0.1, effects, cells=(1, 2)))


@pytest.mark.parametrize(
    ("model", "buckled", "snapped", "fastest", "expected"),
    [
        (lying(), 0, 1, SLOW, True),
        (lying(), 0, 0, FAST, False),
        (lying(), 1, 0, FAST, True),
        (lying(), 1, 0, SLOW, False),  # slower than the slip speed everywhere: viscous, nothing holds
        (lying(Friction(1.0, law=Viscous())), 1, 0, FAST, False),
        (lying(None, Inertia(1e-5, MATERIAL)), 1, 0, SLOW, True),
        (ShellModel(planar()), 1, 0, 1e3, False),
    ],
)
def test_who_may_take_another_way(
    model: ShellModel, buckled: int, snapped: int, fastest: float, expected: bool
) -> None:
    columns = (np.array([0.0, value]) for value in (buckled, snapped, fastest))
    assert may_branch(model, *columns) is expected


@pytest.mark.parametrize(
    ("settings", "fewest", "expected"),
    [
        (Settings(steps=128), 40, Settings(steps=64)),
        (Settings(steps=64), 40, Settings(steps=40)),
        (Settings(steps=48), 40, Settings(steps=72)),
        (Settings(rtol=0.01), 40, Settings(rtol=0.02)),
        (Settings(scheme=BackwardDifferences(0.01)), 40, Settings(scheme=BackwardDifferences(0.02))),
    ],
)
def test_other_steps_resolve_the_wave(settings: Settings, fewest: int, expected: Settings) -> None:
    found = settings.with_other_steps(fewest)
    for name in ("periods", "rtol", "steps", "scheme"):
        assert getattr(found, name) == getattr(expected, name)


@pytest.mark.parametrize("gait", ["backward", "forward"])
def test_dry_gaits_with_few_steps_are_within_their_errors(gait: str) -> None:
    """One of them takes another way with 48 steps a cycle than with more."""
    rows = {
        row.change: row
        for row in decisive.TABLE.read()
        if (row.gait, row.friction) == (gait, "dry") and (row.change == "none" or "steps" in row.change)
    }
    finest = rows.pop("128 steps")
    assert set(rows) == {"48 steps", "none", "96 steps"}
    for row in rows.values():
        assert abs(row.third - finest.third) <= row.error + finest.error


class Failing(Run):
    """A run that finds no further step."""

    def finish(self, *_: object) -> None:
        """Raise the error."""
        raise ConvergenceError("no further step", self.history.state, 0.0)


def refused(*_: object) -> None:
    """What a run does whose elements, say, are too long for what the scene names."""
    raise ValueError("cells = (1, 3): elements are too long")


@pytest.mark.parametrize("run", [Failing, refused])
def test_a_speed_is_kept_where_the_run_on_a_coarser_mesh_fails(
    monkeypatch: pytest.MonkeyPatch, run: object
) -> None:
    scene = planar(cells=(2, 4))
    expected = simulate(scene, periods=1, steps=8)
    monkeypatch.setattr(second_runs, "Run", run)
    found = simulate(scene, periods=1, steps=8, mesh_error=True)
    assert found.mean_speed == expected.mean_speed
    assert found.errors.mesh == math.inf
    assert found.speed.error == math.inf
    assert not found.speed.converged


def test_the_limit_of_rigid_ground_is_kept_where_its_coarser_mesh_fails(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The last call of `simulate` is that on the coarser mesh."""
    found = simulate(lying().scene.but(cells=(2, 4)), periods=1, steps=8)
    calls = iter([found, found, found])

    def stepped(*_: object, **__: object) -> Trajectory:
        try:
            return next(calls)
        except StopIteration:
            raise ConvergenceError("no further step", found.states[-1], 0.0) from None

    monkeypatch.setattr(rigid_ground, "simulate", stepped)
    limit = rigid_ground.rigid_ground(found.scene, periods=1, most=3, mesh_error=True)
    assert limit.motions[-1].errors.mesh == math.inf


@pytest.mark.parametrize("call", [simulate, rigid_ground.rigid_ground])
def test_a_mesh_that_cannot_be_coarser_is_refused_before_any_work(
    monkeypatch: pytest.MonkeyPatch, call: Callable[..., object]
) -> None:
    monkeypatch.setattr(Run, "finish", lambda *_: pytest.fail("there was work"))
    scene = lying().scene.but(cells=(1, 2))
    with pytest.raises(ValueError, match=r"cells = \(1, 2\): must both be >= 2 if mesh_error = True"):
        call(scene, periods=1, mesh_error=True)

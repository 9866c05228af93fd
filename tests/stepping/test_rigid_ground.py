"""Rigid ground as a limit: its law, its error against a far stiffer one, friction by the reaction."""

import numpy as np
import pytest

from fem_check import RigidGround, rigid_ground, simulate
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.ground import Ground
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.stepping.further import rigid_ground as module
from fem_check.shell.stepping.further.progress import Progress
from fem_check.shell.stepping.further.rigid_ground import Limit
from fem_check.shell.stepping.stepper import Stepper
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import WEIGHT, lying, planar

SCENES = ((0.1, 1.0), (0.05, 1.0), (-0.1, 1.0))
RTOL = 0.2


def stiff(alpha: float, bending: float, factor: float = 1.0) -> Scene:
    """A bilayer on a ground of stiffness 8 times the factor."""
    return module._on(lying(alpha, bending, slip=0.02, cells=(1, 4)), 8.0 * factor)


@pytest.fixture(scope="module", params=SCENES, ids=str)
def limit(request: pytest.FixtureRequest) -> tuple[RigidGround, Scene]:
    found = rigid_ground(stiff(*request.param), periods=1, rtol=RTOL, most=3)
    return found, stiff(*request.param, 1000.0)


def test_the_error_is_honest(limit: tuple[RigidGround, Scene]) -> None:
    """Against a ground a thousand times stiffer, into which it sinks 1/32 as deep, and finer steps."""
    found, far = limit
    assert found.speed.error == found.ground_error + found.motions[-1].speed.error
    exact = simulate(far, periods=1, rtol=RTOL / 4).speed
    assert abs(found.speed.mean - exact.mean) <= found.speed.error
    assert found.speed.error < abs(found.speed.mean)  # an estimate that says nothing is honest too


def test_stiffnesses_grow_until_the_limit_is_known(limit: tuple[RigidGround, Scene]) -> None:
    found, _ = limit
    assert found.stiffnesses == pytest.approx(8.0 * 4.0 ** np.arange(len(found.motions)))
    known = found.ground_error <= RTOL * abs(found.speed.mean)
    assert known is (found.stopped == "")
    assert known or len(found.motions) == 3
    assert "limit of a rigid ground from stiffnesses 8 to" in found.speed.model


def test_friction_acts_on_the_reaction_of_the_ground(limit: tuple[RigidGround, Scene]) -> None:
    """The load of friction is k depth^2 per area, point by point, and carries the weight."""
    motion = limit[0].motions[-1]
    region = motion.model.discretisation.interior
    ground = motion.scene.find(Ground)
    assert motion.scene.find(Friction) is not None
    depth = np.minimum(region.position(motion.states[-1], (0,))[0, 2], 0)
    area = motion.model.rest(motion.times[-1]).grown_area
    load = ground.stiffness * depth**2 * area
    assert load.sum() == pytest.approx(WEIGHT * area.sum(), rel=1e-2)
    held = Stepper(motion.model, motion.start, 0.1).held(
        Step(), motion.states[-1], motion.model.rest(motion.times[-1]), motion.times[-1]
    )
    np.testing.assert_allclose(held.pressed, load, rtol=1e-12)


@pytest.mark.parametrize("power", [0.5, 0.7, 1.0])
@pytest.mark.parametrize("second", [-0.5, 0.0, 0.5])
def test_the_limit_of_power_laws(power: float, second: float) -> None:
    """V = V0 + a k^-p + b k^-2p, at k = 1, 4, 16."""
    k = 4.0 ** np.arange(3)
    for size in (1.0, -0.3, 1e-6):
        found = Limit(2 + size * (k**-power + second * k ** (-2 * power)))
        assert abs(found.value - 2) <= found.error


@pytest.mark.parametrize(
    ("values", "value", "error"),
    [
        ((1.0, 1.0, 1.0), 1.0, 0.0),
        ((0.0, 1.0, 0.5), 0.5, 2.0),
        ((0.0, 0.1, 1.0), 1.0, 16.2),
    ],
    ids=["equal", "alternating", "growing"],
)
def test_the_limit_of_odd_sequences(values: tuple[float, ...], value: float, error: float) -> None:
    found = Limit(values)
    assert (found.value, found.error) == pytest.approx((value, error))


def test_bad_input() -> None:
    with pytest.raises(ValueError, match=r"effects = .*: must include Ground"):
        rigid_ground(planar())
    with pytest.raises(ValueError, match="factor = 1: must be > 1"):
        rigid_ground(lying(), factor=1)
    with pytest.raises(ValueError, match="most = 2: must be >= 3"):
        rigid_ground(lying(), most=2)
    with pytest.raises(ValueError, match="values: has 2 entries, must have >= 3"):
        Limit([1.0, 2.0])
    with pytest.raises(ValueError, match="motions: has 0 entries, must have >= 3"):
        RigidGround((), 0.1, 0.0)


def test_progress_is_that_of_all_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[Progress] = []
    heard = module._part(seen.append, 1, 4, "on k = 2")
    heard(Progress(1.0, 2.0, 10, 0, 3.0, 3.0, 0.5))
    assert seen == [Progress(1.0, 2.0, 10, 0, 3.0, 15.0, 0.375, "on k = 2")]

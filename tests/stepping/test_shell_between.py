"""Shapes between the states that were kept: errors that are known, and refused where they are large."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from fem_check.shell.model import ShellModel
from fem_check.shell.stepping.between import PROBES, between, probe_region
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import FieldWave, SineWave, TravellingWave
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import lying, planar

pytestmark = pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
Array = NDArray[np.float64]

PULSE = TravellingWave(np.array([0.5, 0.3]), np.array([0.2, 0.1]))
OBLIQUE = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), 1.0)
SCENES = {
    "large": (planar(0.25, cells=(2, 4)), {"steps": 64}),
    "adaptive": (planar(0.25, cells=(2, 4)), {"rtol": 1e-2}),
    "pulse": (planar(0.1, PULSE, cells=(2, 4)), {"steps": 48}),
    "short": (planar(0.1, SineWave(2), cells=(2, 8)), {"steps": 48}),
    "oblique": (planar(0.1, OBLIQUE, cells=(2, 4)), {"steps": 48}),
    "bending": (lying(slip=0.1, cells=(2, 4)), {"steps": 48}),
    "dry": (lying(slip=0.01, cells=(2, 4)), {"rtol": 2e-2}),
    "snapping": (lying(alpha=0.25, bending=0.0, cells=(2, 4)), {"steps": 48}),
}


@pytest.fixture(scope="module", params=SCENES)
def whole(request: pytest.FixtureRequest) -> Trajectory:
    scene, options = SCENES[request.param]
    return simulate(scene, periods=1, **options)


def positions(trajectory: Trajectory) -> Array:
    """Of the vertices at the stored times, (times, components, vertices)."""
    sheet = trajectory.model.discretisation
    region = sheet.points(sheet.mesh.p)
    return np.array([region.position(u, (0,))[0] for u in trajectory.states])


def thinned(whole: Trajectory, every: int) -> Trajectory:
    """The run as if it had been made with that keep_every."""
    last = whole.times.size - 1
    kept = np.unique(np.append(np.arange(0, last, every), last))
    return replace(whole, stored_times=whole.times[kept], states=whole.states[kept])


def distance(first: Array, second: Array) -> float:
    return float(np.sqrt(((first - second) ** 2).sum(0)).max())


@pytest.mark.parametrize("every", [2, 4, 7, 20, 48])
def test_the_error_between_kept_states_is_not_understated(whole: Trajectory, every: int) -> None:
    """Against the states that were dropped; what is let through by default is right to it."""
    few, true = thinned(whole, every), positions(whole)
    motion = np.sqrt((np.ptp(whole.probes[-48:], axis=0) ** 2).sum(-1)).max()
    seen = 0
    for row in np.linspace(1, whole.times.size - 2, 12).astype(int):
        t = whole.times[row]
        if t in few.stored_times:
            assert few.shape_error(t) == 0
            continue
        error = distance(few.positions(t, rtol=None), true[row])
        assert error <= few.shape_error(t) + 1e-12
        if error > 0.02 * motion:
            seen += 1
            with pytest.raises(ValueError, match=r"t = .* larger rtol, .* smaller keep_every"):
                few.positions(t)
    assert seen or every < 20


def test_the_error_between_steps_is_not_understated(whole: Trajectory) -> None:
    """Every second step is taken out of the run with all that is known of it, and is the truth."""
    table = {name: column[::2] for name, column in whole.table.items()}
    snaps = whole.table["buckled"]
    table["buckled"] = np.append(0, np.maximum(snaps[1:-1:2], snaps[2::2]))[: table["time"].size]
    half = replace(
        whole,
        table=table,
        probes=whole.probes[::2],
        stored_times=whole.times[::2],
        states=whole.states[::2],
    )
    true, ratios = positions(whole), []
    for row in range(1, half.stored_times.size * 2 - 2, 2):
        t = whole.times[row]
        ratios.append(distance(half.positions(t, rtol=None), true[row]) / half.shape_error(t))
    if whole.buckled.any():  # a snap within three steps: its ends are known, not its course
        assert np.quantile(ratios, 0.8) < 1
        assert max(ratios) < 2
    else:
        assert max(ratios) < 1.1


def test_kept_states_are_exact_and_every_state_lets_all_times_through() -> None:
    whole = simulate(planar(0.25, cells=(1, 2)), periods=1, steps=48)
    for k in (0, 7, 71, 72):
        np.testing.assert_array_equal(whole.shape(whole.times[k]), whole.states[k])
    for t in (
        1.0,
        np.nextafter(1.0, 0),
        1 + 1e-12,
    ):  # the sum of 48 steps of 1/48 is 1 but for roundoff
        np.testing.assert_array_equal(whole.shape(t), whole.states[48])
    np.testing.assert_array_equal(whole.shape(1.5 + 1e-12), whole.states[-1])
    for t in np.random.default_rng(0).uniform(0, 1.5, 20):
        assert whole.shape_error(t) > 0
        whole.positions(t)


def test_one_state_a_period_shows_no_motion_and_is_not_believed() -> None:
    """All kept states are alike, and so are interpolations of any order between them."""
    scene = planar(0.25, cells=(1, 2))
    whole, few = (simulate(scene, periods=3, steps=24, ramp=1.0, keep_every=k) for k in (1, 24))
    t = whole.times[60]
    alike = [between(few.stored_times, few.states, t, k) for k in (2, 3, 4)]
    assert max(abs(a - alike[0]).max() for a in alike) < 0.03
    true = distance(few.positions(t, rtol=None), whole.positions(t))
    assert true > 0.1
    assert true <= few.shape_error(t) <= 4 * true
    with pytest.raises(ValueError, match=r"error of positions, 0\.\d+, is above rtol = 0.01"):
        few.shape(t)
    np.testing.assert_array_equal(few.path.position[:, 2], whole.path.position[:, 48])


def test_rtol_is_widened_by_the_user() -> None:
    few = simulate(planar(0.25, cells=(1, 2)), periods=1, steps=24, keep_every=5)
    t = 0.9
    with pytest.raises(ValueError, match=r"rtol = 0\.01"):
        few.positions(t)
    np.testing.assert_array_equal(few.positions(t, rtol=0.5), few.positions(t, rtol=None))
    for bad in (0.0, -1.0, np.nan):
        with pytest.raises(ValueError, match="rtol"):
            few.positions(t, rtol=bad)
    for bad in (-0.1, 2.0):
        with pytest.raises(ValueError, match="where states were kept"):
            few.shape_error(bad)


def test_a_sheet_at_rest_has_shapes_at_all_times() -> None:
    """Nothing moves, and no motion is no scale: what minimisations leave is let through."""
    few = simulate(planar(0.0, cells=(1, 2)), periods=1, steps=8, keep_every=4)
    assert few.shape_error(0.7) < 1e-9
    few.positions(0.7)


@pytest.mark.parametrize("scene", [planar(cells=(2, 4)), lying(cells=(1, 2))], ids=["many", "few"])
def test_probes_lie_at_the_corners_and_far_from_each_other(scene: Scene) -> None:
    sheet = ShellModel(scene).discretisation
    points = probe_region(sheet).parameters.reshape(2, -1)
    assert points.shape[1] == min(PROBES, sheet.mesh.p.shape[1])
    corners = {tuple(p) for p in points.T if abs(p[0]) == 0.25 and abs(p[1]) == 0.5}
    assert len(corners) == 4
    assert len({tuple(p) for p in points.T}) == points.shape[1]

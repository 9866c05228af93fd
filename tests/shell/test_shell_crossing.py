"""A sheet that passes through itself is found, one that only comes near is not."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import skfem

from fem_check.choice import answers
from fem_check.mesh.elements import grid
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.kinematics import crossing
from fem_check.shell.kinematics.crossing import Crossings, CrossingsUnknown
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import FieldWave, Sheet
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import MATERIAL, lying, planar

SHEET = Sheet()


def bent(angle: Callable[[np.ndarray], np.ndarray]) -> Callable[..., np.ndarray]:
    """Jets of the displacement of a sheet bent along y into the plane curve with this tangent angle."""
    s = np.linspace(-0.5, 0.5, 4001)
    tangent = np.stack([np.cos(angle(s)), np.sin(angle(s))])
    steps = (tangent[:, 1:] + tangent[:, :-1]) / 2 * np.diff(s)
    curve = np.concatenate([np.zeros((2, 1)), np.cumsum(steps, axis=1)], axis=1)

    def jets(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        out = np.zeros((6, 3, x.size))
        out[0, 1], out[0, 2] = (np.interp(y, s, c) for c in curve)
        out[0, 1] -= y
        out[2, 1], out[2, 2] = np.cos(angle(y)) - 1, np.sin(angle(y))
        step = 1e-4
        out[4, 1], out[4, 2] = (
            (f(angle(y + step)) - f(angle(y - step))) / (2 * step) for f in (np.cos, np.sin)
        )
        return out

    return jets


def spiral(radius: float, gap: float) -> Callable[[np.ndarray], np.ndarray]:
    """Tangent angle of r = radius + gap theta/(2 pi): turns that lie `gap` apart never meet."""
    theta = np.linspace(0, 40, 40001)
    r, slope = radius + gap * theta / (2 * np.pi), gap / (2 * np.pi)
    length = np.concatenate([[0], np.cumsum(np.hypot(r, slope)[1:] * np.diff(theta))])
    turned = theta + np.pi / 2 - np.arctan2(slope, r)
    return lambda y: np.interp(y + 0.5, length, turned)


def loop(turn: float) -> Callable[[np.ndarray], np.ndarray]:
    """Tangent that turns by `turn` in the middle third: at 2 pi a loop, whose ends must cross."""
    return lambda y: turn * (0.5 + np.arctan(20 * y) / np.pi)


MESHES = {
    "rectangles": (grid(SHEET, (4, 12)), skfem.ElementQuadBFS()),
    "triangles": (
        skfem.MeshTri.init_tensor(np.linspace(-0.25, 0.25, 4), np.linspace(-0.5, 0.5, 13)),
        skfem.ElementTriArgyris(),
    ),
}


@pytest.mark.parametrize("kind", MESHES)
@pytest.mark.parametrize(
    ("angle", "crosses"),
    [
        (loop(0.0), False),
        (loop(np.pi), False),
        (loop(2 * np.pi), True),
        (spiral(0.06, 0.03), False),
        (spiral(0.10, -0.03), False),
    ],
    ids=["flat", "hairpin", "loop", "spiral outward", "spiral inward"],
)
def test_curled_by_hand(kind: str, angle: Callable[[np.ndarray], np.ndarray], crosses: bool) -> None:
    discretisation = Discretisation(*MESHES[kind])
    u = discretisation.interpolate(bent(angle))
    assert Crossings(discretisation).found(u) is crosses


def test_the_proxy_covers_the_sheet() -> None:
    for mesh, element in MESHES.values():
        places, triangles = Crossings(Discretisation(mesh, element))._places
        assert np.isclose(
            np.abs(crossing._area(places[:, triangles])).sum(), SHEET.length * SHEET.width
        )
        edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        _, counts = np.unique(edges, axis=0, return_counts=True)
        assert set(counts) == {1, 2}  # one surface, without gaps between elements
        assert places.shape[1] - len(counts) + len(triangles) == 1


def test_without_the_package_only_open_sheets_are_known(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(package: str, extra: str, use: str) -> None:
        raise ModuleNotFoundError(f"{use} needs {package}: pip install 'sheetcrawl[{extra}]'")

    monkeypatch.setattr(crossing, "optional", missing)
    discretisation = Discretisation(*MESHES["rectangles"])
    looks = Crossings(discretisation)
    assert looks.found(discretisation.interpolate(bent(loop(1.0)))) is False
    with pytest.raises(CrossingsUnknown, match=r"through itself needs ipctk: pip install"):
        looks.found(discretisation.interpolate(bent(loop(2 * np.pi))))


@pytest.fixture(scope="module")
def flat() -> Trajectory:
    """A sheet that does not cross itself."""
    return simulate(lying(alpha=0.01, bending=0.1, slip=0.002, cells=(2, 4)), periods=1, rtol=0.2)


def curled(motion: Trajectory, turn: float) -> Trajectory:
    """The same with its last kept shape replaced by one that is bent by hand."""
    shape = motion.model.discretisation.interpolate(bent(loop(turn)))
    return replace(motion, states=np.concatenate([motion.states[:-1], shape[None]]))


def test_a_speed_beyond_a_crossing_is_not_converged(flat: Trajectory) -> None:
    assert flat.crossed is not None
    assert not flat.crossed.any()
    assert "itself" not in flat.speed.model
    loose = replace(flat, rtol=1e3)
    assert loose.speed.converged
    assert curled(loose, np.pi).speed.converged
    crossing = curled(loose, 2 * np.pi)
    assert crossing.crossed is not None
    assert crossing.crossed.tolist() == [False] * (len(flat.states) - 1) + [True]
    assert not crossing.speed.converged
    assert f"passes through itself from t = {flat.times[-1]:g}" in crossing.speed.model


def test_what_was_not_looked_for_is_said(flat: Trajectory, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(package: str, extra: str, use: str) -> None:
        raise ModuleNotFoundError(package)

    monkeypatch.setattr(crossing, "optional", missing)
    unknown = curled(flat, 2 * np.pi)
    assert unknown.crossed is None
    assert (
        "not looked at for crossing itself (pip install 'sheetcrawl[contact]')" in unknown.speed.model
    )


def test_a_planar_sheet_cannot_cross_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Crossings, "found", None)
    motion = simulate(planar(0.1, cells=(1, 2), slip=0.02), periods=1, rtol=0.2)
    assert motion.crossed is not None
    assert not motion.crossed.any()


@pytest.mark.parametrize(("curvature", "crosses"), [(0.5, False), (8.0, True)])
def test_a_cycle_of_shapes_that_cross_is_not_converged(curvature: float, crosses: bool) -> None:
    """Bent to an arc of half a radian, and to one of 8 radians, which is more than a full turn."""
    wave = FieldWave(lambda x, y, t: 1 + 0.1 * np.sin(2 * np.pi * (y - t)) + 0 * x, 1.0)
    bends = (Membrane(MATERIAL), Bending(MATERIAL))
    scene = Scene(SHEET, wave, 0.05, curvature, bends, cells=(2, 6))
    found = cycle_speed(scene, friction="viscous", rtol=0.3, atol=1.0)
    assert found.error < 1
    assert found.converged is not crosses
    assert ("passes through itself from t = 0," in found.model) is crosses
    shapes = found.deformation.shapes  # type: ignore[union-attr]
    assert shapes.crossed.tolist() == [crosses] * len(shapes.states)
    assert (answers._crossing(found) != "") is crosses

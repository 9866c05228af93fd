"""Parts of a sheet that meet keep apart by its thickness."""

import contextlib
import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy.sparse as sp
import skfem
from scipy.spatial import cKDTree

from fem_check.mesh.elements import grid
from fem_check.shell.effects.contact.barrier import Barrier
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.triangulation import Triangulation
from fem_check.shell.material import Material
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.linear_solver import DENSE, _dense, _sparse
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.sparsity import Sparsity
from fem_check.shell.stepping.further import second_runs
from fem_check.shell.stepping.further.errors import Doubt
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from figures.measure import self_contact
from linear_theory import FieldWave, Sheet, crawl_speed
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import MATERIAL, lying
from tests.shell.test_shell_crossing import bent, loop, spiral

STRIP = Sheet(length=1.0, width=0.06, thickness=0.04)
H = STRIP.thickness
SOFT = Material(H, STRIP.poisson)


def rolled(contact: bool = True, tilt: float = 0.0, extra: tuple[Effect, ...] = ()) -> Scene:
    """A strip that rolls up as it grows: to a full turn and more, a little more on one side."""

    def wave(x: Any, y: Any, t: Any) -> Any:
        return 1 + tilt * y + 0.1 * np.sin(2 * np.pi * (y - t)) + 0 * x

    effects: tuple[Effect, ...] = (
        *(Membrane(SOFT), Bending(SOFT), Gravity(2.5e-4), Ground(5.0)),
        *(Friction(1.0, law="viscous"), *extra),
    )
    effects = (*effects, SelfContact(SOFT)) if contact else effects
    return Scene(STRIP, FieldWave(wave, 1.0, name="rolls up"), 0.05, -9.0, effects, cells=(1, 8))


def moved(scene: Scene, **options: Any) -> Trajectory:
    return simulate(scene, periods=1, **{"steps": 8, **options})


@pytest.fixture(scope="module")
def roll() -> Trajectory:
    return moved(rolled(tilt=0.4))


class Patches:
    """Two parallel squares, the upper one at a height u[0] and shifted along, as a `Triangulation`."""

    def __init__(self, parts: int, shift: float) -> None:
        side = np.linspace(0, 1, parts + 1)
        mesh = skfem.MeshTri.init_tensor(side, side)
        lower = np.vstack([mesh.p, 0 * mesh.p[:1]])
        upper = lower + np.array([[shift], [0.3 * shift], [0.0]])
        self.rest = np.hstack([lower, upper])
        self.triangles = np.vstack([mesh.t.T, mesh.t.T + mesh.p.shape[1]])
        lift = np.zeros((3, self.rest.shape[1]))
        lift[2, mesh.p.shape[1] :] = 1
        self.map = sp.csr_array(lift.T.reshape(-1, 1))
        self.discretisation = self

    def zeros(self) -> np.ndarray:
        """Far apart, when neighbours are looked for."""
        return np.array([10.0])

    def vertices(self, u: np.ndarray) -> np.ndarray:
        return self.rest + (self.map @ u).reshape(-1, 3).T


def published(d: float, thickness: float, gap: float) -> tuple[float, float]:
    """The barrier b(s, S) of Li et al. (2020), eq. 6, over S^2 times the gap, and its slope in d."""
    s, most = d**2 - thickness**2, (thickness + gap) ** 2 - thickness**2
    value = -((s - most) ** 2) * np.log(s / most)
    slope = (most - s) * (2 * np.log(s / most) - most / s + 1)
    return gap * value / most**2, gap * slope / most**2 * 2 * d


def test_a_point_over_a_triangle_is_repelled_as_published() -> None:
    """A small triangle over the middle of a large one: three points, each with a third of its area.

    A quarter of that area counts: points over triangles and pairs of edges, each seen from both sides,
    are four ways to add up the same contact.
    """
    corners = [(0.2, 0.2, 0.0), (0.4, 0.25, 0.0), (0.25, 0.4, 0.0)]
    surface = Patches(1, 0.0)
    surface.rest = np.vstack([[(0, 0, 0), (1, 0, 0), (0, 1, 0)], corners]).T.astype(float)
    surface.triangles = np.array([[0, 1, 2], [3, 4, 5]])
    surface.map = sp.csr_array(np.repeat([[0, 0, 0], [0, 0, 1]], 3, axis=0).reshape(-1, 1) * 1.0)
    first, second, third = np.array(corners)
    area = np.linalg.norm(np.cross(second - first, third - first)) / 2
    barrier = Barrier(surface, 0.03, 0.015, 0.2, 0.0)  # type: ignore[arg-type]
    for d in (0.031, 0.036, 0.043):
        energy, gradient = barrier.energy_and_gradient(np.array([d]))
        value, slope = published(d, 0.03, 0.015)
        assert energy == pytest.approx(0.2 * area / 4 * value, rel=1e-10)
        assert gradient[0] == pytest.approx(0.2 * area / 4 * slope, rel=1e-10)
        assert barrier.distance(np.array([d])) == pytest.approx(d, rel=1e-12)


@pytest.mark.parametrize("shift", [0.0, 0.07])
def test_parallel_patches_repel_as_published(shift: float) -> None:
    """Energy per area: that of the formula, up to what neighbouring pairs count for together."""
    barrier = Barrier(Patches(6, shift), 0.03, 0.015, 0.2, 0.0)  # type: ignore[arg-type]
    for d in (0.031, 0.036, 0.043):
        energy, gradient = barrier.energy_and_gradient(np.array([d]))
        value, slope = published(d, 0.03, 0.015)
        assert 0.9 < energy / (0.2 * value) < 2
        assert gradient[0] / energy == pytest.approx(slope / value, rel=0.03)
    for d in (0.0451, 0.2):
        assert barrier.energy_and_gradient(np.array([d]))[0] == 0
        assert barrier.hessian(np.array([d])) is None
    assert barrier.energy_and_gradient(np.array([0.03]))[0] == np.inf


def test_no_step_passes_through() -> None:
    barrier = Barrier(Patches(3, 0.1), 0.03, 0.015, 0.2, 0.0)  # type: ignore[arg-type]
    start, way = np.array([0.05]), np.array([-0.1])
    share = barrier.reach(start, way)
    assert 0.1 < share < 0.2  # 0.2 would be touching
    assert barrier.energy_and_gradient(start + share * way)[0] < np.inf
    assert barrier.reach(start, -way) == 1
    assert barrier.reach(start, 0.1 * way) == 1
    assert barrier.reach(start, -100 * way) < 1  # far motions are cut, to keep the work bounded


@pytest.fixture(scope="module")
def curled() -> tuple[Discretisation, Barrier, np.ndarray]:
    """A strip rolled up by hand into a spiral whose turns are within the gap.

    Not a perfect one: where edges are parallel the second derivative of a distance jumps.
    """
    sheet = Discretisation(grid(STRIP, (1, 10)), skfem.ElementQuadBFS())
    barrier = Barrier(Triangulation(sheet, 2), 0.03, 0.015, 0.1, 0.2)
    rough = 1e-3 * np.random.default_rng(2).standard_normal(sheet.size) * np.repeat(sheet.units, 3)
    return sheet, barrier, sheet.interpolate(bent(spiral(0.07, 0.04))) + rough


def test_derivatives_are_those_of_the_energy(
    curled: tuple[Discretisation, Barrier, np.ndarray],
) -> None:
    sheet, barrier, u = curled
    random, step = np.random.default_rng(0), 1e-7
    along = random.standard_normal(u.size) * np.repeat(sheet.units, 3)
    (more, up), (less, down) = (barrier.energy_and_gradient(u + s * along) for s in (step, -step))
    energy, gradient = barrier.energy_and_gradient(u)
    hessian = barrier.hessian(u)
    assert energy > 0
    assert (more - less) / (2 * step) == pytest.approx(gradient @ along, rel=1e-6)
    wanted = hessian @ along
    assert np.allclose((up - down) / (2 * step), wanted, rtol=0, atol=1e-5 * abs(wanted).max())
    convex = barrier.hessian(u, convex=True).toarray()
    assert np.linalg.eigvalsh(convex).min() > -1e-9 * abs(convex).max()
    assert abs(hessian - hessian.T).max() < 1e-9 * abs(hessian).max()


def test_a_flat_or_open_sheet_does_not_touch_itself(
    curled: tuple[Discretisation, Barrier, np.ndarray],
) -> None:
    sheet, barrier, u = curled
    assert barrier.touches(u)
    for angle in (loop(0.0), loop(np.pi), spiral(0.07, 0.06)):
        assert not barrier.touches(sheet.interpolate(bent(angle)))


def test_the_map_of_the_vertices_is_linear(
    curled: tuple[Discretisation, Barrier, np.ndarray],
) -> None:
    _, barrier, u = curled
    surface = barrier.surface
    flat = surface.vertices(np.zeros_like(u))
    assert np.allclose(surface.vertices(u).T.ravel(), flat.T.ravel() + surface.map @ u, atol=1e-14)


@pytest.mark.parametrize("pieces", [2, 4])
def test_triangles_are_mirror_symmetric(pieces: int) -> None:
    sheet = Discretisation(grid(STRIP, (1, 3)), skfem.ElementQuadBFS())
    surface = Triangulation(sheet, pieces)
    middles = surface.places[:, surface.triangles].mean(2)
    tree = cKDTree(middles.T)
    for mirror in ((-1, 1), (1, -1)):
        assert tree.query(middles.T * mirror)[0].max() < 1e-12


@pytest.mark.parametrize("solver", [_dense, _sparse])
def test_factors_with_distant_couplings(solver: Callable[..., Any]) -> None:
    sheet = Discretisation(grid(STRIP, (1, 3)), skfem.ElementQuadBFS())
    sparsity, random = Sparsity(sheet, np.ones(sheet.size, bool)), np.random.default_rng(1)
    values = np.where(
        sparsity.rows == sparsity.columns, 50.0, random.standard_normal(sparsity.rows.size)
    )
    far = random.standard_normal((sparsity.size, 3)) * (random.random((sparsity.size, 1)) < 0.1)
    coupled, right = sp.csr_array(far @ far.T), random.standard_normal(sparsity.size)
    full = sparsity.matrix(values).toarray() + coupled.toarray()
    factor = solver(sparsity, values, coupled)
    assert np.allclose(full @ factor.solve(right), right)
    assert solver(sparsity, values - 200 * (sparsity.rows == sparsity.columns), coupled) is None
    assert sparsity.size < DENSE


def gap_of(motion: Trajectory, u: np.ndarray) -> float:
    """Smallest distance of points of the sheet itself, not of its triangles, that are far along it."""
    length, width = STRIP.length, STRIP.width
    y, x = np.linspace(-length / 2, length / 2, 241), np.linspace(-width / 2, width / 2, 5)
    places = np.stack([v.ravel() for v in np.meshgrid(x, y)])
    position = motion.model.discretisation.points(places).position(u, (0,))[0].T
    near = cKDTree(position).query_pairs(2 * H, output_type="ndarray")
    far = near[abs(places[1][near[:, 0]] - places[1][near[:, 1]]) > 0.3]
    apart = position[far[:, 0]] - position[far[:, 1]]
    return float(np.sqrt((apart**2).sum(1)).min(initial=2 * H))


def test_a_strip_that_rolls_up_keeps_its_thickness(roll: Trajectory) -> None:
    """By points of the smooth sheet, from which the triangles depart by 0.2 thicknesses at the most."""
    touching = roll.touching
    assert roll.crossed is not None
    assert not roll.crossed.any()
    assert touching[-1]
    assert not touching[0]
    assert all(gap_of(roll, u) > (1 - 2 * 0.2) * H for u in roll.states)
    assert gap_of(roll, roll.states[-1]) < 2 * H
    assert np.isfinite(roll.speed.mean)
    assert np.isfinite(roll.speed.error)
    assert roll.speed.error > roll.errors.contact > 0
    assert "touches itself from t =" in roll.speed.model


def test_without_the_effect_it_passes_through_itself() -> None:
    free = moved(rolled(contact=False, tilt=0.4))
    assert free.crossed is not None
    assert free.crossed[-1]
    assert gap_of(free, free.states[-1]) < 0.2 * H
    assert not free.touching.any()


def test_the_energy_balance_counts_the_contact(roll: Trajectory) -> None:
    works, stored = roll.power, 0.0
    model, last = roll.model, roll.states[-1]
    stored = model.couplings[0].energy_and_gradient(last)[0]
    elastic = model.potential(roll.model.rest(roll.times[-1]), effects=model.effects[:2])
    assert stored > 0
    assert works.elastic[-1] == pytest.approx(elastic.energy(last) + stored, rel=1e-6)


def test_where_nothing_touches_nothing_changes() -> None:
    scene = lying(slip=2e-3, cells=(2, 4))
    guarded = scene.but(effects=(*scene.effects, SelfContact(MATERIAL)))
    plain, same = (simulate(s, periods=1, steps=8) for s in (scene, guarded))
    assert np.array_equal(plain.states, same.states)
    assert plain.speed.mean == same.speed.mean
    assert not same.touching.any()


@pytest.mark.parametrize(
    ("angle", "mirror"),
    [(spiral(0.07, 0.04), (-1, 1, 1)), (lambda y: 6.05 * y, (1, -1, 1))],
    ids=["left and right", "ends of an arc that nearly closes"],
)
def test_forces_of_a_symmetric_shape_are_symmetric(
    angle: Callable[[np.ndarray], np.ndarray], mirror: tuple[int, int, int]
) -> None:
    sheet = Discretisation(grid(STRIP, (2, 10)), skfem.ElementQuadBFS())
    surface = Triangulation(sheet, 2)
    barrier, u = Barrier(surface, 0.03, 0.015, 0.1, 0.2), sheet.interpolate(bent(angle))
    near, vertices = barrier._near(u)
    forces = barrier._potential.gradient(near, barrier._mesh, vertices).reshape(-1, 3)
    other = cKDTree(surface.places.T).query(surface.places.T * mirror[:2])[1]
    assert abs(forces).max() > 0
    assert np.allclose(forces, forces[other] * mirror, atol=1e-9 * abs(forces).max())


def test_a_run_with_inertia_resumes_bit_for_bit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Interrupted while the strip touches itself: the last factor is that of a coupled matrix."""
    scene = rolled(tilt=0.4, extra=(Inertia(1e-5, SOFT),))
    path, options = tmp_path / "run.npz", {"steps": 8}
    for name in ("snap_error", "contact_error"):  # runs of their own, which are tested elsewhere
        monkeypatch.setattr(second_runs, name, lambda run, whole: Doubt())

    def stop(progress: Any) -> None:
        if progress.time > 1.2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        moved(scene, snapshot=path, progress=stop, **options)
    with np.load(path) as file:
        assert "coupled_data" in file.files
    resumed, whole = moved(scene, snapshot=path, **options), moved(scene, **options)
    assert 1.2 < resumed.resumed_at < 1.5
    assert np.array_equal(resumed.states, whole.states)
    assert whole.touching.any()
    assert whole.crossed is not None
    assert not whole.crossed.any()


def test_other_levels_refuse_it_by_name() -> None:
    scene = rolled()
    for level in (crawl_speed, lambda s: crawl_speed(s, order=2)):
        with pytest.raises(ValueError, match="SelfContact"):
            level(scene)
    from fem_check import cycle_speed

    with pytest.raises(ValueError, match=r"SelfContact.*simulate\(scene\) can"):
        cycle_speed(scene)


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"gap": 0.0}, "gap = 0: must be > 0"),
        ({"stiffness": -1.0}, "stiffness = -1: must be > 0"),
        ({"material": 0.03}, "material = 0.03"),
    ],
)
def test_values_out_of_range(change: dict[str, Any], match: str) -> None:
    with pytest.raises(ValueError, match=match):
        SelfContact(**{"material": MATERIAL, **change})


def test_scenes_that_it_cannot_be_in() -> None:
    flat = (Membrane(MATERIAL), SelfContact(MATERIAL))
    with pytest.raises(ValueError, match="SelfContact must come with Bending"):
        Scene(Sheet(), lying().wave, 0.1, effects=flat)
    pressed = (Membrane(MATERIAL), Gravity(1e-3), Friction(0.7, 0.1), SelfContact(MATERIAL))
    with pytest.raises(ValueError, match="SelfContact must come with Bending"):
        Scene(Sheet(), lying().wave, 0.1, effects=pressed)
    other = SelfContact(Material(0.02, 0.5))
    scene = lying(cells=(2, 4))
    with pytest.raises(ValueError, match="must be the same"):
        scene.but(effects=(*scene.effects, other))
    contact = SelfContact(MATERIAL)
    bends = {"curvature_coupling": 45.0, "cells": (8, 16)}
    sharp = scene.but(effects=(*scene.effects, contact), **bends)
    with pytest.raises(ValueError, match="curvature_coupling: bends the sheet by 45, must be by <= 39"):
        ShellModel(sharp).check_elements()
    with pytest.raises(ValueError, match="curvature_coupling: bends the sheet by 45, must be by <= 39"):
        ShellModel(sharp).couplings  # noqa: B018 - made on first use
    wide = scene.but(effects=(*scene.effects, SelfContact(MATERIAL, gap=1.0)), curvature_coupling=10.0)
    with pytest.raises(ValueError, match=r"or the gap must be <= \d") as refused:
        ShellModel(wide).check_elements()
    for share in (0.99, 1.01):  # of the gap that is named, met and missed
        near = SelfContact(MATERIAL, gap=share * float(str(refused.value).split()[-1]))
        bent = ShellModel(scene.but(effects=(*scene.effects, near), curvature_coupling=10.0))
        with pytest.raises(ValueError, match="bends") if share > 1 else contextlib.nullcontext():
            bent.check_elements()
    thin = dataclasses.replace(Sheet(), thickness=1e-3)
    material = Material(1e-3, 0.5)
    parts = (Membrane(material), Bending(material), SelfContact(material))
    coarse = Scene(thin, scene.wave, 0.1, 20.0, parts, cells=(2, 4))
    with pytest.raises(ValueError, match=r"cells: elements are 0\.354 long, must be shorter"):
        ShellModel(coarse).couplings  # noqa: B018 - made on first use


def test_a_potential_does_not_drop_it() -> None:
    model = ShellModel(rolled())
    with pytest.raises(ValueError, match="couplings: must be those of SelfContact"):
        Potential(model.discretisation, model.effects, model.rest(0.0))


def test_scene_files_hold_it(tmp_path: Path) -> None:
    scene = lying(cells=(2, 4))
    scene = scene.but(effects=(*scene.effects, SelfContact(MATERIAL, gap=0.01)))
    path = tmp_path / "scene.toml"
    scene.to_toml(path)
    assert Scene.from_toml(path) == scene
    assert Scene.from_dict(scene.to_dict()) == scene


def test_errors_by_the_gap_are_honest() -> None:
    """Of strips that roll up, against the smallest gap; and of stiffness, which acts within the gap."""
    rows = [r for r in self_contact.TABLE.read() if np.isfinite(r.speed)]
    assert {r.kappa for r in rows} >= {-8.0, -9.0, -10.0}
    assert {r.stiffness for r in rows} == {0.1, 1.0, 10.0}
    for row in rows:
        narrowest = (r for r in rows if (r.kappa, r.gap) == (row.kappa, self_contact.GAPS[-1]))
        (best,) = (r for r in narrowest if r.stiffness == 1)
        assert abs(row.speed - best.speed) <= row.error
        assert row.touching > 0
        assert row.crossed == 0


def test_the_page_has_the_speeds_of_the_table() -> None:
    """docs/howto/bending.md against figures/data/self_contact.csv."""
    text = (Path(__file__).parents[2] / "docs" / "howto" / "bending.md").read_text(encoding="utf-8")
    rows = [r for r in self_contact.TABLE.read() if r.kappa == self_contact.KAPPAS[0]]
    for usual in (True, False):
        told = ", ".join(f"{r.speed:.4f}" for r in rows if (r.stiffness == 1) is usual)
        assert f"{told} L/T" in " ".join(text.split())

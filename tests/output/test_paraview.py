"""Files for ParaView, read back: the arrays of the results, and those of a second calculation."""

import numpy as np
import pytest

from fem_check import Material, Membrane, Scene, cycle_speed, simulate, write_paraview
from figures.measure import saddle
from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    Tanh,
    airy_series,
    crawl_speed,
    friction_field,
    line_balance,
    rigid_path,
)
from tests.shell.shell_scenes import planar

meshio = pytest.importorskip("meshio")


def read(path):
    """Points (2, n), type of the cells, and (time, data) of all steps."""
    with meshio.xdmf.TimeSeriesReader(path) as reader:
        points, cells = reader.read_points_cells()
        steps = [reader.read_data(k)[:2] for k in range(reader.num_steps)]
    return points[:, :2].T, cells[0].type, steps


def test_of_a_trajectory(tmp_path):
    trajectory = simulate(planar(), periods=1, steps=16, keep_every=6)
    path = tmp_path / "crawl.xdmf"
    write_paraview(trajectory, path, refine=1)
    points, kind, steps = read(path)
    assert kind == "quad"
    np.testing.assert_allclose([t for t, _ in steps], trajectory.stored_times)
    time, data = steps[-1]
    assert time == pytest.approx(1.5)
    # XML holds all digits of a double
    moved = trajectory.positions(1.5, points)
    np.testing.assert_allclose(points + data["displacement"].T[:2], moved, atol=1e-14)
    wave = trajectory.model.growth(1.5, *points)
    np.testing.assert_allclose(data["wave"], wave, atol=1e-14)
    np.testing.assert_allclose(data["growth"], trajectory.scene.alpha * wave, atol=1e-14)
    size = np.hypot(*data["friction"].T[:2])
    assert 0.5 < np.median(size) < 2  # dry: the load per undeformed area
    assert steps[0][1]["growth"] == pytest.approx(0)  # before the ramp


def test_of_a_speed_by_theory(tmp_path):
    speed = crawl_speed(Sheet(), SineWave(), 0.1, rtol=1e-4)
    path = tmp_path / "theory.xdmf"
    write_paraview(speed, path)
    points, kind, steps = read(path)
    assert kind == "triangle"
    times = np.array([t for t, _ in steps])
    np.testing.assert_allclose(np.diff(times), 1 / 24)
    field = airy_series(Sheet(), SineWave(), rtol=1e-7)
    for k in (0, 7, 24):
        t, data = steps[k]
        crawled = rigid_path(speed, 1, 24).position[1, k]
        u = 0.1 * field.displacement(*points, t) + [[0.0], [crawled]]
        np.testing.assert_allclose(data["displacement"].T[:2], u, atol=1e-5)
        np.testing.assert_allclose(data["wave"], SineWave().value(*points, t), atol=1e-12)
        np.testing.assert_allclose(data["growth"], 0.1 * data["wave"], atol=1e-12)
        inner = np.abs(points[1]) < 0.45  # the series converges slowly at the corners
        for component, name in zip(field.stress(*points, t), ("xx", "yy", "xy"), strict=True):
            got = data[f"stress_{name}"][inner]
            np.testing.assert_allclose(got, 0.1 * component[inner], atol=1e-3)
        force = friction_field(field, 0.1, *points, t).force
        off = data["friction"].T[:2] - force
        assert np.sqrt(np.mean(off**2)) < 0.05


def test_of_a_plate_on_its_ground(tmp_path):
    """Pressure and height obey the ground, linearised about the depth that carries the weight."""
    paper = saddle.PLACES["paper"]
    speed = crawl_speed(saddle.scene(paper, SineWave(), Tanh(0.3), 1e-3, -0.1), order=2, rtol=1e-2)
    write_paraview(speed, tmp_path / "plate.xdmf")
    _, _, steps = read(tmp_path / "plate.xdmf")
    for _, data in (steps[0], steps[7]):
        deflection = data["displacement"].T[2] + (paper.weight / paper.stiffness) ** 0.5
        grown = data["pressure"] - 1 + 2 * (paper.stiffness / paper.weight) ** 0.5 * deflection
        assert np.ptp(data["pressure"]) > 0.05
        # what is left is alpha e, of growth and load by area
        assert np.abs(grown).max() < 5e-3
        assert np.abs(deflection).max() > 1e-3


def test_of_a_sheet_that_turns(tmp_path):
    """In the frame of the ground: after a period, turned and moved along the path."""
    lopsided = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), period=1.0)
    scene = Scene(Sheet(), lopsided, 0.2, effects=[Membrane(Material(0.03, 0.5))], cells=(2, 4))
    speed = cycle_speed(scene, rtol=1e-2)
    write_paraview(speed, tmp_path / "turn.xdmf")
    points, _, steps = read(tmp_path / "turn.xdmf")
    path = rigid_path(speed)
    places = [(points + data["displacement"].T[:2]).T @ [1, 1j] for _, data in (steps[0], steps[-1])]
    turned = places[0] * np.exp(1j * path.turn) + path.step @ [1, 1j]
    np.testing.assert_allclose(places[1], turned, atol=1e-9)
    forces = [data["friction"].T[:2].T @ [1, 1j] for _, data in (steps[0], steps[-1])]
    np.testing.assert_allclose(forces[1], forces[0] * np.exp(1j * path.turn), atol=1e-9)
    assert "stress_xx" not in steps[0][1]


def test_what_cannot_be_written_is_said(tmp_path):
    speed = crawl_speed(Sheet(), SineWave(), 0.1, rtol=1e-2)
    for result, arguments, words in (
        (line_balance(SineWave(), 0.1), ("a.xdmf",), "result: must have a shape"),
        (speed, ("a.vtk",), r"path = .*: must end in \.xdmf"),
        (speed, ("a.xdmf", -1), "refine = -1"),
        (speed, ("a.xdmf", 7), r"refine = 7: must be in \[0, 6\]"),
        (3.0, ("a.xdmf",), "result = 3"),
    ):
        path, *rest = arguments
        with pytest.raises(ValueError, match=words):
            write_paraview(result, tmp_path / path, *rest)
    assert not list(tmp_path.iterdir())

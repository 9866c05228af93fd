"""Results as tables of pandas and labelled arrays of xarray; the version; units of the world."""

import importlib.metadata
import json
import sys
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import fem_check
import linear_theory
from linear_theory import FieldWave, Sheet, SineWave, crawl_speed, rigid_path
from linear_theory.common import version
from linear_theory.common.extras import optional

TRAJECTORY_UNITS = {
    "centre_x": "length",
    "centre_y": "length",
    "velocity": "length/time",
    **dict.fromkeys(
        ("growth", "elastic", "weight", "ground", "kinetic", "friction", "damping", "residual"),
        "force*length",
    ),
    "fastest": "length/time",
    "linear": "1",
    "iterations": "1",
    "buckled": "1",
    "snapped": "1",
}


@cache
def turning():
    wave = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), period=1.0)
    return crawl_speed(Sheet(), wave, alpha=0.25, rtol=5e-2)


@cache
def trajectory():
    effects = [
        fem_check.Membrane(fem_check.Material(0.03, 0.5)),
        fem_check.Gravity(3e-6),
        fem_check.Friction(1.0, slip_speed=0.005),
    ]
    scene = fem_check.Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(1, 2))
    return fem_check.simulate(scene, periods=1, rtol=0.1)


def test_speed_over_time():
    speed = turning()
    frame, labelled = speed.to_dataframe(), speed.to_xarray()
    assert isinstance(frame, pd.DataFrame)
    assert isinstance(labelled, xr.Dataset)
    assert np.array_equal(frame.index, speed.times)
    assert np.array_equal(labelled["time"], speed.times)
    columns = {"velocity": speed.velocity, "velocity_x": speed.rigid[0], "rotation": speed.rigid[2]}
    columns["power"] = speed.energy.spent
    assert list(frame.columns) == list(columns)
    for name, values in columns.items():
        assert np.array_equal(frame[name], values)
        assert np.array_equal(labelled[name], values)
    units = {"time": "time", "velocity": "length/time", "velocity_x": "length/time"}
    assert frame.attrs["units"] == {**units, "rotation": "rad/time", "power": "length/time"}
    assert labelled["velocity"].attrs["units"] == "length/time"
    assert "along y" in labelled["velocity"].attrs["long_name"]
    assert frame.attrs["mean"] == labelled.attrs["mean"] == speed.mean


def test_speed_of_mirrored_motion_has_one_velocity():
    frame = crawl_speed(Sheet(), SineWave(), alpha=0.1, rtol=1e-2).to_dataframe()
    assert list(frame.columns) == ["velocity", "power"]
    assert frame.index.name == "time"


def test_path_over_time():
    path = rigid_path(turning(), periods=3)
    frame, labelled = path.to_dataframe(), path.to_xarray()
    assert np.array_equal(frame[["x", "y"]].to_numpy().T, path.position)
    assert np.array_equal(labelled["heading"], path.heading)
    assert np.array_equal(frame["position_error"], path.position_error)
    assert labelled["heading"].attrs["units"] == "rad"
    assert labelled.attrs["turn"] == path.turn
    poses = path.seen_from(0).to_dataframe()
    assert list(poses.columns) == ["x", "y", "heading"]


def test_trajectory_over_time():
    motion = trajectory()
    frame, labelled = motion.to_dataframe(), motion.to_xarray()
    assert {name: frame.attrs["units"][name] for name in frame.columns} == TRAJECTORY_UNITS
    assert np.array_equal(frame["centre_y"], motion.centre[1])
    assert np.allclose(frame["friction"].diff().iloc[1:], motion.table["friction"][1:], rtol=1e-9)
    stored = "elastic", "weight", "ground", "kinetic", "friction", "damping", "residual"
    assert np.allclose(frame["growth"], frame[list(stored)].sum(axis=1), rtol=1e-9, atol=1e-18)
    t = float(motion.stored_times[5])
    places = labelled["position"].sel(stored_time=t)
    assert np.allclose(places, motion.positions(t), atol=1e-15)
    assert np.array_equal(labelled["vertex_y"], motion.model.discretisation.mesh.p[1])
    assert labelled["position"].dims == ("stored_time", "component", "vertex")


def test_labelled_arrays_go_through_a_file(tmp_path):
    labelled = trajectory().to_xarray()
    labelled.to_netcdf(tmp_path / "motion.nc", engine="scipy")
    with xr.open_dataset(tmp_path / "motion.nc", engine="scipy") as again:
        assert np.array_equal(again["position"], labelled["position"])
        assert again["growth"].attrs == labelled["growth"].attrs
        assert again.attrs["mean"] == labelled.attrs["mean"]


def test_tables_do_not_share_memory_with_the_result():
    speed = crawl_speed(Sheet(), SineWave(), alpha=0.1, rtol=1e-2)
    before = speed.velocity.copy()
    speed.to_xarray()["velocity"][:] = 0
    frame = speed.to_dataframe()
    frame.loc[:, "velocity"] = 0.0
    assert np.array_equal(speed.velocity, before)


def test_sweep_becomes_a_table_by_its_rows():
    alphas = 0.05, 0.1
    found = [crawl_speed(Sheet(), SineWave(), alpha, rtol=1e-2) for alpha in alphas]
    table = pd.DataFrame([f.to_row() for f in found], index=alphas)
    assert list(table["mean"]) == [f.mean for f in found]
    assert list(table["converged"]) == [f.converged for f in found]


@pytest.mark.parametrize(
    ("package", "extra", "call"),
    [
        ("pandas", "tables", lambda: turning().to_dataframe()),
        ("xarray", "tables", lambda: turning().to_xarray()),
        ("meshio", "paraview", lambda: fem_check.write_paraview(trajectory(), "motion.xdmf")),
    ],
)
def test_missing_packages_are_named_with_their_extra(monkeypatch, package, extra, call):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(ModuleNotFoundError, match=rf"{package}: pip install 'sheetcrawl\[{extra}\]'"):
        call()


def test_extras_are_those_of_the_project():
    project = tomllib.loads(version.PROJECT.read_text(encoding="utf-8"))["project"]
    for extra, package in (("tables", "xarray"), ("paraview", "meshio")):
        lines = [*project["dependencies"], *project["optional-dependencies"][extra]]
        named = [line.split(">")[0] for line in lines]
        assert package in named


def test_a_package_that_lacks_something_says_what(tmp_path, monkeypatch):
    (tmp_path / "halfway.py").write_text("import not_there_at_all\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="No module named 'not_there_at_all'"):
        optional("halfway", "tables", "a test")


def test_version_is_that_of_the_project():
    project = tomllib.loads(version.PROJECT.read_text(encoding="utf-8"))["project"]
    assert linear_theory.__version__ == fem_check.__version__ == project["version"]


def test_version_needs_no_installation(monkeypatch):
    def missing(name):
        raise importlib.metadata.PackageNotFoundError(name)

    monkeypatch.setattr(importlib.metadata, "version", missing)
    assert version.current_version() == linear_theory.__version__


def test_version_of_an_installed_package(monkeypatch, tmp_path):
    monkeypatch.setattr(version, "PROJECT", Path(tmp_path) / "pyproject.toml")
    monkeypatch.setattr(importlib.metadata, "version", {"sheetcrawl": "7.8.9"}.__getitem__)
    assert version.current_version() == "7.8.9"
    version.PROJECT.write_text('[project]\nname = "another"\nversion = "1.0"\n')
    assert version.current_version() == "7.8.9"


def test_plain_data_of_an_answer_is_one_line_of_json():
    found = fem_check.predict(Sheet(), SineWave(), alpha=0.05, rtol=0.1)
    content = json.loads(json.dumps(found.to_dict(arrays=False), allow_nan=False))
    assert content["mean"] == found.mean
    assert content["error"] == found.error
    assert content["level"] == found.level
    assert content["speed"]["type"] == "CrawlSpeed"

"""Scenes run to folders: their files, what is read back, interruptions, locks, refusals."""

import json
import os
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray
from PIL import Image

from fem_check.answer.block import block
from fem_check.choice.solving import solve
from fem_check.command import BAD_ARGUMENTS, INTERRUPTED, MET, MISSED, main, screens
from fem_check.files import RunSettings, read
from fem_check.output.kymographs import Quantity, line_of
from fem_check.output.pictures import moving_of
from fem_check.runs import finished, netcdf, recorded, run
from fem_check.runs.folder import LOCK, SNAPSHOT, locked
from fem_check.runs.pictures import pictures, possible_films, write_films
from linear_theory import FieldWave, Scene, Sheet, SineWave
from linear_theory.speed.crawl import crawl_speed
from tests.runs.processes import interruptible
from tests.runs.run_cases import FRAMES, PLANE, STEPPED, draw_nothing, short_films  # noqa: F401

DRAWN = {f"{kind}{suffix}" for kind in ("motion", "kymographs") for suffix in (".png", ".pdf")}
FILES = {"scene.toml", "result.json", "trajectory.nc", "report.html", *DRAWN}


def command(capsys, *arguments):
    """Exit status and what was printed, (status, out, err)."""
    with pytest.raises(SystemExit) as end:
        main([str(word) for word in arguments])
    printed = capsys.readouterr()
    return end.value.code, printed.out, printed.err


def names(folder):
    return {path.name for path in Path(folder).iterdir() if not path.name.startswith(".")}


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder with two scene files, and a run of each."""
    folder = tmp_path_factory.mktemp("runs")
    for name, text in (("plane", PLANE), ("stepped", STEPPED)):
        path = folder / f"{name}.toml"
        path.write_text(text)
        file = read(path)
        run(file.scene, folder / name, file.run, file.units)
    return folder


@pytest.fixture(scope="module")
def plane(place):
    return finished(place / "plane")


def test_a_run_leaves_its_files_and_nothing_half_done(place):
    films = {f"motion{suffix}" for suffix in possible_films()}
    assert names(place / "plane") == FILES | films
    assert names(place / "stepped") == FILES | films | {SNAPSHOT}
    hidden = {path.name for path in (place / "plane").glob(".*")}
    assert hidden == {LOCK}


def test_the_result_is_the_answer_with_errors_units_scene_versions_and_cost(plane, place):
    file = read(place / "plane.toml")
    expected = solve(file.scene, rtol=file.run.rtol)
    said = plane.result["answer"]
    assert (said["mean"], said["error"]) == (expected.mean, expected.error)
    assert (said["unit"], plane.units) == ("mm/s", file.units)
    assert Scene.from_dict(plane.result["scene"]) == file.scene
    assert {"sheetcrawl", "numpy", "python"} <= plane.result["versions"].keys()
    assert plane.result["cost"][-1]["seconds"] > 0
    assert plane.result["errors"][0]["error"] == expected.speed.error
    again = Scene.from_toml(plane.folder / "scene.toml")
    assert again == file.scene


def test_show_prints_the_block_of_the_run(plane, capsys):
    status, out, _ = command(capsys, "show", plane.folder)
    assert (status, out.strip("\n")) == (MET, plane.block)
    file = read(plane.folder.with_suffix(".toml"))
    expected = block(solve(file.scene, rtol=file.run.rtol), file.units, hints=("", ""))
    assert plane.block.splitlines()[:-1] == expected.splitlines()[:-1]  # the last is the time it took


def test_the_motion_is_netcdf_with_units(place):
    with xarray.open_dataset(place / "stepped" / "trajectory.nc", engine="scipy") as kept:
        assert kept["sheet_place"].dims == ("frame", "axis", "point")
        assert all({"units", "long_name"} <= kept[name].attrs.keys() for name in kept.data_vars)
        assert kept["sheet_place"].units == kept["centre_y"].units == "length"
        assert kept["growth"].units == "force*length"
    with xarray.open_dataset(place / "plane" / "trajectory.nc", engine="scipy") as kept:
        assert float(kept["velocity"].mean()) == pytest.approx(kept.attrs["mean"], rel=1e-6)


def lopsided(x, y, t, length=1.0):
    """A wave that turns the sheet."""
    return np.sin(2 * np.pi * (y / length - t)) * (1 + x)


@pytest.mark.parametrize("wave", [SineWave(), FieldWave(lopsided, period=1.0)], ids=["even", "turning"])
def test_a_recording_moves_as_its_result(wave, tmp_path):
    """At recorded phases to the single precision of the file, also after several turns."""
    scene = Scene(Sheet(), wave, alpha=0.2)
    speed = crawl_speed(scene, rtol=5e-2)
    moving = moving_of(speed)
    netcdf.write(recorded(speed, scene), speed, tmp_path / "motion.nc")
    kept = netcdf.read(tmp_path / "motion.nc")
    points, triangles = moving.covering()
    assert np.array_equal(kept.covering()[0], points)
    assert np.array_equal(kept.covering()[1], triangles)
    for mine, own in zip(kept.frames(points, 3, 8), moving.frames(points, 3, 8), strict=True):
        for name in ("time", "place", "still", "growth", "centre", "heading"):
            np.testing.assert_allclose(getattr(mine, name), getattr(own, name), atol=1e-6, rtol=0)
    tails = kept.tails
    start = kept.times[0]  # of the speed, which begins where it likes
    np.testing.assert_allclose(kept.friction(tails, start), moving.friction(tails, start), atol=1e-6)
    elsewhere = points[:, ::7] * 0.9
    mine, own = kept.at(elsewhere, 0.25), moving.at(elsewhere, 0.25)
    np.testing.assert_allclose(mine.growth, own.growth, atol=2e-3)  # linear in time and space
    assert mine.time == own.time
    assert kept.speed.mean == speed.mean


def test_a_recording_of_a_trajectory_is_where_the_trajectory_was(place):
    kept = finished(place / "stepped").recording
    with xarray.open_dataset(place / "stepped" / "trajectory.nc", engine="scipy") as data:
        end = data["centre_y"].values[-1]
        assert kept.centre[-1, 1] == pytest.approx(end, abs=1e-12)
        assert kept.times[-1] == pytest.approx(data["time"].values[-1])
    with pytest.raises(ValueError, match=r"phase = 2: must be in \[0, 1\]"):
        kept.at(kept.points, 2.0)


def test_the_kymograph_shows_the_wave_and_the_displacement(plane):
    line = line_of(plane.recording, Quantity.WAVE, 1)
    file = read(plane.folder.with_suffix(".toml"))
    expected = file.scene.drive.value(0.0, line.y, line.times[:, None])
    assert np.abs(line.values - expected).max() < 5e-3  # linear between points
    along = line_of(plane.recording, Quantity.DISPLACEMENT, 1).values
    assert np.abs(along).max() < 40.0 * 0.05  # growth of 5 % along at most half of the sheet
    assert pictures(plane.recording)["kymographs"] == ("kymograph", "displacement")


def test_films_have_the_same_bytes_every_time(plane, tmp_path):
    for folder in (tmp_path / "a", tmp_path / "b"):
        folder.mkdir()
        write_films(plane.recording, folder, plane.units)
    for suffix in possible_films():
        one, other = ((tmp_path / name / f"motion{suffix}").read_bytes() for name in "ab")
        assert one == other == (plane.folder / f"motion{suffix}").read_bytes()
    with Image.open(plane.folder / "motion.gif") as film:
        assert film.n_frames == 2 * FRAMES


RUNS = [shlex.split(line)[1:] for _, line in screens.RUNS]


def test_examples_of_the_commands_run_one_after_the_other(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("hydrogel.toml").write_text(PLANE)
    helps = (screens.RUN_HELP, screens.SHOW_HELP, screens.MOVIE_HELP)
    for words, text in zip(RUNS, (*helps, screens.PLOT_HELP, screens.PARAVIEW_HELP), strict=True):
        assert f"  {shlex.join(['sheetcrawl', *words])}\n" in text
        status, out, err = command(capsys, *words)
        assert (status, err) == (MET, "")
        assert out
    assert {"crawl.gif", "crawl.pdf", "hydrogel"} <= names(tmp_path)
    assert "motion.xdmf" in names("hydrogel")
    status, out, _ = command(capsys, "plot", "hydrogel")
    assert out.splitlines()[0] == "hydrogel/motion.png written"
    assert command(capsys, "plot", "hydrogel", "--file", "path.svg", "--what", "path")[0] == MET
    status, out, err = command(capsys, "plot", "hydrogel", "--file", "a.png", "--what", "sound")
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert "what = 'sound'" in err
    assert "kymographs" in err


def test_an_earlier_result_is_never_overwritten(place, capsys):
    before = (place / "plane" / "result.json").read_bytes()
    status, _, err = command(capsys, "run", place / "plane.toml", "--out", place / "plane")
    assert status == BAD_ARGUMENTS
    assert "holds the result of an earlier run" in err
    other = place / "other.toml"
    other.write_text(PLANE.replace("5 %", "6 %"))
    status, _, err = command(capsys, "run", other, "--out", place / "plane", "--resume")
    assert (status, err.count("\n")) == (BAD_ARGUMENTS, 1)
    assert "holds the result of another scene" in err
    assert (place / "plane" / "result.json").read_bytes() == before


def test_resume_draws_what_is_missing_and_solves_nothing(place, monkeypatch):
    file = read(place / "plane.toml")
    folder = place / "plane"
    (folder / "report.html").unlink()
    (folder / "motion.gif").unlink()
    monkeypatch.setattr("fem_check.runs.running.solved", None)
    run(file.scene, folder, file.run, file.units, resume=True)
    assert {"report.html", "motion.gif"} <= names(folder)


def _begin(scene, folder):
    return subprocess.Popen(
        [sys.executable, "-m", "fem_check", "run", str(scene), "--out", str(folder)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=interruptible,
    )


@pytest.fixture
def long(tmp_path):
    path = tmp_path / "long.toml"
    path.write_text(STEPPED.replace("steps = 40", "steps = 150"))
    return path


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_a_run_that_is_stopped_goes_on_and_ends_with_the_same_numbers(
    how, long, tmp_path, capsys, monkeypatch
):
    draw_nothing(monkeypatch)
    folder = tmp_path / "long"
    program = _begin(long, folder)
    until = time.monotonic() + 100
    while not (folder / SNAPSHOT).exists() and time.monotonic() < until:
        time.sleep(0.02)
    program.send_signal(how)
    _, err = program.communicate(timeout=100)
    assert not (folder / "result.json").exists()
    if how == signal.SIGINT:
        assert program.returncode == INTERRUPTED
        assert err.count("\n") == 1
        assert "all kept in" in err
        assert err.endswith(f"sheetcrawl run {long} --out {folder} --resume\n")
    status, _, err = command(capsys, "run", long, "--out", folder)
    assert status == BAD_ARGUMENTS
    assert "--resume" in err
    file = read(long)
    resumed = run(file.scene, folder, file.run, file.units, resume=True)
    whole = solve(file.scene, file.run.level, None, periods=1, steps=file.run.steps)
    assert resumed.result["answer"]["mean"] == whole.mean
    assert "report.html" in names(folder)


def test_two_runs_do_not_share_a_folder(place, tmp_path, capsys):
    folder = tmp_path / "shared"
    with locked(folder):
        done = subprocess.run(
            [sys.executable, "-m", "fem_check", "run", place / "plane.toml", "--out", folder],
            capture_output=True,
            text=True,
        )
    assert done.returncode == BAD_ARGUMENTS
    assert done.stderr.count("\n") == 1
    assert f"another run is at work in it (process {os.getpid()} on" in done.stderr
    assert names(folder) == set()
    with locked(folder):  # the words of the lock stay, the lock itself does not
        pass


def test_a_level_without_a_shape_is_refused_before_the_work(tmp_path, capsys):
    path = tmp_path / "line.toml"
    path.write_text(PLANE + 'level = "line"\n')
    status, out, err = command(capsys, "run", path, "--out", tmp_path / "line")
    assert (status, out) == (BAD_ARGUMENTS, "")
    assert not (tmp_path / "line").exists()
    assert "level = 'line': has no shape to be filmed or kept in a folder" in err


@pytest.mark.parametrize("kind", ["a file", "below a file", "other files", "no folder may be made"])
def test_a_folder_that_cannot_be_that_of_a_run_is_refused_before_the_work(
    kind, place, tmp_path, capsys, monkeypatch
):
    monkeypatch.setattr("fem_check.runs.running.solved", None)
    (tmp_path / "file").touch()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "scene.toml").write_text("mine")
    folder = {
        "a file": tmp_path / "file",
        "below a file": tmp_path / "file" / "run",
        "other files": tmp_path / "mine",
        "no folder may be made": Path("/proc/run"),
    }[kind]
    status, out, err = command(capsys, "run", place / "plane.toml", "--out", folder)
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert f"folder = {str(folder)!r}" in err
    assert (tmp_path / "mine" / "scene.toml").read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["run", "none.toml"], "there is no such file"),
        (["run", "bad.toml"], "is not TOML"),
        (["run", "scene.txt"], "--out"),
        (["run"], "SCENE"),
        (["show", "none"], "there is no such folder"),
        (["show", "bad.toml"], "is a file"),
        (["movie", "empty"], "holds no result.json"),
        (["paraview", "none", "--file", "a.vtk"], ".xdmf"),
    ],
)
def test_bad_arguments_get_one_line_and_status_2(words, named, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("bad.toml").write_text("growth =")
    Path("scene.txt").write_text(PLANE)
    Path("empty").mkdir()
    status, out, err = command(capsys, *words)
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert err.startswith("sheetcrawl: ")
    assert named in err


def test_a_full_disk_leaves_no_half_file(place, tmp_path, monkeypatch, capsys):
    def full(*arguments, **options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("xarray.Dataset.to_netcdf", full)
    status, _, err = command(capsys, "run", place / "plane.toml", "--out", tmp_path / "full")
    assert status == MISSED
    assert "No space left" in err
    assert names(tmp_path / "full") == {"scene.toml"}


@pytest.mark.parametrize("text", ["", "{}", "no netCDF"])
def test_damaged_files_are_named(text, place, tmp_path, capsys):
    for name in ("result.json", "trajectory.nc"):
        (tmp_path / name).write_bytes((place / "plane" / name).read_bytes())
    (tmp_path / "trajectory.nc").write_text(text)
    status, _, err = command(capsys, "plot", tmp_path)
    assert (status, err.count("\n")) == (BAD_ARGUMENTS, 1)
    assert "trajectory.nc: is damaged, or that of another run" in err
    (tmp_path / "result.json").write_text(text)
    status, _, err = command(capsys, "show", tmp_path)
    assert status == BAD_ARGUMENTS
    assert "result.json" in err


def test_without_xarray_there_is_one_line_before_the_work(place, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("fem_check.runs.running.solved", None)
    monkeypatch.setitem(sys.modules, "xarray", None)
    status, _, err = command(capsys, "run", place / "plane.toml", "--out", tmp_path / "new")
    assert status == BAD_ARGUMENTS
    assert "pip install 'sheetcrawl[tables]'" in err


def test_a_scene_with_functions_is_kept_as_data(tmp_path):
    scene = Scene(Sheet(), FieldWave(lopsided, period=1.0), alpha=0.05)
    found = run(scene, tmp_path / "own", RunSettings(rtol=0.3))
    assert "scene.json" in names(found.folder)
    assert json.loads((found.folder / "scene.json").read_text())["type"] == "Scene"


def test_the_report_is_one_small_file_that_asks_for_nothing(place):
    for name in ("plane", "stepped"):
        text = (place / name / "report.html").read_text(encoding="utf-8")
        assert len(text.encode()) < 5e6
        assert "http:" not in text
        assert "https:" not in text
        assert text.count("src=") == text.count('src="data:image/png;base64,') == 2
        assert "url(" not in text
        assert "$" not in text.replace("${", "")

"""Runs that lost something: damaged and missing files, a full disk, SIGTERM, missing packages."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray

from fem_check.answer.record import record
from fem_check.choice.solving import solve, solved
from fem_check.command import BAD_ARGUMENTS, MET, MISSED, TERMINATED, main
from fem_check.files import read
from fem_check.runs import finished, run
from fem_check.runs.folder import SNAPSHOT, TRAJECTORY
from tests.runs.processes import interruptible
from tests.runs.run_cases import PLANE, STEPPED, blank_pictures, draw_nothing, short_films  # noqa: F401

IN_MM = (
    STEPPED.replace("young = 1.0", 'length = "40 mm"\nwidth = "20 mm"\nyoung = "1 MPa"')
    .replace("[wave]", '[wave]\nperiod = "8 s"')
    .replace("weight = 3e-6", 'weight = "10 Pa"')
    .replace("slip_speed = 0.005", 'slip_speed = "0.03 mm/s"')
)

OTHER = PLANE.replace("5 %", "6 %")

NO_ENCODER = "raise ModuleNotFoundError(\"No module named 'imageio_ffmpeg'\")\n"


def command(capsys, *arguments):
    """Exit status and what was printed, (status, out, err)."""
    with pytest.raises(SystemExit) as end:
        main([str(word) for word in arguments])
    printed = capsys.readouterr()
    return end.value.code, printed.out, printed.err


def _run(folder, name, text):
    path = folder / f"{name}.toml"
    path.write_text(text)
    file = read(path)
    return run(file.scene, folder / name, file.run, file.units)


@pytest.fixture
def undrawn(monkeypatch):
    draw_nothing(monkeypatch)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder with scene files and a run of each."""
    folder = tmp_path_factory.mktemp("damaged")
    with pytest.MonkeyPatch.context() as patch:
        draw_nothing(patch)
        for name, text in (("plane", PLANE), ("stepped", IN_MM), ("other", OTHER)):
            _run(folder, name, text)
    return folder


def _copied(place, name, tmp_path):
    """A run to be damaged."""
    folder = tmp_path / name
    folder.mkdir()
    for path in (place / name).iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    return folder


DAMAGES = {
    "truncated": lambda path: path.write_bytes(path.read_bytes()[:-100]),
    "garbled": lambda path: path.write_bytes(path.read_bytes()[::-1]),
    "empty": lambda path: path.write_bytes(b""),
    "one byte": lambda path: path.write_bytes(path.read_bytes()[:-9] + b"x" + path.read_bytes()[-8:]),
    "missing": lambda path: path.unlink(),
}


@pytest.mark.parametrize("damage", DAMAGES)
@pytest.mark.usefixtures("undrawn")
def test_a_damaged_motion_is_refused_and_resume_writes_it_again(damage, place, tmp_path, capsys):
    for name, how in (("plane", "solved again"), ("stepped", f"written again from {SNAPSHOT}")):
        folder = _copied(place, name, tmp_path)
        DAMAGES[damage](folder / TRAJECTORY)
        for words in (["plot"], ["movie"], ["paraview"]):
            status, out, err = command(capsys, *words, folder)
            assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
            assert str(folder / TRAJECTORY) in err
            assert "--resume" in err
        words = ["run", place / f"{name}.toml", "--out", folder, "--resume"]
        status, out, err = command(capsys, *words)
        assert (status, err.count("\n")) == (MET, 1)
        assert TRAJECTORY in err
        assert how in err
        again, before = finished(folder), finished(place / name)
        assert again.result["answer"]["mean"] == before.result["answer"]["mean"]
        assert np.array_equal(again.recording.place, before.recording.place)


def test_the_motion_of_another_run_is_not_taken(place, tmp_path, capsys):
    folder = _copied(place, "plane", tmp_path)
    (folder / TRAJECTORY).write_bytes((place / "other" / TRAJECTORY).read_bytes())
    assert "that of another run" in command(capsys, "plot", folder)[2]
    result = json.loads((folder / "result.json").read_text())
    del result["files"], result["checksum"]  # as of a version without them
    (folder / "result.json").write_text(json.dumps(result))
    assert "is of another run" in command(capsys, "plot", folder)[2]
    (folder / TRAJECTORY).write_bytes((place / "plane" / TRAJECTORY).read_bytes())
    assert finished(folder).recording.speed.mean == result["answer"]["mean"]


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"answer": "x"}, "answer must be an object, is a text"),
        ({"units": 3}, "units must be an object or null, is a number"),
        ({"units": {"length": "mm"}}, "units.time is missing"),
        ({"block": None}, "block must be a text, is null"),
        ({"answer": {"mean": "fast"}}, "answer.mean must be a number, is a text"),
        ({"answer": {"mean": 1.0, "error": [], "numerical_error": 0}}, "answer.error must be"),
        ({"errors": [3]}, "errors[0] must be an object"),
        ({"cost": [{"part": "all", "work": ""}]}, "cost[0].seconds is missing"),
    ],
)
def test_a_result_of_another_structure_is_refused_in_one_line(change, named, place, tmp_path, capsys):
    folder = _copied(place, "plane", tmp_path)
    result = json.loads((folder / "result.json").read_text())
    (folder / "result.json").write_text(json.dumps({**result, **change}))
    for words in (["show"], ["plot"], ["paraview"], ["movie"]):
        status, out, err = command(capsys, *words, folder)
        assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
        assert named in err
        assert "delete the folder, or name another one" in err


def test_truncated_files_say_the_way_out(place, tmp_path, capsys):
    folder = _copied(place, "stepped", tmp_path)
    text = (folder / "result.json").read_bytes()
    (folder / "result.json").write_bytes(text[:50])
    for words in (["show", folder], ["run", place / "stepped.toml", "--out", folder, "--resume"]):
        status, _, err = command(capsys, *words)
        assert status == BAD_ARGUMENTS
        assert "delete the folder, or name another one" in err
    (folder / "result.json").unlink()
    snapshot = folder / SNAPSHOT
    snapshot.write_bytes(snapshot.read_bytes()[:-100])
    status, _, err = command(capsys, "run", place / "stepped.toml", "--out", folder, "--resume")
    assert (status, err.count("\n")) == (BAD_ARGUMENTS, 1)
    assert "remove the file, or name another one" in err


def test_json_says_what_the_block_and_the_motion_say(place):
    """The error of a motion in time is known, without that of the mesh, and nobody asked for 1 %."""
    file, found = read(place / "stepped.toml"), finished(place / "stepped")
    said = found.result["answer"]
    with xarray.open_dataset(found.folder / TRAJECTORY, engine="scipy") as kept:
        assert said["error"] == said["numerical_error"] == kept.attrs["error"] > 0
    assert said["not_in_error"] == ["error of the mesh", "change from period to period"]
    assert said["tolerance"] is None
    assert said["converged"]
    assert "NOT MET" not in found.block
    assert "model" not in found.block
    assert "not estimated: error of the mesh" in " ".join(found.block.split())
    assert "no tolerance asked for" in (found.folder / "report.html").read_text(encoding="utf-8")
    direct = solve(file.scene, file.run.level, None, periods=1, steps=file.run.steps)
    again = record(direct, file.units)
    assert {**again, "seconds": 0} == {**said, "seconds": 0}
    assert direct.to_row()["error"] == said["error"]


def test_units_are_those_of_the_run_and_velocity_is_over_time(place):
    for name, size in (("plane", 2), ("stepped", 61)):
        with xarray.open_dataset(place / name / TRAJECTORY) as kept:
            velocity = kept.velocity
            assert velocity.dims == ("time",)
            assert velocity.size == size
            assert (velocity.units, velocity.time.units) == ("mm/s", "s")
            assert kept.sheet_place.units == "mm"
            values, times = velocity.values, velocity.time.values
            if name == "stepped":  # the mean of the only counted period, from 4 s to 12 s
                counted = times >= 4.0
                mean = np.trapezoid(values[counted], times[counted]) / 8.0
                assert mean == pytest.approx(kept.attrs["mean"], rel=2e-2)


def test_the_balance_of_power_is_recorded_and_drawn(place, tmp_path, capsys):
    recording = finished(place / "stepped").recording
    works = recording.energies.works
    stored = "elastic", "weight", "ground", "kinetic", "friction", "damping", "residual"
    total = sum(works[name] for name in stored)
    np.testing.assert_allclose(works["growth"], total, atol=1e-12 * np.abs(works["growth"]).max())
    assert recording.energies.times[0] == pytest.approx(4.0)
    picture = tmp_path / "power.png"
    status, _, _ = command(capsys, "plot", place / "stepped", "--file", picture, "--what", "power")
    assert (status, picture.exists()) == (MET, True)
    status, _, err = command(capsys, "movie", place / "stepped", "--periods", "2")
    assert status == BAD_ARGUMENTS
    assert "the run recorded 1 period" in err


def test_a_file_in_a_folder_that_is_not_there_is_refused(place, tmp_path, capsys):
    none = tmp_path / "none"
    for words in (
        ["plot", place / "plane", "--file", none / "a.png"],
        ["speed", "--growth", "5 %", "--plot", none / "a.png"],
        ["speed", "--growth", "5 %", "--movie", none / "a.gif"],
        ["new", "pulse", none / "a.toml"],
    ):
        status, out, err = command(capsys, *words)
        assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
        assert f"{str(none)!r} is not" in err
    assert not none.exists()


@pytest.mark.parametrize("name", ["result.json", "report.html"])
@pytest.mark.usefixtures("undrawn")
def test_a_full_disk_loses_no_answer(name, place, tmp_path, monkeypatch, capsys):
    written = Path.write_text

    def full(part, *arguments, **options):
        if part.suffix == Path(name).suffix:
            raise OSError(28, "No space left on device")
        return written(part, *arguments, **options)

    words = ["run", place / "plane.toml", "--out", tmp_path / "full"]
    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_text", full)
        status, out, err = command(capsys, *words)
    assert (status, err.count("\n")) == (MISSED, 1)
    assert f"{tmp_path / 'full' / name}: cannot be written: No space left" in err
    assert err.endswith("--resume\n")
    assert "speed     0.021" in out
    assert not (tmp_path / "full" / name).exists()
    assert command(capsys, *words, "--resume")[0] == MET


def test_without_an_encoder_all_else_is_written(place, tmp_path, capsys, monkeypatch):
    (tmp_path / "imageio_ffmpeg.py").write_text(NO_ENCODER)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "imageio_ffmpeg", raising=False)
    monkeypatch.setattr("fem_check.runs.pictures.movie", lambda recording, path, **how: path.touch())
    monkeypatch.setattr("fem_check.runs.running.write_pictures", blank_pictures)
    status, out, err = command(capsys, "run", place / "plane.toml", "--out", tmp_path / "run")
    monkeypatch.delitem(sys.modules, "imageio_ffmpeg", raising=False)
    assert (status, err.count("\n")) == (MET, 1)
    assert "motion.mp4 is left out" in err
    assert "sheetcrawl[movies]" in err
    assert "speed     0.021" in out
    assert "motion.gif, motion.png, report.html" in out
    status, _, err = command(capsys, "movie", tmp_path / "run", "--file", tmp_path / "a.mp4")
    assert (status, err.count("\n")) == (BAD_ARGUMENTS, 1)


def _begin(*words, **how):
    return subprocess.Popen(
        [sys.executable, "-m", "fem_check", *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=interruptible,
        **how,
    )


@pytest.mark.usefixtures("undrawn")
def test_sigterm_keeps_the_snapshot_and_says_how_to_go_on(tmp_path):
    path, folder = tmp_path / "long.toml", tmp_path / "long"
    path.write_text(STEPPED.replace("steps = 40", "steps = 150"))
    program = _begin("run", path, "--out", folder)
    until = time.monotonic() + 100
    while not (folder / SNAPSHOT).exists() and time.monotonic() < until:
        time.sleep(0.02)
    program.send_signal(signal.SIGTERM)
    _, err = program.communicate(timeout=100)
    assert (program.returncode, err.count("\n")) == (TERMINATED, 1)
    assert "all kept in" in err
    assert err.endswith("--resume\n")
    with np.load(folder / SNAPSHOT) as kept:
        before = float(kept["seconds"])
    file = read(path)
    direct = solve(file.scene, file.run.level, None, periods=1, steps=file.run.steps)
    start = time.perf_counter()
    resumed = run(file.scene, folder, file.run, file.units, resume=True)
    spent = time.perf_counter() - start
    said = resumed.result["answer"]
    assert said["mean"] == direct.mean
    assert before < said["seconds"] < before + spent


def test_a_closed_output_is_one_line():
    shell = f"{sys.executable} -m fem_check examples >&-"
    done = subprocess.run(shell, shell=True, capture_output=True, text=True, env=os.environ)
    assert (done.returncode, done.stderr.count("\n")) == (MISSED, 1)
    assert "the standard output is closed" in done.stderr


def test_periods_that_differ_are_a_caution_whatever_the_tolerance(tmp_path, monkeypatch):
    """The first period after a short ramp against the second one, far apart as if nothing repeated."""
    path = tmp_path / "stepped.toml"
    path.write_text(STEPPED.replace("periods = 1", "periods = 2"))
    file = read(path)
    settings = replace(file.run, rtol=None)
    usual = solved(file.scene, settings).answer
    assert (usual.converged, usual.caution) == (True, "")
    assert usual.not_in_error == ("error of the mesh",)
    speeds = np.array([0.5, 1.0]) * usual.mean
    monkeypatch.setattr("fem_check.shell.stepping.trajectory.Trajectory.period_speeds", speeds)
    found = solved(file.scene, settings).answer
    assert not found.converged
    assert "the last two periods differ by 50 % of the speed" in found.caution
    assert "CAUTION" in str(found)
    assert "NOT MET" not in str(found)

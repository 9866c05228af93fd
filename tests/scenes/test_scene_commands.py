"""`sheetcrawl new`, `check`, `speed` of a scene file, `schema`: what they print, write and refuse."""

import json
import os
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from fem_check import Friction, Gravity, Inertia, Material, Membrane, cycle_speed, predict, simulate
from fem_check.answer.block import block
from fem_check.choice import solving, ways
from fem_check.choice.expected import expected_seconds
from fem_check.choice.settings import RunSettings
from fem_check.choice.solving import solve, solved
from fem_check.choice.ways import way_of
from fem_check.command import BAD_ARGUMENTS, MET, MISSED, main, screens
from fem_check.command.options import Options
from fem_check.command.quantities import asked
from fem_check.files import gallery, read
from fem_check.files.schema import schema
from fem_check.shell.stepping.trajectory import SpeedErrors
from figures.measure import self_contact
from linear_theory import Scene, Sheet, SineWave
from linear_theory.common.progress import Progress

pytestmark = pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "100")


def run(capsys: Any, *arguments: str) -> tuple[int, str, str]:
    """Exit status and what was printed."""
    with pytest.raises(SystemExit) as end:
        main(arguments)
    printed = capsys.readouterr()
    return int(str(end.value.code)), printed.out, printed.err


def test_new_writes_the_file_of_the_gallery_and_never_overwrites(capsys: Any, tmp_path: Path) -> None:
    status, out, err = run(capsys, "new", "hydrogel")
    assert (status, err) == (MET, "")
    assert out == "hydrogel.toml written; next: sheetcrawl check hydrogel.toml\n"
    assert (tmp_path / "hydrogel.toml").read_text() == gallery.text("hydrogel")
    (tmp_path / "hydrogel.toml").write_text("mine")
    status, out, err = run(capsys, "new", "hydrogel")
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert "hydrogel.toml: is there already" in err
    assert (tmp_path / "hydrogel.toml").read_text() == "mine"
    status, out, _ = run(capsys, "new", "paper", "mine.toml")
    assert (status, out.split()[0]) == (MET, "mine.toml")
    (tmp_path / "folder").mkdir()
    assert run(capsys, "new", "paper", "folder")[0] == BAD_ARGUMENTS
    status, _, err = run(capsys, "new", "paper", "nowhere/a.toml")
    assert (status, err.count("\n")) == (BAD_ARGUMENTS, 1)
    assert "nowhere/a.toml: must be in a folder that is there, 'nowhere' is not" in err
    assert sorted(os.listdir()) == ["folder", "hydrogel.toml", "mine.toml"]


def test_a_disk_that_is_full_leaves_no_half_of_a_file(
    capsys: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Full:
        def __enter__(self) -> "Full":
            return self

        def __exit__(self, *error: object) -> None:
            pass

        def write(self, text: str) -> None:
            Path("paper.toml").write_text(text[:10])

        def flush(self) -> None:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(
        "fem_check.command.actions.scene_files.open", lambda *a, **k: Full(), raising=False
    )
    status, out, err = run(capsys, "new", "paper")
    assert (status, out, err.count("\n")) == (MISSED, "", 1)
    assert "paper.toml: No space left on device" in err
    assert not os.listdir()


def test_new_lists_what_there_is(capsys: Any) -> None:
    for words in (("new",), ("new", "--list"), ("new", "paper", "--list")):
        status, out, err = run(capsys, *words)
        assert (status, err) == (MET, "")
        assert [line.split()[0] for line in out.splitlines()] == list(gallery.names())
        assert max(map(len, out.splitlines())) <= 100
    assert not os.listdir()
    assert all(f"  {name} " in run(capsys, "examples")[1] for name in gallery.names())


def test_a_scene_that_reads_a_table_comes_with_it(capsys: Any) -> None:
    status, out, err = run(capsys, "new", "measured", "mine.toml")
    assert (status, err) == (MET, "")
    assert "mine.toml written (and measured.csv)" in out
    assert sorted(os.listdir()) == ["measured.csv", "mine.toml"]
    status, out, err = run(capsys, "new", "measured", "other.toml")
    assert (status, out) == (BAD_ARGUMENTS, "")
    assert "measured.csv: is there already; give another name or folder" in err
    assert sorted(os.listdir()) == ["measured.csv", "mine.toml"]


WAYS = {
    **dict.fromkeys(("paper", "hydrogel", "pulse", "viscous", "measured"), "predict"),
    **dict.fromkeys(("trapezoid", "hole", "turning", "inchworm", "piezo"), "cycle"),
    **dict.fromkeys(("bumpy", "excitable"), "stepped"),
}


@pytest.mark.parametrize("name", gallery.names())
def test_check_of_each_scene_of_the_gallery(name: str, capsys: Any) -> None:
    run(capsys, "new", name)
    status, out, err = run(capsys, "check", f"{name}.toml")
    assert (status, err) == (MET, "")
    said = dict(re.findall(r"^  (\w+) +(.*)$", out, re.MULTILINE))
    assert said["answer"].startswith(f"{WAYS[name]}: ")
    assert re.match(r"(at most )?about [\d.]+ (s|min) on one core", said["cost"])
    assert said["next"] == f"sheetcrawl speed {name}.toml"
    scene = read(f"{name}.toml").scene
    assert all(type(effect).__name__ in said["effects"] for effect in scene.effects)
    assert f"{scene.sheet.length:g} × {scene.sheet.width:g}" in said["sheet"]


def test_speed_of_a_file_is_the_answer_of_the_library(capsys: Any) -> None:
    run(capsys, "new", "paper")
    status, out, err = run(capsys, "speed", "paper.toml", "--rtol", "20 %", "--json")
    expected = predict(Sheet(), SineWave(), 0.25, rtol=0.2)
    assert (status, err) == (MET, "")
    assert json.loads(out)["mean"] == expected.mean
    assert json.loads(out)["unit"] == "length/time"
    said = run(capsys, "speed", "paper.toml", "--rtol", "20 %")[1]
    lines = block(expected, width=100, hints=("sheetcrawl examples", "--why")).splitlines()
    assert said.strip("\n").splitlines()[:-1] == lines[:-1]
    assert "rtol" not in said


def test_speed_of_a_sheet_that_bends_is_told_in_its_units(capsys: Any) -> None:
    run(capsys, "new", "inchworm")
    status, out, err = run(capsys, "speed", "inchworm.toml")
    file = read("inchworm.toml")
    found = cycle_speed(file.scene, rtol=0.1)
    assert (status, err) == (MET, "")
    value, error = re.search(r"speed +−([\d.]+) ± ([\d.]+) mm/s, against the wave", out).groups()  # type: ignore[union-attr]
    assert abs(-float(value) - found.mean) <= float(error)
    assert "60 × 30 × 1.5 mm" in out
    assert "curvature " in out
    assert "bending" not in out[out.index("left out") :]
    assert "deformation by friction" in out[out.index("left out") :]
    assert "inertia" in out[out.index("left out") :]


def test_speed_of_a_scene_in_time(capsys: Any) -> None:
    """A small planar one with inertia, which no other level represents."""
    text = (
        "[sheet]\nyoung = 1.0\n[growth]\nalpha = 0.1\n[gravity]\nweight = 3e-6\n"
        "[inertia]\ndensity = 1e-6\n[friction]\ncoefficient = 0.7\nslip_speed = 0.02\n"
        "[run]\nrtol = 0.2\nperiods = 1\ncells = [1, 2]\n"
    )
    Path("a.toml").write_text(text)
    status, out, _ = run(capsys, "speed", "a.toml", "--json")
    material = Material(0.03, 0.5)
    effects = [Membrane(material), Gravity(3e-6), Inertia(1e-6, material), Friction(0.7, 0.02)]
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects, cells=(1, 2))
    motion = simulate(scene, periods=1, rtol=0.2)
    assert json.loads(out)["mean"] == motion.speed.mean
    assert status == (MET if motion.speed.converged else MISSED)
    said = run(capsys, "speed", "a.toml")[1]
    assert "coefficient 0.7, which deforms the sheet, too" in said
    assert "steps in time" in said
    status, out, err = run(capsys, "speed", "a.toml", "--movie", "a.gif")
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert "simulate(Scene.from_toml('a.toml')).movie(...)" in err
    assert "12 steps a period" in run(capsys, "check", _with("a.toml", "rtol = 0.2", "steps = 12"))[1]


def _with(path: str, old: str, new: str) -> str:
    text = Path(path).read_text()
    assert old in text
    Path("changed.toml").write_text(text.replace(old, new))
    return "changed.toml"


def test_pictures_and_tables_of_a_file(capsys: Any) -> None:
    run(capsys, "new", "trapezoid")
    path = _with("trapezoid.toml", 'rtol = "2 %"', 'rtol = "20 %"\nelement = "ElementTriP1()"')
    status, out, _ = run(capsys, "speed", path, "--csv", "--plot", "a.png")
    assert status in (MET, MISSED)
    assert out.startswith("t [time],V [length/time]\n")
    assert Path("a.png").stat().st_size > 5000


DAMPED = "[run] level = 'predict': cannot represent Ground(damping = 0.1); must be 'stepped'"

REFUSED = (
    (("speed", "none.toml"), "none.toml: there is no such file"),
    (("check", "none.toml"), "none.toml: there is no such file"),
    (("check", "."), ".: is a folder, must be a scene file"),
    (("speed", "folder.toml"), "folder.toml: is a folder, must be a scene file"),
    (("check", "text.toml"), "text.toml:1: is not TOML"),
    (("check", "kg.toml"), "kg.toml:2: [sheet] length = '40 kg': is not a length"),
    (("speed", "kg.toml"), "kg.toml:2: [sheet] length = '40 kg': is not a length"),
    (("check", "thin.toml"), "thin.toml:2: [sheet] thickness = '-1 mm': must be > 0"),
    (("speed", "good.toml", "--width", "3"), "--width '3': must be left out, good.toml says it"),
    (("speed", "good.toml", "--level", "strip"), "--level 'strip': must be left out"),
    (("speed", "good.toml", "--rtol", "3"), "rtol = 3: must be in"),
    (
        ("speed", "good"),
        "'good': must follow an option, such as --growth, or be a scene file, NAME.toml",
    ),
    (
        ("speed", "level.toml"),
        "[run] level = 'predict': cannot represent Ground(damping = 0.1); must be 'stepped'",
    ),
    (
        ("check", "level.toml"),
        "[run] level = 'predict': cannot represent Ground(damping = 0.1); must be 'stepped'",
    ),
    (("new", "none"), "'none': is not a scene of the gallery; there are paper, bumpy"),
    (("check",), "requires an argument"),
    (("check", "good.toml", "more"), "more"),
)


@pytest.mark.parametrize(("words", "told"), REFUSED, ids=lambda v: " ".join(v) if v[1:] else None)
def test_bad_input_is_one_line_and_status_2(words: tuple[str, ...], told: str, capsys: Any) -> None:
    Path("folder.toml").mkdir()
    bad = "[growth]\nalpha = 0.1\n"
    Path("good.toml").write_text(bad)
    Path("text.toml").write_text("Dear sheet,\n")
    Path("kg.toml").write_text(f'[sheet]\nlength = "40 kg"\n{bad}')
    Path("thin.toml").write_text(f'[sheet]\nthickness = "-1 mm"\n{bad}')
    level = "[bending]\n[gravity]\nweight = 1e-4\n[friction]\nslip_speed = 0.1\ncoefficient = 1e-3\n"
    level += '[ground]\nstiffness = 1.0\ndamping = 0.1\n[run]\nlevel = "predict"\n'
    Path("level.toml").write_text(bad + level)
    before = sorted(os.listdir())
    status, out, err = run(capsys, *words)
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert err.startswith("sheetcrawl: ")
    assert told in err
    assert sorted(os.listdir()) == before


def test_every_mistake_has_its_line(capsys: Any) -> None:
    Path("a.toml").write_text("[sheet]\nwidth = 0\n[wave]\ncount = 0\n[growth]\nalpha = 1\nbeta = 2\n")
    status, out, err = run(capsys, "check", "a.toml")
    assert (status, out) == (BAD_ARGUMENTS, "")
    places = [line.split(" ")[1] for line in err.splitlines()]
    assert places == ["a.toml:2:", "a.toml:4:", "a.toml:7:"]


@pytest.mark.parametrize(
    ("growth", "named"),
    [("alpha = 1e26", "by more than a number can hold"), ('alpha = 2\nlaw = "linear"', "alpha = 2")],
)
def test_growth_that_no_sheet_has_is_no_scene(capsys: Any, growth: str, named: str) -> None:
    Path("a.toml").write_text(f"[growth]\n{growth}\n")
    status, out, err = run(capsys, "check", "a.toml")
    assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1)
    assert named in err


def test_a_smaller_tolerance_is_expected_to_cost_more(capsys: Any) -> None:
    scene = read(gallery.FOLDER / "paper.toml").scene
    costs = [
        expected_seconds(scene, "predict", RunSettings(rtol=rtol)) for rtol in (1e-1, 1e-2, 1e-4, 1e-6)
    ]
    assert costs[0] == costs[1]
    assert costs[3] / costs[1] == pytest.approx(20, rel=0.5)  # measured: 12 s and 0.6 s


def test_the_schema_is_printed(capsys: Any) -> None:
    status, out, _ = run(capsys, "schema")
    assert status == MET
    assert json.loads(out) == json.loads(json.dumps(schema()))


def test_a_wave_by_a_table_is_that_of_the_scene_file(capsys: Any) -> None:
    """In the units of length and period, and only beside what gives them."""
    run(capsys, "new", "measured")
    scene = read(Path("measured.toml")).scene
    sheet = {"length": "40 mm", "width": "15 mm", "thickness": "0.8 mm", "poisson": 0.45}
    question = asked(Options(period="8 s", alpha=0.1, wave_csv=Path("measured.csv"), **sheet))
    assert question.scene.wave == scene.wave
    assert (question.scene.sheet, question.scene.alpha) == (scene.sheet, scene.alpha)
    for beside, named in (
        ([], "--length: must be given"),
        (["--length", "40", "--pulse", "0.2"], "'measured.csv': must not be combined with --pulse"),
        (["--length", "40", "--count", "2"], "'measured.csv': must not be combined with --count"),
        (["--length", "60"], "cover"),
    ):
        status, out, err = run(capsys, "speed", "--alpha", "0.1", "--wave-csv", "measured.csv", *beside)
        assert (status, out, err.count("\n")) == (BAD_ARGUMENTS, "", 1), beside
        assert named in err
    other = ["--alpha", "0.1", "--length", "40", "--wave-csv"]
    assert "nothing.csv': there is no such file" in run(capsys, "speed", *other, "nothing.csv")[2]
    Path("damaged.csv").write_text("y,t\n0,0\n")
    assert "column" in run(capsys, "speed", *other, "damaged.csv")[2]


def test_examples_of_the_helps_run_in_their_order(capsys: Any) -> None:
    """As the screen has them, each with the file of those before it."""
    for _, command in screens.FILES:
        words = shlex.split(command.partition(" >")[0])[1:]
        status, out, err = run(capsys, *words)
        assert (status, err) == (MET, ""), command
        assert out
    helps = {"new": 0, "check": 1, "speed": 2, "schema": 3}
    for name, place in helps.items():
        status, out, _ = run(capsys, name, "--help")
        assert status == MET
        assert screens.FILES[place][1] in out
    assert all(command in run(capsys, "examples")[1] for _, command in screens.FILES)


@pytest.mark.parametrize("words", [["--help"], ["speed", "--help"], ["new", "--list"], ["examples"]])
def test_helps_and_lists_load_no_libraries(words: list[str]) -> None:
    code = (
        "import sys\nfrom fem_check.command import main\n"
        f"try: main({words})\nfinally: print('loaded', *sys.modules)"
    )
    root = str(Path(__file__).parents[2])
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": root},
    )
    loaded = set(done.stdout.partition("loaded ")[2].split())
    assert "cyclopts" in loaded
    assert not loaded & {"numpy", "scipy", "sympy", "skfem", "matplotlib", "pint", "pydantic", "meshio"}


def test_a_slope_without_friction_is_refused_with_what_is_missing() -> None:
    slope = Gravity(1e-4, incline=0.2)
    scene = Scene(Sheet(), SineWave(), 0.1, effects=[Membrane(Material(0.03, 0.5)), slope])
    with pytest.raises(
        ValueError, match=r"nothing holds the sheet on its slope, incline = 0.2; name Fr"
    ):
        solve(scene)


def test_the_way_of_a_scene() -> None:
    scenes = {name: read(gallery.FOLDER / f"{name}.toml").scene for name in gallery.names()}
    assert {name: way_of(scene) for name, scene in scenes.items()} == WAYS
    assert way_of(scenes["paper"], "cycle") == "cycle"
    assert way_of(scenes["inchworm"], "predict") == "predict"
    with pytest.raises(
        ValueError, match=r"level = .strip.: cannot represent Bending.*must be .predict"
    ):
        way_of(scenes["inchworm"], "strip")
    with pytest.raises(ValueError, match=r"level = 'best': must be one of 'auto', 'predict'"):
        way_of(scenes["paper"], "best")
    load = "[dead_load]\nforce = [0.0, 1e-3]\n[growth]\nalpha = 0.1\n"
    Path("load.toml").write_text(load)
    with pytest.raises(ValueError, match=r"no level represents this scene \(predict: DeadLoad, cycle"):
        way_of(read("load.toml").scene)


def _written(name: str) -> str:
    path = Path(f"{name}.toml")
    path.write_text(gallery.text(name))
    return str(path)


def test_ways_answer_as_they_do_alone() -> None:
    seen: list[Progress] = []
    trapezoid = read(_written("trapezoid")).scene.but(mesh=None, cells=(2, 4))
    found = solve(trapezoid, "cycle", rtol=0.1, progress=seen.append)
    alone = cycle_speed(trapezoid, rtol=0.1)
    assert (found.mean, found.speed.error, found.converged) == (
        alone.mean,
        alone.error,
        alone.converged,
    )
    assert seen
    seen.clear()
    bumpy = read(_written("bumpy")).scene.but(cells=(1, 2))
    motion = simulate(bumpy, periods=1, steps=8)
    stepped = solve(bumpy, rtol=None, periods=1, steps=8, progress=seen.append)
    assert stepped.mean == motion.speed.mean
    assert stepped.level == "stepped"
    assert stepped.left_out == ("inertia",)
    assert stepped.error == motion.speed.error
    assert stepped.not_in_error == ("error of the mesh", "change from period to period")
    assert seen[-1].share == pytest.approx(1)
    assert not motion.snaps
    assert "not estimated: error of the mesh" in " ".join(block(stepped).split())
    assert "CAUTION" not in block(stepped)


@pytest.mark.parametrize(
    ("crossed", "snaps", "error", "said"),
    [
        (np.array([False, True]), True, np.nan, "the sheet passes through itself"),
        (None, True, np.nan, "depends on the steps: the error is a lower bound"),
        (np.array([False]), True, 0.1, "the sheet snaps over in the last period"),
        (None, True, np.inf, "the steps; the run with other steps failed, without which the error"),
        (None, False, np.inf, "the run with other steps failed, without which the error of the speed"),
        (None, False, 0.0, ""),
    ],
)
def test_what_is_wrong_with_a_motion_is_a_caution(crossed, snaps, error, said) -> None:  # type: ignore[no-untyped-def]
    motion = SimpleNamespace(
        crossed=crossed,
        wrinkled=np.zeros(2, bool),
        snaps=snaps,
        errors=SpeedErrors(0.0, 0.0, np.nan, np.nan, error),
        scene=Scene(Sheet(), SineWave(), 0.1),
        speed=SimpleNamespace(mean=1.0),
    )
    found = solving._caution(motion)  # type: ignore[arg-type]
    assert said in found
    assert bool(found) == bool(said)
    assert ("lower bound" in found) == (snaps and np.isnan(error) and crossed is None)


@pytest.mark.parametrize("kappa", [-9.0, -2.0])
def test_the_expected_cost_of_a_sheet_that_touches_itself(kappa: float) -> None:
    """Of the measured strip, or one that is too open; to the factor stated, and 3 for the machine."""
    scene, settings = self_contact.scene(kappa, cells=(1, 6)), RunSettings(steps=8, periods=1)
    start = time.process_time()
    solved(scene, settings)
    spent = time.process_time() - start
    assert 1 / 15 < spent / expected_seconds(scene, "stepped", settings) < 15


@pytest.mark.parametrize("name", ["inchworm", "measured", "bumpy"])
def test_the_expected_cost_is_of_the_right_size(name: str) -> None:
    """To the factor that is stated, and another 3 for the machine."""
    file = read(gallery.FOLDER / f"{name}.toml")
    scene, run_as = file.scene, file.run
    way = way_of(scene)
    start = time.process_time()
    solved(scene, run_as)
    spent = time.process_time() - start
    expected = expected_seconds(scene, way, run_as)
    assert spent < 15 * expected
    assert way == "predict" or spent > expected / 15
    assert set(ways.WAYS) == {"predict", "cycle", "stepped"}

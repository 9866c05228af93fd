"""Levels by name wherever they can be typed: files, sweeps, runs; above all of sheets that bend."""

import math
import time
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from fem_check import Gravity, Ground, RunSettings, predict, solve
from fem_check.choice.asked import way_for
from fem_check.choice.expected import expected_seconds
from fem_check.choice.result import TO_A_SHEET
from fem_check.choice.settings import SHARE
from fem_check.choice.solving import solved
from fem_check.choice.ways import ANSWERS, way_of
from fem_check.command import main
from fem_check.files import read
from fem_check.files.fields import Level
from fem_check.files.writing import write
from fem_check.runs import run
from fem_check.runs.record import errors_of
from fem_check.sweeps import Grid
from fem_check.sweeps.cost import _price
from fem_check.sweeps.plan import plan_of
from figures.measure import saddle
from linear_theory import FieldWave, Scene, Sheet, SineWave, Tanh, crawl_speed, line_speed
from linear_theory.line.closed_form import line_speed_viscous

BEND = """[wave]
period = 1.0
[growth]
alpha = 0.01
curvature_coupling = -0.1
[bending]
[gravity]
weight = 2.5e-4
[ground]
stiffness = 0.5
[friction]
coefficient = 1e-3
slip_speed = 0.3
[run]
level = "second order"
rtol = "2 %"
"""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def bending() -> Scene:
    return saddle.scene(saddle.PLACES["paper"], SineWave(), Tanh(0.3), 0.004, -0.1)


def test_every_level_may_be_said_in_a_file_and_is_written_again() -> None:
    assert get_args(Level) == ANSWERS
    for level in ANSWERS:
        Path("a.toml").write_text(f'[growth]\nalpha = 0.1\n[run]\nlevel = "{level}"\n')
        found = read("a.toml")
        assert found.run.level == level
        write(found.scene, Path("b.toml"), found.run)
        assert read("b.toml").run == found.run


def test_second_order_is_crawl_speed_to_that_order(bending: Scene) -> None:
    found = solve(bending, "second order", rtol=0.02)
    alone = crawl_speed(bending, order=2, rtol=0.02 * SHARE)
    assert (found.mean, found.level, found.model_error) == (
        alone.mean,
        "second order",
        alone.model_error,
    )
    named = {type(e): e for e in bending.effects}
    other = [Gravity(2.5e-4, load="current"), Ground(0.5, load="current")]
    kept = [e for kind, e in named.items() if kind not in (Gravity, Ground)]
    current = bending.but(effects=[*kept, *other])  # a load that no cycle of shapes represents
    found = solve(current, "second order", rtol=0.02)
    assert found.mean == crawl_speed(current, order=2, rtol=0.02 * SHARE).mean
    with pytest.raises(ValueError, match=r"level = 'predict': cannot .* must be 'stepped' or 'second"):
        solve(current, "predict")
    flat = Scene(Sheet(), SineWave(), 0.1)
    assert solve(flat, "second order").mean == predict(flat, level="second order").mean


def test_predict_is_predict(bending: Scene) -> None:
    found, alone = solve(bending, "predict", rtol=0.02), predict(bending, rtol=0.02)
    assert (found.mean, found.level, found.reason) == (alone.mean, "second order", alone.reason)
    parts = [row["part"] for row in errors_of(solved(bending, RunSettings("predict", 0.02)))]
    assert parts[-1] == "model: distance to a cycle of its shapes"
    assert way_of(bending) == "cycle"  # unless it is asked for
    lifted = bending.but(curvature_coupling=-0.6, cells=(2, 4))
    found = solve(lifted, "predict", rtol=0.5)
    assert found.level == "cycle"
    assert "curvature_coupling = -0.6: must be in (-0.52" in found.passed[0].why


def _said(capsys: Any, *words: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as end:
        main(words)
    out, err = capsys.readouterr()
    return int(end.value.code or 0), out, err


def test_files_of_sheets_that_bend_are_checked_and_answered(capsys: Any) -> None:
    Path("bend.toml").write_text(BEND)
    status, out, _ = _said(capsys, "check", "bend.toml")
    assert status == 0
    assert "second order: theory to second order in growth and curvature; to 2 %" in out
    assert "about 0.3 s on one core" in out
    status, out, _ = _said(capsys, "speed", "bend.toml")
    assert "by second-order theory in alpha and beta" in out
    Path("bend.toml").write_text(BEND.replace("second order", "predict"))
    status, out, _ = _said(capsys, "check", "bend.toml")
    assert "predict: the cheapest theory or cycle of shapes" in out
    assert "at most about" in out


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (("= -0.1", "= -0.6"), "bend.toml:5: [growth] curvature_coupling = -0.6: must be in (-0.52"),
        (
            ("stiffness", "damping = 0.1\nstiffness"),
            "[run] level = 'second order': cannot represent Grou",
        ),
        (
            ("second order", "first order"),
            "cannot represent Bending; Gravity; Ground; must be 'predict', ",
        ),
        (("second order", "best"), "[run] level"),
    ],
)
def test_what_a_level_cannot_answer_is_refused_by_name(
    change: tuple[str, str], told: str, capsys: Any
) -> None:
    Path("bend.toml").write_text(BEND.replace(*change))
    for command in ("check", "run"):
        status, out, err = _said(capsys, command, "bend.toml")
        assert (status, out, err.count("\n")) == (2, "", 1)
        assert told in err
    assert [path.name for path in Path().iterdir()] == ["bend.toml"]


def test_a_run_refuses_a_sheet_that_lifts_off_before_any_work(bending: Scene) -> None:
    with pytest.raises(ValueError, match="lifts off"):
        run(bending.but(curvature_coupling=0.6), "folder", RunSettings("second order"))
    assert not Path("folder").exists()


def test_sweeps_ask_for_them_too(bending: Scene) -> None:
    over = {"growth.curvature_coupling": [-0.1, -0.05]}
    for level in ("second order", "predict"):
        plan = plan_of(bending, over, Grid(), RunSettings(level, 0.02))
        asked = plan.question(next(iter(plan.points())))
        assert asked.settings.level == level == way_for(*asked)
        assert _price(asked) < 15
        assert solved(*asked).answer.level == "second order"


def test_the_expected_cost_of_the_plate_is_of_the_right_size(bending: Scene) -> None:
    start = time.process_time()
    solve(bending, "second order", rtol=0.02)
    spent = time.process_time() - start
    assert 1 / 15 < spent / expected_seconds(bending, "second order", RunSettings()) < 15


@pytest.mark.parametrize("friction", ["coulomb", "viscous"])
def test_a_body_on_a_line_is_that_of_the_closed_form(friction: str) -> None:
    """Eqs 5 to 7: its error is its own, for it is no sheet whose distance could be known."""
    found = predict(Sheet(), SineWave(), 0.25, "linear", friction=friction, level="line")
    exact = float({"coulomb": line_speed, "viscous": line_speed_viscous}[friction](0.25))
    assert abs(found.mean - exact) <= found.error + 1e-15
    assert (found.level, found.converged, found.not_in_error) == ("line", True, (TO_A_SHEET,))
    assert math.isnan(found.model_error)


def test_auto_never_takes_a_body_on_a_line() -> None:
    assert predict(Sheet(), SineWave(), 0.25, rtol=0.3).level == "strip"
    wide = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) * (1 + x), period=1.0)
    with pytest.raises(ValueError, match="level = 'line': must be 'cycle'"):
        predict(Sheet(), wide, 0.1, level="line")

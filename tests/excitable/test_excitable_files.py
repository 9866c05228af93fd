"""Excitable waves in scene files: written and read again, in units, and their mistakes named."""

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem_check import Outline, StrainFeedback
from fem_check.choice.solving import solved
from fem_check.choice.ways import way_of
from fem_check.command.actions.checking import check
from fem_check.command.actions.scenes import answerable
from fem_check.command.actions.speed import speed
from fem_check.command.options import Options
from fem_check.command.waiting import Waiting
from fem_check.excitable import (
    BumpStart,
    CrossedStart,
    Euler,
    Excitation,
    FitzHughNagumo,
    Pacing,
    RationalStart,
    UniformStart,
    excitable_preset,
)
from fem_check.files import SceneFileError, gallery, read
from fem_check.files.parts.excitable import entries_of, excitable_of
from fem_check.files.reading import parsed
from fem_check.files.system import System
from fem_check.files.tables import WaveTable
from fem_check.files.toml import text_of
from fem_check.files.writing import toml_of
from linear_theory import Scene, Sheet
from linear_theory.common.progress import Progress
from tests.robust.drawn_examples import examples

HERE = Path("scene.toml")
NUMBERS, SIZES = st.floats(-2, 2), st.floats(0.01, 50.0)
STARTS = st.one_of(
    st.builds(RationalStart, NUMBERS, SIZES),
    st.builds(UniformStart, NUMBERS, NUMBERS),
    st.builds(BumpStart, NUMBERS, SIZES, st.tuples(st.none() | NUMBERS, NUMBERS)),
    st.builds(CrossedStart, NUMBERS, NUMBERS, SIZES),
)
PACINGS = st.builds(
    lambda period, share, *others: Pacing(period, others[0], share * period, *others[1:]),
    *(SIZES, st.floats(0.01, 0.5), NUMBERS, SIZES, st.booleans()),
)


@st.composite
def excitable_waves(draw: Any) -> Any:
    """Not solved: a scene asks a wave for its period."""
    feedback = draw(st.none() | st.builds(StrainFeedback, NUMBERS))
    equation = FitzHughNagumo(
        *(draw(NUMBERS), draw(SIZES), draw(SIZES), draw(SIZES), draw(STARTS)),
        draw(st.none() | PACINGS),
        feedback,
    )
    sheet = Sheet(draw(SIZES), draw(SIZES))
    wave = Excitation(equation, sheet, draw(SIZES), draw(st.floats(1e-6, 0.5)))
    return wave.periodic() if feedback is None and draw(st.booleans()) else wave


@examples(60)
@given(excitable_waves())
def test_random_waves_are_the_same_again(wave: Any) -> None:
    text = text_of({"wave": entries_of(wave)}, "A wave.")
    table = WaveTable.model_validate(tomllib.loads(text)["wave"])
    again = excitable_of(table, System(), wave.body)
    assert again == wave
    assert text_of({"wave": entries_of(again)}, "A wave.") == text  # type: ignore[arg-type]


def wave_of(table: str, sheet: str = "") -> Any:
    text = f'{sheet}\n[growth]\nalpha = 0.1\n[wave]\nkind = "excitable"\n{table}'
    return parsed(text, HERE).scene.wave


def test_a_preset_is_scaled_to_the_sheet() -> None:
    """c on a sheet of 40 mm is that on the sheet of length 1, at the same place in lengths."""
    sheet = '[sheet]\nlength = "40 mm"'
    table = 'until = "60 s"\nrtol = "3 %"\nequation = { preset = "nu = -0.1" }'
    wave = wave_of(table, sheet)
    assert (wave.equation.diffusion_length, wave.equation.start.scale) == (0.8, 40.0)
    same = excitable_preset("nu = -0.1").on(Sheet(), 60.0, 3e-2)
    y = np.linspace(-0.5, 0.5, 7)
    assert wave.value(0.0, 40 * y, 55.0) == pytest.approx(same.value(0.0, y, 55.0), abs=1e-9)
    other = 'until = 5.0\nequation = { preset = "nu = -0.05", diffusion_length = 0.03, feedback = 0.2 }'
    expected = excitable_preset("nu = -0.05").but(diffusion_length=0.03, feedback=StrainFeedback(0.2))
    assert wave_of(other).equation == expected


MISTAKES = {
    "no equation": ("until = 3.0", "equation: must be given for kind = 'excitable'"),
    "no time": ('equation = { preset = "printed" }', "until: must be given"),
    "missing": (
        "until = 3.0\nequation = { threshold = 0.1 }",
        "must have recovery_decay, recovery_rate",
    ),
    "preset": ('until = 3.0\nequation = { preset = "print" }', "must be 'printed', 'nu = -0.1'"),
    "period": (
        'until = 3.0\nperiod = 2.0\nequation = { preset = "printed" }',
        "period: must be left out, the equation makes its own waves",
    ),
    "orbit": (
        'until = 3.0\norbit = true\nequation = { preset = "printed", feedback = 0.1 }',
        "orbit: must be left out beside feedback",
    ),
    "start": (
        'until = 3.0\nequation = { preset = "printed", start = { kind = "bump", c = 1.0 } }',
        "start.c: must be left out of a start of kind = 'bump'",
    ),
    "outline": (
        'until = 3.0\nequation = { preset = "printed" }\n[outline]\nshape = "ellipse"',
        "must be another beside [outline]",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_are_named(name: str) -> None:
    table, words = MISTAKES[name]
    with pytest.raises(SceneFileError) as found:
        wave_of(table)
    assert words in str(found.value)
    assert "[wave" in str(found.value)


def test_what_a_file_cannot_say() -> None:
    equation = excitable_preset("printed")
    for wave, words in (
        (equation.on(Sheet(), 5.0, method=Euler()), "must be Adaptive"),
        (equation.on(Outline.rectangle(Sheet()), 5.0), "waves on rectangles only"),
        (equation.on(Sheet(width=0.3), 5.0), "wave: a scene file cannot say exactly this"),
    ):
        with pytest.raises(ValueError, match=words):
            toml_of(Scene(Sheet(), wave, alpha=0.1))


def test_a_wave_that_does_not_repeat_is_stepped() -> None:
    scene = read(gallery.FOLDER / "excitable.toml").scene
    assert way_of(scene) == "stepped"
    assert way_of(scene, "stepped") == "stepped"


def test_the_scene_meets_its_own_tolerance() -> None:
    """As it is shipped, and with a finer answer within its error."""
    file = read(gallery.FOLDER / "excitable.toml")
    found = solved(file.scene, file.run).answer
    assert found.converged
    assert file.run.rtol is not None
    assert found.error <= file.run.rtol * abs(found.mean)
    fine = solved(file.scene.but(cells=(1, 4)), replace(file.run, rtol=0.1)).answer
    assert abs(fine.mean - found.mean) <= found.error


REFUSED = {
    "before one cycle": (
        'until = 5.0\n[wave.equation]\npreset = "nu = -0.1"',
        "",
        6,
        "until = 5: must be",
    ),
    "three periods": (
        'until = 120.0\n[wave.equation]\npreset = "nu = -0.1"',
        "",
        6,
        "until = 120: must be >= 152.1",
    ),
    "not repeated": (
        'until = 120.0\n[wave.equation]\npreset = "nu = -0.1"',
        'level = "cycle"',
        10,
        "level = 'cycle': must be 'stepped' or 'auto' beside this wave",
    ),
    "endless": ('until = 1e9\n[wave.equation]\npreset = "printed"', "", 6, "must be in (0, 10000]"),
    "misplaced": (
        'until = 9.0\n[wave.equation]\npreset = "printed"\norbit = true',
        "",
        9,
        "orbit: is not a key; it belongs in [wave], before its tables",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_speed_refuses_is_refused_by_check(name: str, tmp_path: Path) -> None:
    """By the same line, with the place in the file."""
    wave, level, line, words = REFUSED[name]
    run = f"[run]\n{level}\nrtol = 0.2\nperiods = 3\ncells = [1, 3]\n"
    run = run if level else run.replace("\n\n", "\n")
    rest = (
        "[gravity]\nweight = 3e-6\nload = 'current'\n[friction]\ncoefficient = 1.0\nslip_speed = 5e-5\n"
    )
    path = tmp_path / "scene.toml"
    path.write_text(
        f'[growth]\nalpha = 0.1\n[wave]\nkind = "excitable"\nrtol = 0.05\n{wave}\n{run}{rest}'
    )
    told = []
    for action in (check, lambda path: speed(Options(), path)):
        with pytest.raises(SceneFileError) as found:
            action(path)
        told.append(str(found.value))
    assert told[0] == told[1]
    assert told[0].startswith(f"{path}:{line}: [")
    assert words in told[0]


def test_long_solutions_tell_how_far_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    """While a file is read, before the level is known."""
    seen: list[Progress] = []
    monkeypatch.setattr(Waiting, "report", lambda self, progress: seen.append(progress))
    answerable(gallery.FOLDER / "excitable.toml")
    assert "the excitable wave" in {progress.task for progress in seen}

"""Optimisation files and their command: what is printed, kept, refused, and by which status."""

import math
import re

import pytest

from fem_check.command.program import main
from fem_check.optimisation.optimise_file import read
from linear_theory import line_speed

FILE = """
[scene.sheet]
length = "40 mm"
width = "4 mm"
[scene.wave]
period = "8 s"
[scene.growth]
alpha = 0.1
[over]
sheet.width = { low = "2 mm", high = "0.4 cm" }
growth.alpha = { low = 0.05, high = 0.1 }
[optimise]
level = "strip"
starts = 1
check = false
"""


def run(capsys, *words):
    with pytest.raises(SystemExit) as ended:
        main([str(word) for word in words])
    out, err = capsys.readouterr()
    return ended.value.code, out, err


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "one.toml").write_text(FILE)
    return tmp_path


def test_a_file_is_answered_kept_and_written(place, capsys):
    """The speed of a strip does not depend on its width, and rises with alpha to its bound."""
    status, out, err = run(capsys, "optimise", "one.toml", "--out", "best.toml")
    assert (status, err) == (0, "")
    assert re.search(r"best      speed 0\.0\d+ mm/s", out.replace(" ± 0.00000", ""))
    assert "growth.alpha = 0.1" in out
    assert "upper bound of growth.alpha" in out
    assert "mm/s per 1 of growth.alpha" in out
    assert "best.toml written; next: sheetcrawl speed best.toml" in out
    assert (place / "one.answers.jsonl").exists()
    status, out, _ = run(capsys, "optimise", "one.toml")
    assert status == 0
    assert ", 0 answers" in out
    assert "next: sheetcrawl check optimise.toml" in run(capsys, "new", "optimise")[1]
    assert run(capsys, "check", "optimise.toml")[0] == 0
    assert read("optimise.toml").unknowns.names[0] == "growth.alpha"


def test_the_best_scene_is_not_written_over_the_question(place, capsys):
    status, _, err = run(capsys, "optimise", "one.toml", "--out", "./one.toml")
    assert status == 2
    assert "is the optimisation file itself" in err
    assert (place / "one.toml").read_text() == FILE
    begin, end = FILE.index("[scene"), FILE.index("[over]")
    scene = FILE[begin:end].replace("[scene.", "[")
    (place / "sheet.toml").write_text(scene)
    (place / "named.toml").write_text('scene = "sheet.toml"\n' + FILE[end:])
    status, _, err = run(capsys, "optimise", "named.toml", "--out", "sheet.toml")
    assert (status, (place / "sheet.toml").read_text()) == (2, scene)
    assert "--out sheet.toml: is the scene file of named.toml; give another name" in err


CHECK = "check = false\n"
GROWS = FILE[FILE.index("alpha = 0.1") : FILE.index("[optimise]")]
STILL = "alpha = 0\n" + GROWS[GROWS.index("[over]") : GROWS.index("growth.alpha")]


def bounds(words):
    return f"{CHECK}[constraints]\n{words}\n"


def robust(words):
    return f"{CHECK}[robust]\nby = 'worst'\n[robust.over]\n{words}\n"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("growth.alpha", "growth.alhpa", "one.toml:11: [over] growth.alhpa: is not a field of a scene"),
        ("low = 0.05", "low = 0.5", "one.toml:11: [over] growth.alpha = from 0.5 to 0.1"),
        ("starts = 1", "starts = 0", "one.toml:14: [optimise] starts"),
        ("[optimise]", "[optimize]", "one.toml:12: [optimize] is not a table of an optimisation"),
        ('level = "strip"', 'objective = "fun"', "one.toml:13: [optimise] objective"),
        ("[optimise]", "[harmonics]\n[optimise]", "one.toml:12: [harmonics] count"),
        ('"0.4 cm"', '"1 kg"', "one.toml:10: [over] sheet.width"),
        ('"2 mm"', '"-2 mm"', "one.toml:10: [over] sheet.width: lower bound -2.0 mm: must be > 0"),
        ("low = 0.05", "low = true", "one.toml:11: [over] growth.alpha low = True: must be a finite"),
        ("low = 0.05", "low = nan", "one.toml:11: [over] growth.alpha low = nan: must be a finite"),
        ("low = 0.05", "count = 3, low = 0.05", "one.toml:11: [over] growth.alpha: count = 3"),
        ("growth.alpha", "growth.law", "one.toml:11: [over] growth.law: lower bound 0.05: must be"),
        ("growth.alpha", "run.rtol", "one.toml:11: [over] run.rtol: says how a scene is answered"),
        ('"strip"', '"stirp"', "did you mean 'strip'?"),
        ("growth.alpha", "wave.cosine.0", "[over] wave.cosine.0: amplitudes change together, as"),
        ("starts = 1", f"seed = {2**53 + 1}", f"one.toml:14: [optimise] seed = {2**53 + 1}: must be"),
        (GROWS, STILL, "one.toml:8: [scene.growth] alpha = 0: must not be 0, or be among what may"),
        ("starts = 1", 'rtol = "120 %"', "one.toml:14: [optimise] rtol = 1.2: must be in"),
        (CHECK, bounds("power = { at_most = '1 kg' }"), "one.toml:17: [constraints] power: at_most"),
        (CHECK, bounds("powr = { at_most = 1 }"), "one.toml:17: [constraints] 'powr': must be one of"),
        (CHECK, bounds("power = { most = 1 }"), "one.toml:17: [constraints] power: most: is not a key"),
        ("{ low = 0.05, high = 0.1 }", "1", "growth.alpha = 1: must be { low = ..., high = ... }"),
        (CHECK, bounds("m = { exactly = 1, of = { growth.alpha = 'x' } }"), "must be a single real"),
        (CHECK, bounds("power = 3"), "one.toml:17: [constraints] power"),
        (CHECK, robust("friction.law = ['dry', 'dyr']"), "[robust] regimes: [friction] law = 'dyr'"),
        (CHECK, robust("friction.law = ['dry']"), "[robust] regimes: 1: must be from 2 to 32"),
        (CHECK, robust("run.rtol = [1, 2]"), "[robust] regimes: run.rtol: says how a scene"),
    ],
)
def test_mistakes_are_told_with_their_line(place, capsys, old, new, words):
    (place / "one.toml").write_text(FILE.replace(old, new))
    status, out, err = run(capsys, "optimise", "one.toml")
    assert (status, out) == (2, "")
    assert words in err, err
    assert run(capsys, "check", "one.toml") == (2, "", err)
    assert not (place / "one.answers.jsonl").exists()


def test_what_cannot_be_answered_is_status_1(place, capsys):
    text = FILE.replace("low = 0.05, high = 0.1", "low = 1.7, high = 1.8").replace(
        "strip", "first order"
    )
    (place / "one.toml").write_text(text)
    status, _, err = run(capsys, "optimise", "one.toml")
    assert status == 1
    assert err.startswith("sheetcrawl: no start has an answer; the first: ")
    assert err.count("\n") == 1


def test_a_file_with_constraints_and_regimes(place, capsys):
    """The power of the sine is the larger on dry ground, its speed the smaller on viscous ground."""
    words = bounds("power = { at_most = '0.5 mm/s' }").removeprefix(CHECK)
    text = FILE.replace("high = 0.1", "high = 0.3").replace(CHECK, "check = false\nrtol = '0.2 %'\n")
    (place / "two.toml").write_text(text + words + robust("friction.law = ['dry', 'viscous']")[14:])
    status, out, err = run(capsys, "optimise", "two.toml")
    assert (status, err) == (0, "")
    said = " ".join(out.split())
    assert "held by power <= 0.5 mm/s with friction.law = dry, friction.law = viscous" in said
    assert "power <= 0.5 mm/s with friction.law = dry: 0.5 mm/s (moving the bound brings 0.48" in said
    assert "the value above is the worst of 2" in said


def test_check_says_how_the_scene_stands_to_its_limits(place, capsys):
    """The stretch of a sine is exp(alpha) at its crest, its speed far below 1 mm/s."""
    limits = "stretch = { at_most = 1.1 }\nspeed = { at_most = '1 mm/s' }\n"
    limits += "sum = { at_most = 0.2, of = { growth.alpha = 1 } }"
    (place / "one.toml").write_text(FILE.replace(CHECK, bounds(limits)))
    status, out, err = run(capsys, "check", "one.toml")
    assert (status, err) == (0, "")
    said = " ".join(out.split())
    assert said.startswith("one.toml is an optimisation sheet 40 × 4 ×")
    assert "over sheet.width from 2 to 4 mm, growth.alpha from 0.05 to 0.1" in said
    assert f"stretch <= 1.1: {math.exp(0.1):.4f}" in said
    assert "as given, beyond it: the search first moves within it" in said
    assert re.search(r"speed <= 1 mm/s: 0\.0\d+ mm/s as given answer strip", said)
    assert "limits sum <= 0.2: kept to as given; stretch" in said
    assert "next sheetcrawl optimise one.toml" in said
    assert not (place / "one.answers.jsonl").exists()


def test_check_says_it_by_the_body_on_a_line_too(place, capsys):
    """The speed of a sine in closed form, L/T = 5 mm/s."""
    text = FILE.replace(CHECK, bounds("speed = { at_most = '1 mm/s' }")).replace("strip", "line")
    text = text.replace("alpha = 0.1", "law = 'linear'\nalpha = 0.1", 1)
    (place / "line.toml").write_text(text)
    status, out, _ = run(capsys, "check", "line.toml")
    assert status == 0
    assert f"speed <= 1 mm/s: {5 * float(line_speed(0.1)):.5g} mm/s as given" in out


@pytest.mark.parametrize(
    ("words", "text", "said"),
    [
        (
            ["speed"],
            FILE,
            "is no scene but a sweep or an optimisation, as [over] says; sheetcrawl check",
        ),
        (["run"], 'scene = "a.toml"\n', "as [scene] says"),
        (["optimise"], "[wave]\n[growth]\nalpha = 0.1\n", "is a scene, which sheetcrawl speed and run"),
        (["sweep"], "[wave]\n[growth]\nalpha = 0.1\n", "sheetcrawl new sweep writes a file"),
    ],
)
def test_a_file_of_another_kind_is_told_by_its_kind(words, text, said, place, capsys):
    (place / "other.toml").write_text(text)
    status, out, err = run(capsys, *words, "other.toml")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert said in err


def test_check_knows_sweeps(place, capsys):
    over = FILE[: FILE.index("[over]")] + "[over]\ngrowth.alpha = [0.05, 0.1]\n"
    (place / "many.toml").write_text(over)
    status, out, _ = run(capsys, "check", "many.toml")
    assert status == 0
    assert "2 scenes over growth.alpha" in out


def test_a_scene_that_is_the_file_itself(place, capsys):
    (place / "self.toml").write_text('scene = "self.toml"\n' + FILE[FILE.index("[over]") :])
    status, _, err = run(capsys, "optimise", "self.toml")
    assert status == 2
    assert "self.toml:1: scene = 'self.toml': must not be this file itself" in err


def test_an_interruption_before_the_search_says_what_is_kept(place, capsys, monkeypatch):
    def stop(path):
        raise KeyboardInterrupt

    monkeypatch.setattr("fem_check.optimisation.optimise_file.read", stop)
    status, _, err = run(capsys, "optimise", "one.toml")
    assert (status, "there is no answer yet" in err) == (130, True)
    (place / "one.answers.jsonl").write_text("")
    status, _, err = run(capsys, "optimise", "one.toml")
    assert "answers are in one.answers.jsonl; sheetcrawl optimise one.toml goes on with them" in err

"""Optimisation files and their command: what is printed, kept, refused, and by which status."""

import re

import pytest

from fem_check.command.program import main
from fem_check.optimisation.optimise_file import read

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
    assert run(capsys, "new", "optimise")[0] == 0
    assert read("optimise.toml").unknowns.names[0] == "growth.alpha"


def test_the_best_scene_is_not_written_over_the_question(place, capsys):
    status, _, err = run(capsys, "optimise", "one.toml", "--out", "./one.toml")
    assert status == 2
    assert "is the optimisation file itself" in err
    assert (place / "one.toml").read_text() == FILE


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
    ],
)
def test_mistakes_are_told_with_their_line(place, capsys, old, new, words):
    (place / "one.toml").write_text(FILE.replace(old, new))
    status, out, err = run(capsys, "optimise", "one.toml")
    assert (status, out) == (2, "")
    assert words in err, err
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

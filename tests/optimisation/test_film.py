"""The film of before and after: one clock, one ground and one scale, or a refusal in words."""

import numpy as np
import pytest
from PIL import Image

from fem_check import Scene, optimise
from fem_check.command.program import main
from fem_check.optimisation.film import NoFilm, film, shown
from fem_check.output.film.race import Race
from fem_check.output.film.stage import Stage
from fem_check.output.movies import race
from fem_check.output.pictures import checked_units, moving_of
from linear_theory import Sheet, SineWave, crawl_speed, line_balance

SCENE = Scene(Sheet(width=0.2), SineWave(), alpha=0.1)

FILE = """
[scene.sheet]
length = 1.0
width = 0.2
[scene.wave]
kind = "sine"
[scene.growth]
alpha = 0.1
[over]
growth.alpha = { low = 0.05, high = 0.2 }
[optimise]
level = "strip"
starts = 1
check = false
"""


@pytest.fixture(scope="module")
def best():
    over = {"growth.alpha": (0.05, 0.2)}
    return optimise(SCENE, over, level="strip", starts=1, check=False)


@pytest.fixture(scope="module")
def speeds():
    """A slow sheet and one of half the period, four times as fast a growth."""
    waves = SineWave(), SineWave(period=0.5)
    pairs = zip(waves, (0.05, 0.2), strict=True)
    return [crawl_speed(Sheet(), wave, alpha=alpha, rtol=1e-2) for wave, alpha in pairs]


def test_both_run_on_one_clock_ground_and_scale(speeds):
    movings = [moving_of(speed) for speed in speeds]
    both = Race(movings, ("one", "two"), checked_units(movings[0], None), 2, 6, 420, Stage)
    one, two = both._stages
    assert np.array_equal(one._low, two._low)
    assert np.array_equal(one._high, two._high)
    assert one._tint.most == two._tint.most == pytest.approx(20, rel=0.02)  # percent
    for k, (i, j) in enumerate(zip(*both._orders, strict=True)):
        times = [frames[n].time - frames[0].time for frames, n in ((one._frames, i), (two._frames, j))]
        assert times == pytest.approx([k / 6, k / 6], abs=1e-12)
    way = two._frames[both._orders[1][-1]].centre[1] - two._frames[0].centre[1]
    assert way == pytest.approx(11 / 6 * speeds[1].mean, rel=0.05)
    pictures = list(both.pictures())
    assert len(pictures) == len(both) == 12
    assert all(size % 2 == 0 for size in pictures[0].shape[:2])
    half = pictures[0].shape[0] // 2
    assert not np.array_equal(pictures[0][:half], pictures[0][half:])
    assert not np.array_equal(pictures[0][half:], pictures[-1][half:])


def test_the_film_shows_the_given_scene_and_the_best(best, tmp_path):
    level, motions = shown(best, SCENE)
    assert level == "strip"
    means = [line_balance(SineWave(), a, body="strip", growth_law="exp").mean for a in (0.1, 0.2)]
    assert [one.mean for one in motions] == pytest.approx(means, rel=1e-6)
    path, _ = film(best, SCENE, tmp_path / "best.gif", periods=1, frames=3, width=420)
    with Image.open(path) as image:
        assert image.n_frames == 3
        assert image.size[0] == 420


def test_a_scene_without_an_answer_has_no_film(best, monkeypatch):
    monkeypatch.setattr("fem_check.optimisation.film.LADDER", ("strip", "first order"))
    with pytest.raises(NoFilm, match=r"no film: no level shows both scenes \(strip: alpha = 150"):
        shown(best, SCENE.but(alpha=150.0))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"names": ("one",)}, "results, names: 2 and 1 given, must be two each"),
        ({"periods": 500}, "gives 12000 frames"),
        ({"width": 100}, r"width = 100: must be in \[420, 1920\]"),
    ],
)
def test_bad_looks_are_refused(speeds, arguments, words, tmp_path):
    given = {"names": ("one", "two"), **arguments}
    with pytest.raises(ValueError, match=words):
        race(speeds, given.pop("names"), tmp_path / "two.gif", **given)


def test_the_command_refuses_other_files_before_any_work(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ask.toml").write_text(FILE)
    with pytest.raises(SystemExit) as ended:
        main(["optimise", "ask.toml", "--movie", "best.png"])
    assert ended.value.code == 2
    assert "best.png" in capsys.readouterr().err
    assert not (tmp_path / "ask.answers.jsonl").exists()

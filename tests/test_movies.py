"""What `.movie(path)` writes: frames, size, the same bytes, nothing half done, clear refusals."""

import imageio_ffmpeg
import matplotlib as mpl
import numpy as np
import pytest
from PIL import Image

from fem_check.output import Units, movies, writers
from fem_check.output.panels import GROWTH_MAP
from fem_check.output.pictures import checked_units, moving_of
from fem_check.output.stage import LEFT, RIGHT, TOP, Stage
from figures.draw import readme_movie
from linear_theory import Sheet, SineWave, crawl_speed, line_balance

SMALL = {"periods": 2, "frames": 5, "width": 421}


@pytest.fixture(scope="module")
def speed():
    return crawl_speed(Sheet(), SineWave(), 0.2, rtol=1e-2)


def test_gif_has_its_frames_and_the_same_bytes_every_time(speed, tmp_path):
    once = speed.movie(tmp_path / "once.gif", fps=10, **SMALL)
    with mpl.rc_context({"font.size": 20, "axes.grid": True}):  # the user's own taste
        again = speed.movie(str(tmp_path / "new" / "again.GIF"), fps=10, **SMALL)
    assert once.read_bytes() == again.read_bytes()
    with Image.open(once) as film:
        assert film.n_frames == 10
        assert film.size[0] == 420  # even, as the encoders of .mp4 want it
        assert film.info["duration"] == 100
        assert film.info["loop"] == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["new", "once.gif"]


def test_mp4_has_its_frames(speed, tmp_path):
    path = speed.movie(tmp_path / "crawl.mp4", fps=10, **SMALL)
    count, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
    assert (count, seconds) == (10, pytest.approx(1.0, abs=0.05))
    reader = imageio_ffmpeg.read_frames(str(path))
    assert next(reader)["size"][0] == 420
    frame = np.frombuffer(next(reader), np.uint8)
    reader.close()
    assert frame.max() > 200 > 100 > frame.min()


def test_the_sheet_in_the_picture_is_where_the_result_says(speed):
    """Its right end, found by its edge line, to two pixels: at the start, and after a period."""
    moving = moving_of(speed)
    stage = Stage(moving, checked_units(moving, None), 2, 4, 640, 1.0)
    pictures = list(stage.pictures())
    assert len(pictures) == len(stage) == 8
    low, high = stage._low[1], stage._high[1]
    points, _ = moving.covering()
    frames = moving.frames(points, 2, 4)
    for k in (0, 3, 4):
        end = frames[k].place[1].max()
        expected = LEFT + (end - low) / (high - low) * (640 - LEFT - RIGHT)
        ground = pictures[k][TOP + 20 : -50].astype(int)
        # the edge is dark; the dashed line of the start and the trail lie left of the middle
        dark = np.flatnonzero((ground.max(2) < 110).any(0))
        assert dark.max() == pytest.approx(expected, abs=2)
    moved = frames[4].centre[1] - frames[0].centre[1]
    assert moved == pytest.approx(speed.mean, rel=1e-6)


def test_a_wide_sheet_fits_on_the_ground():
    """Its wide sides are to be seen: ground on all sides of the sheet."""
    moving = moving_of(crawl_speed(Sheet(width=4.0), SineWave(), 0.1, rtol=1e-2))
    stage = Stage(moving, checked_units(moving, None), 1, 2, 420, 1.0)
    ground = stage._set_up()[1][0]
    for frame in stage._frames:
        for limits, values in zip((ground.get_ylim(), ground.get_xlim()), frame.place, strict=True):
            assert min(limits) < values.min() < values.max() < max(limits)


def test_exaggeration_moves_points_but_not_the_centre(speed):
    moving = moving_of(speed)
    plain, larger = (Stage(moving, checked_units(moving, None), 1, 4, 420, f) for f in (1.0, 3.0))
    frame = plain._frames[1]
    shown = larger._shown(frame)
    np.testing.assert_allclose(shown.place - frame.still, 3 * (frame.place - frame.still), atol=1e-12)
    np.testing.assert_array_equal(shown.centre, frame.centre)
    ground = larger._set_up()[1][0]
    assert any("displacement x 3" in text.get_text() for text in ground.texts)


def test_words_are_in_the_units_that_were_asked_for(speed):
    moving = moving_of(speed)
    stage = Stage(moving, Units("mm", "s", 40.0, 8.0), 2, 4, 420, 1.0)
    words = stage._words(stage._frames[4])
    assert words == f"t = 8.00 s    way +{40 * speed.mean:.1f} mm"


def test_colours_of_growth_are_opposite_about_white():
    low, middle, high = (np.array(GROWTH_MAP(v)[:3]) for v in (0.0, 0.5, 1.0))
    assert middle.min() > 0.95
    assert low[0] > low[2]  # orange
    assert high[2] > high[0]  # and violet: told apart without red and green cones


def test_progress_is_told_frame_by_frame(speed, tmp_path):
    told = []
    speed.movie(tmp_path / "a.gif", progress=lambda done, total: told.append((done, total)), **SMALL)
    assert told == [(k, 10) for k in range(1, 11)]
    speed.movie(tmp_path / "b.gif", progress=True, **SMALL)
    with pytest.raises(ValueError, match=r"progress = 'yes': must be"):
        speed.movie(tmp_path / "c.gif", progress="yes", **SMALL)


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_an_interrupted_film_leaves_nothing_and_keeps_the_old_one(speed, tmp_path, suffix):
    path = tmp_path / f"crawl{suffix}"
    path.write_bytes(b"before")

    def stop(done, total):
        if done == 9:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        speed.movie(path, progress=stop, **SMALL)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
    assert path.read_bytes() == b"before"


def test_bad_paths_are_found_before_the_work(speed, tmp_path, monkeypatch):
    monkeypatch.setattr(movies, "moving_of", pytest.fail)
    (tmp_path / "file").touch()
    (tmp_path / "folder.gif").mkdir()
    for path, error, words in (
        ("crawl.avi", ValueError, r"must end in \.gif or \.mp4"),
        ("file/crawl.gif", NotADirectoryError, "is a file, must be a folder"),
        ("folder.gif", IsADirectoryError, "is a folder"),
        ("x" * 300 + ".gif", OSError, "cannot be written"),
    ):
        with pytest.raises(error, match=words):
            speed.movie(tmp_path / path)


def test_a_missing_encoder_is_named_before_the_work(speed, tmp_path, monkeypatch):
    monkeypatch.setattr(movies, "moving_of", pytest.fail)
    monkeypatch.setattr(writers, "find_spec", lambda name: None)
    with pytest.raises(ModuleNotFoundError, match=r"sheetcrawl\[movies\]"):
        speed.movie(tmp_path / "crawl.mp4")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        ({"periods": 0}, "periods = 0"),
        ({"frames": 1}, "frames = 1"),
        ({"periods": 1000}, "gives 24000 frames, must be at most"),
        ({"fps": 0}, "fps = 0"),
        ({"width": 100}, "width = 100: must be in"),
        ({"exaggerate": -1}, "exaggerate = -1"),
    ],
)
def test_bad_numbers_are_named(speed, tmp_path, bad, words):
    with pytest.raises(ValueError, match=words):
        speed.movie(tmp_path / "crawl.gif", **bad)


def test_a_body_on_a_line_has_no_film(tmp_path):
    with pytest.raises(ValueError, match="must have a shape"):
        line_balance(SineWave(), 0.1).movie(tmp_path / "line.gif")


def test_the_film_of_the_readme_is_small_and_shows_its_sheet():
    path = readme_movie.GALLERY / readme_movie.NAME
    assert path.stat().st_size < 3e6
    with Image.open(path) as film:
        assert film.n_frames == readme_movie.PERIODS * readme_movie.FRAMES
        assert film.size[0] == readme_movie.WIDTH
    assert readme_movie.PULSE.value(0.0, 0.0, 0.0) == pytest.approx(1.0)
    assert np.exp(readme_movie.ALPHA) == pytest.approx(1.12)

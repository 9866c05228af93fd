"""What `.movie(path)` writes: frames, size, the same bytes, nothing half done, clear refusals."""

import sys
from types import SimpleNamespace

import imageio_ffmpeg
import matplotlib as mpl
import numpy as np
import pytest
from PIL import Image

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    Scene,
    cycle_speed,
    simulate,
)
from fem_check.output import Units, View, movies, writers
from fem_check.output.film.arrows import Friction as Forces
from fem_check.output.film.camera import Camera
from fem_check.output.film.space import SpaceStage
from fem_check.output.film.stage import LEFT, RIGHT, TOP, Stage
from fem_check.output.film.surface import Surface, _visible, normals, quads
from fem_check.output.panels import GROWTH_MAP
from fem_check.output.pictures import checked_units, moving_of
from figures.draw import readme_movie
from linear_theory import FieldWave, Sheet, SineWave, crawl_speed, line_balance, pulse_wave

SMALL = {"periods": 2, "frames": 5, "width": 421}


@pytest.fixture(scope="module")
def speed():
    return crawl_speed(Sheet(), SineWave(), 0.2, rtol=1e-2)


def test_gif_has_its_frames_and_the_same_bytes_every_time(speed, tmp_path):
    once = speed.movie(tmp_path / "once.gif", fps=10, **SMALL)
    with mpl.rc_context({"font.size": 20, "axes.grid": True}):  # the user's own taste
        again = speed.movie(str(tmp_path / "again.GIF"), fps=10, **SMALL)
    assert once.read_bytes() == again.read_bytes()
    with Image.open(once) as film:
        assert film.n_frames == 10
        assert film.size[0] == 420  # even, as the encoders of .mp4 want it
        assert film.info["duration"] == 100
        assert film.info["loop"] == 0
    assert sorted(p.name for p in tmp_path.iterdir()) == ["again.GIF", "once.gif"]


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
    assert words == f"t = 8.00 s    moved +{40 * speed.mean:.1f} mm"


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


def test_a_film_that_was_cut_short_by_a_full_disk_is_no_film(speed, tmp_path):
    whole, cut = speed.movie(tmp_path / "crawl.mp4", **SMALL), tmp_path / "cut.mp4"
    assert writers.is_whole(whole)
    for size in (0, 20, 2000, whole.stat().st_size - 1):
        cut.write_bytes(whole.read_bytes()[:size])
        assert not writers.is_whole(cut)


def test_a_missing_encoder_is_named_before_the_work(speed, tmp_path, monkeypatch):
    monkeypatch.setattr(movies, "moving_of", pytest.fail)
    monkeypatch.setitem(sys.modules, writers.MODULE, None)
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


MATERIAL = Material(0.03, 0.5)


def bumps(x, y):
    return 0.01 * np.cos(2 * np.pi * y / 0.6) + 0 * x


@pytest.fixture(scope="module")
def lying():
    """A bilayer on uneven ground."""
    effects = [
        Membrane(MATERIAL),
        Bending(MATERIAL),
        Gravity(2.5e-4),
        Ground(0.5, height=bumps),
        Friction(0.7, slip_speed=0.02),
    ]
    scene = Scene(Sheet(), SineWave(), 0.02, 2.0, effects, cells=(2, 4))
    return simulate(scene, periods=1, steps=12)


def in_space(result, width=640, exaggerate=1.0, periods=1):
    moving = moving_of(result)
    return SpaceStage(moving, checked_units(moving, None), periods, 4, width, exaggerate)


def test_a_sheet_that_leaves_the_plane_is_filmed_in_space(lying, speed, tmp_path, monkeypatch):
    seen = []

    def stage(view):
        def made(*arguments):
            seen.append(view)
            return SimpleNamespace(pictures=lambda: iter(()), __len__=lambda: 0)

        return made

    monkeypatch.setattr(movies, "STAGES", {view: stage(view) for view in View})
    monkeypatch.setitem(writers.WRITERS, ".gif", lambda path, pictures, fps: path.touch())
    for result, view in ((lying, None), (speed, None), (lying, "top"), (speed, View.SPACE)):
        result.movie(tmp_path / "film.gif", view=view, periods=1, frames=4)
    assert seen == [View.SPACE, View.TOP, View.TOP, View.SPACE]
    with pytest.raises(ValueError, match="view = 'below': must"):
        speed.movie(tmp_path / "film.gif", view="below")


def test_a_film_in_space_has_the_same_bytes_every_time(lying, tmp_path):
    once = lying.movie(tmp_path / "once.gif", frames=3, width=420)
    with mpl.rc_context({"font.size": 20, "axes.grid": True}):
        again = lying.movie(tmp_path / "again.gif", frames=3, width=420)
    assert once.read_bytes() == again.read_bytes()


def test_the_camera_keeps_lengths_and_directions():
    """What it does to the three axes is a rotation."""
    for steepest in (0.0, 1.0):
        camera = Camera.over(steepest)
        units = np.concatenate([camera.page(np.eye(3)), camera.depth(np.eye(3))[None]])
        np.testing.assert_allclose(units @ units.T, np.eye(3), atol=1e-14)
        assert np.linalg.det(units) == pytest.approx(1)  # not mirrored
        (right, up), toward = units[:2], units[2]
        assert right[1] > abs(right[0])  # y runs to the right,
        assert up[0] < 0 < up[2]  # x down the page and z up
        assert toward[0] > 0 < toward[2]
        # a slope that rises towards the viewer is seen from its upper side
        way = toward[:2] / np.hypot(*toward[:2])
        assert toward @ [*(-steepest * -way), 1] > 0
    stretched = Camera.over(0.0, 5.0)
    point = np.array([0.1, 0.2, 0.3])
    np.testing.assert_allclose(stretched.page(point), Camera.over(0.0).page(point * [1, 1, 5]))


def test_the_sheet_in_space_is_where_the_result_says(lying):
    """Its colours cover the corners of the picture that the camera says, to four pixels."""
    stage = in_space(lying)
    _, picture, *_ = stage.pictures()  # both ends of the sheet grow or shrink
    ends = stage._camera.page(stage._shown(stage._frames[1]).place)
    low, high = stage._page
    scale = (640 - LEFT - RIGHT) / (high - low)[0]
    columns = LEFT + (ends[0] - low[0]) * scale
    view = picture[TOP + 30 : TOP + stage._height].astype(int)
    colored = np.flatnonzero((np.ptp(view, axis=2) > 40).any(0))
    assert colored.min() == pytest.approx(columns.min(), abs=4)
    assert colored.max() == pytest.approx(columns.max(), abs=4)


def test_heights_are_to_scale_or_the_film_says_by_how_much(lying, monkeypatch):
    monkeypatch.setitem(mpl.rcParams, "figure.constrained_layout.use", True)  # the user's own
    stage = in_space(lying)
    canvas, (_, side) = stage._set_up()
    canvas.draw()
    origin, right, up = side.transData.transform([(0, 0), (0.1, 0), (0, 0.01)])
    assert stage._stretch == 1
    assert (up - origin)[1] / (right - origin)[0] == pytest.approx(0.1, rel=1e-3)
    assert "to scale" in side.texts[0].get_text()
    effects = [Membrane(MATERIAL), Bending(MATERIAL), Gravity(2.5e-7), Ground(0.5)]
    effects.append(Friction(0.7, slip_speed=1e-3))
    flat = simulate(Scene(Sheet(), SineWave(), 1e-3, 0.02, effects, cells=(1, 2)), periods=1, steps=8)
    stage = in_space(flat)
    canvas, (_, side) = stage._set_up()
    canvas.draw()
    origin, right, up = side.transData.transform([(0, 0), (0.1, 0), (0, 1e-3)])
    assert stage._stretch in (5, 10, 20, 50, 100)
    assert (up - origin)[1] / (right - origin)[0] == pytest.approx(0.01 * stage._stretch, rel=1e-3)
    assert f"heights × {stage._stretch:g} in both views" in side.texts[0].get_text()


def test_the_section_is_the_middle_line_and_the_ground_below_it(lying):
    stage = in_space(lying)
    _, (_, side) = stage._set_up()
    _, line, sheet, _ = stage._section(side, 2)
    y, z = line.get_data()
    np.testing.assert_allclose(z, bumps(0, y), atol=1e-12)
    start = lying.positions(stage._frames[2].time, np.array([[0.0], [0.0]]), rtol=None)
    off = np.hypot(*(np.array(sheet.get_data()) - start[1:]))
    assert off.min() < 5e-3


def test_edges_behind_the_sheet_are_hidden():
    """Of two squares one above the other, the lower one's edges in their overlap."""
    square = np.array([[0, 1, 1, 0], [0, 0, 1, 1.0]])
    seen = np.concatenate([square, square * 0.5 + 0.25], axis=1)
    depth = np.repeat([1.0, 0.0], 4)
    cells = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    rim = np.array([[0, 1], [1, 2], [4, 5], [6, 7]])
    np.testing.assert_array_equal(_visible(seen, depth, cells, rim), [True, True, False, False])
    np.testing.assert_array_equal(_visible(seen, -depth, cells, rim), True)


def test_a_grid_of_cells_faces_up():
    x, y = (a.ravel() for a in np.meshgrid([0, 1, 2.0], [0, 1.0], indexing="ij"))
    cells = quads(2, x.size)
    assert sorted(map(sorted, cells.tolist())) == [[0, 1, 2, 3], [2, 3, 4, 5]]
    slope = normals(Surface(np.stack([x, y, 2 * x]), cells))
    np.testing.assert_allclose(abs(slope[:, 0]), np.array([2, 0, 1]) / np.sqrt(5))


def test_arrows_of_a_sheet_that_turns_are_against_its_motion():
    """Against differences of the places in the film, which know nothing of friction."""
    lopsided = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), period=1.0)
    scene = Scene(Sheet(), lopsided, 0.2, effects=[Membrane(MATERIAL)], cells=(2, 4))
    moving = moving_of(cycle_speed(scene, rtol=1e-2))
    samples, periods = 24, 8
    forces = Forces(moving, periods, samples)
    frames = moving.frames(forces._points, periods, samples * 50)
    for k in (5, samples * 6 + 7):
        before, after = (frames[50 * k + d].place for d in (-1, 1))
        found = forces.at(k)
        np.testing.assert_allclose(found.frame.place, frames[50 * k].place, atol=1e-9)
        slip = after - before
        cosine = (found.ways * slip).sum(0) / np.hypot(*found.ways) / np.hypot(*slip)
        assert cosine.max() < -0.99
        assert 0.5 < np.hypot(*found.ways).max() / forces._step < 1.2
    assert frames[50 * k].heading > 0.2


def test_a_scene_without_friction_has_no_arrows():
    effects = [Membrane(MATERIAL), Inertia(1e-3, MATERIAL)]
    run = simulate(Scene(Sheet(), SineWave(), 0.05, effects=effects, cells=(1, 2)), periods=1, steps=16)
    assert not Forces(moving_of(run), 1, 4).acts


def test_colours_of_a_gif_are_those_of_the_scale(tmp_path):
    """Also of growth that never occurs: a pulse only grows, its scale shows both signs."""
    pulse = crawl_speed(Sheet(), pulse_wave(0.2), 0.1, rtol=1e-2)
    path = pulse.movie(tmp_path / "pulse.gif", periods=1, frames=2, width=640)
    with Image.open(path) as film:
        picture = np.asarray(film.convert("RGB")).astype(int)
    row = picture[21, 640 - 118 : 640 - 28]
    expected = 255 * GROWTH_MAP(np.linspace(0, 1, row.shape[0]))[:, :3]
    assert np.abs(row - expected)[3:-3].max() < 16

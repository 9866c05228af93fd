"""`progress=`: what is said on the way, at what pace, and what Ctrl-C says."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from fem_check import Material, Membrane, Scene, cycle_speed, predict
from fem_check.mesh.elements import default_cells
from linear_theory import SampledWave, Sheet, SineWave, crawl_speed
from linear_theory.common.progress import part_of, track, watched

SCENE = Scene(Sheet(), SineWave(), 0.1, effects=[Membrane(Material(0.03, 0.5))], cells=(1, 2))
CALLS = {
    "crawl_speed": lambda **told: crawl_speed(Sheet(), SineWave(), 0.1, rtol=1e-2, **told),
    "cycle_speed": lambda **told: cycle_speed(SCENE, rtol=0.1, **told),
    "predict": lambda **told: predict(Sheet(), SineWave(), 0.1, rtol=1e-2, level="first order", **told),
}


def test_a_measured_wave_says_how_far_its_fit_is():
    x, y, t = np.linspace(-0.25, 0.25, 6), np.linspace(-0.5, 0.5, 12), np.arange(8) / 8
    c = (1 + x[:, None, None]) * np.sin(2 * np.pi * (y[:, None] - t))
    seen = []
    told = SampledWave(x, y, t, c, period=1.0, progress=seen.append)
    assert told == SampledWave(x, y, t, c, period=1.0)
    assert {one.task for one in seen} == {
        "measured wave: looking for its numbers",
        "measured wave: sweeping them",
    }
    assert seen[-1].share == 1


@pytest.mark.parametrize("name", CALLS)
def test_every_task_goes_from_nothing_to_all_and_changes_no_answer(name):
    seen = []
    told, untold = CALLS[name](progress=seen.append), CALLS[name]()
    assert (told.mean, told.error) == (untold.mean, untold.error)
    tasks = [[]]
    for one in seen:
        if one.share == 0:
            tasks.append([])
        tasks[-1].append(one)
    assert not tasks.pop(0)
    assert tasks
    for task in tasks:
        shares = [one.share for one in task]
        assert shares == sorted(shares)
        assert shares[-1] == 1
        assert len({one.task for one in task}) == 1
        assert math.isnan(task[0].left)
        assert task[-1].left == 0
    seconds = [one.seconds for one in seen]
    assert seconds == sorted(seconds)


def test_time_left_is_at_the_pace_so_far(monkeypatch):
    """A clock that a loop turns by 3 s for each of 4 items: 9, 6, 3 and 0 s are left."""
    clock = [100.0]
    monkeypatch.setattr("linear_theory.common.progress.time.perf_counter", lambda: clock[0])
    seen = []
    with watched(seen.append, "a test"), part_of("whole"):
        for _ in track("items", range(4)):
            clock[0] += 3
    assert [(one.share, one.left, one.seconds) for one in seen[1:]] == [
        (0.25, 9, 3),
        (0.5, 6, 6),
        (0.75, 3, 9),
        (1, 0, 12),
    ]
    assert {one.task for one in seen} == {"whole: items"}


def test_levels_and_meshes_are_named():
    seen = []
    predict(Sheet(), SineWave(), 0.1, rtol=0.1, level="cycle", progress=seen.append)
    across, along = default_cells(SineWave().on(Sheet()), planar=True)  # enough for this tolerance
    assert all(one.task.startswith(f"cycle, {across} x {along} elements: ") for one in seen)
    assert any("shapes" in one.task for one in seen)
    assert any("friction" in one.task for one in seen)


def test_true_prints_on_stderr(capsys):
    CALLS["crawl_speed"](progress=True)
    printed = capsys.readouterr()
    assert printed.out == ""
    assert "friction balance over the period 100%, 0 s left" in printed.err
    assert printed.err.endswith("\n")


@pytest.mark.parametrize("name", CALLS)
def test_bad_listeners_are_refused(name):
    with pytest.raises(ValueError, match="progress = 'yes': must be True"):
        CALLS[name](progress="yes")


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_says_in_a_line_what_is_kept(name):
    def interrupt(progress):
        raise KeyboardInterrupt

    told = f"^{name} was interrupted; no partial result was kept, call it again$"
    with pytest.raises(KeyboardInterrupt, match=told):
        CALLS[name](progress=interrupt)
    seen = []
    assert list(track("nobody listens", range(3))) == [0, 1, 2]
    CALLS[name](progress=seen.append)
    assert seen  # the next call has its own listener


def test_a_listener_hears_its_own_thread_alone():
    def ask(count):
        seen = []
        with watched(seen.append, "a test"):
            list(track("items", range(count)))
        return len(seen)

    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(ask, range(1, 20))) == list(range(2, 21))

"""Snapshots: a run that is killed and resumed ends with the same bits; damaged files are refused."""

import json
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray

from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.stepping.power import Ledger
from fem_check.shell.stepping.record import Record
from fem_check.shell.stepping.run import Run
from fem_check.shell.stepping.settings import Settings
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.snapshot import (
    VERSION,
    SnapshotError,
    fingerprint,
    load_snapshot,
    save_snapshot,
)
from fem_check.shell.stepping.step_control import StepSize
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import FieldWave
from linear_theory.scene.scene import Scene
from tests.runs.processes import interruptible
from tests.shell.shell_scenes import lying, planar

Array = NDArray[np.float64]
OPTIONS = {"periods": 1, "steps": 24, "snapshot_every": 5}


class Killed(Exception):
    """Stands for the end of a process."""


def same(first: Trajectory, second: Trajectory) -> None:
    """Bit for bit."""
    assert first.rejected == second.rejected
    for name, column in first.table.items():
        np.testing.assert_array_equal(column, second.table[name], err_msg=name)
    np.testing.assert_array_equal(first.stored_times, second.stored_times)
    np.testing.assert_array_equal(first.states, second.states)
    np.testing.assert_array_equal(first.probes, second.probes)
    assert first.speed.mean == second.speed.mean
    assert first.errors == second.errors or np.isnan(first.errors.spread)


def interrupted(scene: Scene, path: Path, after: int, **options: object) -> Trajectory:
    """A run that ends after so many steps and is resumed."""

    def stop(progress: object) -> None:
        if progress.steps == after:
            raise Killed

    with pytest.raises(Killed):
        simulate(scene, snapshot=path, progress=stop, **options)
    return simulate(scene, snapshot=path, **options)


@pytest.mark.parametrize("steps", [3, 5, 12, 35])
def test_an_interrupted_run_ends_as_one_that_was_not(tmp_path: Path, steps: int) -> None:
    """Nor do its numbers depend on whether there are snapshots at all."""
    whole = simulate(planar(), periods=1, steps=24)
    resumed = interrupted(planar(), tmp_path / "cut.npz", steps, **OPTIONS)
    assert np.isnan(resumed.resumed_at) == (steps < 5)
    same(whole, resumed)


@pytest.mark.parametrize("load", ["grown", "current"])
def test_with_ground_damping_and_adaptive_steps(tmp_path: Path, load: str) -> None:
    options = {"periods": 1, "rtol": 0.03, "snapshot_every": 7, "keep_every": 3}
    scene = lying(slip=0.05, damping=2.5e-7, load=load, cells=(2, 4))
    whole = simulate(scene, **options)
    same(whole, interrupted(scene, tmp_path / "cut.npz", 17, **options))


CHILD = """
import sys
from fem_check.shell.stepping.simulation import simulate
from tests.shell.shell_scenes import planar

def report(progress):
    print(progress.steps, flush=True)

simulate(planar(), snapshot=sys.argv[1], progress=report, periods=1, steps=24, snapshot_every=5)
"""


def test_a_killed_process_is_resumed(tmp_path: Path) -> None:
    """SIGKILL at instants that nobody chose, again and again, until one process comes to the end."""
    path, root = tmp_path / "run.npz", Path(__file__).parents[2]
    whole = simulate(planar(), snapshot=tmp_path / "whole.npz", **OPTIONS)
    for after in (6, 14, 23):  # steps reported since the process was started
        child = subprocess.Popen(
            [sys.executable, "-c", CHILD, str(path)], stdout=subprocess.PIPE, text=True, cwd=root
        )
        with child:
            assert child.stdout is not None
            for line in child.stdout:
                if int(line) >= after:
                    time.sleep(0.001)  # into the middle of a step or of writing a file
                    child.kill()
                    break
        assert child.returncode == -9
    resumed = simulate(planar(), snapshot=path, **OPTIONS)
    assert resumed.resumed_at > 0
    same(whole, resumed)


def stopped(path: Path | None, after: int) -> subprocess.CompletedProcess[str]:
    """CHILD after Ctrl-C in the middle of a step."""
    source = CHILD if path is not None else CHILD.replace("snapshot=sys.argv[1], ", "")
    child = subprocess.Popen(
        [sys.executable, "-c", source, str(path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=Path(__file__).parents[2],
        preexec_fn=interruptible,
    )
    with child:
        assert child.stdout is not None
        assert child.stderr is not None
        for line in child.stdout:
            if int(line) >= after:
                time.sleep(0.002)
                child.send_signal(signal.SIGINT)
                break
        child.stdout.read()
        return subprocess.CompletedProcess([], child.wait(), "", child.stderr.read())


def test_a_run_stopped_by_control_c_keeps_all_its_steps(tmp_path: Path) -> None:
    """More steps than the last multiple of snapshot_every; resumed it ends with the same bits."""
    path = tmp_path / "run.npz"
    for after in (7, 13):  # of all steps, also those before it was resumed
        left = stopped(path, after)
        assert left.returncode == -signal.SIGINT
        *_, last = left.stderr.splitlines()
        assert "KeyboardInterrupt: simulate was interrupted at t = " in last
        assert f"all kept in {path}; the same call resumes from there" in last
        assert len(left.stderr.splitlines()) < 12  # neither numpy nor the minimiser in the traceback
    with np.load(path) as file:
        assert len(file["rows"]) > 13
    assert sorted(p.name for p in tmp_path.iterdir()) == ["run.npz"]
    resumed = simulate(planar(), snapshot=path, **OPTIONS)
    assert resumed.resumed_at > 0
    same(simulate(planar(), periods=1, steps=24), resumed)


def test_control_c_in_a_further_run_says_that_it_starts_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stopped_there(*_: object) -> float:
        raise KeyboardInterrupt

    path = tmp_path / "run.npz"
    monkeypatch.setattr("fem_check.shell.stepping.further.second_runs.snap_error", stopped_there)
    with pytest.raises(KeyboardInterrupt, match=r"in a further run.*, after all \d+ steps") as told:
        simulate(planar(), snapshot=path, **OPTIONS)
    said = f"kept in {path}, but nothing of the further run; the same call starts it again"
    assert said in str(told.value)
    monkeypatch.undo()
    resumed = simulate(planar(), snapshot=path, **OPTIONS)
    assert resumed.resumed_at == resumed.times[-1]  # no step of the first run is taken again


def test_control_c_without_a_snapshot_says_what_would_have_kept_it() -> None:
    left = stopped(None, 4)
    assert left.returncode == -signal.SIGINT
    assert "which are lost; with snapshot='run.npz'" in left.stderr.splitlines()[-1]


def test_control_c_at_any_place_of_a_step(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Raised by one function after the other that a step goes through, the last ones of it included."""
    scene, options = planar(cells=(1, 2)), {"periods": 1, "steps": 4, "snapshot_every": 3}
    whole = simulate(scene, **options)
    places = [
        (Minimiser, "minimise"), (Ledger, "moment"), (Ledger, "works"), (Record, "add"),
        (Record, "keep"), (Run, "_accept"), (Run, "_land"), (StepSize, "judge"),
    ]  # fmt: skip

    def striking(original: Callable[..., object], calls: list[int]) -> Callable[..., object]:
        def struck(*arguments: object, **options: object) -> object:
            result = original(*arguments, **options)
            calls[0] -= 1
            if calls[0] == 0:
                raise KeyboardInterrupt
            return result

        return struck

    for number in range(14, 24):  # two steps and a bit of eight places each, after those of the start
        path, calls = tmp_path / f"{number}.npz", [number]
        with monkeypatch.context() as patch:
            for owner, name in places:
                patch.setattr(owner, name, striking(getattr(owner, name), calls))
            with pytest.raises(KeyboardInterrupt, match="all kept in"):
                simulate(scene, snapshot=path, **options)
        resumed = simulate(scene, snapshot=path, **options)
        assert resumed.resumed_at > 0
        same(whole, resumed)


def test_control_c_where_the_disk_is_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was written before stays, and the message says so."""
    path = tmp_path / "run.npz"

    def full(*_: object, **__: object) -> None:
        raise OSError("no space left")

    def stop(progress: object) -> None:
        if progress.steps == 7:
            monkeypatch.setattr(np, "savez", full)
            raise KeyboardInterrupt

    with pytest.raises(
        KeyboardInterrupt, match=r"run.npz: cannot be written: no space left; it is unchanged"
    ):
        simulate(planar(), snapshot=path, progress=stop, **OPTIONS)
    with np.load(path) as file:
        assert len(file["rows"]) == 6


def no_step(progress: object) -> None:
    pytest.fail("a step was made")


def test_places_where_no_snapshot_can_be_are_refused_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for path, message in (
        (tmp_path / "missing" / "run.npz", "must be in an existing folder"),
        (tmp_path / "file" / "run.npz", "must be in an existing folder"),
        (tmp_path, "must be a file, is a folder"),
        (Path("/proc/run.npz"), "cannot be written there"),
        (tmp_path / (300 * "n"), "cannot be written there"),
    ):
        with pytest.raises(SnapshotError, match=f"snapshot = .*{message}"):
            simulate(planar(), snapshot=path, progress=no_step, **OPTIONS)
    assert [p.name for p in tmp_path.iterdir()] == ["file"]


def test_other_snapshots_of_the_same_run_do_not_matter(tmp_path: Path, written: bytes) -> None:
    """How often they are written; and numpy's numbers are numbers."""
    path = tmp_path / "run.npz"
    path.write_bytes(written)
    options = {"periods": np.int32(1), "steps": np.int64(24), "snapshot_every": np.int64(7)}
    scene = planar(alpha=np.float64(0.25), slip=np.float64(1e-3))
    keep = np.int8(1)
    again = simulate(
        scene, snapshot=path, ramp=np.float64(0.5), keep_every=keep, progress=no_step, **options
    )
    assert again.resumed_at == 1.5


def growing(share: float) -> FieldWave:
    """A wave whose amplitude is larger by a share of it between 0.6 and 0.95 of the period only."""

    def value(x: float, y: float, t: float) -> Array:
        pulse = np.clip(np.sin(np.pi * (t % 1 - 0.6) / 0.35), 0, None) * (t % 1 > 0.6) * (t % 1 < 0.95)
        return (1 + share * pulse) * np.sin(2 * np.pi * (y - t)) + 0 * x

    return FieldWave(value, 1.0)


def bump(height: float) -> Callable[[Array, Array], Array]:
    """A hill far ahead of the sheet, where no point of it lies at the start."""

    def jets(x: Array, y: Array) -> Array:
        s = 8 * (y - 2.0)
        e = height * np.exp(-(s**2))
        zero = 0 * x
        return np.stack([e, zero, -16 * s * e, zero, 128 * (2 * s**2 - 1) * e, zero])

    return jets


def on(ground: object) -> Scene:
    scene = lying(cells=(1, 2))
    return scene.but(
        effects=tuple(replace(e, height=ground) if hasattr(e, "height") else e for e in scene.effects),
    )


@pytest.mark.parametrize(
    ("first", "second", "part"),
    [
        (planar(wave=growing(0.0)), planar(wave=growing(1.0)), "wave"),
        (on(bump(0.0)), on(bump(0.3)), "effects"),
        (on(None), on(bump(0.0)), "effects"),
    ],
    ids=["a wave between phases", "a hill ahead", "flat"],
)
def test_functions_are_known_by_what_they_are(
    tmp_path: Path, first: Scene, second: Scene, part: str
) -> None:
    """Their values where and when they were looked at say little about them elsewhere."""
    path, options = tmp_path / "run.npz", {"periods": 1, "steps": 48}

    def stop(progress: object) -> None:
        if progress.steps == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        simulate(first, snapshot=path, progress=stop, **options)
    before = path.read_bytes()
    with pytest.raises(SnapshotError, match=f"another scene .*: different {part}"):
        simulate(second, snapshot=path, progress=no_step, **options)
    assert path.read_bytes() == before


def noisy(seed: int, name: str | None = None) -> FieldWave:
    rng = np.random.default_rng(seed)
    return FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) + 0 * x * rng.normal(), 1.0, name=name)


def test_a_function_that_cannot_be_identified_must_have_a_name(tmp_path: Path) -> None:
    path = tmp_path / "run.npz"
    with pytest.raises(
        SnapshotError, match=r"cannot be identified.*wave.*rng.*FieldWave\(\.\.\., name="
    ) as raised:
        simulate(planar(wave=noisy(0)), snapshot=path, progress=no_step, **OPTIONS)
    assert "snapshot = " in str(raised.value)
    assert not path.exists()
    options = {"periods": 1, "steps": 48}
    simulate(planar(wave=noisy(0, "a sine")), snapshot=path, **options)
    again = simulate(planar(wave=noisy(1, "a sine")), snapshot=path, progress=no_step, **options)
    assert again.resumed_at == 1.5
    with pytest.raises(SnapshotError, match="different wave"):
        simulate(planar(wave=noisy(1, "another")), snapshot=path, progress=no_step, **options)
    simulate(planar(wave=noisy(0)), **options)  # without a snapshot no name is needed


def test_a_name_does_not_cover_another_wave(tmp_path: Path) -> None:
    path, options = tmp_path / "run.npz", {"periods": 1, "steps": 48}
    sine = lambda k: FieldWave(  # noqa: E731
        lambda x, y, t: np.sin(2 * np.pi * (k * y - t)) + 0 * x, 1.0, name="a sine"
    )
    simulate(planar(wave=sine(1)), snapshot=path, **options)
    with pytest.raises(SnapshotError, match="different values of the wave"):
        simulate(planar(wave=sine(2)), snapshot=path, progress=no_step, **options)


def test_long_velocities_and_meshes_are_compared_number_by_number() -> None:
    """The repr of an array leaves out what is in the middle of it."""
    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.25, 0.25, 3), np.linspace(-0.5, 0.5, 801))
    points = mesh.p.copy()
    points[1, 1200] += 1e-9
    scenes = [
        planar(mesh=m, element=skfem.ElementQuad1()) for m in (mesh, skfem.MeshQuad(points, mesh.t))
    ]
    one, other = (fingerprint(scene, Settings()) for scene in scenes)
    assert json.loads(one)["mesh"] != json.loads(other)["mesh"]
    fast = [fingerprint(scenes[0], Settings(velocity=(0.0, v))) for v in (1.0, np.nextafter(1.0, 2.0))]
    assert fast[0] != fast[1]


def test_a_finished_run_is_read_and_not_repeated(tmp_path: Path) -> None:
    path = tmp_path / "run.npz"
    whole = simulate(planar(), snapshot=path, **OPTIONS)
    again = simulate(planar(), snapshot=path, progress=lambda p: pytest.fail("a step"), **OPTIONS)
    same(whole, again)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["run.npz"]


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("snapshot") / "run.npz"
    simulate(planar(), snapshot=path, **OPTIONS)
    return path.read_bytes()


def test_truncated_and_altered_snapshots_are_refused(tmp_path: Path, written: bytes) -> None:
    path = tmp_path / "run.npz"
    for length in (0, 1, 100, len(written) // 2, len(written) - 1):
        path.write_bytes(written[:length])
        with pytest.raises(SnapshotError, match="truncated or damaged"):
            simulate(planar(), snapshot=path, **OPTIONS)
    rng = np.random.default_rng(0)
    for place in rng.integers(0, len(written), 20):
        altered = bytearray(written)
        altered[place] ^= 0x10
        path.write_bytes(bytes(altered))
        try:
            load_snapshot(path, load_owner(written, tmp_path))
        except SnapshotError:
            continue
        # A flipped bit in a name or date of the archive that nothing reads changes no number.
        with np.load(path) as file, np.load(whole(written, tmp_path)) as original:
            for name in original.files:
                np.testing.assert_array_equal(file[name], original[name])


def whole(written: bytes, folder: Path) -> Path:
    path = folder / "whole.npz"
    path.write_bytes(written)
    return path


def load_owner(written: bytes, folder: Path) -> str:
    with np.load(whole(written, folder)) as file:
        return str(file["fingerprint"])


def test_a_snapshot_with_other_numbers_is_refused(tmp_path: Path, written: bytes) -> None:
    """Rewritten as a valid archive, so that only the checksum tells."""
    path = tmp_path / "run.npz"
    with np.load(whole(written, tmp_path)) as file:
        arrays = {name: file[name] for name in file.files}
    arrays["past_states"] = arrays["past_states"] * (1 + 1e-15)
    np.savez(path, **arrays)
    with pytest.raises(SnapshotError, match="altered"):
        simulate(planar(), snapshot=path, **OPTIONS)


def test_other_versions_and_other_files_are_refused(tmp_path: Path, written: bytes) -> None:
    path = tmp_path / "run.npz"
    with np.load(whole(written, tmp_path)) as file:
        arrays = {name: file[name] for name in file.files}
    old = {name: array for name, array in arrays.items() if name != "python"}
    for version, contents in ((99, arrays), (1, old)):
        np.savez(path, **{**contents, "version": np.array(version)})
        with pytest.raises(SnapshotError, match=rf"version {version}, must be {VERSION} .*; remove"):
            simulate(planar(), snapshot=path, **OPTIONS)
    np.savez(path, x=np.ones(3))
    with pytest.raises(SnapshotError, match="not a snapshot"):
        simulate(planar(), snapshot=path, **OPTIONS)
    np.savez(path, x=np.array([{}], dtype=object))
    with pytest.raises(SnapshotError, match="damaged"):
        simulate(planar(), snapshot=path, **OPTIONS)


@pytest.mark.parametrize(
    ("scene", "options"),
    [
        (planar(alpha=0.2500001), OPTIONS),
        (planar(slip=2e-3), OPTIONS),
        (planar(cells=(2, 5)), OPTIONS),
        (planar(load="grown"), OPTIONS),
        (planar().but(growth_law="linear"), OPTIONS),
        (planar(), {**OPTIONS, "steps": 25}),
        (planar(), {**OPTIONS, "periods": 2}),
        (planar(), {**OPTIONS, "keep_every": 2}),
        (planar(), {**OPTIONS, "ramp": 0.25}),
    ],
)
def test_a_snapshot_of_another_run_is_refused(
    tmp_path: Path, written: bytes, scene: Scene, options: dict[str, int]
) -> None:
    path = tmp_path / "run.npz"
    path.write_bytes(written)
    with pytest.raises(SnapshotError, match="another scene"):
        simulate(scene, snapshot=path, **options)
    assert path.read_bytes() == written


def test_writing_fails_without_harm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The old file stays and no other is left behind."""
    path = tmp_path / "run.npz"
    save_snapshot(path, {"a": np.arange(3.0)}, "owner")

    def full(*_: object, **__: object) -> None:
        raise OSError("no space left")

    monkeypatch.setattr(np, "savez", full)
    with pytest.raises(OSError, match="no space"):
        save_snapshot(path, {"a": np.arange(4.0)}, "owner")
    assert load_snapshot(path, "owner")["a"].size == 3
    assert len(list(tmp_path.iterdir())) == 1


def test_files_that_are_no_snapshots_and_values_that_are_no_paths(tmp_path: Path) -> None:
    """An array of numpy, an archive of something else, a version of two numbers."""
    scene, path = planar(cells=(1, 2)), tmp_path / "run.npz"
    for save in (
        lambda file: np.save(file, np.arange(3)),
        lambda file: np.savez(file, a=np.arange(3)),
        lambda file: np.savez(file, version=np.array([1, 2])),
    ):
        with open(path, "wb") as file:
            save(file)
        with pytest.raises(SnapshotError, match="snapshot"):
            simulate(scene, periods=1, steps=4, snapshot=path)
    for value in (5, "", b"run.npz"):
        with pytest.raises(ValueError, match=r"snapshot = .*: must be the path of a file"):
            simulate(scene, periods=1, steps=4, snapshot=value)
    with pytest.raises(ValueError, match="progress = 3: must be True, False or a function"):
        simulate(scene, periods=1, steps=4, progress=3)

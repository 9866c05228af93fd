"""Snapshots: a run that is killed and resumed ends with the same bits; damaged files are refused."""

import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fem_check.shell.scene import Scene
from fem_check.shell.stepping.paraview import write_paraview
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.snapshot import SnapshotError, load_snapshot, save_snapshot
from fem_check.shell.stepping.trajectory import Trajectory
from tests.shell_scenes import lying, planar

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
    whole = simulate(planar(), snapshot=tmp_path / "whole.npz", **OPTIONS)
    resumed = interrupted(planar(), tmp_path / "cut.npz", steps, **OPTIONS)
    assert np.isnan(resumed.resumed_at) == (steps < 5)
    same(whole, resumed)


@pytest.mark.parametrize("load", ["grown", "current"])
def test_with_ground_damping_and_adaptive_steps(tmp_path: Path, load: str) -> None:
    options = {"periods": 1, "rtol": 0.03, "snapshot_every": 7, "keep_every": 3}
    scene = lying(slip=0.05, damping=2.5e-7, load=load, cells=(2, 4))
    whole = simulate(scene, snapshot=tmp_path / "whole.npz", **options)
    same(whole, interrupted(scene, tmp_path / "cut.npz", 17, **options))


CHILD = """
import sys
from fem_check.shell.stepping.simulation import simulate
from tests.shell_scenes import planar

def report(progress):
    print(progress.steps, flush=True)

simulate(planar(), snapshot=sys.argv[1], progress=report, periods=1, steps=24, snapshot_every=5)
"""


def test_a_killed_process_is_resumed(tmp_path: Path) -> None:
    """SIGKILL at instants that nobody chose, again and again, until one process comes to the end."""
    path, root = tmp_path / "run.npz", Path(__file__).parents[1]
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
    np.savez(path, **{**arrays, "version": np.array(99)})
    with pytest.raises(SnapshotError, match="version 99"):
        simulate(planar(), snapshot=path, **OPTIONS)
    np.savez(path, x=np.ones(3))
    with pytest.raises(SnapshotError, match="no snapshot"):
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
        (replace(planar(), growth_law="linear"), OPTIONS),
        (planar(), {**OPTIONS, "steps": 25}),
        (planar(), {**OPTIONS, "periods": 2}),
        (planar(), {**OPTIONS, "snapshot_every": 6}),
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


def test_paraview_reads_what_was_written(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    scene = planar()
    trajectory = simulate(scene, periods=1, steps=16, keep_every=6)
    path = tmp_path / "crawl.xdmf"
    write_paraview(trajectory, path, refine=1)
    with meshio.xdmf.TimeSeriesReader(path) as reader:
        points, cells = reader.read_points_cells()
        assert reader.num_steps == trajectory.stored_times.size
        assert cells[0].type == "quad"
        time_read, data, _ = reader.read_data(reader.num_steps - 1)
    assert time_read == pytest.approx(1.5)
    moved = trajectory.positions(1.5, points[:, :2].T)
    # XML holds all digits of a double
    np.testing.assert_allclose(points[:, :2].T + data["displacement"].T[:2], moved, atol=1e-14)
    np.testing.assert_allclose(data["growth"], scene.growth(1.5, *points[:, :2].T), atol=1e-14)

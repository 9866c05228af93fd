"""Sweeps in one process: records, failures, what is kept and gone on with, exports, the command."""

import contextlib
import csv
import json
import math
import resource
import signal
import sqlite3
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fem_check import Scene, predict, sweep
from fem_check.command import program
from fem_check.files import RunSettings
from fem_check.sweeps import Between, Grid, LatinHypercube, Sweep, expected, kept, run
from fem_check.sweeps.plan import plan_of
from fem_check.sweeps.records import store as stores
from fem_check.sweeps.records.opening import reading, writing
from fem_check.sweeps.records.record import Record, State
from fem_check.sweeps.records.store import Store, checksum
from fem_check.sweeps.running import RefusedScenes
from fem_check.sweeps.work import cluster
from fem_check.sweeps.work.answering import Task, record_of
from fem_check.sweeps.work.bound import OutOfTime, bounded
from linear_theory import FieldWave, Sheet, SheetcrawlError, SineWave
from linear_theory.common import extras
from linear_theory.speed.result import ENERGIES
from tests.sweeps import sweep_cases

BASE = Scene(Sheet(), SineWave(), alpha=0.1)


def free_sweep(path: Path, count: int = 20, **options: Any) -> Sweep:
    return run(sweep_cases.plan(count), path, workers=1, **{"answering": sweep_cases.free, **options})


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "speeds.sqlite"


def test_records_are_what_predict_says(file: Path) -> None:
    over = {"growth.alpha": [0.05, 0.2], "sheet.width": [0.2, 0.5]}
    found = sweep(BASE, over, file, rtol=0.05, workers=1)
    assert found.complete
    for (alpha, width), record in found.rows():
        alone = predict(BASE.but(alpha=alpha, sheet=Sheet(width=width)), rtol=0.05)
        assert record is not None
        assert (record.mean, record.error, record.level) == (alone.mean, alone.error, alone.level)
        assert record.converged is alone.converged
        for name in ENERGIES:
            value, error = getattr(alone, name)
            assert (getattr(record, name), getattr(record, f"{name}_error")) == (value, error)
            nonlinear = alone.level == "cycle"  # others have a distance to it
            assert (error > getattr(alone.speed, name).error) is not nonlinear
        assert record.cost_of_transport == pytest.approx(record.power / abs(record.mean))  # type: ignore[operator]
        assert Scene.from_dict(json.loads(record.scene)) == alone.scene
        assert record.cpu_seconds is not None
        assert record.cpu_seconds > 0


def test_a_level_by_its_name(file: Path) -> None:
    found = sweep(BASE, {"growth.alpha": [0.1]}, file, level="first order", rtol=0.05, workers=1)
    (record,) = [record for _, record in found.rows()]
    assert record is not None
    assert record.mean == predict(BASE, rtol=0.05, level="first order").mean


def test_what_is_kept_is_not_computed_again(file: Path) -> None:
    calls: list[str] = []

    def counted(task: Task) -> Record:
        calls.append(task.key)
        if len(calls) == 8:
            raise KeyboardInterrupt
        return sweep_cases.free(task)

    with pytest.raises(
        KeyboardInterrupt, match=r"interrupted; 7 of 20 records are kept in .*: the same"
    ):
        free_sweep(file, answering=counted)
    assert not kept(file).complete
    before = [record for _, record in kept(file).rows()][:7]
    assert free_sweep(file, answering=counted).complete
    assert len(calls) == 21
    assert len(set(calls)) == 20
    assert [record for _, record in kept(file).rows()][:7] == before
    free_sweep(file, answering=counted)
    assert len(calls) == 21


def test_scenes_that_are_the_same_are_answered_once(file: Path) -> None:
    calls: list[str] = []

    def counted(task: Task) -> Record:
        calls.append(task.key)
        return sweep_cases.free(task)

    plan = plan_of(BASE, {"growth.alpha": [0.1, 0.2, 0.1]}, Grid(), RunSettings())
    found = run(plan, file, workers=1, answering=counted)
    assert (len(calls), found.size, found.counts) == (2, 3, {"answered": 2})
    assert [record and record.mean for _, record in found.rows()][::2] == [pytest.approx(0.005)] * 2
    other = plan_of(BASE, {"growth.alpha": [0.2, 0.3]}, Grid(), RunSettings())
    assert run(other, file, workers=1, answering=counted).complete
    assert len(calls) == 3  # sweeps in one file share their records
    with pytest.raises(ValueError, match="holds 2 sweeps, must be one"):
        kept(file)


def failing(task: Task) -> Record:
    """Every way to end, by alpha."""
    if task.question.scene.alpha < 0.1:
        return record_of(task._replace(seconds=0.02))
    return record_of(task)


def test_failures_are_records_with_their_reason(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def solved(question: Any) -> Any:
        alpha = question.scene.alpha
        if alpha == 0.01:
            while True:
                math.sin(alpha)
        if alpha == 0.2:
            raise ValueError("alpha = 0.2: must be\n smaller")
        if alpha == 0.3:
            raise MemoryError("no room")
        return predict(question.scene, rtol=0.1)

    monkeypatch.setattr("fem_check.sweeps.work.answering.solved", solved)
    plan = plan_of(BASE, {"growth.alpha": [0.01, 0.1, 0.2, 0.3]}, Grid(), RunSettings(rtol=0.1))
    found = run(plan, file, workers=1, answering=failing)
    assert found.counts == {"answered": 1, "refused": 1, "could not": 1, "out of time": 1}
    told = {record.state: record.reason for _, record in found.failures()}
    assert told == {
        "out of time": "no answer within 0.02 s",
        "refused": "alpha = 0.2: must be smaller",
        "could not": "MemoryError: no room",
    }
    assert all(record.mean is None and record.scene for _, record in found.failures())
    monkeypatch.setattr("fem_check.sweeps.work.answering.solved", lambda q: predict(q.scene, rtol=0.1))
    assert run(plan, file, workers=1).failed == 3
    assert run(plan, file, workers=1, retry=True).failed == 0


def swallow_everything() -> None:
    while True:
        with contextlib.suppress(Exception):
            sum(range(1000))


def test_the_bound_ends_work_and_nothing_after_it() -> None:
    with pytest.raises(OutOfTime), bounded(0.02):
        swallow_everything()
    for _ in range(200):  # the end and the bound at about the same time
        with contextlib.suppress(OutOfTime), bounded(1e-4):
            time.sleep(1e-4)
    sum(range(100_000))


def test_warnings_are_kept(file: Path) -> None:
    scene = BASE.resting(friction="tanh", slip_speed=1.0)
    found = sweep(scene, {"growth.alpha": [0.1]}, file, level="strip", rtol=0.1, workers=1)
    (record,) = [record for _, record in found.rows()]
    assert record is not None
    assert "viscous" in record.warnings
    assert record.regime == "viscous"


def test_scenes_that_cannot_be_are_refused_before_any_work(file: Path) -> None:
    over = {"sheet.poisson": [0.2, 0.7, 0.9], "growth.alpha": [0.1, 0.2]}
    with pytest.raises(RefusedScenes) as refused:
        sweep(BASE, over, file, workers=1)
    assert refused.value.mistakes == (
        "[sheet] poisson = 0.7: must be in (-1, 0.5] (2 of 6 scenes)",
        "[sheet] poisson = 0.9: must be in (-1, 0.5] (2 of 6 scenes)",
    )
    with reading(file) as store:
        assert store.sweeps() == []
    many = {"sheet.poisson": [1.0 + k for k in range(9)]}
    with pytest.raises(RefusedScenes, match="and 4 more reasons"):
        sweep(BASE, many, file, workers=1)
    carried = {"gravity.weight": [1e-4], "ground.stiffness": [0.5]}
    with pytest.raises(RefusedScenes, match="Ground"):
        sweep(BASE, carried, file, level="strip", workers=1)
    rng = np.random.default_rng(0)
    unnamed = Scene(Sheet(), FieldWave(lambda x, y, t: rng.normal() + 0 * x, 1.0), alpha=0.1)
    with pytest.raises(ValueError, match="rng"):
        sweep([unnamed], None, file, workers=1)


def test_files_that_cannot_be_used(file: Path, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="is a folder, must be a file"):
        free_sweep(tmp_path)
    file.write_text("no database at all, but some text " * 100)
    with pytest.raises(ValueError, match="is not a database of sweeps; name another file"):
        free_sweep(file)
    assert file.read_text().startswith("no database")
    other = tmp_path / "other.sqlite"
    with sqlite3.connect(other) as db:
        db.execute("CREATE TABLE mine (a)")
    db.close()
    with pytest.raises(ValueError, match="is a database, but not of sweeps"):
        free_sweep(other)
    with pytest.raises(ValueError, match="there is no such file"):
        kept(tmp_path / "none.sqlite")
    with pytest.raises(ValueError, match="cannot be written: its folder is a file"):
        free_sweep(other / "speeds.sqlite")
    with pytest.raises(ValueError, match="workers = 0: must be >= 1"):
        run(sweep_cases.plan(8), tmp_path / "new.sqlite", workers=0)
    free_sweep(tmp_path / "new.sqlite")
    with sqlite3.connect(tmp_path / "new.sqlite") as db:
        db.execute("PRAGMA user_version = 7")
    db.close()
    with pytest.raises(ValueError, match="is of version 7, this program writes and reads version 3"):
        free_sweep(tmp_path / "new.sqlite")


def test_one_file_is_written_by_one_sweep_and_may_be_read_meanwhile(file: Path) -> None:
    seen = []

    def looked(task: Task) -> Record:
        if not seen:
            with pytest.raises(ValueError, match=r"another sweep is at work in it \(process \d+ on "):
                free_sweep(file)
        seen.append(kept(file).counts.get("answered", 0))
        return sweep_cases.free(task)

    assert free_sweep(file, answering=looked).complete
    assert seen == list(range(20))


def test_full_disks_keep_what_is_there(file: Path) -> None:
    def full(store: Store, record: Record, keep: Callable[..., None] = Store.keep) -> None:
        store._db.execute("PRAGMA max_page_count = 1")
        keep(store, replace(record, reason="a" * 100_000))

    done: list[str] = []

    def answering(task: Task) -> Record:
        done.append(task.key)
        if len(done) == 6:
            stores.Store.keep = full  # type: ignore[method-assign]
        return sweep_cases.free(task)

    keep = stores.Store.keep
    try:
        with pytest.raises(
            SheetcrawlError, match="cannot be written: database or disk is full; 5 of 20 rec"
        ):
            free_sweep(file, answering=answering)
    finally:
        stores.Store.keep = keep  # type: ignore[method-assign]
    assert kept(file).counts == {"answered": 5, "open": 15}
    assert free_sweep(file).complete


def test_a_file_that_may_not_grow(file: Path) -> None:
    """As a quota does it: the operating system refuses to write."""
    free_sweep(file, 20)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (file.stat().st_size, before[1]))
    try:
        with pytest.raises((SheetcrawlError, ValueError), match="cannot be"):
            free_sweep(file, 400)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert kept(file).complete


def test_another_program_that_reads_scenes_differently_is_told(file: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        free_sweep(file, answering=stopped)
    with sqlite3.connect(file) as db:
        *row, _ = db.execute("SELECT * FROM points WHERE place = 3").fetchone()
        row[-1] = "[0.5, 0.5]"
        db.execute("UPDATE points SET given = ?, crc32 = ? WHERE place = 3", (row[-1], checksum(row)))
    db.close()
    with pytest.raises(SheetcrawlError, match="reads a scene of the sweep differently"):
        free_sweep(file)


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ("UPDATE records SET mean = mean * 2 WHERE key = (SELECT MAX(key) FROM records)", "a record"),
        ("UPDATE records SET converged = 1 - converged", "a record"),
        ("UPDATE points SET given = '[0.5, 0.5]' WHERE place = 3", "a point"),
        ('UPDATE sweeps SET units = \'["mm", "s"]\'', "a sweep"),
        ("UPDATE records SET worker = x'ff00'", "a record"),
    ],
)
def test_a_number_that_was_damaged_is_not_believed(
    file: Path, change: str, named: str, capsys: Any
) -> None:
    list(free_sweep(file, 8).rows())
    with sqlite3.connect(file) as db:
        db.execute(change)
    db.close()
    with pytest.raises(SheetcrawlError, match=rf"is damaged \({named} is not what was written\)"):
        list(kept(file).rows())
    status, out, err = command(capsys, "sweep", str(file))
    assert (status, out, err.count("\n")) == (1, "", 1)
    assert f"is damaged ({named} is not" in err


def test_a_schema_that_is_no_text_is_said_to_be_damage(file: Path) -> None:
    free_sweep(file, 8)
    file.write_bytes(file.read_bytes().replace(b"CREATE TABLE sweeps", b"CR\xe3ATE TABLE sweeps"))
    with pytest.raises(ValueError, match=r"file = '.*': is damaged \("):
        list(kept(file).rows())


def stopped(task: Task) -> Record:
    """At once."""
    raise KeyboardInterrupt


def test_without_dask_one_worker_is_enough(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(package: str) -> Any:
        raise ModuleNotFoundError(f"No module named {package!r}", name=package)

    monkeypatch.setattr(extras.importlib, "import_module", missing)
    words = r"needs distributed: pip install 'sheetcrawl\[sweep\]'"
    with pytest.raises(ModuleNotFoundError, match=words):
        run(sweep_cases.plan(8), file, workers=2, answering=sweep_cases.free)
    assert not file.exists()
    assert free_sweep(file).complete
    with pytest.raises(ModuleNotFoundError, match=words):
        cluster.require_dask()


def test_progress_counts_failures_and_tells_what_is_left(file: Path) -> None:
    heard = []

    def late(task: Task) -> Record:
        state = State.LATE if task.question.scene.alpha < 0.02 else State.ANSWERED
        return replace(sweep_cases.free(task), state=str(state))

    free_sweep(file, answering=late, progress=heard.append)
    assert heard[-1].task == "20 of 20 scenes, 4 failed"
    assert heard[-1].share == 1.0
    assert heard[-1].left == 0.0


def test_tables_and_arrays_hold_the_same(file: Path, tmp_path: Path) -> None:
    import pandas
    import xarray

    found = free_sweep(file)
    want = {(a, p): a**2 * (1 + p) / 3 for (a, p), _ in found.rows()}
    table = found.to_dataframe()
    assert table.shape[0] == 20
    for _, row in table.iterrows():
        assert row["mean"] == want[row["growth.alpha"], row["sheet.poisson"]]
    assert table.attrs["units"]["mean"] == "length/time"
    arrays = xarray.load_dataset(found.export(tmp_path / "v.nc"), engine="scipy")
    assert arrays["mean"].dims == ("growth_alpha", "sheet_poisson")
    for (alpha, poisson), mean in want.items():
        assert float(arrays["mean"].sel(growth_alpha=alpha, sheet_poisson=poisson)) == mean
    assert json.loads(arrays.attrs["definition"])["over"][0]["path"] == "growth.alpha"
    with open(found.export(tmp_path / "v.csv"), newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert [float(row["mean [length/time]"]) for row in rows] == list(table["mean"])
    again = pandas.read_parquet(found.export(tmp_path / "v.parquet"))
    assert list(again["mean"]) == list(table["mean"])
    with pytest.raises(ValueError, match=r"must end in \.nc or \.csv or \.parquet"):
        found.export(tmp_path / "v.xls")


def test_open_and_failed_scenes_are_in_the_tables(file: Path, tmp_path: Path) -> None:
    def some(task: Task) -> Record:
        if task.question.scene.alpha > 0.1:
            raise KeyboardInterrupt
        return replace(sweep_cases.free(task), state="refused", mean=None, converged=None)

    with pytest.raises(KeyboardInterrupt):
        free_sweep(file, answering=some)
    found = kept(file)
    table = found.to_dataframe()
    assert set(table["state"]) == {"refused", "open"}
    assert table["mean"].isna().all()
    assert found.to_xarray()["converged"].values.min() == -1
    for suffix in ("nc", "csv", "parquet"):
        assert found.export(tmp_path / f"v.{suffix}").exists()


def test_random_designs_are_rows(file: Path) -> None:
    design = LatinHypercube(12, seed=3)
    plan = plan_of(BASE, {"growth.alpha": Between(0.1, 0.2)}, design, RunSettings())
    arrays = run(plan, file, workers=1, answering=sweep_cases.free).to_xarray()
    assert arrays["mean"].dims == ("scene",)
    assert np.allclose(arrays["mean"], arrays["growth_alpha"] ** 2 / 2)


def test_the_cost_is_foretold_by_the_levels_and_then_as_measured(file: Path) -> None:
    plan = sweep_cases.plan(20)
    before = expected(plan, file, workers=2)
    assert (before.scenes, before.open, before.measured, before.workers) == (20, 20, 0, 2)

    def dear(task: Task) -> Record:
        if task.question.scene.alpha > 0.1:
            raise KeyboardInterrupt
        return replace(sweep_cases.free(task), cpu_seconds=5.0)

    with pytest.raises(KeyboardInterrupt):
        run(plan, file, workers=1, answering=dear)
    after = expected(plan, file, workers=2)
    assert (after.measured, after.each, after.open) == (8, 5.0, 12)
    assert after.seconds == pytest.approx(30.0)


def command(capsys: Any, *words: str) -> tuple[int, str, str]:
    with pytest.raises(SystemExit) as ended:
        program.main(words)
    said = capsys.readouterr()
    return int(ended.value.code or 0), said.out, said.err


QUICK = """
[scene.growth]
alpha = 0.1
[over]
growth.alpha = [0.05, 0.1]
[sweep]
level = "strip"
"""


def test_the_command(capsys: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text(QUICK.replace("[sweep]", "[scene.run]\nrtol = 0.9\n[sweep]"))
    status, out, _ = command(capsys, "sweep", "mine.toml", "--dry-run")
    assert status == 0
    assert "2 scenes over growth.alpha" in out
    assert not Path("mine.sqlite").exists()
    status, out, _ = command(
        capsys, "sweep", "mine.toml", "--workers", "1", "--export", "v.csv", "v.nc"
    )
    assert status == 0
    assert "answered  2 of 2" in out
    assert Path("v.csv").exists()
    assert Path("v.nc").exists()
    status, out, _ = command(capsys, "sweep", "mine.sqlite", "--export", "v.parquet")
    assert status == 0
    assert Path("v.parquet").exists()
    status, out, _ = command(capsys, "sweep", "mine.toml", "--dry-run", "--workers", "1")
    assert "all have a record" in out


def test_the_command_says_by_its_status_what_is_not_met(
    capsys: Any, tmp_path: Path, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text(QUICK)  # a strip is not within 1 % of the sheet
    status, out, _ = command(capsys, "sweep", "mine.toml", "--workers", "1")
    assert status == 1
    assert "2 of 2, 2 of them miss their tolerance" in out
    cases = {
        ("none.toml",): "none.toml: there is no such file",
        ("mine.sqlite", "--dry-run"): "--dry-run: needs a sweep file",
        ("none.sqlite",): "file = 'none.sqlite': there is no such file",
        ("mine.toml", "--export", "v.xls"): "must end in .nc or .csv or .parquet",
        ("mine.toml", "--workers", "0"): "workers = 0: must be >= 1",
        ("mine.toml", "--out", "."): "is a folder, must be a file",
    }
    for words, said in cases.items():
        status, _, err = command(capsys, "sweep", *words)
        assert (status, err.count("\n")) == (2, 1), err
        assert said in err
    Path("bad.toml").write_text("[scene.growth]\nalpha = 0.1\n[over]\nsheet.poisson = [0.7, 0.8]\n")
    status, _, err = command(capsys, "sweep", "bad.toml", "--workers", "1")
    assert status == 2
    assert "sheetcrawl: bad.toml:4: [sheet] poisson = 0.7: must be in (-1, 0.5] (1 of 2 scenes)" in err
    assert err.count("\n") == 2


def test_the_example_and_the_schema(
    capsys: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert command(capsys, "new", "sweep")[0] == 0
    assert "12 scenes over" in command(capsys, "sweep", "sweep.toml", "--dry-run")[1]
    assert command(capsys, "new", "sweep")[0] == 2
    assert json.loads(command(capsys, "schema", "--sweep")[1])["title"] == "Sweep"


def test_writing_leaves_nothing_open(file: Path) -> None:
    with writing(file):
        pass
    assert not Path(f"{file}-wal").exists()

"""Sweeps on the workers of a Dask cluster, and sweeps that are killed."""

import json
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from fem_check.command.status import INTERRUPTED
from fem_check.sweeps import run
from fem_check.sweeps.work import flight
from fem_check.sweeps.work.answering import Task
from linear_theory import SheetcrawlError
from tests.sweeps import sweep_cases, sweep_kills, sweeps_page

distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, dashboard_address=":0", silence_logs=1000
    ) as made:
        yield made


def test_a_cluster_gives_the_same_numbers(cluster: Any, tmp_path: Path) -> None:
    plan = sweep_cases.plan(40)
    there = run(plan, tmp_path / "there.sqlite", scheduler=cluster.scheduler_address)
    here = run(plan, tmp_path / "here.sqlite", workers=1)
    assert there.complete
    pairs = zip(there.rows(), here.rows(), strict=True)
    assert all(a and b and (a.mean, a.error) == (b.mean, b.error) for (_, a), (_, b) in pairs)
    workers = {record.worker for _, record in there.rows() if record is not None}
    assert workers.isdisjoint(record.worker for _, record in here.rows() if record is not None)


@pytest.mark.parametrize(
    ("answering", "words"),
    [
        (
            sweep_cases.broken,
            "ModuleNotFoundError: No module named 'fem_check'; they need the same sheetc",
        ),
        (sweep_cases.old, "has sheetcrawl 0.0.1, this is"),
    ],
)
def test_workers_that_cannot_answer_are_told(
    answering: Any, words: str, cluster: Any, tmp_path: Path
) -> None:
    with pytest.raises(SheetcrawlError, match=words):
        run(sweep_cases.plan(8), tmp_path / "v.sqlite", scheduler=cluster, answering=answering)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense", "foo://a:1", 3])
def test_no_scheduler_at_the_address(
    address: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fem_check.sweeps.work.cluster.PATIENCE", 1.0)
    start = time.monotonic()
    with pytest.raises(ValueError, match=r"scheduler = .*: no scheduler answers there within 1 s"):
        run(sweep_cases.plan(8), tmp_path / "v.sqlite", scheduler=address)
    assert time.monotonic() - start < 30


def test_a_scene_with_which_workers_die_is_a_record_and_the_rest_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whichever worker takes it dies, with the scenes that wait there: these are answered."""
    log = tmp_path / "deaths"
    monkeypatch.setenv(sweep_cases.LOG, str(log))
    plan = sweep_cases.plan(8)
    found = run(plan, tmp_path / "d.sqlite", workers=2, answering=sweep_cases.deadly)
    assert found.counts == {"answered": 7, "could not": 1}
    (failed,) = (record for _, record in found.rows() if record and record.state != "answered")
    assert failed.key == plan.question(next(plan.points())).key()
    assert "its worker died all 3 times that it was tried, at last with no other scene" in failed.reason
    assert log.read_text().split() == [failed.key] * flight.TRIES


def test_suspects_are_tried_alone_and_the_innocent_are_answered() -> None:
    plan = sweep_cases.plan(8)
    tasks = [Task(q.key(), q, 60.0) for q in map(plan.question, plan.points())]
    suspects = flight.Suspects()
    for task in tasks[:2]:
        for _ in range(2 * flight.TRIES):  # never together with others: it may be their fault
            assert suspects.died(task, 1, alone=False) is None
    assert list(suspects.waiting) == [task for task in tasks[:2] for _ in range(2 * flight.TRIES)]
    record = suspects.died(tasks[0], 1, alone=True)
    assert record is not None
    assert (record.key, record.state, record.mean) == (tasks[0].key, "could not", None)


class Cluster:
    """A local cluster that lost its workers, as Dask's clients see it."""

    def __init__(self) -> None:
        self.worker_spec, self.asked = {0: {}, 1: {}}, 0

    def scale(self, workers: int) -> None:
        self.asked = workers


def test_workers_that_do_not_come_back_are_replaced_and_not_waited_for_without_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = [0.0]
    monkeypatch.setattr(flight.time, "monotonic", lambda: clock[0])
    cluster = type("LocalCluster", (Cluster,), {})()
    workers = flight.Workers(SimpleNamespace(cluster=cluster, nthreads=dict))
    workers.look()
    workers.check()
    assert cluster.asked == 2
    clock[0] = flight.GONE_HERE + 1
    workers.look()
    with pytest.raises(SheetcrawlError, match="all workers have died, and none has come for 120 s"):
        workers.check()


KILLS = {
    11: sweep_kills.ALONE,
    12: sweep_kills.ALONE,
    13: sweep_kills.CLIENT,
    14: sweep_kills.WORKER,
    15: sweep_kills.SCHEDULER,
}


SCENES = 48
"""Enough for a kill in the middle; the page has a hundred kills of sweeps of 200."""


@pytest.mark.parametrize("seed", KILLS)
def test_nothing_is_lost_and_nothing_comes_twice(seed: int, tmp_path: Path) -> None:
    found = sweep_kills.trial(KILLS[seed], seed, tmp_path, SCENES)
    assert found.fine, found


SLOW = """
[scene.growth]
alpha = 0.1
[over]
growth.alpha = { low = 0.01, high = 0.1, count = 50 }
[sweep]
level = "second order"
"""


def test_ctrl_c_keeps_the_records_and_says_how_to_go_on(tmp_path: Path) -> None:
    (tmp_path / "slow.toml").write_text(SLOW)
    words = [sys.executable, "-m", "fem_check", "sweep", "slow.toml", "--workers", "1"]
    environment = {**sweep_kills.environment(), "PYTHONPATH": str(Path(__file__).parents[2])}
    child = subprocess.Popen(
        words,
        cwd=tmp_path,
        env=environment,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # a shell that runs the tests in its background lets them, and their children, ignore it
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    sweep_kills.wait_until(lambda: sweep_kills.count(tmp_path / "slow.sqlite") > 1)
    child.send_signal(signal.SIGINT)
    _, said = child.communicate(timeout=sweep_kills.PATIENCE)
    assert child.returncode == INTERRUPTED
    (line,) = said.splitlines()
    assert (
        "of 50 records are kept in slow.sqlite, the rest follows by: sheetcrawl sweep slow.toml" in line
    )
    assert shlex.split(line.partition(": sheetcrawl ")[2]) == ["sweep", "slow.toml", "--workers", "1"]


def test_the_page_is_that_of_its_numbers() -> None:
    data = json.loads(sweeps_page.DATA.read_text())
    assert sweeps_page.page(data) == sweeps_page.PAGE.read_text()
    assert len(data["kills"]) >= 100
    assert all(one["fine"] for one in data["kills"])
    assert data["cost"]["overhead"] < 5e-3


def test_a_job_for_slurm_is_as_the_page_says() -> None:
    jobqueue = pytest.importorskip("dask_jobqueue")
    job = jobqueue.slurm.SLURMJob(
        scheduler="tcp://10.0.0.1:8786",
        name="sheetcrawl",
        job_name="sheetcrawl",
        cores=16,
        processes=16,
        memory="16GB",
        walltime="24:00:00",
        python="python",
    )
    script = job.job_script()
    for line in ("-J sheetcrawl", "--cpus-per-task=16", "--mem=15G", "-t 24:00:00"):
        assert f"#SBATCH {line}" in script
    assert "distributed.cli.dask_worker tcp://10.0.0.1:8786" in script
    assert "--nworkers 16" in script
    assert "--nthreads 1" in script

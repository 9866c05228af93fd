"""The same random questions in threads, spawned processes, with many BLAS threads, beside busy cores.

    python -m tests.robust.trials.settings

Writes figures/data/random_settings.csv, a few minutes on two cores. Every answer must have the bits of
the one that was found alone.
"""

import multiprocessing
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass

from threadpoolctl import threadpool_limits

from figures.common.folders import DATA
from figures.common.records import Table
from tests.robust.trials.families import outcome
from tests.robust.trials.outcome import Outcome
from tests.robust.trials.table import SEED

QUESTIONS = [
    (family, number)
    for family, count in (("line", 16), ("speed", 12), ("direction", 5), ("bent", 4), ("prediction", 3))
    for number in range(count)
]

THREADS, PROCESSES, BLAS, BUSY = 4, 2, 8, 2


@dataclass(frozen=True)
class Row:
    """How all questions were asked: how many, and how many answers had other bits than alone."""

    setting: str
    asked: int
    different: int


TABLE = Table(
    DATA / "random_settings.csv",
    Row,
    "python -m tests.robust.trials.settings",
    f"seed {SEED}",
    3,
)


def answer(question: tuple[str, int]) -> Outcome:
    """Numbers of one question and of the better answer to it, and the words of refusals."""
    family, number = question
    return outcome.__wrapped__(family, SEED, number)


def alone() -> list[Outcome]:
    """One after the other."""
    return [answer(question) for question in QUESTIONS]


def through(pool: Executor) -> list[Outcome]:
    """Several at once."""
    with pool:
        return list(pool.map(answer, QUESTIONS))


def many_blas_threads() -> list[Outcome]:
    """For a user who has given BLAS all cores and more."""
    with threadpool_limits(limits=BLAS, user_api="blas"):
        return alone()


def beside_work() -> list[Outcome]:
    """While other processes want every core."""
    with busy():
        return alone()


@contextmanager
def busy() -> Iterator[None]:
    """Processes that do nothing, as fast as they can."""
    others = [SPAWNED.Process(target=_turn, daemon=True) for _ in range(BUSY)]
    for other in others:
        other.start()
    try:
        yield
    finally:
        for other in others:
            other.kill()


def _turn() -> None:
    while True:
        pass


SPAWNED = multiprocessing.get_context("spawn")

SETTINGS: dict[str, Callable[[], list[Outcome]]] = {
    "alone": alone,
    f"{THREADS} threads at once": lambda: through(ThreadPoolExecutor(THREADS)),
    f"{PROCESSES} spawned processes": lambda: through(
        ProcessPoolExecutor(PROCESSES, mp_context=SPAWNED)
    ),
    f"{BLAS} BLAS threads": many_blas_threads,
    f"beside {BUSY} busy processes": beside_work,
}


def main(arguments: Sequence[str] | None = None) -> None:
    """The table."""
    chosen = TABLE.options(__doc__, arguments)
    right, rows = alone(), []
    for setting, ask in SETTINGS.items():
        found = ask()
        different = sum(one != other for one, other in zip(found, right, strict=True))
        rows.append(Row(setting, len(found), different))
        print(rows[-1], flush=True)
    TABLE.write(rows, chosen.out)


if __name__ == "__main__":
    warnings.simplefilter("ignore")  # remarks on regimes and reach; filters are not safe in threads
    main()

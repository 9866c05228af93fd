"""A sweep answered in this process, one scene after the other."""

from collections.abc import Generator, Iterable

from fem_check.sweeps.records.record import Record
from fem_check.sweeps.work.answering import Answering, Task, record_of


def records(tasks: Iterable[Task], answering: Answering = record_of) -> Generator[Record]:
    """As they are found."""
    for task in tasks:
        yield answering(task)

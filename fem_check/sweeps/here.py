"""A sweep answered in this process, one scene after the other."""

from collections.abc import Generator, Iterable

from fem_check.sweeps.answering import Answering, Task, record_of
from fem_check.sweeps.records import Record


def records(tasks: Iterable[Task], answering: Answering = record_of) -> Generator[Record]:
    """As they are found."""
    for task in tasks:
        yield answering(task)

"""How far a simulation is, its second runs on another mesh or with other steps included.

Work is counted in that of the first run, 1. Which further runs follow may be known only on the way: the
share of the work left that each step does is added to the share done, which therefore never falls.
"""

import sys
from collections.abc import Callable
from typing import NamedTuple

from linear_theory.common.shown import Shown

FIRST = "the motion"
"""Task of the first run."""


class _Progress(NamedTuple):
    time: float
    end: float
    steps: int
    rejected: int
    seconds: float
    left: float
    share: float = 0.0
    task: str = FIRST


class Progress(Shown, _Progress):
    """time and end of the run, accepted and rejected steps, seconds spent and left (estimated).

    share: fraction of the whole work done, 0 to 1, further runs for the errors included, of which
    `left` knows too. task: the run, in words: "the motion", then "on a coarser mesh" and so on.
    """


Listener = Callable[[Progress], None]


class Whole:
    """Tells a listener of several runs as of one work.

    report: the listener; planned: work of the runs that follow the first one, by task.

    >>> from fem_check.shell.stepping.further.progress import Progress, Whole
    >>> whole = Whole(lambda p: print(f"{p.task}: {p.share:.0%}"), {"on a coarser mesh": 0.25})
    >>> whole.of()(Progress(1.0, 2.0, 10, 0, 3.0, 3.0))
    the motion: 40%
    >>> whole.of()(Progress(2.0, 2.0, 20, 0, 6.0, 0.0))
    the motion: 80%
    >>> whole.of("on a coarser mesh")(Progress(2.0, 2.0, 20, 0, 1.0, 0.0))
    on a coarser mesh: 100%
    """

    def __init__(self, report: Listener, planned: dict[str, float]) -> None:
        self.report, self.share = report, 0.0
        self._sizes = {FIRST: 1.0, **planned}
        self._left, self._price = dict(self._sizes), 0.0

    def plan(self, task: str, work: float) -> None:
        """A further run has turned out to be needed."""
        if task not in self._sizes:
            self._sizes[task] = self._left[task] = work

    def of(self, task: str = FIRST) -> Listener:
        """Listener for one run; those before it are over."""
        for earlier in list(self._left)[: list(self._sizes).index(task)]:
            self._left[earlier] = 0.0
        return lambda progress: self._hear(task, progress)

    def _hear(self, task: str, progress: Progress) -> None:
        before = sum(self._left.values())
        ahead = 1 - progress.time / progress.end if progress.end > 0 else 0.0
        self._left[task] = mine = self._sizes[task] * max(ahead, 0.0)
        after = sum(self._left.values())
        self.share += (1 - self.share) * (1 - after / before if before > 0 else 1.0)
        if mine > 0:
            self._price = progress.left / mine
        self.report(progress._replace(share=self.share, task=task, left=self._price * after))


def printed(progress: Progress) -> None:
    """Print the share of the whole on the present line of stderr."""
    task = "" if progress.task == FIRST else f" {progress.task}"
    text = f"{100 * progress.share:5.1f} %, {progress.steps} steps{task}, {progress.left:.0f} s left"
    print(f"\r{text:<60}", end="", file=sys.stderr, flush=True)

"""How a search goes, and what of it is kept and told."""

from dataclasses import dataclass, field
from pathlib import Path

from linear_theory.common import validation
from linear_theory.common.progress import Report
from linear_theory.common.shown import Value
from linear_theory.optimisation.climbing import Ascent


@dataclass(frozen=True)
class Searching(Value):
    """starts: climbs, the first from the scene itself; seed: of the points of the others; how: they
    climb; check: whether the next higher level is asked about the best scene, too. Raises ValueError
    for others.

    >>> from fem_check.optimisation.options.searching import Searching
    >>> print(Searching(starts=2).how.method)
    SLSQP
    """

    starts: int = 4
    seed: int = 0
    how: Ascent = field(default_factory=Ascent)
    check: bool = True

    def __post_init__(self) -> None:
        validation.integer("starts", self.starts, 1)
        validation.integer("seed", self.seed, 0)
        validation.instance("how", self.how, Ascent)
        validation.flag("check", self.check)


@dataclass(frozen=True)
class Keeping:
    """file: that holds the answers, if any; report: hears of progress; again: what goes on with the
    file after an interruption, in words."""

    file: Path | None = None
    report: Report | None = None
    again: str = "the same call"

    def interrupted(self, count: int) -> str:
        """What is said of an interruption after that many answers."""
        if self.file is None:
            return "interrupted; nothing is kept without file=..."
        answers = "1 answer is" if count == 1 else f"{count} answers are"
        return f"interrupted; {answers} in {self.file}; {self.again} goes on with them"

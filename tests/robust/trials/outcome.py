"""What a random question with a better answer beside it finds."""

from dataclasses import dataclass

import numpy as np

from fem_check.shell.cycle.motion import UnresolvedError
from fem_check.shell.statics.equilibrium import ConvergenceError
from linear_theory import CrawlSpeed, NotConvergedError

REFUSALS = (ValueError, NotConvergedError, ConvergenceError, UnresolvedError)


@dataclass(frozen=True)
class Outcome:
    """What a trial found. stated: its error and that of the better answer together; words: the
    question, and what was refused of it, if anything; refused: whether there was no answer."""

    words: str
    true: float = 0.0
    stated: float = 0.0
    refused: bool = False

    @property
    def ratio(self) -> float:
        """True error over the stated one; 0 for a refusal."""
        return self.true / self.stated if self.true > 0 else 0.0


def refusal(words: str, error: Exception) -> Outcome:
    """Of a question that was not answered."""
    return Outcome(f"{words}: {error}", refused=True)


def compared(found: CrawlSpeed, better: CrawlSpeed, words: str) -> Outcome:
    """All three components where there are such, and the power."""
    pairs = [(abs(found.power.value - better.power.value), found.power.error + better.power.error)]
    if found.rigid_mean is None or better.rigid_mean is None:
        pairs.append((abs(found.mean - better.mean), found.error + better.error))
    else:
        differences = abs(found.rigid_mean - better.rigid_mean)
        pairs += zip(differences, found.rigid_error + better.rigid_error, strict=True)
    true, stated = np.array(pairs).T
    worst = int(np.argmax(true / np.maximum(stated, 1e-300)))
    return Outcome(words, float(true[worst]), float(stated[worst]))

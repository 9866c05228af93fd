"""The solution of the equation on a body, as users have it."""

from dataclasses import dataclass

from fem_check.excitable.periodic.wave import PeriodicExcitation
from fem_check.excitable.solution import Solution


@dataclass(frozen=True, eq=False)
class Excitation(Solution):
    """The solution of an equation on a body from time 0 to `until`, found when it is first asked for.

    body: a Sheet, or an Outline; on a sheet whose start and pacing depend on y alone so does c, which
    is then solved for on a line. rtol: error of c, relative to the largest |c|, at which refinement
    stops; method: `Adaptive()` or `Euler(step)`.

    It is a wave c(x, y, t) as `linear_theory.wave.protocol.Wave`: scenes and `simulate` take it as it
    is, with the duration of its last cycle as the period. It need not repeat: levels that average over
    a period refuse it unless it does, `speeds` gives one speed for each cycle, and `periodic` the orbit
    that it approaches. Plain data as all parts of a scene: it is stored as the question, not as
    numbers.

    Raises ValueError for a body of another kind and numbers out of range; when it is solved,
    NotConvergedError for a c that grows without bound or needs more than MOST_NUMBERS numbers.

    >>> from fem_check import Excitation, excitable_preset
    >>> from linear_theory import Sheet
    >>> solution = Excitation(excitable_preset("nu = -0.1"), Sheet(), until=200.0, rtol=1e-2)
    >>> print(solution.cycles.count, "cycles, the last of", f"{solution.period:.1f}")
    3 cycles, the last of 42.9
    >>> print(solution.repeats)
    False
    """

    def periodic(self) -> PeriodicExcitation:
        """The periodic orbit that it approaches, found when it is first asked for."""
        return PeriodicExcitation.of(self)

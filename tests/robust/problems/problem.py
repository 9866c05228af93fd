"""A hard case: what is asked, what is known of the answer, and what came out."""

import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory import CrawlSpeed
from linear_theory.common.errors import BeyondReachWarning, ViscousRegimeWarning

Array = NDArray[np.float64]

TAGS = {
    "small parameter": "digits are lost where a small number is the difference of large ones",
    "large growth": "the linear theory ends, elements invert",
    "aspect": "scales of length far apart",
    "stiff": "coefficients far apart, or a limit that locks",
    "corner": "strains without bound, or slow series",
    "rough": "growth that jumps, or is 0 nearly everywhere",
    "stuck": "a balance that many forces meet",
    "instability": "equilibria that are no minima, or more than one",
    "spurious": "the energy has minima that are no sheet",
    "mesh": "elements that are long, skew or few",
    "material": "Poisson ratios at the ends of their range",
    "long time": "errors that could add up",
    "slow": "takes more than a few seconds: run by the page, not by the tests",
}
"""What makes cases hard."""

VERDICTS = {
    "met": "the true error is at most the claimed one, and the tolerance that was asked for is met",
    "flagged": "the same, but the tolerance is missed and `converged` is False",
    "refused": "an error is raised that names the argument or the limit",
}
"""That a case may expect; what else can happen is "silent failure", and fails the tests."""

SILENT = "silent failure"


@dataclass(frozen=True)
class Outcome:
    """What a solver said, and what is true.

    value, reference: in the units of the case; error: the true one, absolute, |value - reference|
    unless given (norms of fields); claimed: by the solver, or by the case where `stated`; allowance:
    error of the reference; converged: as the solver says.
    """

    value: float
    reference: float
    claimed: float
    allowance: float = 0.0
    converged: bool = True
    error: float = np.nan
    stated: bool = False

    @property
    def true_error(self) -> float:
        """Distance to the reference."""
        return abs(self.value - self.reference) if np.isnan(self.error) else self.error

    @property
    def scale(self) -> float:
        """That errors are shown relative to."""
        return abs(self.reference) or 1.0

    @property
    def verdict(self) -> str:
        """A key of VERDICTS, or SILENT for NaN and for claims that are too small."""
        finite = np.isfinite([self.value, self.reference, self.true_error, self.allowance]).all()
        if not finite or not self.true_error <= self.claimed + self.allowance:
            return SILENT
        return "met" if self.converged else "flagged"


@dataclass(frozen=True)
class Problem:
    """A named hard case.

    family: heading under which it is listed; tags: of TAGS; statement: what is hard, one sentence;
    reference: what the answer is compared with, in words; run: solves it, returns the outcome or
    raises; expected: verdict; limit: pattern of the message of a refusal; raises: its class.
    """

    name: str
    family: str
    tags: frozenset[str]
    statement: str
    reference: str
    run: Callable[[], Outcome]
    expected: str = "met"
    limit: str = ""
    raises: type[Exception] = ValueError

    @property
    def slow(self) -> bool:
        """Whether only the page runs it."""
        return "slow" in self.tags


class Result(NamedTuple):
    """Verdict, outcome (None after a refusal), what the code said, and the time it took, seconds."""

    verdict: str
    outcome: Outcome | None
    message: str
    seconds: float


def solved(problem: Problem) -> Result:
    """Run a case. An error that is not the expected one is a failure and passes through."""
    start = time.perf_counter()
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("error")
        for remark in (BeyondReachWarning, ViscousRegimeWarning):  # no failures
            warnings.simplefilter("always", remark)
        try:
            outcome = problem.run()
        except problem.raises as refusal:
            if problem.expected != "refused":
                raise
            return Result("refused", None, str(refusal), time.perf_counter() - start)
    message = str(said[0].message) if said else ""
    return Result(outcome.verdict, outcome, message, time.perf_counter() - start)


def of_speed(speed: CrawlSpeed, reference: float, allowance: float = 0.0, unit: float = 1.0) -> Outcome:
    """A speed against its reference, both divided by `unit`."""
    return Outcome(
        speed.mean / unit,
        reference / unit,
        speed.error / abs(unit),
        allowance / abs(unit),
        speed.converged,
    )


def stated(value: float, reference: float, tolerance: float, allowance: float = 0.0) -> Outcome:
    """A value whose solver estimates no error: the case states what is promised, relative."""
    claimed = tolerance * (abs(reference) or 1.0)
    return Outcome(float(value), float(reference), claimed, allowance, stated=True)


def family(name: str, *problems: Problem) -> tuple[Problem, ...]:
    """The cases under one heading."""
    return tuple(replace(problem, family=name) for problem in problems)


def case(
    name: str,
    tags: str,
    statement: str,
    reference: str,
    run: Callable[[], Outcome],
    **options: object,
) -> Problem:
    """A problem whose tags are separated by commas; its family is set by `family`."""
    split = frozenset(tag.strip() for tag in tags.split(","))
    return Problem(name, "", split, statement, reference, run, **options)

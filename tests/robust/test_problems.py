"""The table of hard cases: what it must hold, that its cases do as they say, and its page."""

import json
import re
from collections import Counter

import pytest

from tests.robust.hard_cases_page import DATA, PAGE, entry, page
from tests.robust.problems import PROBLEMS
from tests.robust.problems.problem import SILENT, TAGS, VERDICTS, Outcome, Problem, Result, case, solved

USABLE = 0.3
"""A claim above this share of the answer would be met by anything."""

DEMANDED = {
    "alpha from 1e-12": r"line: sine, alpha = 1e-12|speed: sheet, alpha = 1e-12",
    "alpha to the largest": r"line: sine, alpha = 0\.999999|speed: alpha = 0\.437",
    "alpha beyond": r"line: alpha = 1$|speed: alpha = 0\.4378",
    "aspect 1 : 100": r"field: width 0\.01 L|speed: width L/100|cycle: width L/100",
    "aspect 100 : 1": r"field: width 100 L|speed: width 100 L",
    "1 to 50 waves": r"line: 50 waves|field: 50 waves|speed: 50 waves",
    "nu = -0.99": r"nu = -0\.99",
    "nu = 0": r"nu = 0(?!\.)",
    "nu = 1/2": r"nu = 0\.5",
    "1 mode": r"field: 1 modes",
    "2 000 modes": r"field: 2000 modes",
    "discontinuous pulses": r"square wave|growth that jumps",
    "narrow pulses": r"line: pulse of width 0\.05|field: narrow pulse",
    "corners": r"inner corner of an L|shear stress in the corner",
    "almost stuck": r"pulse with a gap|growth that never changes|step: alpha = 1e-6",
    "slip speed 1e-6": r"slip speed 1e-06",
    "slip speed 1e3": r"slip speed 1000",
    "h/L = 0.3": r"h/L = 0\.3",
    "h/L = 1e-3": r"h/L = 0\.001",
    "inverted minima": r"full growth at once|inverted start",
    "buckling found": r"strip between walls|flat sheet that buckles",
    "perturbed start": r"perturbed strip",
    "snap-through": r"snaps",
    "ground stiffness": r"ground of stiffness (0\.0005|500)",
    "step size": r"steps of (6\.25e-05|62\.5)",
    "100 periods": r"100 periods, (speed|energy)",
    "lifted and dropped": r"sheet (thrown up|dropped)",
    "45 degrees": r"leaning by 45",
    "10 : 1 elements": r"10 : 1",
    "growth of 150 %": r"growth of 150 %",
    "wave that stops": r"wave that stops",
    "friction almost one-way": r"direction: r = 1 - 1e-12",
    "friction that almost balances": r"direction: r = 1e-12",
    "heading of 90 degrees": r"heading of 90 degrees",
    "patch with a sharp edge": r"patch with an edge of 0\.0001 L",
    "coefficient that jumps": r"map: jump on a line|map: jump at an unknown place",
}
"""What the table must hold, as patterns of names of which every alternative must occur."""

FAST = [problem for problem in PROBLEMS if not problem.slow]


@pytest.mark.parametrize("problem", FAST, ids=lambda problem: problem.name)
def test_a_hard_case_ends_as_the_table_says(problem: Problem) -> None:
    result = solved(problem)
    assert result.verdict == problem.expected, result
    check(problem, result.message, result.outcome)


def check(problem: Problem, message: str, outcome: Outcome | None) -> None:
    """A refusal names its limit; a claim that is met says something."""
    if problem.expected == "refused":
        assert re.search(problem.limit, message)
        return
    assert outcome is not None
    if problem.expected == "met" and outcome.reference != 0 and not outcome.stated:
        assert outcome.claimed <= USABLE * outcome.scale


def test_names_are_unique_and_entries_complete() -> None:
    assert max(Counter(problem.name for problem in PROBLEMS).values()) == 1
    for problem in PROBLEMS:
        assert problem.family
        assert problem.statement
        assert problem.reference
        assert problem.expected in VERDICTS
        assert (problem.expected == "refused") == bool(problem.limit), problem.name


def test_every_tag_is_known_and_used() -> None:
    assert set().union(*(problem.tags for problem in PROBLEMS)) == set(TAGS)


@pytest.mark.parametrize("demand", DEMANDED)
def test_every_demanded_case_is_in_the_table(demand: str) -> None:
    for alternative in re.sub(r"\((.*)\|(.*)\)(.*)", r"\1\3|\2\3", DEMANDED[demand]).split("|"):
        assert any(re.search(alternative, problem.name) for problem in PROBLEMS), alternative


def test_every_verdict_occurs() -> None:
    assert {problem.expected for problem in PROBLEMS} == set(VERDICTS)


def toy(outcome: Outcome | Exception, **options: object) -> Problem:
    def run() -> Outcome:
        if isinstance(outcome, Exception):
            raise outcome
        return outcome

    return case("toy", "stiff", "none", "none", run, **options)


@pytest.mark.parametrize(
    ("outcome", "verdict"),
    [
        (Outcome(1.0, 1.1, 0.11), "met"),
        (Outcome(1.0, 1.1, 0.09), SILENT),
        (Outcome(1.0, 1.1, 0.09, allowance=0.02), "met"),
        (Outcome(1.0, 1.1, 0.11, converged=False), "flagged"),
        (Outcome(1.0, 1.1, 0.09, converged=False), SILENT),
        (Outcome(float("nan"), 1.1, 1.0), SILENT),
        (Outcome(1.0, 1.1, float("nan")), SILENT),
        (Outcome(1.0, 1.0, 0.1, error=0.2), SILENT),
        (Outcome(1.0, 1.1, float("inf"), allowance=float("nan")), SILENT),
    ],
)
def test_verdicts(outcome: Outcome, verdict: str) -> None:
    assert solved(toy(outcome)).verdict == verdict


def test_errors_that_no_one_expects_pass_through() -> None:
    with pytest.raises(ValueError, match="on purpose"):
        solved(toy(ValueError("on purpose")))
    with pytest.raises(ZeroDivisionError):
        solved(toy(ZeroDivisionError(), expected="refused", limit="x"))
    refused = solved(toy(ValueError("limit 3"), expected="refused", limit="limit"))
    assert refused == Result("refused", None, "limit 3", refused.seconds)
    accepted = solved(toy(Outcome(1.0, 1.0, 0.1), expected="refused", limit="x"))
    assert accepted.verdict == "met"  # which is not what was expected


def test_the_page_is_that_of_the_table() -> None:
    """Committed: every case of the table with what is said of it now, and a result, slow ones too."""
    kept = {case["name"]: case for case in json.loads(DATA.read_text())}
    assert list(kept) == [problem.name for problem in PROBLEMS]
    for problem in PROBLEMS:
        said = entry(problem)
        assert {key: kept[problem.name][key] for key in said} == said
        assert kept[problem.name]["verdict"] == problem.expected
    assert PAGE.read_text() == page(list(kept.values()))

"""The table of hard cases: it drives tests/robust/test_problems.py and the page docs/hard_cases.md.

    python -m tests.robust.hard_cases_page

A new case is a new entry in one of the families; `Problem` says what an entry holds.
"""

from tests.robust.problems import balances, directional, fields, line, motion, statics
from tests.robust.problems.problem import Problem

PROBLEMS: tuple[Problem, ...] = (
    *line.PROBLEMS,
    *fields.PROBLEMS,
    *balances.PROBLEMS,
    *directional.PROBLEMS,
    *statics.PROBLEMS,
    *motion.PROBLEMS,
)

"""The page of hard cases: all cases of the table solved, with error, cost and verdict.

    python -m tests.robust.hard_cases_page [words]

writes docs/hard_cases.json (all results) and docs/hard_cases.md (the page made from it). With words,
only cases whose names contain one of them are solved anew. Errors have two digits and times one, so
that the page changes where a result does.
"""

import json
import sys
from pathlib import Path
from typing import Any

from tests.robust.problems import PROBLEMS
from tests.robust.problems.problem import TAGS, VERDICTS, Problem, solved

FOLDER = Path(__file__).parents[2] / "docs"
DATA, PAGE = FOLDER / "hard_cases.json", FOLDER / "hard_cases.md"

Record = dict[str, Any]


def entry(problem: Problem) -> Record:
    """What the table says of a case."""
    return {
        "name": problem.name,
        "family": problem.family,
        "tags": sorted(problem.tags),
        "statement": problem.statement,
        "reference": problem.reference,
        "expected": problem.expected,
    }


def record(problem: Problem) -> Record:
    """The entry of a case with its result; errors relative to the reference unless that is 0."""
    result = solved(problem)
    found: Record = {"error": None, "claimed": None, "stated": False, "said": result.message}
    if result.outcome is not None:
        outcome = result.outcome
        found["error"] = digits(outcome.true_error / outcome.scale, 2)
        found["claimed"] = digits((outcome.claimed + outcome.allowance) / outcome.scale, 2)
        found["stated"] = outcome.stated
    seconds = digits(result.seconds, 1)
    return {**entry(problem), "verdict": result.verdict, **found, "seconds": seconds}


def digits(number: float, count: int) -> str:
    """`count` significant digits."""
    if 1e-3 <= number < 1e3:
        return f"{float(format(number, f'.{count}g')):g}"
    return format(number, f".{count - 1}e")


def page(records: list[Record]) -> str:
    """The page, Markdown."""
    verdicts = [r["verdict"] for r in records]
    counts = ", ".join(f"{verdicts.count(v)} {v}" for v in VERDICTS)
    lines = [
        "# Hard cases",
        "",
        "What the solvers do with small parameters, large growth, rough waves, corners and stuck",
        f"sheets: {len(records)} cases with a reference value from elsewhere, {counts}.",
        "",
        *(f"* **{name}**: {words}." for name, words in VERDICTS.items()),
        "",
        "Errors are relative to the reference (absolute where that is 0). The bound is what the solver",
        "claims for itself plus what is uncertain in the reference; where it estimates no error, the",
        "bound is what the case demands, in (brackets). Times are in seconds, the reference included.",
        "",
        "Made by `python -m tests.robust.hard_cases_page` from `tests/robust/problems/`, the table",
        "that also drives `tests/robust/test_problems.py`.",
    ]
    for family in dict.fromkeys(r["family"] for r in records):
        lines += ["", f"## {family}", "", *_table([r for r in records if r["family"] == family])]
    said = [r for r in records if r["said"]]
    lines += ["", "## What the code says", "", *(f"* {r['name']}: “{_cell(r['said'])}”" for r in said)]
    lines += ["", "## Tags", "", *(f"* {tag}: {words}" for tag, words in TAGS.items())]
    return "\n".join(lines) + "\n"


def _table(records: list[Record]) -> list[str]:
    head = ["case", "what is hard", "tags", "reference", "error", "bound", "s", "verdict"]
    rows = [head, ["---"] * len(head)]
    for r in records:
        claimed = f"({r['claimed']})" if r["stated"] else r["claimed"]
        rows.append(
            [
                r["name"],
                r["statement"],
                ", ".join(r["tags"]),
                r["reference"],
                r["error"] or "",
                claimed or "",
                r["seconds"],
                r["verdict"],
            ]
        )
    return ["| " + " | ".join(_cell(text) for text in row) + " |" for row in rows]


def _cell(text: str) -> str:
    return " ".join(text.replace("|", "\\|").split())


def main(words: list[str]) -> None:
    """Solve, write both files, and name what is not as expected."""
    kept = {r["name"]: r for r in json.loads(DATA.read_text())} if words and DATA.exists() else {}
    records, failed = [], []
    for problem in PROBLEMS:
        anew = problem.name not in kept or any(word in problem.name for word in words)
        records.append(record(problem) if anew else {**kept[problem.name], **entry(problem)})
        print(f"{records[-1]['verdict']:10s} {problem.name} ({records[-1]['seconds']} s)", flush=True)
        if records[-1]["verdict"] != problem.expected:
            failed.append(problem.name)
    FOLDER.mkdir(exist_ok=True)
    DATA.write_text(json.dumps(records, indent=1, ensure_ascii=False) + "\n")
    PAGE.write_text(page(records))
    if failed:
        sys.exit("not as the table expects: " + ", ".join(failed))


if __name__ == "__main__":
    main(sys.argv[1:])

"""The page of sweeps: kills that they have survived, and what they cost beside their scenes.

    python -m tests.sweeps.sweeps_page kills 100     that many kills, an hour
    python -m tests.sweeps.sweeps_page cost          a quarter of an hour, on a quiet machine
    python -m tests.sweeps.sweeps_page page          the page alone

write docs/sweeps.json (all numbers) and docs/sweeps.md, the page made from it.
"""

import json
import sys
import tempfile
import textwrap
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

from tests.sweeps import sweep_cases, sweep_cost, sweep_kills

FOLDER = Path(__file__).parents[2] / "docs"
DATA, PAGE = FOLDER / "sweeps.json", FOLDER / "sweeps.md"

SHARES = (
    *(sweep_kills.ALONE,) * 8,
    *(sweep_kills.CLIENT,) * 5,
    *(sweep_kills.WORKER,) * 4,
    *(sweep_kills.SCHEDULER,) * 3,
)
"""What is killed, in turn."""

WORDS = {
    sweep_kills.ALONE: "the process of a sweep with `--workers 1`",
    sweep_kills.CLIENT: "the process that keeps the records, with two workers of its own",
    sweep_kills.WORKER: "one of two workers",
    sweep_kills.SCHEDULER: "a scheduler that runs elsewhere",
}

Numbers = dict[str, Any]


def kills(count: int) -> list[Numbers]:
    """That many trials, one after the other; those that are there already are not made again."""
    kept = json.loads(DATA.read_text()).get("kills", []) if DATA.exists() else []
    found = {one["seed"]: one for one in kept}
    with tempfile.TemporaryDirectory() as folder:
        for seed in sorted(set(range(count)) - found.keys()):
            one = sweep_kills.trial(SHARES[seed % len(SHARES)], seed, Path(folder))
            found[seed] = {**asdict(one), "fine": one.fine}
            print(seed, one, flush=True)
            _write({"kills": [found[key] for key in sorted(found)]})
    return list(found.values())


def page(data: Numbers) -> str:
    """The page, Markdown."""
    trials, cost = data["kills"], data["cost"]
    fine = sum(one["fine"] for one in trials)
    lines = [
        "# Sweeps: kills and overhead",
        *_paragraph(
            "Is anything lost when a sweep is killed, and what does it cost beside its scenes? How to "
            "use sweeps: [Many scenes](howto/many_scenes.md). Made by `python -m "
            "tests.sweeps.sweeps_page` from `tests/sweeps/sweep_kills.py` and "
            "`tests/sweeps/sweep_cost.py`."
        ),
        *("", "## Kills"),
        *_paragraph(
            f"A sweep of {data['scenes']} scenes was killed by SIGKILL at a random instant, "
            f"{len(trials)} times, and then continued: after the death of a worker by itself, else "
            "by the same command. Nothing lost, no record twice and the same numbers: "
            f"{fine} of {len(trials)}."
        ),
        *("", *_table(trials)),
        *_paragraph(
            "Lost: records that were in the file right after the kill, and missing or different in the "
            "end. Twice: scenes that were computed again although they had a record, as Dask may do "
            "after the death of a worker; the record then stays as it was. Missing and "
            "wrong: records that the finished sweep lacks, or whose speed or error differs in any bit "
            "from that of the scene alone. Left: processes of the sweep that were there ten seconds "
            "after the kill. Scenes that were at work when it happened have no record yet and are "
            "computed again. SQLite's integrity check is part of each trial."
        ),
        *("", "## What a sweep costs beside its scenes"),
        *("", *sweep_cost.table(cost)),
        *_paragraph(sweep_cost.words(cost)),
    ]
    return "\n".join(lines) + "\n"


def _paragraph(text: str) -> list[str]:
    return ["", *textwrap.wrap(text, 110, break_long_words=False, break_on_hyphens=False)]


def _table(trials: list[Numbers]) -> list[str]:
    kinds = Counter(one["kind"] for one in trials)
    rows = [
        "| killed | times | kept at the kill | lost | twice | missing | wrong | left | computed again |"
    ]
    rows.append("|" + " --- |" * 9)
    for kind, count in kinds.items():
        mine = [one for one in trials if one["kind"] == kind]
        kept = [one["kept"] for one in mine]
        sums = [
            sum(one[name] for one in mine) for name in ("lost", "twice", "missing", "wrong", "left")
        ]
        again = sum(one["again"] for one in mine) / count
        cells = [WORDS[kind], count, f"{min(kept)} to {max(kept)}", *sums, f"{again:.1f} a kill"]
        rows.append("| " + " | ".join(map(str, cells)) + " |")
    return rows


def _write(found: Numbers) -> None:
    data = json.loads(DATA.read_text()) if DATA.exists() else {}
    data |= {"scenes": sweep_cases.plan().size, **found}
    DATA.write_text(json.dumps(data, indent=1) + "\n")


def main(what: str, count: str = "100") -> None:
    """Measure, and write the page."""
    if what == "kills":
        kills(int(count))
    elif what == "cost":
        _write({"cost": sweep_cost.measured()})
    data = json.loads(DATA.read_text())
    if {"kills", "cost"} <= data.keys():
        PAGE.write_text(page(data))
    bad = [one["seed"] for one in data.get("kills", []) if not one["fine"]]
    if bad:
        sys.exit(f"kills that did harm, by their seeds: {bad}")


if __name__ == "__main__":
    main(*sys.argv[1:])

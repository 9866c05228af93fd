"""The page on reliability, docs/reliability.md, from tables that other commands fill.

    python -m tests.robust.reliability_page

No number of the page is written by hand; what each table holds is checked by the tests.
"""

import json
import math
import textwrap
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from figures.common.output import replacing
from figures.measure import gaits_checked
from figures.measure.energy import errors as energy_errors
from figures.measure.gradient import table as gradients
from tests.robust.trials import settings, table

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reliability.md"

ENTRANCES = {
    "line": (
        "`line_balance`",
        "body on a line, any wave, load, law, growth",
        "the same wave in samples",
    ),
    "speed": ("`crawl_speed`", "both orders, laws from dry to viscous", "the other method, rtol/10"),
    "direction": (
        "`crawl_speed`, directional",
        "coefficients 0.3 to 3, any heading",
        "the other method, rtol/10",
    ),
    "field": (
        "`airy_series`",
        "displacement, W/L 0.05 to 2, rtol 1e-7 to 1e-2",
        "`ritz_field`, rtol/100",
    ),
    "outline": (
        "`plane_stress_field`",
        "polygons of 3 to 7 corners",
        "elements half as large, rtol/10",
    ),
    "bent": ("`crawl_speed(order=2)`", "a sheet that bends on its ground", "rtol/30"),
    "prediction": (
        "`predict`",
        "flat sheets, its choice of the level",
        "nonlinear sheet, elements a third as large",
    ),
}

WORDS = {
    "command": "`sheetcrawl speed` with one to five random options, right and wrong",
    "damaged": "`sheetcrawl check` of a scene file with one to three lines dropped, doubled, cut, "
    "or with strange values and bytes",
    "kept": "a kept file (answers of `optimise`, a sweep, a snapshot, motion or result of a run) "
    "with bytes flipped, overwritten, removed or cut off, or another digit",
}

KILLS = "sweep killed at a random instant and gone on with ([more](sweeps.md))"

WIDTH = 104

HEAD = """# Reliability in figures

How often the program was asked something at random, and how often it was wrong: stated errors below the
true ones, damaged files, bad command lines, kills.

Made by `python -m tests.robust.reliability_page`. An error is *understated* if the true one is larger
than the stated one and that of the better answer together.

## Random questions

`python -m tests.robust.trials.table` draws each from the seed {seed} and its number, so that any can
be asked again: `python -m tests.robust.trials.families speed 100 {seed}`. The suite asks the first of
each family. Shares: the true error over the stated one; seconds with those of the better answer.

| entrance | drawn | compared with | asked | answered | understated | share | median | seconds |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
"""

REST = """## Everything else

*Wrong* is anything but the right answer, bit for bit, or a refusal that says what is wrong, with status
1 or 2: a traceback, a damaged number that is believed, something lost. Seconds: of the slowest.

| what | tried | wrong | seconds |
| --- | --- | --- | --- |
"""

SETTINGS = """## Threads, processes, a busy machine

`python -m tests.robust.trials.settings` asks {asked} of the random questions one after the other,
and again in other circumstances; all answers and errors must have the same bits.

| setting | asked | other bits |
| --- | --- | --- |
"""

TAIL = """## Elsewhere

Named cases at the edges of what is allowed, with their references: [hard cases](hard_cases.md).
Numbers of others: [validation](validation.md). A run that is stepped in time goes on bit for bit from
its last snapshot, which the suite tests by killing it.
"""


def line(
    entrance: str, drawn: str, better: str, asked: int, shares: Sequence[float], most: float
) -> str:
    """Of the table. shares: true errors over stated ones; most: seconds of the slowest."""
    wrong, seconds = sum(share > 1 for share in shares), "" if math.isnan(most) else f"{most:.0f}"
    return (
        f"| {entrance} | {drawn} | {better} | {asked} | {len(shares)} | {wrong} | {max(shares):.2f} | "
        f"{np.median(shares):.2g} | {seconds} |"
    )


def answers(rows: Sequence[table.Row]) -> list[str]:
    """A line for each entrance whose questions are drawn here."""
    lines = []
    for family, words in ENTRANCES.items():
        own = [row for row in rows if row.family == family]
        shares = [row.ratio for row in own if not row.refused]
        lines.append(line(*words, len(own), shares, max(row.seconds for row in own)))
    return lines


def others() -> list[str]:
    """Those whose questions and better answers are tables of their own."""
    gaits = [row for row in gaits_checked.TABLE.read() if row.holds >= 0]
    energy = [row for row in energy_errors.TABLE.read() if math.isfinite(row.claimed)]
    slopes = [row for row in gradients.TABLE.read() if row.kind == "accuracy"]
    return [
        line(
            *("`simulate`", "bending gaits on uneven ground", "mesh 1.5 times finer, rtol/4"),
            len(gaits),
            [abs(row.speed - row.finer) / row.error for row in gaits],
            max(row.seconds for row in gaits),
        ),
        line(
            *("`power`", "of lines, sheets, cycles, plates and steps", "finer, by level"),
            len(energy),
            [row.true / (row.claimed + row.doubt) for row in energy],
            math.nan,
        ),
        line(
            *("`speed_gradient`", "all derivatives of a scene", "rtol/10 to rtol/33"),
            len(slopes),
            [row.share for row in slopes],
            max(row.seconds for row in slopes),
        ),
    ]


def rest(rows: Sequence[table.Row]) -> list[str]:
    """Lines on command lines, files and kills."""
    lines = []
    for family, what in WORDS.items():
        own = [row for row in rows if row.family == family]
        wrong, slowest = sum(row.ratio > 0 for row in own), max(row.seconds for row in own)
        lines.append(f"| {what} | {len(own)} | {wrong} | {slowest:.1f} |")
    killed = json.loads((ROOT / "docs" / "sweeps.json").read_text())["kills"]
    wrong = sum(not one["fine"] for one in killed)
    lines.append(f"| {KILLS} | {len(killed)} | {wrong} | |")
    return lines


def in_settings() -> str:
    """The same questions in other circumstances."""
    rows = settings.TABLE.read()
    lines = (f"| {row.setting} | {row.asked} | {row.different} |" for row in rows)
    return SETTINGS.format(asked=rows[0].asked) + "\n".join(lines) + "\n"


def told(text: str) -> str:
    """A paragraph in lines."""
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def summary(rows: Sequence[table.Row]) -> str:
    """How many questions, answers and understated errors."""
    asked = [row for row in rows if row.family in ENTRANCES]
    known = [row for row in asked if not row.refused]
    wrong, memory = sum(row.ratio > 1 for row in known), max(row.memory for row in rows)
    return told(
        f"Of {len(asked)} questions drawn here {len(known)} were answered, {wrong} of them with an "
        "understated error; the others were refused, with a reason. No process that asked them "
        f"needed more than {memory:.0f} MB."
    )


def page(rows: Sequence[table.Row]) -> str:
    """The whole page."""
    lines = "\n".join([*answers(rows), *others()])
    more = "\n".join(rest(rows))
    return "\n".join(
        [
            f"{HEAD.format(seed=table.SEED)}{lines}\n",
            f"{summary(rows)}\n",
            f"{REST}{more}\n",
            in_settings(),
            TAIL,
        ]
    )


def main() -> None:
    """Write the page."""
    with replacing(PAGE) as place:
        place.write_text(page(table.TABLE.read()), encoding="utf-8")


if __name__ == "__main__":
    main()

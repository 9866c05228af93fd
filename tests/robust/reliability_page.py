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
from tests.robust.trials import table

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

WIDTH = 104

HEAD = """# Reliability in figures

Made by `python -m tests.robust.reliability_page`. An error is *understated* if the true one is larger
than the stated one and that of the better answer together.

## Random questions

`python -m tests.robust.trials.table` draws each from the seed {seed} and its number, so that any can
be asked again: `python -m tests.robust.trials.families speed 100 {seed}`. The suite asks the first of
each family. Shares: the true error over the stated one; seconds with those of the better answer.

| entrance | drawn | compared with | asked | answered | understated | share | median | seconds |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
"""

TAIL = """## Elsewhere

Named cases at the edges of what is allowed, with their references: [hard cases](hard_cases.md). The
suite runs the same questions in four threads at once, in processes that are spawned, with any number
of BLAS threads and beside damaged snapshots, runs and records; they must agree bit for bit, or be
refused.
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


def refusals(rows: Sequence[table.Row]) -> str:
    """What the program did with random words and damaged files."""
    words = [row for row in rows if row.family == "command"]
    files = [row for row in rows if row.family == "damaged"]
    bad = [sum(row.ratio > 0 for row in own) for own in (words, files)]
    slowest = [max(row.seconds for row in own) for own in (words, files)]
    return "\n".join(
        [
            told(
                f"* `sheetcrawl speed` under {len(words)} random lines of one to five options, "
                f"right and "
                f"wrong: {bad[0]} ended with anything but an answer that is JSON and says whether "
                f"it met its "
                f"tolerance, or a refusal of status 1 or 2; the slowest took {slowest[0]:.1f} s."
            ),
            told(
                f"* `sheetcrawl check` of {len(files)} scene files with one to three lines dropped, "
                f"doubled, "
                f"cut, or with strange values and bytes in them: {bad[1]} ended with anything but a "
                f"scene, "
                f"or a refusal that says what is wrong; the slowest took {slowest[1]:.1f} s."
            ),
            "",
        ]
    )


def told(text: str) -> str:
    """A paragraph, or an item of a list, in lines."""
    return textwrap.fill(
        text,
        WIDTH,
        subsequent_indent="  " * text.startswith("*"),
        break_long_words=False,
        break_on_hyphens=False,
    )


def kills() -> str:
    """What sweeps survived."""
    found = json.loads((ROOT / "docs" / "sweeps.json").read_text())["kills"]
    fine = sum(one["fine"] for one in found)
    return told(
        f"Sweeps were killed by SIGKILL at a random instant {len(found)} times and gone on with: "
        f"{fine} "
        "times nothing was lost, twice there, or different in any bit ([more](sweeps.md)). A run "
        "that is "
        "stepped in time goes on bit for bit from its last snapshot, which the suite tests by "
        "killing it."
    )


def page(rows: Sequence[table.Row]) -> str:
    """The whole page."""
    asked = [row for row in rows if row.family in ENTRANCES]
    known = [row for row in asked if not row.refused]
    wrong = sum(row.ratio > 1 for row in known)
    said = told(
        f"Of {len(asked)} questions drawn here {len(known)} were answered, {wrong} of them with an "
        "understated error; the others were refused, with a reason. The process that asked them "
        "needed at most "
        f"{max(row.memory for row in rows):.0f} MB."
    )
    lines = "\n".join([*answers(rows), *others()])
    return "\n".join(
        [
            f"{HEAD.format(seed=table.SEED)}{lines}\n",
            f"{said}\n",
            f"## Command lines and files\n\n{refusals(rows)}",
            f"## Kills\n\n{kills()}\n",
            TAIL,
        ]
    )


def main() -> None:
    """Write the page."""
    with replacing(PAGE) as place:
        place.write_text(page(table.TABLE.read()), encoding="utf-8")


if __name__ == "__main__":
    main()

"""The page on results that others published, docs/validation.md, from its table.

python -m figures.validation.page [--out FILE]
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from figures.common.command import write_page
from figures.measure.validation import TABLE, Row
from figures.validation.catalogue import COMPARISONS, MODULES, SUBJECTS
from figures.validation.comparison import SCENES, Comparison, Confirmed
from linear_theory.common.shown import with_error

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "validation.md"
COMMAND = "python -m figures.validation.page"

UNEXPLAINED = "not explained"
"""First words of a number whose difference nobody could explain."""

MARKS = {Confirmed.READ: "R", Confirmed.DERIVED: "D", Confirmed.MEMORY: "M"}

HEAD = """# Checked against results that others wrote

Numbers that others published, or that follow from independent theory, beside what this package
computes: how far it can be trusted where it was not written to agree.

Made by `python -m figures.validation.page` from figures/data/validation.csv, which
`python -m figures.measure.validation` fills; each comparison is a few lines in figures/validation.

*There* is the published number with its own accuracy, mostly half of its last digit; *here* is
computed by this package with its error: that of the method where it states one, else the distance
between two meshes, which is an upper bound where they converge. Two numbers agree within errors if
they differ by no more than both together. Where they do not, the verdict says by how much and why, or
that it is not explained. Cost is CPU time of one core for all numbers of a comparison. How a number
there was confirmed:

"""

AGAIN = """To compute numbers again:

* a comparison that names **scene files** reads them. `sheetcrawl check FILE` says what a file holds,
  and `sheetcrawl speed FILE` gives the number where that is a speed; a sheet that only curls or lies
  has the speed 0, and the comparison reads its number from its shape, or from its wave;
* those that name none are no scenes that a file can say: they hold edges or load points, refer to a
  curved surface, have a drive that jumps along the sheet or does not repeat (voltages of actuators, one
  front, one pulse), or are formulas of a laminate. They are in the Python module that stands under each
  heading.

`python -m figures.measure.validation --only "NAME"` computes the numbers of any comparison and prints
them.

![Distances of all numbers](../figures/gallery/validation.png)

Each line is a number, in the order of the tables below. Bar: accuracy there and error here together;
mark: distance of the two numbers, at the left edge where it is below 1e-9. Both are relative, and
absolute where the number there is 0. Drawn by `python -m figures.draw.validation`.
"""


def page(rows: Sequence[Row]) -> str:
    """The page of a table."""
    found = {(row.comparison, row.number): row for row in rows}
    lines = [HEAD + "\n".join(_grades()), "", *_summary(found), "", AGAIN]
    for subject, comparisons in SUBJECTS.items():
        place = Path(str(MODULES[subject].__file__)).relative_to(ROOT).as_posix()
        lines += [f"## {subject}", "", f"Module: `{place}`.", "", *_table(comparisons, found), ""]
        lines += [*_sources(comparisons), ""]
    return "\n".join(lines).rstrip() + "\n"


def _grades() -> Iterator[str]:
    told = [f"* **{mark}**: {grade.value}" for grade, mark in MARKS.items()]
    yield ";\n".join(told) + "."


def _summary(found: Mapping[tuple[str, int], Row]) -> Iterator[str]:
    apart = [row for row in found.values() if not row.agrees]
    unexplained = [row for row in apart if _why(row).startswith(UNEXPLAINED)]
    told = f", of which {len(unexplained)} are not explained" if unexplained else ", each explained"
    yield (
        f"**{len(found)} numbers of {len(COMPARISONS)} comparisons: {len(found) - len(apart)} agree "
        f"within errors, {len(apart)} differ{told}.**"
    )


def _table(comparisons: Sequence[Comparison], found: Mapping[tuple[str, int], Row]) -> Iterator[str]:
    yield "| comparison | number | there | here | verdict | cost |"
    yield "| --- " * 6 + "|"
    for comparison in comparisons:
        said = ""
        for k, number in enumerate(comparison.numbers):
            row = found.get((comparison.name, k))
            name = f"**{comparison.name}** ({MARKS[comparison.source.confirmed]})" if k == 0 else ""
            if row is None:
                yield f"| {name} | {number.name} | {number.value:g} | not run | | |"
                continue
            there, here = _number(row.there, row.accuracy), _number(row.here, row.error)
            cost = f"{row.seconds:.2g} s" if k == 0 else ""
            words = verdict(row)
            if not row.agrees and number.why == said:
                words = words.replace(said, "as above")
            said = said if row.agrees else number.why
            yield f"| {name} | {number.name} | {there} | {here} | {words} | {cost} |"


def verdict(row: Row) -> str:
    """In words, from the numbers of the row."""
    if row.agrees:
        return "agrees within errors"
    why = _why(row)
    if row.there == 0:
        return f"differs by {row.here:.2g}: {why}"
    return f"differs by {100 * abs(row.here / row.there - 1):.2g} %: {why}"


def _why(row: Row) -> str:
    return COMPARISONS[row.comparison].numbers[row.number].why


def _number(value: float, error: float) -> str:
    """With its error; to nine digits where that is roundoff."""
    if not error > 1e-9 * abs(value):
        text = f"{value:.9g}"
    elif abs(value) >= 1e-3 or value == 0:
        decimals = max(0, 1 - math.floor(math.log10(error)))
        text = f"{value:.{decimals}f} ± {error:.2g}"
    else:
        text = with_error(value, error)
    return text.replace("-", "\N{MINUS SIGN}")


def _sources(comparisons: Sequence[Comparison]) -> Iterator[str]:
    for comparison in comparisons:
        source = comparison.source
        remark = f" ({source.remark})" if source.remark else ""
        scene = ""
        if comparison.scenes:
            shown = [f"`{(SCENES / s).relative_to(ROOT).as_posix()}`" for s in comparison.scenes]
            scene = f" Scene file{'s' * (len(shown) > 1)}: {', '.join(shown)}."
        yield f"* **{comparison.name}**: {comparison.problem}. {source.text}{remark}.{scene}"


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page."""
    write_page(COMMAND, __doc__, PAGE, lambda: page(TABLE.read()), arguments)


if __name__ == "__main__":
    main()

"""Every number that others published against ours: how far apart they are, and how far they may be.

    python -m figures.draw.validation [--out FOLDER] [--formats png pdf]

One line a number, by subject, from the table of `figures.measure.validation`. Bar: accuracy there and
error here together; mark: the distance of the two numbers, both relative to the number there, or
absolute where that is 0. What is below `SMALLEST` is drawn at the edge.
"""

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures.common import style
from figures.measure.validation import TABLE, Row
from figures.validation.catalogue import COMPARISONS, SUBJECTS
from figures.validation.page import UNEXPLAINED

SMALLEST, LARGEST = 1e-9, 2.0

COLUMNS = 2
PITCH_CM, MARGIN_CM = 0.235, 1.9
"""Of a line, and what axis and legend take."""

AGREES, DIFFERS, OPEN = "agrees within errors", "differs, explained", "differs, not explained"
LOOKS = {
    AGREES: ("o", style.COLORS["blue"], style.COLORS["blue"]),
    DIFFERS: ("D", style.COLORS["orange"], style.COLORS["orange"]),
    OPEN: ("s", "white", style.COLORS["black"]),
}
"""Marker, its face and its edge: shapes alone tell them apart."""

BAR = "0.85"


class Line(NamedTuple):
    """One number, or the heading of a subject: then verdict is empty.

    label: name of the comparison beside its first number; apart, allowed: relative.
    """

    label: str
    verdict: str = ""
    apart: float = 0.0
    allowed: float = 0.0


GAP = Line("")


def line_of(row: Row) -> Line:
    """The line of a number."""
    size = abs(row.there) or 1.0
    why = COMPARISONS[row.comparison].numbers[row.number].why
    verdict = AGREES if row.agrees else OPEN if why.startswith(UNEXPLAINED) else DIFFERS
    label = row.comparison if row.number == 0 else ""
    return Line(label, verdict, abs(row.here - row.there) / size, (row.accuracy + row.error) / size)


def lines(rows: Sequence[Row]) -> list[list[Line]]:
    """Of each subject with its heading, in the order of the catalogue."""
    found = []
    for subject, comparisons in SUBJECTS.items():
        names = [comparison.name for comparison in comparisons]
        told = sorted(
            (r for r in rows if r.comparison in names), key=lambda r: names.index(r.comparison)
        )
        found.append([Line(subject), *map(line_of, told), GAP])
    return found


def columns(groups: Sequence[Sequence[Line]]) -> list[list[Line]]:
    """Subjects in two columns whose heights differ least."""

    def height(part: Sequence[Sequence[Line]]) -> int:
        return sum(map(len, part))

    half = min(range(1, len(groups)), key=lambda k: max(height(groups[:k]), height(groups[k:])))
    parts = groups[:half], groups[half:]
    return [[line for group in part for line in group][:-1] for part in parts]


def draw(rows: Sequence[Row]) -> Figure:
    """Two panels, each one column of the journal wide."""
    parts = columns(lines(rows))
    longest = max(map(len, parts))
    fig = style.figure(width=style.DOUBLE_CM, height=PITCH_CM * longest + MARGIN_CM)
    for axes, part in zip(fig.subplots(1, COLUMNS), parts, strict=True):
        _draw_part(axes, part, longest)
    handles: list[Artist] = [
        Line2D([], [], ls="", marker=marker, mfc=face, mec=edge, label=verdict)
        for verdict, (marker, face, edge) in LOOKS.items()
    ]
    handles.append(Patch(color=BAR, lw=0, label="errors of both together"))
    fig.legend(handles=handles, loc="outside upper center", ncols=len(handles))
    return fig


def _draw_part(axes: Axes, part: Sequence[Line], longest: int) -> None:
    numbers = [(place, line) for place, line in enumerate(part) if line.verdict]
    for place, line in numbers:
        marker, face, edge = LOOKS[line.verdict]
        axes.barh(place, _shown(line.allowed) - SMALLEST, 0.9, SMALLEST, color=BAR, lw=0)
        axes.plot(_shown(line.apart), place, marker, mfc=face, mec=edge, ms=3, mew=0.8, clip_on=False)
    for place, line in enumerate(part):
        weight = "normal" if line.verdict else "bold"
        axes.annotate(
            line.label,
            (0, place),
            (-5, 0),
            xycoords=("axes fraction", "data"),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=6,
            fontweight=weight,
        )
    axes.set(xscale="log", xlim=(SMALLEST, LARGEST), ylim=(longest - 0.5, -0.5), yticks=[])
    axes.set_xticks([1e-8, 1e-6, 1e-4, 1e-2, 1])
    axes.set_xlabel("|here/there \N{MINUS SIGN} 1|")
    axes.grid(axis="x", lw=0.3, color="0.8")
    axes.set_axisbelow(True)


def _shown(value: float) -> float:
    return min(max(value, SMALLEST), LARGEST)


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("validation", __doc__, arguments)
    figure = draw(TABLE.read())
    print(*style.save(figure, "validation", options.out, tuple(options.formats)), sep="\n")


if __name__ == "__main__":
    main()

"""Error against time of other codes: two scenes on the ground, the displacement of a sheet that grows.

python -m figures.draw.peers [--out FOLDER] [--formats png pdf]

From the tables of `figures.measure.peers` and `figures.measure.peers.field`.
"""

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from figures.common import style
from figures.measure.cost.cases import P4, RITZ, TAIL
from figures.measure.peers import field
from figures.measure.peers.command import TABLE, Row
from figures.measure.peers.problems import BLOCK, MUJOCO, NEWTON, OURS, STRIP

LOOKS = {
    OURS: (style.COLORS["blue"], "o"),
    MUJOCO: (style.COLORS["vermillion"], "s"),
    NEWTON: (style.COLORS["green"], "^"),
}
"""Colour and marker of each code."""

NAMES = {BLOCK: "block on an incline", STRIP: "strip that settles"}

SECONDS, ERRORS = (1e-2, 100.0), (3e-5, 2.0)
"""Limits of the axes."""

FIELD_LOOKS = {
    f"{OURS}, {TAIL}": (style.COLORS["blue"], "o"),
    f"{OURS}, {RITZ}": (style.COLORS["sky"], "D"),
    f"{OURS}, {P4}": (style.COLORS["black"], "P"),
    "NGSolve P4": (style.COLORS["orange"], "v"),
    "SfePy Q2": (style.COLORS["vermillion"], "s"),
}
FIELD_SECONDS, FIELD_ERRORS = (1e-4, 1.0), (1e-14, 1.0)

Look = tuple[str, str]
Limits = tuple[float, float]


def draw(rows: Sequence[Row], solved: Sequence[field.Row]) -> Figure:
    """One panel for each scene, and one for the displacement."""
    fig = style.figure(width=style.DOUBLE_CM, height=7.0)
    panels = fig.subplots(1, len(NAMES) + 1)
    for axes, letter, (problem, words) in zip(panels[:-1], "ab", NAMES.items(), strict=True):
        axes.set_title(f"({letter})  {words}", loc="left")
        for code, look in LOOKS.items():
            own = [r for r in rows if (r.problem, r.code) == (problem, code)]
            _draw_code(axes, code, look, [r for r in own if math.isfinite(r.error)])
        _prepare(axes, SECONDS, ERRORS)
    panels[-1].set_title("(c)  sheet that grows", loc="left")
    for code in dict.fromkeys(row.code for row in solved):
        found = [row for row in solved if row.code == code]
        _draw_code(panels[-1], code, FIELD_LOOKS[code], found)
    _prepare(panels[-1], FIELD_SECONDS, FIELD_ERRORS)
    panels[0].set_ylabel("relative error")
    panels[1].legend(loc="lower right", frameon=False)
    panels[-1].legend(loc="lower left", frameon=False)
    return fig


def _prepare(axes: Axes, seconds: Limits, errors: Limits) -> None:
    axes.set(xscale="log", yscale="log", xlim=seconds, ylim=errors, xlabel="processor time (s)")
    axes.xaxis.set_major_locator(LogLocator(numticks=8))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(color="0.93", lw=0.5)
    axes.set_axisbelow(True)


def _draw_code(axes: Axes, code: str, look: Look, rows: Sequence[Row] | Sequence[field.Row]) -> None:
    color, marker = look
    x, y = [r.seconds for r in rows], [r.error for r in rows]
    axes.plot(x, y, marker=marker, ms=4, lw=1, color=color, label=code)


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("peers", __doc__, arguments)
    figure = draw(TABLE.read(), field.TABLE.read())
    print(*style.save(figure, "peers", options.out, tuple(options.formats)), sep="\n")


if __name__ == "__main__":
    main()

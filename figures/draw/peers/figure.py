"""Error against time of codes for soft bodies on two scenes, on the same axes.

python -m figures.draw.peers [--out FOLDER] [--formats png pdf]

From the table of `figures.measure.peers`.
"""

import math
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from figures.common import style
from figures.measure.peers.command import TABLE, Row
from figures.measure.peers.problems import MUJOCO, NEWTON, OURS, TITLES

LOOKS = {
    OURS: (style.COLORS["blue"], "o"),
    MUJOCO: (style.COLORS["vermillion"], "s"),
    NEWTON: (style.COLORS["green"], "^"),
}
"""Colour and marker of each code."""

SECONDS, ERRORS = (1e-2, 100.0), (3e-5, 2.0)
"""Limits of the axes."""


def draw(rows: Sequence[Row]) -> Figure:
    """One panel for each scene."""
    fig = style.figure(width=style.DOUBLE_CM, height=7.0)
    panels = fig.subplots(1, len(TITLES), sharex=True, sharey=True)
    for axes, letter, (problem, title) in zip(panels, "ab", TITLES.items(), strict=True):
        axes.set_title(f"({letter})  {title}", loc="left")
        for code in LOOKS:
            _draw_code(axes, code, [r for r in rows if (r.problem, r.code) == (problem, code)])
        axes.set(xscale="log", yscale="log", xlim=SECONDS, ylim=ERRORS, xlabel="processor time (s)")
        axes.xaxis.set_major_locator(LogLocator(numticks=8))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.grid(color="0.93", lw=0.5)
        axes.set_axisbelow(True)
    panels[0].set_ylabel("relative error")
    handles, names = panels[0].get_legend_handles_labels()
    fig.legend(handles, names, loc="outside upper center", ncols=len(LOOKS))
    return fig


def _draw_code(axes: Axes, code: str, rows: Sequence[Row]) -> None:
    color, marker = LOOKS[code]
    known = [r for r in rows if math.isfinite(r.error)]
    x, y = [r.seconds for r in known], [r.error for r in known]
    axes.plot(x, y, marker=marker, ms=4, lw=1, color=color, label=code)


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("peers", __doc__, arguments)
    figure = draw(TABLE.read())
    print(*style.save(figure, "peers", options.out, tuple(options.formats)), sep="\n")


if __name__ == "__main__":
    main()

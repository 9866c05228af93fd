"""Work-precision diagrams: error against time, one panel for each quantity.

    python -m figures.draw.cost [--out FOLDER] [--data FOLDER] [--formats png pdf]

(a) displacement, (b) small-strain and (c) nonlinear speed, from the table that `figures.measure.cost`
writes.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter, NullLocator

from figures.common import style
from figures.common.folders import DATA
from figures.measure.cost.cases import (
    AUTO,
    BAR,
    CYCLE,
    LINE,
    P2,
    P4,
    PLAIN,
    RITZ,
    SECOND,
    STEPPER,
    STRIP,
    TAIL,
)
from figures.measure.cost.fields import PANEL as FIELD
from figures.measure.cost.speeds import LINEAR, LINEAR_ALPHA, NONLINEAR, NONLINEAR_ALPHA
from figures.measure.cost.tables import REFERENCE, Point, cheapest, curves, read

HEIGHT_CM = 9.0

GREY = "0.45"


class Look(NamedTuple):
    """Colour, marker and line of a level."""

    color: str
    marker: str
    line: str = "-"
    filled: bool = True


LOOKS = {
    LINE: Look(style.COLORS["black"], "*", ""),
    BAR: Look(style.COLORS["black"], "P", ""),
    STRIP: Look(style.COLORS["black"], "X", ""),
    PLAIN: Look(style.COLORS["sky"], "v", "--"),
    TAIL: Look(style.COLORS["blue"], "o"),
    RITZ: Look(style.COLORS["green"], "s"),
    P2: Look(style.COLORS["orange"], "^", "--"),
    P4: Look(style.COLORS["orange"], "^"),
    SECOND: Look(style.COLORS["purple"], "D"),
    CYCLE: Look(style.COLORS["vermillion"], "h"),
    STEPPER: Look(GREY, "o", "-", False),
    AUTO: Look(style.COLORS["black"], "p", ":", False),
}
"""Levels by name; markers tell apart what colours may not."""

KNOBS = {
    (STEPPER, "steps"): Look(GREY, "o", "-", False),
    (STEPPER, "cells across"): Look(GREY, "s", "--", False),
    (STEPPER, "slip speed"): Look(GREY, "d", ":", False),
    (CYCLE, "cells across"): Look(style.COLORS["vermillion"], "h", "--", False),
}
"""Curves of a level that is turned by more than one knob."""

LABELS = {
    (STEPPER, "steps"): "stepper: time step",
    (STEPPER, "cells across"): "stepper: mesh",
    (STEPPER, "slip speed"): "stepper: slip speed",
    (CYCLE, "cells across"): "cycle: mesh",
    (CYCLE, "rtol"): "cycle: tolerance",
}
"""In the legend, where the level alone would not do."""

PEER = Look("0.65", "x", ":")
"""Of codes that are not part of this one."""

LEFT_OUT = {(FIELD, "rtol")}
"""Panels and knobs that stand in the table only: they would hide those of the resolution."""

TITLES = {
    FIELD: "(a)  displacement",
    LINEAR: rf"(b)  $\bar V$, small strain, $\alpha$ = {LINEAR_ALPHA:g}",
    NONLINEAR: rf"(c)  $\bar V$, nonlinear sheet, $\alpha$ = {NONLINEAR_ALPHA:g}",
}

LIMITS = (2e-6, 40.0)
"""Seconds, alike in all panels."""

HEADROOM = 3.0
"""Room, as a factor, above the largest and below the smallest error."""

PLATEAUS = {
    FIELD: ((STRIP, (STRIP,)),),
    LINEAR: ((LINE, (LINE,)), (STRIP, (STRIP,))),
    NONLINEAR: (
        (BAR, (BAR,)),
        (LINE, (LINE,)),
        ("small strain", (TAIL, RITZ)),
        (STRIP, (STRIP,)),
        (SECOND, (SECOND,)),
    ),
}
"""Models that are not the target of a panel: name, and the levels that compute it."""


def draw(points: Sequence[Point]) -> Figure:
    """The figure of the points, from the table alone."""
    fig = style.figure(width=style.DOUBLE_CM, height=HEIGHT_CM)
    panels = fig.subplots(1, len(TITLES))
    for axes, panel in zip(panels, TITLES, strict=True):
        chosen = [p for p in points if p.panel == panel]
        draw_panel(axes, panel, chosen)
    panels[0].set_ylabel("relative error")
    handles = legend_handles(points)
    fig.legend(
        handles=handles, loc="outside upper center", ncols=5, columnspacing=1.4, handlelength=2.4
    )
    return fig


def draw_panel(axes: Axes, panel: str, points: Sequence[Point]) -> None:
    """All curves of a panel on logarithmic axes, plateaus, and what is cheapest for every error."""
    doubt = max((p.error for p in points if p.level == REFERENCE), default=math.nan)
    shown = [p for p in points if p.level != REFERENCE and (panel, p.knob) not in LEFT_OUT]
    errors = [p.error for p in shown] or [1.0]
    axes.set(xscale="log", yscale="log", xlabel="processor time (s)", xlim=LIMITS)
    axes.set_ylim(min(errors) / HEADROOM, min(max(errors) * HEADROOM, 2.0))
    axes.set_title(TITLES[panel], loc="left")
    decades(axes)
    axes.axhspan(1e-16, doubt, color="0.9", lw=0)  # below it, references differ
    draw_frontier(axes, shown)
    for curve in curves(shown):
        draw_curve(axes, curve)
    label_plateaus(axes, panel, shown)


def decades(axes: Axes) -> None:
    """A tick for every decade, labels for some, thin lines behind."""
    axes.xaxis.set_major_locator(FixedLocator([1e-4, 1e-2, 1.0]))
    axes.xaxis.set_minor_locator(LogLocator(subs=(1.0,), numticks=30))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.grid(color="0.93", lw=0.5, which="both")
    axes.set_axisbelow(True)


def draw_frontier(axes: Axes, points: Sequence[Point]) -> None:
    """A broad pale line through the cheapest way to every error."""
    best = cheapest(points)
    if best:
        x = np.array([*(p.seconds for p in best), LIMITS[1]])
        y = np.array([*(p.error for p in best), best[-1].error])
        axes.step(x, y, where="post", color=style.COLORS["yellow"], lw=4, alpha=0.6, zorder=1)


def draw_curve(axes: Axes, curve: Sequence[Point]) -> None:
    """Points with the range of their times, a line, and a thin one through the claimed errors."""
    look = look_of(curve[0].level, curve[0].knob)
    x, y, low, high, claimed, model = (
        np.array([getattr(p, name) for p in curve])
        for name in ("seconds", "error", "fastest", "slowest", "claimed", "model_claimed")
    )
    axes.errorbar(x, y, xerr=[x - low, high - x], zorder=3, elinewidth=0.6, **line_style(look))
    if curve[0].panel == NONLINEAR:  # what is claimed of the numbers alone is not the error there
        claimed = claimed + model
    axes.plot(x, claimed, color=look.color, lw=0.5, ls="-", zorder=2)


def look_of(level: str, knob: str) -> Look:
    """Of a curve; peers, which are not in the list, look alike."""
    return KNOBS.get((level, knob)) or LOOKS.get(level, PEER)


def line_style(look: Look) -> dict[str, Any]:
    """As matplotlib takes it."""
    return {
        "color": look.color,
        "marker": look.marker,
        "ls": look.line or "none",
        "mfc": look.color if look.filled else "white",
        "ms": 5.5 if look.marker == "*" else 3.5,
        "mew": 0.7,
        "lw": 1.0,
    }


def label_plateaus(axes: Axes, panel: str, points: Sequence[Point]) -> None:
    """A dotted line at the error of each model that is not the target; their list below the lowest."""
    lines: list[tuple[float, str]] = []
    for name, levels in PLATEAUS[panel]:
        found = [p for p in points if p.level in levels]
        if found:
            finest = found[-1]
            lines.append((finest.error, f"{name} {100 * finest.error:.2g} %"))
            ends = [max(p.seconds for p in found), LIMITS[1]]
            height = [finest.error] * 2
            axes.plot(ends, height, color="0.4", lw=0.6, ls=(0, (1, 2)), zorder=1)
    if lines:
        words = [text for _, text in sorted(lines, reverse=True)]
        if len(words) > 1:
            words.insert(0, "models:")
        axes.annotate(
            "\n".join(words),
            (LIMITS[0], min(lines)[0]),
            xytext=(3, -4),
            textcoords="offset points",
            va="top",
            fontsize=6.3,
            color="0.25",
        )


def legend_handles(points: Sequence[Point]) -> list[Artist]:
    """One for each curve of the panels in the order of LOOKS, then what the other marks mean."""
    keys: list[tuple[str, str]] = []
    for curve in curves(points):
        first = curve[0]
        drawn = first.panel in TITLES and first.level != REFERENCE
        key = (first.level, first.knob if (first.level, first.knob) in LABELS else "")
        if drawn and (first.panel, first.knob) not in LEFT_OUT and key not in keys:
            keys.append(key)
    names = list(LOOKS)
    keys.sort(key=lambda key: names.index(key[0]) if key[0] in names else len(names))
    handles: list[Artist] = [
        Line2D([], [], label=LABELS.get(key, key[0]), **line_style(look_of(*key))) for key in keys
    ]
    handles.append(Line2D([], [], color="0.2", lw=0.5, label="error that is claimed"))
    handles.append(Line2D([], [], color=style.COLORS["yellow"], lw=4, alpha=0.6, label="cheapest"))
    handles.append(Patch(color="0.9", lw=0, label="references differ"))
    return handles


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("cost", __doc__, arguments, data=(DATA, "folder of the table"))
    figure = draw(read(options.data / "cost.csv", Point))
    print(*style.save(figure, "cost", options.out, tuple(options.formats)), sep="\n")


if __name__ == "__main__":
    main()

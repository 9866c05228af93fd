"""The two panels of figure 3."""

import itertools
from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from figures import style
from figures.fig3_data import ALPHA_SHOWN, LINE_POINTS, PHASE_SHOWN, Fig3Data, Series, Snapshot

Array = NDArray[np.float64]

ARROW_LOOK: dict[str, Any] = {
    "angles": "xy",
    "scale_units": "xy",
    "scale": 14,
    "width": 0.0055,
    "pivot": "mid",
    "zorder": 3,
}
LINE_LOOKS: dict[str, dict[str, Any]] = {
    "theory": {"linestyle": "-", "linewidth": 1.2},
    "printed": {"linestyle": "--", "linewidth": 1.0},
    "law": {"linestyle": ":", "linewidth": 0.8},
}
COLOURS = {1: style.COLORS["vermillion"], 2: style.COLORS["blue"]}
MARKERS = ("o", "s", "^")
"""Of the simulated series, in their order."""


def draw(data: Fig3Data) -> Figure:
    """Panel A on the left, with y to the right; panel B on the right."""
    fig = style.figure(width=style.DOUBLE_CM, height=9.4)
    cells = fig.add_gridspec(1, 2, width_ratios=(1.1, 1))
    left, right = fig.add_subfigure(cells[0]), fig.add_subfigure(cells[1])
    panels = left.subplots(2, 1, sharex=True, sharey=True)
    for axes, shot in zip(panels, data.snapshots, strict=True):
        colours = _draw_sheet(axes, shot)
    _draw_keys(panels)
    bar = left.colorbar(colours, ax=panels, shrink=0.4, aspect=18, ticks=[-1, 0, 1])
    bar.set_label("growth $c$", labelpad=0)
    _draw_speeds(right.subplots(), data)
    instant = rf"$\alpha$ = {ALPHA_SHOWN:g}, $t/T$ = {PHASE_SHOWN:g}"
    left.suptitle(rf"$\mathbf{{A}}$   friction on the sheet at {instant}", x=0.01, ha="left")
    right.suptitle(r"$\mathbf{B}$   mean speed, positive along the wave", x=0.01, ha="left")
    return fig


def _draw_sheet(axes: Axes, shot: Snapshot) -> QuadMesh:
    """Colour, triangles, outline, sheet at rest and arrows of one snapshot."""
    x, y = shot.position
    colours = axes.pcolormesh(
        y, x, shot.growth, cmap=_colour_map(), vmin=-1, vmax=1, shading="gouraud", rasterized=True
    )
    if shot.edges is not None:
        sides = LineCollection(list(shot.edges[..., ::-1]), colors="0.35", linewidths=0.25, zorder=2)
        axes.add_collection(sides)
    axes.plot(_around(y), _around(x), color="black", linewidth=0.7)
    axes.quiver(*shot.moved[::-1], *shot.force[::-1], **ARROW_LOOK)
    axes.set(aspect="equal", xlabel="$y/L$", ylabel="$x/L$")
    axes.use_sticky_edges = False
    axes.margins(0.04)
    axes.set(xticks=[-0.5, 0, 0.5], yticks=[-0.25, 0, 0.25])
    axes.label_outer()
    axes.set_title(shot.label, loc="left")
    return colours


def _draw_keys(panels: Sequence[Axes]) -> None:
    """Beside the titles: the way of the wave, and the length of an arrow of friction."""
    top, bottom = panels
    place: dict[str, Any] = {"xycoords": "axes fraction", "va": "center"}
    top.annotate("", (1, 1.07), (0.84, 1.07), arrowprops={"arrowstyle": "-|>", "lw": 1.5}, **place)
    top.annotate("wave", (0.82, 1.07), ha="right", fontsize=7, **place)
    key = bottom.quiver([0], [0], [0], [0], **ARROW_LOOK)
    label = r"friction $\mu w$"
    bottom.quiverkey(
        key, 0.95, 1.07, 1.0, label, labelpos="W", labelsep=0.15, fontproperties={"size": 7}
    )


def _colour_map() -> LinearSegmentedColormap:
    """Blue to red without the darkest ends, on which black arrows would not show."""
    shades = mpl.colormaps["RdBu_r"](np.linspace(0.18, 0.82, 256))
    return LinearSegmentedColormap.from_list("growth", shades)


def _around(values: Array) -> Array:
    """Values on a grid, once around its edge."""
    return np.concatenate([values[0], values[:, -1], values[-1, ::-1], values[::-1, 0]])


def _draw_speeds(axes: Axes, data: Fig3Data) -> None:
    """Lines, symbols and the largest alpha of panel B."""
    for series in data.series:
        if series.kind != "simulation":
            _draw_line(axes, series)
    simulated = [series for series in data.series if series.kind == "simulation"]
    for series, marker in zip(simulated, itertools.cycle(MARKERS)):
        axes.errorbar(
            series.alpha, series.speed, series.error, ls="none", marker=marker, mfc="white",
            color=COLOURS[series.dimension], label=series.label, zorder=3,
        )  # fmt: skip
    axes.axhline(0, color="black", linewidth=0.6)
    axes.axvline(data.largest_alpha, color="0.6", linewidth=0.6)
    note: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7}
    axes.annotate(
        "load reaches 0",
        (data.largest_alpha, 0),
        (-2, -6),
        rotation=90,
        ha="right",
        va="top",
        color="0.4",
        **note,
    )
    axes.annotate(
        "2D: load 'current',\nCoulomb friction",
        (0, 0.04),
        (6, 0),
        xycoords=("data", "axes fraction"),
        **note,
    )
    axes.set(xlim=(0, None), xlabel=r"growth coupling $\alpha$", ylabel="mean speed $V$  ($L/T$)")
    axes.legend(loc="upper left")


def _draw_line(axes: Axes, series: Series) -> None:
    """Through the speeds by a cubic spline, level at alpha = 0 where V is of second order."""
    alphas = np.linspace(series.alpha[0], series.alpha[-1], LINE_POINTS)
    speeds = CubicSpline(series.alpha, series.speed, bc_type=((1, 0.0), "not-a-knot"))(alphas)
    look = LINE_LOOKS[series.kind]
    axes.plot(alphas, speeds, color=COLOURS[series.dimension], label=series.label, **look)

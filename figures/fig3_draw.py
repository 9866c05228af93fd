"""The three panels of figure 3."""

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from figures import nonlinear, style
from figures.fig3_data import ALPHA_SHOWN, LINE_POINTS, PHASE_SHOWN, Fig3Data, Snapshot
from figures.fig3_speed import Series

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
SYMBOL_LOOKS: dict[str, dict[str, Any]] = {
    "2D, linear FEM": {"marker": "o", "markersize": 4.5, "mfc": "white"},
    "2D, nonlinear sheet": {"marker": "s", "markersize": 3.2},
    "1D, finite strain": {"marker": "^", "markersize": 3.8},
}
REGIME_LOOKS: dict[str, dict[str, Any]] = {
    "dry": {"marker": "s", "markersize": 3.5, "color": style.COLORS["blue"]},
    "mixed": {"marker": "D", "markersize": 3.3, "color": style.COLORS["green"]},
    "viscous": {"marker": "v", "markersize": 4.0, "color": style.COLORS["purple"]},
}
"""Of panel C; "s" in blue is the nonlinear sheet under dry friction in B, too."""

LEGEND: dict[str, Any] = {"handlelength": 1.5, "columnspacing": 0.5, "labelspacing": 0.35}
NOTE: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7}


def draw(data: Fig3Data) -> Figure:
    """Panel A on the left, with y to the right; panels B and C on the right."""
    fig = style.figure(width=style.DOUBLE_CM, height=12.6)
    cells = fig.add_gridspec(1, 2, width_ratios=(1.08, 1))
    left, right = fig.add_subfigure(cells[0]), fig.add_subfigure(cells[1])
    panels = left.subplots(2, 1, sharex=True, sharey=True)
    for axes, shot in zip(panels, data.snapshots, strict=True):
        colours = _draw_sheet(axes, shot)
    _draw_keys(panels)
    bar = left.colorbar(colours, ax=panels, location="bottom", shrink=0.4, aspect=18, ticks=[-1, 0, 1])
    bar.set_label("growth $c$", labelpad=0)
    instant = rf"$\alpha$ = {ALPHA_SHOWN:g}, $t/T$ = {PHASE_SHOWN:g}"
    left.suptitle(rf"$\mathbf{{A}}$   friction on the sheet at {instant}", x=0.01, ha="left")
    upper, lower = right.subplots(2, 1, sharex=True)
    _draw_speeds(upper, data)
    _draw_regimes(lower, data)
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
        colour = COLOURS[series.dimension]
        if series.kind == "simulation":
            look = SYMBOL_LOOKS[series.label]
            _draw_symbols(axes, series, 0, color=colour, label=series.label, **look)
        else:
            look = LINE_LOOKS[series.kind]
            _draw_line(axes, series, 0, color=colour, label=series.label, **look)
    axes.plot([0, data.largest_alpha], [0, 0], color="black", linewidth=0.6)
    axes.axvline(data.largest_alpha, color="0.6", linewidth=0.6)
    end = (data.largest_alpha, 0)
    axes.annotate("load reaches 0", end, (2, 4), rotation=90, color="0.4", **NOTE)
    corner: dict[str, Any] = {"xycoords": ("data", "axes fraction"), **NOTE}
    axes.annotate("2D: load 'current',\nCoulomb friction", (0, 0.04), (6, 0), **corner)
    axes.set(ylim=(-0.17, 0.49), ylabel="mean speed $V$  ($L/T$)")
    _draw_legend(axes)
    _title(axes, "B", "mean speed, positive along the wave")


def _draw_legend(axes: Axes) -> None:
    """2D in the first column, 1D in the second, lines above symbols."""
    pairs = sorted(zip(*axes.get_legend_handles_labels(), strict=True), key=lambda p: p[1][:2] == "1D")
    handles, labels = zip(*pairs, strict=True)
    axes.legend(handles, labels, loc="upper left", ncols=2, **LEGEND)


def _draw_regimes(axes: Axes, data: Fig3Data) -> None:
    """Lines of linear theory and symbols of the nonlinear sheet of panel C."""
    handles = []
    for line, symbols in zip(data.slips[::2], data.slips[1::2], strict=True):
        look = REGIME_LOOKS[line.friction]
        label = rf"{line.friction}: $v_0$ = {nonlinear.SLIPS[line.friction]:g} $\alpha L/T$"
        _draw_line(axes, line, 2, color=look["color"], linewidth=1.2)
        _draw_symbols(axes, symbols, 2, label=symbols.label, **look)
        handles.append(Line2D([], [], label=label, linewidth=1.2, **look))
    axes.axvline(data.largest_alpha, color="0.6", linewidth=0.6)
    axes.set(xlim=(0, None), ylim=(0.85, 2.15))
    axes.set(xlabel=r"growth coupling $\alpha$", ylabel=r"$V/\alpha^2$  ($L/T$)")
    axes.legend(handles=handles, loc="upper right", bbox_to_anchor=(0.95, 1.02), **LEGEND)
    _title(axes, "C", "linear theory (lines), nonlinear sheet (symbols)")


def _title(axes: Axes, letter: str, text: str) -> None:
    axes.set_title(rf"$\mathbf{{{letter}}}$   {text}", loc="left", x=-0.18)


def _draw_line(axes: Axes, series: Series, power: int, **look: Any) -> None:
    """V/alpha^power by a cubic spline, level at alpha = 0 as V is even in alpha and of second order."""
    alphas = np.linspace(series.alpha[0], series.alpha[-1], LINE_POINTS)
    values = series.speed / series.alpha**power
    axes.plot(
        alphas, CubicSpline(series.alpha, values, bc_type=((1, 0.0), "not-a-knot"))(alphas), **look
    )


def _draw_symbols(axes: Axes, series: Series, power: int, **look: Any) -> None:
    """V/alpha^power with its error."""
    unit = series.alpha**power
    axes.errorbar(series.alpha, series.speed / unit, series.error / unit, ls="none", zorder=3, **look)

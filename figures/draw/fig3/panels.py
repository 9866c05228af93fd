"""The four panels of figure 3."""

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

from figures.common import style
from figures.draw.fig3.data import ALPHA_SHOWN, LINE_POINTS, PHASE_SHOWN, Fig3Data, Snapshot
from figures.draw.fig3.speeds import LABELS, Series
from figures.measure import nonlinear

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
    "second": {"linestyle": (0, (5, 1.2, 1, 1.2)), "linewidth": 1.0},
}
COLOURS = {1: style.COLORS["vermillion"], 2: style.COLORS["blue"]}
SYMBOL_LOOKS: dict[str, dict[str, Any]] = {
    LABELS["elements"]: {"marker": "o", "markersize": 4.5, "mfc": "white"},
    LABELS["sheet"]: {"marker": "s", "markersize": 3.2},
    LABELS["bar"]: {"marker": "^", "markersize": 3.8},
}
REGIME_LOOKS: dict[str, dict[str, Any]] = {
    "dry": {"marker": "s", "markersize": 3.5, "color": style.COLORS["blue"]},
    "mixed": {"marker": "D", "markersize": 3.3, "color": style.COLORS["green"]},
    "viscous": {"marker": "v", "markersize": 4.0, "color": style.COLORS["purple"]},
}
"""Of panel D; "s" in blue is the nonlinear sheet under dry friction in B and C, too."""

HEIGHT_CM, ROWS, COLUMNS = 15.5, (0.62, 1), (1.08, 1)
"""Of the figure; shares of panel A and of the rest in it; of panel B and of C and D."""

BOTTOM = -0.17
"""Of panel B, L/T."""

LEGEND: dict[str, Any] = {"handlelength": 1.5, "columnspacing": 0.5, "labelspacing": 0.3}
NOTE: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7}


def draw(data: Fig3Data) -> Figure:
    """Panel A across the top, with y to the right; below it B, and beside that C above D."""
    fig = style.figure(width=style.DOUBLE_CM, height=HEIGHT_CM)
    rows = fig.add_gridspec(2, 1, height_ratios=ROWS)
    top, bottom = fig.add_subfigure(rows[0]), fig.add_subfigure(rows[1])
    panels = top.subplots(1, 2, sharex=True, sharey=True)
    for axes, shot in zip(panels, data.snapshots, strict=True):
        colours = _draw_sheet(axes, shot)
    _draw_keys(panels)
    top.colorbar(colours, ax=panels, shrink=0.7, aspect=14, ticks=[-1, 0, 1], label="growth $c$")
    instant = rf"$\alpha$ = {ALPHA_SHOWN:g}, $t/T$ = {PHASE_SHOWN:g}"
    top.suptitle(rf"$\mathbf{{A}}$   friction on the sheet at {instant}", x=0.01, ha="left")
    cells = bottom.add_gridspec(2, 2, width_ratios=COLUMNS)
    speeds, ratios = bottom.add_subplot(cells[:, 0]), bottom.add_subplot(cells[0, 1])
    regimes = bottom.add_subplot(cells[1, 1], sharex=ratios)
    _draw_speeds(speeds, data)
    _draw_ratios(ratios, data)
    _draw_regimes(regimes, data)
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
    _draw_series(axes, data.series, 0)
    axes.plot([0, data.largest_alpha], [0, 0], color="black", linewidth=0.6)
    _draw_limit(axes, data)
    end = (data.largest_alpha, BOTTOM)
    axes.annotate("load reaches 0", end, (2, 4), rotation=90, color="0.4", **NOTE)
    corner: dict[str, Any] = {"xycoords": ("data", "axes fraction"), **NOTE}
    axes.annotate("sheet: load 'current'\nCoulomb friction", (0, 0.04), (6, 0), **corner)
    axes.set(xlim=(0, None), ylim=(BOTTOM, 0.5))
    axes.set(xlabel=r"growth coupling $\alpha$", ylabel="mean speed $V$  ($L/T$)")
    axes.legend(loc="upper left", **LEGEND)
    _title(axes, "B", "mean speed, positive along the wave", -0.135)


def _draw_ratios(axes: Axes, data: Fig3Data) -> None:
    """Panel B over alpha^2, without the print, which has the other sign."""
    _draw_series(axes, [series for series in data.series if series.kind != "printed"], 2)
    _draw_limit(axes, data)
    axes.set(ylim=(0.65, 2.05), ylabel=r"$V/\alpha^2$  ($L/T$)")
    axes.tick_params(labelbottom=False)
    _title(axes, "C", r"the same models, $V/\alpha^2$")


def _draw_series(axes: Axes, chosen: Sequence[Series], power: int) -> None:
    """V/alpha^power by all models: lines and symbols in the colours of the dimension."""
    for series in chosen:
        colour = COLOURS[series.dimension]
        if series.kind == "simulation":
            look = SYMBOL_LOOKS[series.label]
            _draw_symbols(axes, series, power, color=colour, label=series.label, **look)
        else:
            look = LINE_LOOKS[series.kind]
            _draw_line(axes, series, power, color=colour, label=series.label, **look)


def _draw_limit(axes: Axes, data: Fig3Data) -> None:
    axes.axvline(data.largest_alpha, color="0.6", linewidth=0.6)


def _draw_regimes(axes: Axes, data: Fig3Data) -> None:
    """Lines of linear theory and symbols of the nonlinear sheet of panel D."""
    handles = []
    for line, symbols in zip(data.slips[::2], data.slips[1::2], strict=True):
        look = REGIME_LOOKS[line.friction]
        label = f"{line.friction}: {nonlinear.SLIPS[line.friction]:g}"
        _draw_line(axes, line, 2, color=look["color"], linewidth=1.2)
        _draw_symbols(axes, symbols, 2, label=symbols.label, **look)
        handles.append(Line2D([], [], label=label, linewidth=1.2, **look))
    _draw_limit(axes, data)
    axes.set(xlim=(0, None), ylim=(0.85, 2.6), yticks=[1, 1.5, 2])
    axes.set(xlabel=r"growth coupling $\alpha$", ylabel=r"$V/\alpha^2$  ($L/T$)")
    look = LEGEND | {"columnspacing": 1.2, "title_fontsize": 7, "alignment": "left"}
    title = r"friction $\tanh(v/v_0)$, slip speed $v_0/(\alpha L/T)$"
    axes.legend(handles=handles, loc="upper left", ncols=3, title=title, **look)
    _title(axes, "D", "linear strains (lines), nonlinear sheet (symbols)")


def _title(axes: Axes, letter: str, text: str, x: float = -0.18) -> None:
    axes.set_title(rf"$\mathbf{{{letter}}}$   {text}", loc="left", x=x)


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

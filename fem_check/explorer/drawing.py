"""The two figures of the page, and the data that they draw."""

from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from fem_check.explorer.small_strain import FIRST, STRIP, Curve, Picture
from fem_check.explorer.text import PREDICTED, UNIT
from fem_check.output.look import COLORS
from linear_theory.common.extras import optional

ARROW = 0.07
"""Length of the arrow of a force mu times the weight, over that of the sheet."""

MARGIN = 1.25
"""Size of the frame over that of the undeformed sheet."""

LINE_POINTS = 41
"""Of a line through the points of V(alpha)."""

SHEET_HEIGHT, CURVE_HEIGHT = 240, 240
"""Of the figures, in pixels."""


class Figures(NamedTuple):
    """sheet, curve: the figures; sources: their data by name."""

    sheet: Any
    curve: Any
    sources: dict[str, Any]


def figures() -> Figures:
    """Empty figures; `sheet_data` and `curve_data` fill them."""
    models = optional("bokeh.models", "explorer", "sheetcrawl explore")
    sources = {name: models.ColumnDataSource(data, name=name) for name, data in EMPTY.items()}
    return Figures(_sheet(sources), _curve(sources), sources)


POINTS: dict[str, Any] = {name: [] for name in ("alpha", "mean", "lower", "upper")}

EMPTY: dict[str, dict[str, Any]] = {
    "cells": {"xs": [], "ys": [], "c": []},
    "frame": {"x": [-0.5, 0.5], "y": [-0.25, 0.25]},
    "arrows": {name: [] for name in ("x0", "y0", "x1", "y1", "angle")},
    FIRST: POINTS,
    PREDICTED: POINTS,
    f"{STRIP} line": {"alpha": [0.0, 0.5], "mean": [0.0, 0.0]},
    f"{FIRST} line": {"alpha": [], "mean": []},
    "now": {"alpha": [0.0]},
}
"""Data of the figures before there is an answer: a frame and an axis, which set the first ranges."""


def _figure(**arguments: Any) -> Any:
    plotting = optional("bokeh.plotting", "explorer", "sheetcrawl explore")
    figure = plotting.figure(
        sizing_mode="stretch_width", toolbar_location=None, output_backend="canvas", **arguments
    )
    figure.grid.grid_line_alpha = 0.3
    return figure


def _sheet(sources: dict[str, Any]) -> Any:
    """The deformed sheet, +y to the right, coloured by growth, with friction as arrows."""
    models = optional("bokeh.models", "explorer", "sheetcrawl explore")
    figure = _figure(height=SHEET_HEIGHT, match_aspect=True, tools="")
    figure.xaxis.axis_label, figure.yaxis.axis_label = "y, along the wave", "x"
    palettes = optional("bokeh.palettes", "explorer", "sheetcrawl explore")
    # As in pictures and films, orange where the sheet shrinks.
    palette = palettes.interp_palette(palettes.PuOr11[::-1], 256)[40:216]
    colours = models.LinearColorMapper(palette=palette, low=-1, high=1)
    figure.scatter("x", "y", size=0, alpha=0, source=sources["frame"])
    colour = {"field": "c", "transform": colours}
    figure.patches(
        "xs", "ys", source=sources["cells"], line_width=0.5, line_color=colour, fill_color=colour
    )  # fmt: skip
    ink = {"source": sources["arrows"], "color": COLORS["vermillion"]}
    figure.segment("x0", "y0", "x1", "y1", line_width=1.5, **ink)
    figure.scatter("x1", "y1", marker="triangle", size=6, angle="angle", **ink)
    figure.add_layout(models.ColorBar(color_mapper=colours, width=8), "right")
    return figure


def _curve(sources: dict[str, Any]) -> Any:
    """V(alpha) at all levels, with errors."""
    models = optional("bokeh.models", "explorer", "sheetcrawl explore")
    figure = _figure(height=CURVE_HEIGHT, tools="hover", tooltips=[("alpha", "@alpha"), ("V", "@mean")])
    figure.xaxis.axis_label, figure.yaxis.axis_label = "growth coupling alpha", f"V, {UNIT}"
    figure.add_layout(models.Span(location=0, dimension="width", line_color="gray", line_width=0.5))
    figure.vspan("alpha", source=sources["now"], line_dash="dotted", line_color="black")
    for level, colour in ((STRIP, "green"), (FIRST, "blue")):
        name = {"legend_label": "narrow strip"} if level == STRIP else {}
        figure.line("alpha", "mean", source=sources[f"{level} line"], color=COLORS[colour], **name)
    marks = (
        (FIRST, "circle", "blue", "small strain"),
        (PREDICTED, "diamond", "vermillion", "nonlinear"),
    )
    for level, marker, colour, words in marks:
        ink = {"source": sources[level], "color": COLORS[colour]}
        size = 12 if level == PREDICTED else 6
        figure.scatter("alpha", "mean", marker=marker, size=size, legend_label=words, **ink)
        figure.add_layout(
            models.Whisker(
                base="alpha",
                lower="lower",
                upper="upper",
                source=sources[level],
                line_color=COLORS[colour],
                upper_head=models.TeeHead(size=6),
                lower_head=models.TeeHead(size=6),
            )
        )
    figure.add_layout(figure.legend[0], "above")
    figure.legend.orientation, figure.legend.border_line_color = "horizontal", None
    return figure


def sheet_data(picture: Picture) -> dict[str, dict[str, Any]]:
    """Of a picture, data of the sources "cells", "frame" and "arrows"; y to the right, x upwards.

    >>> from fem_check.explorer.drawing import sheet_data
    >>> from fem_check.explorer.question import Question
    >>> from fem_check.explorer.small_strain import picture
    >>> data = sheet_data(picture(Question(), phase=0.0))
    >>> len(data["cells"]["xs"]), len(data["arrows"]["x0"])
    (288, 75)
    """
    x, y = picture.corners.transpose(1, 2, 0)
    across, along = MARGIN * picture.extent
    start, move = picture.place, 2 * picture.extent[1] * ARROW * picture.force
    end = start + move
    return {
        "cells": {"xs": list(y), "ys": list(x), "c": picture.growth},
        "frame": {"x": [-along, along], "y": [-across, across]},
        "arrows": {
            "x0": start[1], "y0": start[0], "x1": end[1], "y1": end[0],
            "angle": np.arctan2(move[0], move[1]) - np.pi / 2,
        },
    }  # fmt: skip


def curve_data(curve: Curve) -> dict[str, dict[str, Any]]:
    """Of a curve, data of its sources: points with error bars, and a line through them.

    >>> from fem_check.explorer.drawing import curve_data
    >>> from fem_check.explorer.small_strain import Curve
    >>> data = curve_data(Curve("first order", [0.0, 0.1, 0.2], [0.0, 0.01, 0.04], [0.0, 1e-3, 1e-3]))
    >>> print(data["first order"]["upper"])
    [0.    0.011 0.041]
    """
    means, errors = np.array(curve.means), np.nan_to_num(curve.errors)
    points = {"alpha": curve.alphas, "mean": means, "lower": means - errors, "upper": means + errors}
    data = {curve.level: points, f"{curve.level} line": _line(curve)}
    return {name: value for name, value in data.items() if name in EMPTY}


def _line(curve: Curve) -> dict[str, Any]:
    """A smooth line through the points, without extrema of its own."""
    if len(curve.alphas) < 2:
        return {"alpha": curve.alphas, "mean": curve.means}
    alphas = np.linspace(curve.alphas[0], curve.alphas[-1], LINE_POINTS)
    return {"alpha": alphas, "mean": PchipInterpolator(curve.alphas, curve.means)(alphas)}

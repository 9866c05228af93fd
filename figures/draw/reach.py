"""Map of how far in alpha the second order reaches, over the width of the sheet.

    python -m figures.draw.reach [--out FOLDER] [--formats png pdf]

Colours and full lines: by how much V_2 alpha^2 differs from the speed V of the nonlinear sheet,
relative to V. Dashed: the narrow strip at finite strain, exact in its width but for the width itself.
Default model (growth law exp, energy per grown area, current load, dry friction, one sine wave), nu =
1/2. Grey: no static shape, or none that is stable against short wrinkles of its edges. The speeds are
read from the table of `figures.measure.reach`, figures/data/reach_speeds.csv; between them splines,
over alpha and over the logarithm of the width.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from figures.common import output, style
from figures.measure.reach import REACHES, SHARES, SPEEDS, Point, Reach, curve

Array = NDArray[np.float64]

POISSON = 0.5

STRIP_SHARES, STRIP_WIDTH = SHARES[1:], 0.5
"""What is drawn of the strip, and up to which width over L: wider sheets meet its speed by accident."""

LABELLED = 0.14, 0.045
"""Width over L and alpha at which the lines of the second order and of the strip are labelled."""

GRID = 121, 101
"""Points over the width and over alpha."""

FILLS = ("#FFFFFF", "#DCE9F5", "#A9CCE5", "#6BA6D0")
"""Of differences below 1, 5 and 10 per cent and above: lightness alone tells them apart."""

UNKNOWN, STRIP_COLOUR = "0.82", style.COLORS["vermillion"]


class Map(NamedTuple):
    """Over a curved grid (widths, alphas): W/L, alpha, and V_theory/V - 1 of both theories.

    The last alpha of a row is the largest with a speed.
    """

    width: Array
    alpha: Array
    second_order: Array
    strip: Array


def compute(table: Sequence[Point]) -> Map:
    """The map from speeds of some widths: splines over alpha up to the last, then over log(width)."""
    widths = sorted({p.width for p in table})
    sheets = [sorted((p for p in table if p.width == w), key=lambda p: p.alpha) for w in widths]
    share = np.linspace(0, 1, GRID[1])
    limits = np.array([sheet[-1].alpha for sheet in sheets])
    fine = np.geomspace(widths[0], widths[-1], GRID[0])

    def across(values: Array) -> Array:
        return np.asarray(PchipInterpolator(np.log(widths), values, axis=0)(np.log(fine)))

    second, strip = (
        across(np.array([curve(sheet, name)(share * sheet[-1].alpha) for sheet in sheets]))
        for name in ("second_order", "strip")
    )
    alpha = across(limits)[:, None] * share
    return Map(np.broadcast_to(fine[:, None], alpha.shape), alpha, second, strip)


def draw(found: Map, largest: float) -> Figure:
    """One panel, one column wide; largest: alpha at which the axis ends."""
    fig = style.figure(width=style.COLUMN_CM, height=7.4)
    axes = fig.subplots()
    axes.set(facecolor=UNKNOWN, yscale="log", xlim=(0, largest))
    _draw_second(axes, found)
    _draw_strip(axes, found)
    ends = found.width[[0, -1], 0]
    axes.set_title("difference to the nonlinear sheet", loc="left")
    axes.set(ylim=ends, xlabel=r"growth coupling $\alpha$", ylabel="width over length $W/L$")
    ticks = [w for w in (0.1, 0.2, 0.5, 1.0, 2.0) if ends[0] <= w <= ends[1]]
    axes.set_yticks(ticks, [f"{w:g}" for w in ticks])
    axes.set_yticks([], minor=True)
    axes.tick_params(axis="x", pad=5)  # the first labels of both axes share a corner
    axes.annotate(
        "no stable\nshape",
        (0.98, 0.93),
        xycoords="axes fraction",
        ha="right",
        va="top",
        fontsize=7,
    )
    handles = [
        Line2D([], [], color="black", label=r"2nd order, $V_2\alpha^2$"),
        Line2D([], [], color=STRIP_COLOUR, linestyle="--", label="narrow strip"),
    ]
    fig.legend(handles=handles, loc="outside upper center", ncols=2)
    return fig


def _draw_second(axes: Axes, found: Map) -> None:
    """Filled between the shares, with lines at them."""
    size = abs(found.second_order)
    levels = [0, *SHARES, 1 + size.max()]
    axes.contourf(found.alpha, found.width, size, levels=levels, colors=FILLS)
    lines = axes.contour(found.alpha, found.width, size, levels=SHARES, colors="black", linewidths=1.0)
    row = np.argmin(abs(found.width[:, 0] - LABELLED[0]))
    alphas = np.interp(SHARES, size[row], found.alpha[row])
    places = [(alpha, found.width[row, 0]) for alpha in alphas]
    axes.clabel(lines, fmt=_percent, fontsize=7, manual=places)


def _draw_strip(axes: Axes, found: Map) -> None:
    """Lines alone, where the sheet is narrow."""
    narrow = found.width[:, 0] <= STRIP_WIDTH
    alpha, width, size = (v[narrow] for v in (found.alpha, found.width, abs(found.strip)))
    lines = axes.contour(
        alpha,
        width,
        size,
        levels=STRIP_SHARES,
        colors=STRIP_COLOUR,
        linewidths=1.0,
        linestyles="--",
    )
    column = np.argmin(abs(alpha[0] - LABELLED[1]))
    widths = np.interp(STRIP_SHARES, size[:, column], width[:, column])
    places = [(alpha[0, column], w) for w in widths]
    axes.clabel(lines, fmt=_percent, fontsize=7, manual=places)


def _percent(level: float) -> str:
    return f"{100 * level:g} %"


def write(
    points: Sequence[Point], reaches: Sequence[Reach], out: Path | None, formats: Sequence[str]
) -> list[Path]:
    """Figure, and its numbers (JSON): reach and coefficients by Poisson ratio and width."""
    chosen = [p for p in points if p.poisson == POISSON]
    figure = draw(compute(chosen), max(p.alpha for p in chosen))
    numbers: dict[str, dict[str, object]] = {}
    for row in reaches:
        numbers.setdefault(f"poisson {row.poisson:g}", {})[f"width {row.width:g}"] = {
            name: value for name, value in row.__dict__.items() if name not in ("width", "poisson")
        }
    return [
        *style.save(figure, "reach", out, tuple(formats)),
        output.write_json(style.output_path("reach.json", out), numbers),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw and write the map."""
    options = style.options("reach", __doc__, arguments)
    for path in write(SPEEDS.read(), REACHES.read(), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

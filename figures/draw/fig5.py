"""Figure 5 of the paper: speed of trapezoids of one area.

    python -m figures.draw.fig5 [--out FOLDER] [--formats png pdf]

V per cycle over w1/w2, the widths of the rear and of the leading edge with respect to the wave, and the
length L'; from the table of `figures.measure.paper.trapezoids`, kappa = beta/h, viscous friction.
Hatched: |V| is below its error. Grey: not computed. Circles: the best length of each ratio. Dashed:
that which the paper calls the best.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from figures.common import style
from figures.draw.speed_map import Colours, Grid, draw_places, draw_speeds, grid, is_map
from figures.measure.paper.trapezoids import GAITS, TABLE, Row

OPTIMUM = {"forward": 0.9, "backward": 1.4}
"""L' of largest speed, as the paper says."""

WAY = {"forward": 1, "backward": -1}


def optimum(found: Grid, way: int) -> dict[float, float]:
    """By ratio, the length of the largest speed in a direction: the top of a parabola through three.

    A largest speed at an end of the range is that of the end.
    """
    tops = {}
    for ratio, column in zip(found.x.tolist(), way * found.speed.T, strict=True):
        if np.isnan(column).any():
            continue
        k = int(column.argmax())
        if 0 < k < column.size - 1:
            a, b, _ = np.polyfit(found.y[k - 1 : k + 2], column[k - 1 : k + 2], 2)
            tops[ratio] = float(-b / (2 * a))
        else:
            tops[ratio] = float(found.y[k])
    return tops


def of(rows: Sequence[Row], gait: str, reading: str = "thickness", friction: str = "viscous") -> Grid:
    """The map of a gait."""
    kept = [r for r in rows if (r.gait, r.reading, r.friction) == (gait, reading, friction)]
    return grid(kept, "ratio", "length")


def draw_gait(ax: Axes, gait: str, found: Grid, colours: Colours) -> Any:
    """One panel; its image."""
    if is_map(found):
        image = draw_speeds(ax, found._replace(x=np.log2(found.x)), colours)
    else:
        x, y = np.meshgrid(np.log2(found.x), found.y)
        image = draw_places(ax, x.ravel(), y.ravel(), found.speed.ravel(), colours)
        ax.set_xlim(-2.2, 2.2)
    tops = optimum(found, WAY[gait])
    ax.plot(
        np.log2(list(tops)),
        list(tops.values()),
        "o",
        color="gold",
        mec="black",
        mew=0.7,
        markersize=4.5,
    )
    ax.axhline(OPTIMUM[gait], linestyle="--", color="black", linewidth=0.8)
    ax.set_xticks([-2, -1, 0, 1, 2], labels=["1/4", "1/2", "1", "2", "4"])
    ax.set(xlabel="$w_1/w_2$ (rear over front)")
    ax.set_title(f"{gait} gait", loc="left")
    return image


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw and write the figure."""
    options = style.options("fig5", __doc__, arguments)
    rows = TABLE.read()
    fig = style.figure(style.DOUBLE_CM, 6.5)
    for ax, gait in zip(fig.subplots(1, 2, sharey=True), GAITS, strict=True):
        found = of(rows, gait)
        image = draw_gait(ax, gait, found, Colours.of(found.speed))
        fig.colorbar(image, ax=ax, label="$V$ ($L$ a cycle)")
    fig.axes[0].set_ylabel("length $L'/L$")
    for path in style.save(fig, "fig5", options.out, tuple(options.formats)):
        print(path)


if __name__ == "__main__":
    main()

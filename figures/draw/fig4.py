"""Figure 4 of the seed paper: speed over growth and rest curvature, with its gaits in three readings.

    python -m figures.draw.fig4 [--out FOLDER] [--formats png pdf]

V per cycle by steps in time, read from the table of `figures.measure.gait_map`; a panel for each law
of friction that it has. Grey: no speed, since the run stopped. Dots: the sheet passes through itself,
which no real one does. Dashed: two equal layers of which one grows, beta = +-100 alpha with beta in
1/L. Symbols: the gait that the paper says runs against the wave (triangles to the left) and the one
that runs along it (to the right), with its beta read as kappa, beta/h and 100 beta.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from figures.common import style
from figures.measure.gait_map import BACKWARD, FORWARD, FRICTIONS, LARGEST, READINGS, TABLE, Row, axes

Array = NDArray[np.float64]

FEWEST = 60
"""Gaits of a law of friction that are worth a panel."""

COLOURS = {"printed": "black", "thickness": "#009E73", "hundred": "#CC79A7"}


def grid(rows: Sequence[Row], alphas: Array, kappas: Array) -> tuple[Array, Array]:
    """V of the third cycle and the number of states in which the sheet crosses itself.

    Both (kappas, alphas), NaN for gaits that the table lacks.
    """
    known = {(r.alpha, r.kappa): r for r in rows}
    speed, crossed = (np.full((kappas.size, alphas.size), np.nan) for _ in range(2))
    for i, kappa in enumerate(kappas.tolist()):
        for j, alpha in enumerate(alphas.tolist()):
            found = known.get((alpha, kappa))
            if found is not None:
                speed[i, j], crossed[i, j] = found.third, found.crossed
    return speed, crossed


def draw_map(ax: Axes, rows: Sequence[Row], most: float) -> Any:
    """One panel; its image."""
    alphas, kappas = axes()
    speed, crossed = grid(rows, alphas, kappas)
    ax.set_facecolor("0.8")
    image = ax.pcolormesh(
        alphas, kappas, speed, cmap="RdBu_r", vmin=-most, vmax=most, shading="nearest"
    )
    ax.contour(alphas, kappas, speed, [0.0], colors="black", linewidths=0.8)
    y, x = np.nonzero(crossed > 0)
    ax.plot(alphas[x], kappas[y], ".", color="0.25", markersize=2)
    line = np.array([-1.0, 1.0]) * LARGEST[1] / 100
    for sign in (-1, 1):
        ax.plot(line, sign * 100 * line, "--", color="black", linewidth=0.8)
    for (alpha, beta), marker in ((BACKWARD, "<"), (FORWARD, ">")):
        for reading, factor in READINGS.items():
            if abs(beta * factor) <= LARGEST[1]:
                ax.plot(alpha, beta * factor, marker, color=COLOURS[reading], mec="white", markersize=6)
    ax.set(xlabel=r"growth coupling $\alpha$", ylim=(-LARGEST[1] * 1.1, LARGEST[1] * 1.1))
    return image


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw and write the figure."""
    options = style.options("fig4", __doc__, arguments)
    rows = TABLE.read(TABLE.path)
    laws = [law for law in FRICTIONS if sum(r.friction == law for r in rows) > FEWEST]
    fig = style.figure(style.COLUMN_CM * len(laws), 7.0)
    panels = fig.subplots(1, len(laws), sharey=True, squeeze=False)[0]
    shown = [r for r in rows if abs(r.kappa) <= LARGEST[1] and r.friction in laws]
    most = float(np.nanpercentile([abs(r.third) for r in shown], 95))
    for ax, law in zip(panels, laws, strict=True):
        image = draw_map(ax, [r for r in shown if r.friction == law], most)
        ax.set_title(f"{law} friction", loc="left")
    panels[0].set_ylabel(r"rest curvature $\kappa L$ per $c$")
    names = {"printed": r"$\beta$", "thickness": r"$\beta/h$", "hundred": r"$100\,\beta$"}
    marks = [Line2D([], [], marker=">", ls="", mec="white", ms=6, color=COLOURS[r]) for r in READINGS]
    labels = [rf"$\kappa L$ = {names[r]}" for r in READINGS]
    fig.legend(marks, labels, loc="outside lower center", ncols=3, handletextpad=0.1)
    fig.colorbar(image, ax=list(panels), label="$V$ ($L$ a cycle)", extend="both")
    for path in style.save(fig, "fig4", options.out, tuple(options.formats)):
        print(path)


if __name__ == "__main__":
    main()

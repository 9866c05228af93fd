"""Figure 4 of the seed paper: speed over growth and rest curvature, with its gaits in three readings.

    python -m figures.draw.fig4 [--out FOLDER] [--formats png pdf]

V per cycle by steps in time, read from the table of `figures.measure.paper.gait_map`; a panel for each
law of friction that it has. Grey: no speed, since the run stopped. Hatched: |V| is below its error.
Dots: the sheet passes through itself, which no real one does. Dashed: two equal layers of which one
grows, beta = +-100 alpha with beta in 1/L. Symbols: the gait that the paper says runs against the wave
(triangles to the left) and the one that runs along it (to the right), with its beta read as kappa,
beta/h and 100 beta; stars: the largest speeds against and along the wave of a sheet that does not pass
through itself. Last panel: the path of the centre of mass for kappa = beta/h.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from figures.common import style
from figures.draw.speed_map import CROSSED, HATCH, Colours, draw_speeds, grid
from figures.measure.paper import gait_paths
from figures.measure.paper.gait_map import LARGEST, TABLE, Row, on_whole_grid
from figures.measure.paper.paper_gait import BACKWARD, FORWARD, FRICTIONS, READINGS

FEWEST = 60
"""Gaits of a law of friction that are worth a panel."""

READING_COLOURS = {"printed": "black", "thickness": "#009E73", "hundred": "#CC79A7"}
MARKERS = {"backward": "<", "forward": ">"}
DASHES = {"viscous": "-", "dry": "--"}


def best(rows: Sequence[Row], way: int) -> Row:
    """The gait of largest speed along (1) or against the wave (-1), of those that do not cross.

    Nor do they jump: where a sheet snaps its speed depends on the steps.
    """
    fit = [r for r in rows if not (np.isnan(r.third) or r.crossed or r.snapped)]
    return max(fit, key=lambda r: way * r.third)


def draw_map(ax: Axes, rows: Sequence[Row], colours: Colours) -> Any:
    """One panel; its image."""
    found = grid(rows, "alpha", "kappa")
    image = draw_speeds(ax, found, colours)
    line = np.array([-1.0, 1.0]) * LARGEST[1] / 100
    for sign in (-1, 1):
        ax.plot(line, sign * 100 * line, "--", color="black", linewidth=0.8)
    for (alpha, beta), marker in zip((BACKWARD, FORWARD), MARKERS.values(), strict=True):
        for reading, factor in READINGS.items():
            if abs(beta * factor) <= LARGEST[1]:
                look: dict[str, Any] = {
                    "color": READING_COLOURS[reading],
                    "mec": "white",
                    "markersize": 6,
                }
                ax.plot(alpha, beta * factor, marker, **look)
    for way in (-1, 1):
        gait = best(rows, way)
        ax.plot(gait.alpha, gait.kappa, "*", color="gold", mec="black", mew=0.6, markersize=8)
    edge = 1 + 1 / max(found.x.size - 1, 1)
    ax.set(xlim=(-LARGEST[0] * edge, LARGEST[0] * edge), ylim=(-LARGEST[1] * edge, LARGEST[1] * edge))
    ax.set(xlabel=r"growth coupling $\alpha$")
    return image


def draw_paths(ax: Axes) -> None:
    """Both gaits, under both laws of friction."""
    rows = gait_paths.TABLE.read()
    for gait, colour in (("forward", style.COLORS["vermillion"]), ("backward", style.COLORS["blue"])):
        for friction, dash in DASHES.items():
            shown = [(r.cycles, r.y) for r in rows if (r.gait, r.friction) == (gait, friction)]
            ax.plot(*np.array(shown).T, dash, color=colour, label=f"{gait}, {friction}")
    ax.axhline(0, color="0.6", linewidth=0.6, zorder=0)
    ax.set(xlabel="cycles", ylabel="centre of mass $y/L$", xlim=(0, gait_paths.PERIODS))
    ax.legend(fontsize=6.5, handlelength=1.4, loc="upper left")
    ax.set_title(r"path, $\kappa = \beta/h$", loc="left")


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw and write the figure."""
    options = style.options("fig4", __doc__, arguments)
    rows = [r for r in TABLE.read() if abs(r.kappa) <= LARGEST[1]]
    laws = [law for law in FRICTIONS if sum(r.friction == law for r in rows) > FEWEST]
    fig = style.figure(style.DOUBLE_CM, 8.0)
    parts: Any = fig.subfigures(1, 2, width_ratios=[len(laws), 0.8])
    maps, path = parts
    panels = maps.subplots(1, len(laws), sharey=True, squeeze=False)[0]
    colours = Colours.of([r.third for r in rows if r.friction in laws], 95)
    for ax, law in zip(panels, laws, strict=True):
        image = draw_map(ax, on_whole_grid([r for r in rows if r.friction == law]), colours)
        ax.set_title(f"{law} friction", loc="left")
    panels[0].set_ylabel(r"curvature coupling $\kappa L$")
    maps.colorbar(image, ax=list(panels), label="$V$ ($L$ a cycle)", extend="both")
    draw_paths(path.subplots())
    _key(maps)
    for saved in style.save(fig, "fig4", options.out, tuple(options.formats)):
        print(saved)


def _key(fig: Any) -> None:
    """What symbols and hatching mean."""
    names = {"printed": r"$\beta$", "thickness": r"$\beta/h$", "hundred": r"$100\,\beta$"}
    marks: list[Any] = [
        Line2D([], [], marker=">", ls="", mec="white", ms=6, color=READING_COLOURS[r]) for r in READINGS
    ]
    labels = [rf"$\kappa L$ = {names[r]}" for r in READINGS]
    marks += [Line2D([], [], marker="*", ls="", mec="black", ms=8, color="gold")]
    marks += [Patch(facecolor="white", edgecolor="0.2", hatch=HATCH, linewidth=0.4)]
    marks += [Line2D([], [], ls="", **CROSSED)]
    labels += ["largest $|V|$", "$|V|$ below its error", "passes through itself"]
    fig.legend(marks, labels, loc="outside lower center", ncols=3, handletextpad=0.3, columnspacing=1.0)


if __name__ == "__main__":
    main()

"""Figure of best outlines: which shape of given area and length crawls fastest?

    python -m figures.draw.optimise.best_outlines [--out FOLDER] [--formats png pdf]

From the table of `figures.measure.optimise.outlines`. Filled: the best outline of each wave and
friction; dotted: the rectangle of the same area and length. Below: V over that of the rectangle, by the
theory of small strain, in which the outline was sought, and by the nonlinear sheet. The wave runs
towards +y.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figures.common import output, style
from figures.measure.optimise.outlines import GENERAL, SHEET, TABLE, Row, shape_of

FACES = {"sine": style.COLORS["sky"], "pulse": style.COLORS["orange"]}


def chosen(rows: Sequence[Row]) -> list[Row]:
    """The general outlines. Raises ValueError, naming the command of the table, if there are none."""
    found = sorted(
        (row for row in rows if row.coefficients == GENERAL), key=lambda row: row.wave, reverse=True
    )
    if not found:
        raise ValueError(f"no best outlines in the table; `{TABLE.command}` makes them")
    return found


def gains(row: Row) -> tuple[float, float]:
    """V of the best over that of the rectangle, by theory and by the nonlinear sheet."""
    return row.best / row.rectangle, row.sheet_best / row.sheet_rectangle


def draw(rows: Sequence[Row]) -> Figure:
    """One panel for each wave and friction."""
    kept = chosen(rows)
    fig = style.figure(width=style.COLUMN_CM, height=3.6)
    axes = fig.subplots(1, len(kept), sharex=True, sharey=True, squeeze=False)[0]
    for ax, row in zip(axes, kept, strict=True):
        _draw_outline(ax, row)
    axes[0].set(yticks=[-0.5, 0, 0.5], ylabel="$y/L$")
    return fig


def _draw_outline(ax: Axes, row: Row) -> None:
    corners = shape_of(row).outline().corners
    ax.fill(*corners.T, facecolor=FACES[row.wave], edgecolor="black", linewidth=0.8)
    x, y = SHEET.width / 2, SHEET.length / 2
    ax.plot([-x, x, x, -x, -x], [-y, -y, y, y, -y], ":", color="black", linewidth=0.9)
    way = "$-y$" if (row.wave, row.friction) == ("pulse", "tanh") else "$+y$"
    ax.set_title(f"{row.wave}, {row.friction}\n$V$ towards {way}", fontsize=7)
    theory, sheet = gains(row)
    ax.set_xlabel(f"$\\times${theory:.2f} theory\n$\\times${sheet:.2f} sheet", fontsize=7)
    ax.set(aspect="equal", xlim=(-0.62, 0.62), ylim=(-0.56, 0.56), xticks=[])
    ax.spines["bottom"].set_visible(False)
    if ax.get_subplotspec().colspan.start:  # type: ignore[union-attr]
        ax.spines["left"].set_visible(False)
        ax.tick_params(left=False)


def numbers_shown(rows: Sequence[Row]) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    return {
        f"{row.wave}, {row.friction}": {
            "gain by theory": gains(row)[0],
            "gain of the nonlinear sheet": gains(row)[1],
            "widths over the mean": np.round(shape_of(row).widths() / SHEET.width, 4).tolist(),
        }
        for row in chosen(rows)
    }


def write(rows: Sequence[Row], out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure and numbers (JSON) in the folder `out`; returns their paths. Its data are the table."""
    return [
        *style.save(draw(rows), "best_outlines", out, tuple(formats)),
        output.write_json(style.output_path("best_outlines.json", out), numbers_shown(rows)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("best.outlines", __doc__, arguments)
    for path in write(TABLE.read(), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

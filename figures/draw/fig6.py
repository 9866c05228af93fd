"""Figure 6 of the paper: speed on uneven ground.

    python -m figures.draw.fig6 [--out FOLDER] [--formats png pdf]

V per cycle of the forward gait over the number of waves of the ground on a length L, across and along;
from the table of `figures.measure.paper.terrain`: a panel for each form of ground (rows) and law of
friction (columns). Hatched: |V| is below its error. Grey: not computed. Letters: flat ground (A) and
the grounds that the paper shows (B to D).
"""

from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes

from figures.common import style
from figures.draw.speed_map import MISSING, Colours, draw_places, draw_speeds, grid
from figures.measure.paper.terrain import FORMS, MOST, SHOWN, TABLE, Row

LAWS = ("viscous", "dry")

FEWEST = 9
"""Rows that make a map."""

MOST_SHOWN = 90
"""Percentage of V within the scale of colours: where the sheet snaps V is beyond all others."""

TITLES = {"printed": r"$\sin\,\sin$ (eq. 13)", "cosine": r"$\cos\,\cos$"}


def draw_ground(ax: Axes, rows: Sequence[Row], colours: Colours) -> Any:
    """One panel; its image, None where the table has nothing. Few grounds are discs beside letters."""
    ax.set_facecolor(MISSING)
    image = None
    if len(rows) >= FEWEST:
        image = draw_speeds(ax, grid(rows, "nx", "ny"), colours)
    elif rows:
        x, y = [r.nx for r in rows], [r.ny for r in rows]
        image = draw_places(ax, x, y, [r.third for r in rows], colours)
    for letter, place in SHOWN.items():
        ax.annotate(
            letter,
            place,
            xytext=(11, 0) if 0 < len(rows) < FEWEST else (0, 0),
            textcoords="offset points",
            ha="center",
            va="center",
            size=7,
            bbox={"boxstyle": "circle,pad=0.2", "fc": "white", "lw": 0.4},
        )
    if image is None:
        ax.text(MOST / 2, MOST / 2, "not computed", ha="center", va="center", color="0.3")
    ax.set(xlim=(-MOST / 12, MOST * 13 / 12), ylim=(-MOST / 12, MOST * 13 / 12), aspect="equal")
    return image


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw and write the figure."""
    options = style.options("fig6", __doc__, arguments)
    rows = [r for r in TABLE.read() if r.gait == "forward"]
    fig = style.figure(style.COLUMN_CM * 1.5, 11.0)
    panels = fig.subplots(len(FORMS), len(LAWS), sharex=True, sharey=True)
    shown = {
        (form, law): [r for r in rows if (r.form, r.friction) == (form, law)]
        for form in FORMS
        for law in LAWS
    }
    for j, law in enumerate(LAWS):
        colours = Colours.of([r.third for form in FORMS for r in shown[form, law]], MOST_SHOWN)
        images = [draw_ground(panels[i, j], shown[form, law], colours) for i, form in enumerate(FORMS)]
        for i, form in enumerate(FORMS):
            panels[i, j].set_title(f"{TITLES[form]}, {law}", loc="left")
        image = next((found for found in images if found is not None), None)
        if image is not None:
            bar: dict[str, Any] = {"location": "bottom", "label": "$V$ ($L$ a cycle)", "extend": "both"}
            fig.colorbar(image, ax=list(panels[:, j]), shrink=0.8, **bar)
    for ax in panels[-1]:
        ax.set_xlabel(r"$L/\lambda_x$ (across)")
    for ax in panels[:, 0]:
        ax.set_ylabel(r"$L/\lambda_y$ (along)")
    for path in style.save(fig, "fig6", options.out, tuple(options.formats)):
        print(path)


if __name__ == "__main__":
    main()

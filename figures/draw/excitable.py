"""Kymographs of c under the presets of the excitable wave that run along a sheet.

    python -m figures.draw.excitable [--out FOLDER] [--formats png pdf]

Time runs to the right, y upwards; each panel has its own scale of c, which the bar at its right shows:
the range of c after the first cycle, which the start exceeds.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from fem_check.excitable.excitation import Excitation
from fem_check.excitable.presets import PRESETS
from figures.common import style
from linear_theory.sheet.rectangle import Sheet

SHEET = Sheet()

SPAN = 320.0
"""Time that is drawn: seven to eleven cycles."""

SETTLED = 60.0
"""Time from which on c sets the scale."""

RTOL = 3e-3
"""Of c, less than a shade."""

POINTS, TIMES = 121, 900
"""Of a picture, as many as a column has dots."""

LABELS = {
    "printed": r"printed, $\nu = -0.01$",
    "nu = -0.1": r"$\nu = -0.1$",
    "nu = -0.05": r"$\nu = -0.05$",
    "pulse train": r"pulse train, $\nu = 0.1$",
}


def draw() -> Figure:
    """The figure."""
    fig = style.figure(style.COLUMN_CM, 11.0)
    panels = fig.subplots(len(LABELS), sharex=True)
    for axes, (name, label) in zip(panels, LABELS.items(), strict=True):
        kymograph(axes, PRESETS[name].equation.on(SHEET, SPAN, RTOL), label)
    panels[-1].set_xlabel("time (units of the reaction)")
    return fig


def kymograph(axes: Axes, wave: Excitation, label: str) -> None:
    """c over time and y; 0 is white."""
    y, t = np.linspace(-0.5, 0.5, POINTS), np.linspace(0, SPAN, TIMES)
    c = wave.value(0.0, y[:, None], t)
    shown = c[:, t > SETTLED]
    low, high = float(shown.min()), float(shown.max())
    image = axes.imshow(
        c,
        extent=(0, SPAN, -0.5, 0.5),
        origin="lower",
        aspect="auto",
        cmap="RdBu_r",
        norm=TwoSlopeNorm(0.0, low, high),
        interpolation="bilinear",
    )
    axes.set_ylabel("$y/L$")
    axes.set_yticks([-0.5, 0, 0.5])
    axes.set_title(label, loc="left", pad=3)
    bar = axes.figure.colorbar(image, ax=axes, pad=0.02, aspect=8)
    bar.set_ticks([low, 0, high], labels=[f"${low:.2f}$", "$c = 0$", f"${high:.2f}$"])


def main(arguments: Sequence[str] | None = None) -> list[Path]:
    """Draw and save it."""
    options = style.options("excitable", __doc__, arguments)
    return style.save(draw(), "excitable", options.out, tuple(options.formats))


if __name__ == "__main__":
    main()

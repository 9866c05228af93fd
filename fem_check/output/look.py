"""The style of all pictures: colours distinguishable with any colour vision, journal column widths."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl
from cycler import cycler

COLUMN_CM = 8.5
"""Width of a figure in one column of the journal."""

DOUBLE_CM = 17.5
"""Width of a figure across both columns."""

CM_PER_INCH = 2.54

COLORS = {
    "blue": "#0072B2",
    "vermillion": "#D55E00",
    "green": "#009E73",
    "purple": "#CC79A7",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "black": "#000000",
    "yellow": "#F0E442",
}
"""Okabe and Ito's colours, distinguishable with any colour vision; in the cycle, those with little
contrast to white paper come last."""

# Any for the keys too: some releases of matplotlib type them as text, newer ones as a list of names.
STYLE: dict[Any, Any] = {
    "axes.linewidth": 0.6,
    "axes.prop_cycle": cycler(color=list(COLORS.values())),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "figure.constrained_layout.use": True,
    "figure.dpi": 150,
    # The font that comes with matplotlib, by name: the same glyphs on every machine.
    "font.family": ["DejaVu Sans"],
    "mathtext.fontset": "dejavusans",
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "figure.titlesize": 8,
    "legend.fontsize": 7,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "image.cmap": "viridis",
    "legend.frameon": False,
    "lines.linewidth": 1.2,
    "lines.markersize": 4,
    "pdf.fonttype": 42,  # text stays text; journals refuse Type 3
    "savefig.dpi": 400,
    # Never "tight": it would crop the page and change the requested width.
    "savefig.bbox": None,
    # Without this, element names in SVG are random.
    "svg.hashsalt": "sheetcrawl",
    "svg.fonttype": "path",
    "xtick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.direction": "in",
    "ytick.major.width": 0.6,
}


@contextmanager
def styled() -> Iterator[None]:
    """Apply the style while a picture is made, then restore the user's own."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(STYLE)
        yield

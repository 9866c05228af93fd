"""One look for all figures, one place for their files, the same bytes for the same input.

    from figures import style
    fig = style.figure(width=style.COLUMN_CM, height=6.0)
    axes = fig.subplots()
    ...
    style.save(fig, "fig3", out)

Figures are made without pyplot: nothing is global but the style, nothing needs closing, and no
display is needed.
"""

import argparse
import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from cycler import cycler
from matplotlib.figure import Figure

from figures.output import replacing

COLUMN_CM = 8.5
"""Width of a figure in one column of the journal."""

DOUBLE_CM = 17.5
"""Width of a figure across both columns."""

CM_PER_INCH = 2.54

OUTPUT_DIR = Path(__file__).resolve().parent / "out"
"""Where figures and their data go unless --out says otherwise."""

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
"""Okabe and Ito's colours, told apart with any colour vision; the cycle takes them in this order,
which keeps those of little contrast with white paper for last."""

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
    # Never "tight": it would crop the page, and with it the width that was asked for.
    "savefig.bbox": None,
    # Element names in SVG are random without it.
    "svg.hashsalt": "sheetcrawl",
    "svg.fonttype": "path",
    "xtick.direction": "in",
    "xtick.major.width": 0.6,
    "ytick.direction": "in",
    "ytick.major.width": 0.6,
}

# Dates and versions would change the bytes of a file whose picture did not change.
METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": None},
    "pdf": {"Creator": None, "Producer": None, "CreationDate": None},
    "svg": {"Creator": None, "Date": None},
}


def use() -> None:
    """Set the style and the Agg backend, whatever the user's own matplotlibrc says."""
    mpl.rcdefaults()
    mpl.rcParams.update(STYLE)
    mpl.use("agg")
    # PDFs without a date make fontTools warn of an old one
    logging.getLogger("fontTools").setLevel(logging.ERROR)


def figure(width: float = COLUMN_CM, height: float = 6.0) -> Figure:
    """An empty figure in the style, sizes in centimetres."""
    use()
    return Figure(figsize=(width / CM_PER_INCH, height / CM_PER_INCH))


def output_path(name: str, out: Path | str | None = None) -> Path:
    """Path of the file `name` (with suffix) in the folder `out`, OUTPUT_DIR if None."""
    return (OUTPUT_DIR if out is None else Path(out)) / name


def save(
    fig: Figure,
    stem: str,
    out: Path | str | None = None,
    formats: tuple[str, ...] = ("png", "pdf"),
) -> list[Path]:
    """Write `fig` as `stem`.png, `stem`.pdf, …: same figure, same bytes. Returns the paths."""
    unknown = [name for name in formats if name not in METADATA]
    if unknown:
        raise ValueError(f"formats = {formats!r}: must be among {', '.join(METADATA)}")
    paths = [output_path(f"{stem}.{name}", out) for name in formats]
    for name, path in zip(formats, paths, strict=True):
        with replacing(path) as part:
            fig.savefig(part, format=name, metadata=METADATA[name])
    return paths


def options(
    program: str, description: str | None, rtol: float, meaning: str, arguments: Sequence[str] | None
) -> argparse.Namespace:
    """The command line that all figures share: --out, --rtol (default and meaning given), --formats."""
    parser = argparse.ArgumentParser(prog=program, description=description)
    parser.add_argument("--out", type=Path, help="folder of the files (figures/out)")
    parser.add_argument("--rtol", type=float, default=rtol, help=f"{meaning} (%(default)g)")
    parser.add_argument("--formats", nargs="+", choices=list(METADATA), default=["png", "pdf"])
    return parser.parse_args(arguments)

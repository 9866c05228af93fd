"""One look for all figures, one place for their files, the same bytes for the same input.

    from figures.common import style
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
from matplotlib.figure import Figure

from fem_check.output.look import CM_PER_INCH, COLORS, COLUMN_CM, DOUBLE_CM, STYLE
from figures.common.command import parser
from figures.common.folders import OUT
from figures.common.output import replacing

__all__ = [
    "CM_PER_INCH",
    "COLORS",
    "COLUMN_CM",
    "DOUBLE_CM",
    "METADATA",
    "STYLE",
    "figure",
    "options",
    "output_path",
    "save",
    "use",
]

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
    """Path of the file `name` (with suffix) in the folder `out`, figures/out if None."""
    return (OUT if out is None else Path(out)) / name


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
    name: str, text: str | None, arguments: Sequence[str] | None, **settings: tuple[Any, str]
) -> argparse.Namespace:
    """Of the script that draws a figure: --out, --formats and further settings, as in `parser`."""
    made = parser(f"python -m figures.draw.{name}", text, OUT, **settings)
    made.add_argument("--formats", nargs="+", choices=list(METADATA), default=["png", "pdf"])
    return made.parse_args(arguments)

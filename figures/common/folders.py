"""Where the files of figures are kept."""

from pathlib import Path

FIGURES = Path(__file__).resolve().parents[1]

DATA = FIGURES / "data"
"""Tables that figures, write-up and tests read."""

OUT = FIGURES / "out"
"""Figures and their numbers, unless --out says otherwise."""

GALLERY = FIGURES / "gallery"
"""Pictures that the README and the pages of docs/ show."""

"""Pictures at one scale: the text in all of them is as large as that of the page."""

import re
import struct
from pathlib import Path

SCALE = 1.3
"""Of a picture on the screen against print, where its text has 7 points."""

INCHES_PER_METRE = 39.37
PIXELS_PER_INCH = 96
"""Of the browser's unit of length."""

IMAGE = re.compile(r'<img src="([^"]+)"')


def sized(html: str, folder: Path) -> str:
    """The HTML of a page in the folder, with the width of each picture that says its size in print."""

    def with_width(found: re.Match[str]) -> str:
        width = print_width(folder / found[1])
        return found[0] + (f' width="{width * PIXELS_PER_INCH * SCALE:.0f}"' if width else "")

    return IMAGE.sub(with_width, html)


def print_width(path: Path) -> float:
    """Inches that a PNG file is wide in print; 0 for other files, and for one that does not say."""
    data = path.read_bytes()[:4096] if path.is_file() else b""
    place = data.find(b"pHYs")
    if not data.startswith(b"\x89PNG") or place < 0:
        return 0.0
    (pixels,) = struct.unpack(">I", data[16:20])
    (density,) = struct.unpack(">I", data[place + 4 : place + 8])
    return float(pixels / density * INCHES_PER_METRE) if density else 0.0

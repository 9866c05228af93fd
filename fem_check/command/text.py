"""Text for streams whose encoding lacks some characters."""

from typing import TextIO

ASCII: dict[str, str | int | None] = {
    "▶": ">",
    "◀": "<",
    "─": "-",
    "×": "x",
    "±": "+-",
    "−": "-",
    "…": "...",
}


def printable(text: str, stream: TextIO) -> str:
    """The text with substitutes for characters missing in the stream's encoding."""
    encoding = getattr(stream, "encoding", None) or "ascii"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return text.translate(str.maketrans(ASCII)).encode("ascii", "replace").decode()
    return text

"""Text on streams that cannot show all of it."""

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
    """The text in characters that the stream's encoding has."""
    encoding = getattr(stream, "encoding", None) or "ascii"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return text.translate(str.maketrans(ASCII)).encode("ascii", "replace").decode()
    return text

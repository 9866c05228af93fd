"""Whether files can be written, found out before the work that they are for."""

import os
from importlib.util import find_spec
from pathlib import Path

from fem_check.command.options import Options

PICTURES, MOVIES = (".png", ".pdf", ".svg"), (".gif", ".mp4")
ENCODER = "imageio_ffmpeg"


def check_files(options: Options) -> None:
    """Raise ValueError for a file that cannot be written, and a film that cannot be made."""
    for name, path, endings in (("plot", options.plot, PICTURES), ("movie", options.movie, MOVIES)):
        if path is not None:
            _check(f"--{name} {path}", path, endings)
    if options.movie is not None and options.movie.suffix.lower() == ".mp4" and not find_spec(ENCODER):
        raise ValueError(
            f"--movie {options.movie}: .mp4 needs an encoder, which pip install 'sheetcrawl[movies]' "
            "brings; .gif needs none"
        )


def _check(named: str, path: Path, endings: tuple[str, ...]) -> None:
    if path.suffix.lower() not in endings:
        raise ValueError(f"{named}: must end with {', '.join(endings[:-1])} or {endings[-1]}")
    if path.is_dir():
        raise ValueError(f"{named}: is a folder; give the name of a file")
    if not path.parent.is_dir():
        raise ValueError(f"{named}: there is no folder {path.parent}; make it first")
    place = path if path.exists() else path.parent
    if not os.access(place, os.W_OK):
        raise ValueError(f"{named}: {place} cannot be written to; choose another place")

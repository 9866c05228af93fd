"""Films as files: .gif by Pillow, .mp4 by the encoder that comes with imageio-ffmpeg, an extra."""

from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from fem_check.output.film.palette import palette
from linear_theory.common.extras import optional

Pixels = NDArray[np.uint8]
Write = Callable[[Path, Iterator[Pixels], float], None]

QUALITY = 20
"""Constant rate factor of the .mp4: no visible artefacts in lines and letters."""

MODULE = "imageio_ffmpeg"


def require(suffix: str) -> None:
    """Raise ModuleNotFoundError, with what to install, if the writer of these files is missing.

    The package of the encoder is imported, and its program looked for: either may be broken.
    """
    if suffix != ".mp4":
        return
    package = optional(MODULE, "movies", "an .mp4 film, unlike a .gif,")
    try:
        package.get_ffmpeg_exe()
    except (RuntimeError, OSError) as missing:
        raise ModuleNotFoundError(
            f"an .mp4 film, unlike a .gif, needs an encoder, which {MODULE} does not find ({missing}): "
            "pip install --force-reinstall 'sheetcrawl[movies]'"
        ) from None


def write_gif(path: Path, pictures: Iterator[Pixels], fps: float) -> None:
    """Write an endlessly repeating .gif, small by one palette for all frames and no dithering.

    The delay of a frame is a whole number of 1/100 s, at least 2.
    """
    colors = palette()
    images = (
        Image.fromarray(picture).quantize(palette=colors, dither=Image.Dither.NONE)
        for picture in pictures
    )
    delay = 10 * max(2, round(100 / fps))
    start = next(images)
    look = {"duration": delay, "loop": 0, "disposal": 1}
    with path.open("wb") as file:  # also closed after an interruption
        start.save(file, format="GIF", save_all=True, append_images=images, **look)


def write_mp4(path: Path, pictures: Iterator[Pixels], fps: float) -> None:
    """Write H.264 in a form that every browser and slide program plays."""
    import imageio_ffmpeg

    first = next(pictures)
    height, width = first.shape[:2]
    writer = imageio_ffmpeg.write_frames(
        str(path),
        (width, height),
        fps=fps,
        codec="libx264",
        pix_fmt_out="yuv420p",
        macro_block_size=2,
        quality=None,
        output_params=["-crf", str(QUALITY), "-fflags", "+bitexact", "-flags:v", "+bitexact"],
        ffmpeg_log_level="error",
    )
    writer.send(None)
    try:
        for picture in chain([first], pictures):
            writer.send(np.ascontiguousarray(picture))
    finally:
        writer.close()
    if not is_whole(path):  # the encoder tells of a full disk on stderr alone
        raise OSError("the encoder could not write all of it (a full disk?)")


def is_whole(path: Path) -> bool:
    """Whether the boxes of an .mp4 fill the file, with the index of its frames among them."""
    names, size, place = set(), path.stat().st_size, 0
    with path.open("rb") as file:
        while place < size:
            file.seek(place)
            head = file.read(16)
            length = int.from_bytes(head[:4], "big")
            if length == 1:  # the size of a large box follows its name
                length = int.from_bytes(head[8:], "big")
            if length < 8:
                return False
            names.add(head[4:8])
            place += length
    return place == size and b"moov" in names


WRITERS: dict[str, Write] = {".gif": write_gif, ".mp4": write_mp4}
"""Writers by the suffix of the file."""

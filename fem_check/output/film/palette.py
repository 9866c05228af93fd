"""The colours of a .gif, which has at most 256: those of a film, evenly."""

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray
from PIL import Image

from fem_check.output.panels import GROWTH_MAP, WAVE

LEVELS, SHADED, GREYS, BLENDS = 96, 48, 86, 6
"""Number of colours of growth, of those in the shade, of greys (with black and white), and between the
colour of the wave and white: edges of letters and lines are blends."""

SHADE = 0.85


def palette() -> Image.Image:
    """An image whose palette holds the colours."""
    growth = GROWTH_MAP(np.linspace(0, 1, LEVELS))[:, :3]
    shaded = SHADE * GROWTH_MAP(np.linspace(0, 1, SHADED))[:, :3]
    greys = np.repeat(np.linspace(0, 1, GREYS)[:, None], 3, axis=1)
    share = np.linspace(0, 1, BLENDS, endpoint=False)[:, None]
    wave = share + (1 - share) * np.array(to_rgb(WAVE))
    colors = np.round(255 * np.concatenate([greys, growth, shaded, wave])).astype(np.uint8)
    return _holding(colors)


def _holding(colors: NDArray[np.uint8]) -> Image.Image:
    image = Image.new("P", (1, 1))
    image.putpalette(colors.ravel().tolist())
    return image

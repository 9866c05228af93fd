"""Speeds over two parameters as a picture: colours, V = 0, where |V| is below its error, crossings."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

Array = NDArray[np.float64]

MISSING = "0.8"
"""Of places without a speed."""

HATCH = "/////"
"""Of places at which |V| is below its error."""


CROSSED: dict[str, Any] = {"marker": ".", "color": "0.25", "markersize": 2}
"""Of gaits whose sheet passes through itself."""


class Grid(NamedTuple):
    """Values x (n,) and y (m,); speed, error and crossings (m, n), NaN where the table has no row."""

    x: Array
    y: Array
    speed: Array
    error: Array
    crossed: Array


def grid(rows: Sequence[Any], x: str, y: str) -> Grid:
    """V of the third cycle, its error, and the number of states in which the sheet crosses itself.

    x, y: names of columns. The axes have the values that occur more than half as often as the most
    frequent one: single places beside the grid, such as the paper's gaits, are on none.
    """
    across, along = (_common([getattr(r, name) for r in rows]) for name in (x, y))
    speed, error, crossed = (np.full((along.size, across.size), np.nan) for _ in range(3))
    known = {(getattr(r, x), getattr(r, y)): r for r in rows}
    for i, v in enumerate(along.tolist()):
        for j, u in enumerate(across.tolist()):
            found = known.get((u, v))
            if found is not None:
                speed[i, j], error[i, j], crossed[i, j] = found.third, found.error, found.crossed
    return Grid(across, along, speed, error, crossed)


def _common(values: Sequence[float]) -> Array:
    found, times = np.unique(values, return_counts=True)
    return np.asarray(found[times > times.max() / 2])


class Colours(NamedTuple):
    """A scale of speeds: its ends, and matplotlib's name of the map."""

    low: float
    high: float
    name: str = "RdBu_r"

    @classmethod
    def of(cls, speeds: Any, share: float = 100.0) -> "Colours":
        """About 0 where both signs occur, else of the speeds alone.

        share: percentage of them within the scale; where a sheet snaps V may be beyond all others.
        """
        known = np.asarray(speeds, float)
        known = known[np.isfinite(known)]
        if known.size and (known.min() > 0 or known.max() < 0):
            low, high = np.percentile(known, [(100 - share) / 2, (100 + share) / 2])
            return cls(float(low), float(high), "viridis")
        most = float(np.percentile(abs(known), share)) if known.size else 1.0
        return cls(-most, most)

    @property
    def look(self) -> dict[str, Any]:
        """Arguments of matplotlib."""
        return {"cmap": self.name, "vmin": self.low, "vmax": self.high}


def draw_speeds(ax: Axes, found: Grid, colours: Colours) -> Any:
    """The map; its image."""
    ax.set_facecolor(MISSING)
    image = ax.pcolormesh(found.x, found.y, found.speed, shading="nearest", **colours.look)
    if np.nanmin(found.speed) < 0 < np.nanmax(found.speed) and min(found.speed.shape) > 1:
        ax.contour(found.x, found.y, found.speed, [0.0], colors="black", linewidths=0.8)
    _hatch(ax, found)
    y, x = np.nonzero(found.crossed > 0)
    ax.plot(found.x[x], found.y[y], ls="", **CROSSED)
    return image


def _hatch(ax: Axes, found: Grid) -> None:
    """Cells whose speed is below its error, one by one: matplotlib hatches no transparent mesh."""
    (left, right), (low, high) = (_sides(v) for v in (found.x, found.y))
    look: dict[str, Any] = {"facecolor": "none", "edgecolor": "0.35", "linewidth": 0.0, "hatch": HATCH}
    for i, j in np.argwhere(np.abs(found.speed) < found.error):
        size = right[j] - left[j], high[i] - low[i]
        ax.add_patch(Rectangle((left[j], low[i]), *size, **look))


def _sides(centres: Array) -> tuple[Array, Array]:
    """Of cells, halfway to their neighbours, as pcolormesh has them."""
    middles = (centres[1:] + centres[:-1]) / 2
    edges = np.concatenate([[2 * centres[0] - middles[0]], middles, [2 * centres[-1] - middles[-1]]])
    return edges[:-1], edges[1:]


FEWEST = 3
"""Values each way from which places are a map."""


def is_map(found: Grid) -> bool:
    """Whether there are places enough for a map; if not, `draw_places` shows them."""
    return min(found.speed.shape) >= FEWEST


def draw_places(ax: Axes, x: Any, y: Any, speed: Any, colours: Colours) -> Any:
    """Single places as discs; their image."""
    ax.set_facecolor("0.93")
    look: dict[str, Any] = {**colours.look, "linewidth": 0.6}
    return ax.scatter(x, y, c=speed, s=90, edgecolors="black", zorder=2, **look)

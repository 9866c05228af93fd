"""Kymographs, as in fig. 2 of the paper: a line along the sheet, y across the page and time upwards."""

from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.geometry import middle_line
from fem_check.output.moving import Moving, turned
from fem_check.output.panels import GROWTH_MAP, add_scale

Array = NDArray[np.float64]

PLACES = 200
"""Points of the line."""

SAMPLES = 48
"""Times per period."""

DISPLACEMENT_MAP = colormaps["RdBu_r"]
"""Colours of displacements, unlike those of growth; signs differ with any colour vision."""


class Quantity(StrEnum):
    """What is shown along the line: the wave c, the displacement along the sheet in the frame of the
    body, or the height above z = 0."""

    WAVE = "kymograph"
    DISPLACEMENT = "displacement"
    HEIGHT = "height"


class Line(NamedTuple):
    """Values on a line of the undeformed sheet: y (k,), times (n,), values (n, k), NaN in holes."""

    y: Array
    times: Array
    values: Array


def line_of(moving: Moving, quantity: Quantity, periods: int) -> Line:
    """The values of a quantity along the middle line of the sheet, units of length and time as given.

    The displacement is that within the sheet: in the axes of the body frame, which moves and turns with
    the sheet as a whole (see `linear_theory.speed.path`).
    """
    points, found = middle_line(*moving.covering(), PLACES)
    inside = points[:, found]
    frames = [moving.at(inside, k / SAMPLES) for k in range(periods * SAMPLES + 1)]
    times = np.array([frame.time for frame in frames])
    rows: Any
    if quantity is Quantity.WAVE:
        rows = moving.waves(inside, times)
    elif quantity is Quantity.HEIGHT:
        rows = [frame.place[2] for frame in frames]
    else:
        rows = [turned(frame.place - frame.still, -frame.heading)[1] for frame in frames]
    values = np.full((times.size, PLACES), np.nan)
    values[:, found] = rows
    return Line(points[1], times, values)


def draw_kymograph(ax: Axes, moving: Moving, units: Units, quantity: Quantity, periods: int) -> None:
    """The values in diverging colours, and a colour bar."""
    line, factor = line_of(moving, quantity, periods), units.length_factor
    labels: dict[Quantity, tuple[str, Any, float]] = {
        Quantity.WAVE: ("wave $c$", GROWTH_MAP, 1.0),
        Quantity.DISPLACEMENT: (f"displacement $u_y$ ({units.length})", DISPLACEMENT_MAP, factor),
        Quantity.HEIGHT: (f"height $z$ ({units.length})", DISPLACEMENT_MAP, factor),
    }
    label, colours, scale = labels[quantity]
    values = scale * line.values
    low, high = _limits(values)
    image = ax.imshow(
        values,
        origin="lower",
        aspect="auto",
        extent=_edges(line.y * factor, line.times * units.time_factor),
        cmap=colours,
        vmin=low,
        vmax=high,
        interpolation="nearest",
    )
    first, last = line.times[[0, -1]] * units.time_factor
    ax.set(xlabel=f"$y$ ({units.length})", ylabel=f"time $t$ ({units.time})", ylim=(first, last))
    ax.set_title(f"{label.split(' (')[0]} along the middle of the sheet", loc="left")
    add_scale(ax, image, label)


def _limits(values: Array) -> tuple[float, float]:
    """Ends of the colours: 0 in the middle, but of values far from it, as of heights of a sheet that
    has sunk into its ground, their own."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if low * high > 0 and high - low < min(abs(low), abs(high)):
        return low, high
    most = max(abs(low), abs(high)) or 1.0
    return -most, most


def _edges(y: Array, times: Array) -> tuple[float, float, float, float]:
    """Outer edges of the pixels, whose centres are at the given places and times."""
    half_y, half_t = (y[1] - y[0]) / 2, (times[1] - times[0]) / 2
    return y[0] - half_y, y[-1] + half_y, times[0] - half_t, times[-1] + half_t

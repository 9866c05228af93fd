"""Kymographs of a recorded motion, as in fig. 2 of the paper: its middle line over time."""

from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.look import CM_PER_INCH, DOUBLE_CM, styled
from fem_check.output.moving import turned
from fem_check.output.panels import GROWTH_MAP
from fem_check.runs.recording import Recording

Array = NDArray[np.float64]

PLACES = 201
"""Points of the line."""

HEIGHT_CM = 6.0

DISPLACEMENT_MAP = colormaps["RdBu_r"]


class Line(NamedTuple):
    """The line x = 0 of the undeformed sheet over time: y (k,), times (n,), wave c, displacement along
    the sheet and height, each (n, k), NaN where there is no sheet; the height is None in the plane."""

    y: Array
    times: Array
    wave: Array
    along: Array
    height: Array | None


def middle_line(recording: Recording) -> Line:
    """What the recording holds along the middle line of the sheet.

    The displacement is that in the axes of the sheet, which move and turn with it.
    """
    low, high = recording.points[1].min(), recording.points[1].max()
    middle = (recording.points[0].min() + recording.points[0].max()) / 2
    y = np.linspace(low, high, PLACES)
    points = np.stack([np.full(PLACES, middle), y])
    there, weights = recording.inside(points)
    along = []
    for place, centre, heading in zip(
        weights(recording.place), recording.centre, recording.heading, strict=True
    ):
        own = turned(place[:2] - centre[:, None], -heading)
        along.append(own[1] - (y - recording.middle[1]))
    height = weights(recording.place[:, 2]) if recording.components == 3 else None
    hidden = np.where(there, 0.0, np.nan)
    return Line(
        y,
        recording.times,
        weights(recording.wave) + hidden,
        np.array(along) + hidden,
        None if height is None else height + hidden,
    )


def kymographs(recording: Recording, units: Units | None = None) -> NDArray[Any]:
    """A figure with c, the displacement along y and, in space, the height; its axes, (2 or 3,).

    units: by default the length of the sheet and the period of the wave.
    """
    import matplotlib.pyplot as plt  # here: it selects a backend

    units = units or Units.of_sheet(recording.length, recording.period)
    line, factor = middle_line(recording), units.length_factor
    panels: list[tuple[str, Array, Any]] = [("wave $c$", line.wave, GROWTH_MAP)]
    panels.append((f"displacement along $y$ ({units.length})", line.along * factor, DISPLACEMENT_MAP))
    if line.height is not None:
        panels.append((f"height ({units.length})", line.height * factor, DISPLACEMENT_MAP))
    with styled():
        size = DOUBLE_CM / CM_PER_INCH, HEIGHT_CM / CM_PER_INCH
        _, axes = plt.subplots(
            1, len(panels), figsize=size, sharey=True, squeeze=False, layout="constrained"
        )
        for ax, (title, values, colours) in zip(axes[0], panels, strict=True):
            _draw(ax, title, values, colours, line, units)
        axes[0, 0].set_ylabel(f"$y$ ({units.length})")
    return np.asarray(axes[0])


def _draw(ax: Axes, title: str, values: Array, colours: Any, line: Line, units: Units) -> None:
    """Time to the right, the line upwards, 0 in the middle of the colours."""
    most = float(np.nanmax(np.abs(values))) or 1.0
    edges = (
        *(t * units.time_factor for t in line.times[[0, -1]]),
        *(y * units.length_factor for y in line.y[[0, -1]]),
    )
    image = ax.imshow(
        values.T,
        origin="lower",
        aspect="auto",
        extent=edges,
        cmap=colours,
        vmin=-most,
        vmax=most,
        interpolation="nearest",
    )
    ax.set_title(title, loc="left")
    ax.set_xlabel(f"time $t$ ({units.time})")
    ax.figure.colorbar(image, ax=ax, pad=0.02)

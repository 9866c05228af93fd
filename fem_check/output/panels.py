"""The sheet in a picture: from above, coloured by growth or friction, and from the side.

The sheet lies along the page: y, the direction of the wave, points to the right and x downwards, so
that a left turn of the sheet is a left turn on the page.
"""

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.transforms import Bbox
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.geometry import edges, inside, refined
from fem_check.output.look import COLORS
from fem_check.output.moving import Frame, Moving
from fem_check.output.tint import Tint, tint_of

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

GROWTH_MAP = LinearSegmentedColormap.from_list(
    "growth", colormaps["PuOr"](np.linspace(0.16, 0.84, 256)), N=256
)
"""Colours of growth: signs are distinguishable with any colour vision, and black lines are visible at
both ends."""

ARROWS = 60
"""Approximate number of friction arrows on a rectangle."""

ARROW = 0.9
"""Length of the longest arrow relative to the spacing of arrows."""

WAVE = COLORS["blue"]

FRICTION_MAP = colormaps["RdBu_r"]
"""Colours of friction: red pushes the sheet towards +y, blue towards -y."""


SUNK = 1.5
"""Depth below level ground, over the range of heights, from which on the sheet is shown without it."""

MARGIN = 0.1
"""Of that range, above and below."""

PRESSURE_MAP = colormaps["Blues"]
"""Colours of pressure: the darker, the more."""


BAR_END = 1.055
"""Right end of a colour bar, over the width of its axes."""

LABEL = 0.75
"""Width of its numbers and label, inches."""


def draw_sheet(ax: Axes, moving: Moving, units: Units, phase: float) -> None:
    """The sheet from above, coloured by its `Tint`, with friction as arrows."""
    points, triangles = moving.covering()
    frame = moving.at(points, phase)
    tint = tint_of(moving, points)
    place = frame.place * units.length_factor
    image, _ = add_sheet(ax, place, tint.at(frame), triangles, tint.most)
    arrows = _draw_around(ax, moving, units, phase)
    friction = ", arrows: friction" if arrows else ""
    ax.set_title(f"{_time(frame, units)}{friction}; {_ways(moving)}", loc="left")
    if tint.most:
        add_scale(ax, image, tint.axis)


def draw_friction(ax: Axes, moving: Moving, units: Units, phase: float) -> None:
    """The sheet from above, coloured by the friction along y, with friction as arrows."""
    # Dry friction changes over distances much shorter than growth does.
    points, triangles = refined(*refined(*moving.covering()))
    frame, along = moving.at(points, phase), moving.friction(points, phase)[1]
    most, place = float(np.abs(along).max()), frame.place * units.length_factor
    image, _ = add_sheet(ax, place, along, triangles, most, FRICTION_MAP)
    _draw_around(ax, moving, units, phase)
    ax.set_title(f"{_time(frame, units)}, arrows: friction; {_ways(moving)}", loc="left")
    add_scale(ax, image, r"friction $f_y$ ($\mu\,w$)")


def draw_pressure(ax: Axes, moving: Moving, units: Units, phase: float) -> None:
    """The sheet from above, coloured by the load with which it presses on the ground."""
    points, triangles = refined(*refined(*moving.covering()))
    frame, pressure = moving.at(points, phase), moving.pressure(points, phase)
    limits = float(pressure.min()), float(pressure.max())
    place = frame.place * units.length_factor
    image, _ = add_sheet(ax, place, pressure, triangles, limits, PRESSURE_MAP)
    _draw_around(ax, moving, units, phase, arrows=False)
    lifted = " (0: lifted off)" if limits[0] <= 0 else ""
    ax.set_title(f"{_time(frame, units)}; {_ways(moving)}", loc="left")
    add_scale(ax, image, f"pressure ($w$){lifted}")


def _draw_around(ax: Axes, moving: Moving, units: Units, phase: float, arrows: bool = True) -> bool:
    """Undeformed outline, friction arrows, axes; whether there are arrows."""
    points, triangles = moving.covering()
    frame, factor = moving.at(points, phase), units.length_factor
    ax.add_collection(outline(frame.still * factor, triangles, linestyle=":", color="0.5"))
    arrows = arrows and _draw_friction(ax, moving, phase, points, triangles, factor)
    label_ground(ax, units)
    ax.set_aspect("equal", anchor="W")
    shown = np.concatenate([frame.still[:2], frame.place[:2]], axis=1) * factor
    margin = 0.06 * float(np.ptp(shown[1]))
    ax.set_xlim(shown[1].min() - margin, shown[1].max() + margin)
    ax.set_ylim(shown[0].max() + margin, shown[0].min() - margin)
    return arrows


def _time(frame: Frame, units: Units) -> str:
    return f"$t$ = {frame.time * units.time_factor:.3g} {units.time}"


def add_scale(ax: Axes, image: Any, label: str) -> None:
    """A colour bar beside the axes, as high as they are."""
    if ax.figure.get_layout_engine() is None:  # axes of the caller: nothing else makes room
        ax.set_axes_locator(Narrowed())
    # inside of the axes' own box: it stays beside them when an equal aspect makes them smaller
    bar = ax.inset_axes((1.02, 0.0, BAR_END - 1.02, 1.0))
    ax.figure.colorbar(image, cax=bar, label=label)


class Narrowed:
    """A locator of axes: their own place, narrowed by what a colour bar with its label takes.

    The bar then fits into that place, whatever becomes of the figure's size, and axes that are drawn
    into again are not narrowed twice.
    """

    def __call__(self, ax: Any, renderer: Any) -> Bbox:
        """The place of the axes, in shares of the figure."""
        place = ax.get_position(original=True)
        width = (place.width - LABEL / ax.figure.bbox.width * ax.figure.dpi) / BAR_END
        width = width if width > place.width / 3 else place.width
        return Bbox.from_bounds(place.x0, place.y0, width, place.height)


def draw_side(ax: Axes, moving: Moving, units: Units, phase: float) -> None:
    """The sheet in space on its ground, seen along x from the edge; heights not to scale."""
    points, triangles = moving.covering()
    frame = moving.at(points, phase)
    add_side(ax, frame, triangles, units.length_factor, tint_of(moving, points))
    low, high = frame.place[1].min(), frame.place[1].max()
    draw_ground(ax, moving, low, high, units.length_factor)
    ax.autoscale_view()
    ax.set(xlabel=f"$y$ ({units.length})", ylabel=f"$z$ ({units.length})")
    ground = "ground at $x$ = 0"
    bottom, top = frame.place[2].min() * units.length_factor, frame.place[2].max() * units.length_factor
    if _level(moving, frame) and -top > SUNK * (top - bottom) > 0:
        margin = MARGIN * (top - bottom)
        ax.set_ylim(bottom - margin, top + margin)
        ground = "ground at $z$ = 0"
    ax.set_title(f"side view, height not to scale; {ground}", loc="left")


def _level(moving: Moving, frame: Frame) -> bool:
    """Whether the ground below the sheet is at z = 0."""
    return not moving.ground(frame.place[0], frame.place[1]).any()


def add_sheet(
    ax: Axes,
    place: Array,
    values: Array,
    triangles: Integers,
    most: float | tuple[float, float],
    cmap: Any = GROWTH_MAP,
) -> tuple[Any, Artist]:
    """Draw values as colours on a scale of +-most, or of two ends, and the outline."""
    grid = Triangulation(*on_page(place[:2]), triangles)
    low, high = most if isinstance(most, tuple) else (-(most or 1.0), most or 1.0)
    image = ax.tripcolor(grid, values, shading="gouraud", cmap=cmap, vmin=low, vmax=high, zorder=2)
    return image, ax.add_collection(outline(place, triangles, color="0.15"))


def add_side(
    ax: Axes, frame: Frame, triangles: Integers, factor: float, tint: Tint
) -> tuple[Artist, Artist]:
    """As `add_sheet`, seen along x from the edge."""
    places = frame.place[1:] * factor
    most = tint.most or 1.0
    image = ax.tripcolor(
        Triangulation(places[0], places[1], triangles),
        tint.at(frame),
        shading="gouraud",
        cmap=GROWTH_MAP,
        vmin=-most,
        vmax=most,
        zorder=2,
    )
    ends = places.T[edges(triangles)]
    return image, ax.add_collection(LineCollection(list(ends), linewidth=0.8, zorder=3, color="0.15"))


def draw_ground(ax: Axes, moving: Moving, low: float, high: float, factor: float) -> None:
    """The ground from the side, under the middle of the sheet, between two positions y."""
    y = np.linspace(low, high, 400)
    ax.plot(y * factor, moving.ground(0 * y, y) * factor, color="0.4", linewidth=0.8, zorder=1)


def outline(place: Array, triangles: Integers, **look: Any) -> LineCollection:
    """The outline of the sheet from above."""
    ends = np.stack(on_page(place[:2]), axis=-1)[edges(triangles)]
    return LineCollection(list(ends), linewidth=0.8, zorder=3, **look)


def label_ground(ax: Axes, units: Units) -> None:
    """Label the axes of a view from above."""
    ax.set(xlabel=f"$y$ ({units.length})", ylabel=f"$x$ ({units.length})")


def arrow_places(points: Array, triangles: Integers) -> Array:
    """Points of the undeformed sheet at which friction is drawn, (2, arrows)."""
    return inside(points, triangles, *_arrow_cells(points))


def _arrow_cells(points: Array) -> tuple[int, int]:
    """Arrows across and along."""
    width, length = np.ptp(points, axis=1)
    along = max(2, round(float(np.sqrt(ARROWS * length / width))))
    return max(2, round(ARROWS / along)), along


def _draw_friction(
    ax: Axes, moving: Moving, phase: float, points: Array, triangles: Integers, factor: float
) -> bool:
    """Draw friction arrows; returns False if there is no friction."""
    width, length = np.ptp(points, axis=1)
    across, along = _arrow_cells(points)
    tails = arrow_places(points, triangles)
    force = moving.friction(tails, phase)
    largest = float(np.hypot(*force).max(initial=0.0))
    if not largest:
        return False
    place = moving.at(tails, phase).place[:2]
    step = min(width / across, length / along) * factor
    scale = ARROW * step / largest
    ax.quiver(
        *on_page(place * factor),
        *on_page(force * scale),
        angles="xy",
        scale_units="xy",
        scale=1,
        pivot="mid",
        units="inches",
        width=0.014,
        zorder=4,
    )
    return True


def on_page(places: Array) -> tuple[Array, Array]:
    """Page coordinates: y to the right, x downwards (the axis is inverted)."""
    return places[1], places[0]


def _ways(moving: Moving) -> str:
    """Directions of wave and sheet, in words; that of a speed of unknown error is "?"."""
    arrows = {1: r"$\rightarrow$", -1: r"$\leftarrow$"}
    wave = f"wave {arrows[moving.direction]}, " if moving.direction else ""
    if np.isinf(moving.speed.error):
        return f"{wave}sheet ?"
    sheet = arrows.get(int(np.sign(moving.speed.mean)), "at rest")
    return f"{wave}sheet {sheet}"

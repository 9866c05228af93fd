"""The panels of a picture: V(t), the sheet from above and from the side, its path.

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
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.geometry import edges, inside
from fem_check.output.look import COLORS
from fem_check.output.moving import Frame, Moving

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

DOTS = 20
"""Approximate largest number of dots on a path."""

PHASES = 24
"""Number of phases from which the colour scale is determined."""

MEAN, BAND, WAVE = COLORS["vermillion"], "#F2B48F", COLORS["blue"]


def draw_speed(ax: Axes, moving: Moving, units: Units) -> None:
    """V(t) with its mean, and the numerical plus model error of the mean as a band."""
    course, speed = moving.course(), moving.speed
    times, velocity = course.times * units.time_factor, course.velocity * units.speed_factor
    ax.plot(times, velocity, color=COLORS["blue"], label="$V(t)$")
    error = speed.error + (0.0 if np.isnan(speed.model_error) else speed.model_error)
    mean, error = (v * units.speed_factor for v in (speed.mean, error))
    counted = [t * units.time_factor for t in course.counted]
    ax.fill_between(counted, mean - error, mean + error, color=BAND, linewidth=0, label="error")
    ax.plot(counted, [mean, mean], color=MEAN, label="mean")
    ax.axhline(0, color="0.6", linewidth=0.5, zorder=0)
    ax.set_title(f"mean {in_words(mean, error)} {units.speed}, band: error", loc="left")
    ax.set(xlabel=f"time $t$ ({units.time})", ylabel=f"$V(t)$ ({units.speed})")
    ax.set_xlim(*(t * units.time_factor for t in course.shown))


def in_words(mean: float, error: float) -> str:
    """Mean and error to the digits resolved by the error, five at most.

    >>> from fem_check.output.panels import in_words
    >>> print(in_words(-0.19177, 5.2e-4), "|", in_words(0.071, 0.0113), "|", in_words(0.0779601, 5e-16))
    −0.19177 ± 0.00052 | 0.071 ± 0.011 | 0.07796 ± 5e−16
    """
    digits = 99
    if np.isfinite(error) and error > 0:
        digits = 1 - int(np.floor(np.log10(error)))
    if digits > 6 or digits < 0:
        words = f"{mean:.5g} ± {error:.1g}" if error else f"{mean:.5g}"
    else:
        words = f"{mean:.{digits}f} ± {error:.{digits}f}"
    return words.replace("-", "\N{MINUS SIGN}")


def draw_sheet(ax: Axes, moving: Moving, units: Units, phase: float) -> None:
    """The sheet from above, with friction as arrows."""
    points, triangles = moving.covering()
    frame = moving.at(points, phase)
    most = growth_scale(moving, points)
    factor = units.length_factor
    ax.add_collection(outline(frame.still * factor, triangles, linestyle=":", color="0.5"))
    image, _ = add_sheet(ax, frame.place * factor, frame.growth, triangles, most)
    drawn = _draw_friction(ax, moving, phase, points, triangles, factor)
    label_ground(ax, units)
    ax.set_aspect("equal", anchor="W")
    shown = np.concatenate([frame.still[:2], frame.place[:2]], axis=1) * factor
    margin = 0.06 * float(np.ptp(shown[1]))
    ax.set_xlim(shown[1].min() - margin, shown[1].max() + margin)
    ax.set_ylim(shown[0].max() + margin, shown[0].min() - margin)
    friction = ", arrows: friction" if drawn else ""
    ax.set_title(
        f"$t$ = {frame.time * units.time_factor:.3g} {units.time}{friction}; {_ways(moving)}",
        loc="left",
    )
    if most:
        ax.figure.colorbar(
            image, ax=ax, label=r"growth $\alpha c$ (%)", shrink=0.9, pad=0.02, panchor=False
        )


def draw_side(ax: Axes, moving: Moving, units: Units, phase: float) -> None:
    """The sheet in space on its ground, seen along x from the edge; heights not to scale."""
    points, triangles = moving.covering()
    frame = moving.at(points, phase)
    add_side(ax, frame, triangles, units.length_factor, growth_scale(moving, points))
    low, high = frame.place[1].min(), frame.place[1].max()
    draw_ground(ax, moving, low, high, units.length_factor)
    ax.autoscale_view()
    ax.set(xlabel=f"$y$ ({units.length})", ylabel=f"$z$ ({units.length})")
    ax.set_title("side view, height not to scale", loc="left")


def draw_path(ax: Axes, moving: Moving, units: Units, periods: int) -> None:
    """The path of the centre, with dots at the ends of periods and the outline at both ends."""
    _, way = moving.way(periods, 16)
    factor = units.length_factor
    if moving.has_shape:
        points, triangles = moving.covering()
        frames = moving.frames(points, periods, 1)
        for index, grey in ((0, "0.75"), (len(frames) - 1, "0.3")):
            ax.add_collection(outline(frames[index].place * factor, triangles, color=grey))
        centres = np.array([frame.centre for frame in frames]).T
    else:
        centres = way[:, ::16]
    every = -(-periods // DOTS)
    ax.plot(*_on_page(way * factor), color=MEAN)
    ax.plot(*_on_page(centres[:, ::every] * factor), "o", color=MEAN, markersize=2)
    label_ground(ax, units)
    ax.set_aspect("equal", adjustable="datalim")
    ax.autoscale_view()
    ax.margins(0.06)
    if not ax.yaxis_inverted():
        ax.invert_yaxis()
    dots = "" if every == 1 else f", a dot every {every}"
    ax.set_title(f"path of {periods} period{'s' * (periods != 1)}{dots}", loc="left")


def add_sheet(
    ax: Axes, place: Array, growth: Array, triangles: Integers, most: float
) -> tuple[Any, Artist]:
    """Draw growth in per cent as colours on a scale of +-most, for a colour bar, and the outline."""
    grid = Triangulation(*_on_page(place[:2]), triangles)
    most = most or 1.0
    image = ax.tripcolor(
        grid, 100 * growth, shading="gouraud", cmap=GROWTH_MAP, vmin=-most, vmax=most, zorder=2
    )
    return image, ax.add_collection(outline(place, triangles, color="0.15"))


def add_side(
    ax: Axes, frame: Frame, triangles: Integers, factor: float, most: float
) -> tuple[Artist, Artist]:
    """As `add_sheet`, seen along x from the edge."""
    places = frame.place[1:] * factor
    most = most or 1.0
    image = ax.tripcolor(
        Triangulation(places[0], places[1], triangles),
        100 * frame.growth,
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
    ends = np.stack(_on_page(place[:2]), axis=-1)[edges(triangles)]
    return LineCollection(list(ends), linewidth=0.8, zorder=3, **look)


def label_ground(ax: Axes, units: Units) -> None:
    """Label the axes of a view from above."""
    ax.set(xlabel=f"$y$ ({units.length})", ylabel=f"$x$ ({units.length})")


def growth_scale(moving: Moving, points: Array) -> float:
    """The largest |alpha c| over a period, per cent; 0 without growth."""
    some = points[:, :: max(1, points.shape[1] // 400)]
    frames = moving.frames(some, 1, PHASES)
    return 100 * max(float(abs(frame.growth).max()) for frame in frames)


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
        *_on_page(place * factor),
        *_on_page(force * scale),
        angles="xy",
        scale_units="xy",
        scale=1,
        pivot="mid",
        units="inches",
        width=0.014,
        zorder=4,
    )
    return True


def _on_page(places: Array) -> tuple[Array, Array]:
    """Page coordinates: y to the right, x downwards (the axis is inverted)."""
    return places[1], places[0]


def _ways(moving: Moving) -> str:
    """Directions of wave and sheet, in words."""
    arrows = {1: r"$\rightarrow$", -1: r"$\leftarrow$"}
    wave = f"wave {arrows[moving.direction]}, " if moving.direction else ""
    sheet = arrows.get(int(np.sign(moving.speed.mean)), "at rest")
    return f"{wave}sheet {sheet}"

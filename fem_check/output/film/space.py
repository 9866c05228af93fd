"""The frames of a film in space: the sheet on its ground from the side and above, and its section."""

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator
from numpy.typing import NDArray

from fem_check.output.film.camera import Camera
from fem_check.output.film.stage import (
    BOTTOM,
    DPI,
    GROUND,
    LEFT,
    MARGIN,
    MOST,
    RIGHT,
    RULES,
    TOP,
    Stage,
    draw_arrows,
    draw_trail,
    multiples,
    nice,
)
from fem_check.output.film.surface import Surface, normals, paint, quads
from fem_check.output.geometry import middle_line
from fem_check.output.moving import Frame
from fem_check.output.panels import GROWTH_MAP

Array = NDArray[np.float64]

SHADOW = "#C9C9C9"

RELIEF = 1.6
"""How much slopes change the brightness of the ground."""

SEEN, RAISED = 14, 30
"""Heights in pixels: smaller ones are stretched, to the larger number or more."""

MOST_STRETCHED = 100
"""Largest factor on heights: what it does not show is flat."""

SIDE_ROOM, CAPTION, SIDE_MOST = 8, 20, 220
"""Pixels above and below the section, of its caption, and its largest height."""

SECTION = 121
"""Points of the section."""

CELLS = 72
"""Cells along uneven ground."""


class SpaceStage(Stage):
    """See `Stage`. Heights are to scale in both views, or stretched by a factor that is stated."""

    def _shown(self, frame: Frame) -> Frame:
        """In space, also a sheet that stays in the plane."""
        shown = super()._shown(frame)
        if len(shown.place) == 3:
            return shown
        flat = np.zeros_like(shown.growth)[None]
        return shown._replace(
            place=np.concatenate([shown.place, flat]), still=np.concatenate([shown.still, flat])
        )

    def _spot(self, frame: Frame) -> Array:
        """With the mean height, so that the path lies on the sheet and not below it."""
        return np.array([*frame.centre, frame.place[2].mean()])

    @cached_property
    def _floor(self) -> Surface:
        """The ground in view."""
        (x0, y0), (x1, y1) = self._low[:2], self._high[:2]
        y = np.linspace(y0, y1, CELLS + 1)
        x = np.linspace(x0, x1, max(2, round(CELLS * (x1 - x0) / (y1 - y0))) + 1)
        x, y = (a.ravel() for a in np.meshgrid(x, y, indexing="ij"))
        return Surface(np.stack([x, y, self._moving.ground(x, y)]), quads(CELLS + 1, x.size))

    @cached_property
    def _levels(self) -> tuple[float, float]:
        """Lowest and highest point of sheet and ground."""
        margin = MARGIN * self._moving.length
        ground = self._floor.points[2]
        low, high = self._low[2] + margin, self._high[2] - margin
        return float(min(low, ground.min())), float(max(high, ground.max()))

    @cached_property
    def _stretch(self) -> float:
        """Factor on heights: 1 where they can be seen."""
        low, high = self._levels
        pixels = (high - low) * (self._width - LEFT - RIGHT) / (self._high[1] - self._low[1])
        if pixels >= SEEN or high - low <= 1e-6 * self._moving.length:
            return 1.0
        return min(nice(RAISED / pixels), MOST_STRETCHED)

    @cached_property
    def _camera(self) -> Camera:
        up = normals(self._floor)[2]
        steepest = float(np.sqrt(1 / up.min() ** 2 - 1))
        return Camera.over(steepest, self._stretch)

    @cached_property
    def _page(self) -> tuple[Array, Array]:
        """Corners of the view in space, in units of length on the page."""
        low, high = self._levels
        corners = np.array(np.meshgrid(*zip(self._low[:2], self._high[:2], strict=True), (low, high)))
        seen = self._camera.page(corners.reshape(3, -1))
        return seen.min(1), seen.max(1)

    @property
    def _height(self) -> int:
        """Height of the view in space in pixels."""
        width, height = self._page[1] - self._page[0]
        return min(round((self._width - LEFT - RIGHT) * height / width), MOST)

    @property
    def _side(self) -> int:
        """Height of the section in pixels."""
        low, high = self._levels
        scale = (self._width - LEFT - RIGHT) / (self._high[1] - self._low[1])
        return min(round((high - low) * self._stretch * scale) + 2 * SIDE_ROOM, SIDE_MOST)

    def _set_up(self) -> tuple[Any, list[Axes]]:
        """The ground and all static parts."""
        height = TOP + self._height + CAPTION + self._side + BOTTOM
        height += height % 2
        fig = Figure(figsize=(self._width / DPI, height / DPI), dpi=DPI)
        fig.set_layout_engine("none")
        canvas: Any = FigureCanvasAgg(fig)
        span = (self._width - LEFT - RIGHT) / self._width
        bottom = 1 - (TOP + self._height) / height
        view = fig.add_axes((LEFT / self._width, bottom, span, self._height / height))
        side = fig.add_axes((LEFT / self._width, BOTTOM / height, span, self._side / height))
        self._draw_floor(view)
        self._draw_ruler(side)
        self._add_scale(fig, height)
        return canvas, [view, side]

    def _draw_floor(self, ax: Axes) -> None:
        """The ground with its rules."""
        factor, camera, floor = self._units.length_factor, self._camera, self._floor
        low, high = (v * factor for v in self._page)
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        ax.set_axis_off()
        grey = np.array([int(GROUND[k : k + 2], 16) / 255 for k in (1, 3, 5)])
        level = camera.light(np.array([0.0, 0.0, 1.0]))
        bright = np.clip(1 + RELIEF * (camera.light(normals(floor)) - level), 0.6, 1.03)
        colors = np.clip(grey * bright[:, None], 0, 1)
        patches: Any = (camera.page(floor.points) * factor).T[floor.cells]
        ax.add_collection(PolyCollection(patches, facecolors=colors, edgecolors=colors, lw=0.6))
        ax.add_collection(LineCollection(list(self._rules()), color=RULES, linewidth=0.8))
        start = [self._line(1, self._start[1])]
        ax.add_collection(LineCollection(start, color="black", lw=0.8, linestyle=(0, (4, 3))))

    def _rules(self) -> Iterator[Array]:
        """Lines on the ground at equal distances along both axes."""
        for axis in (0, 1):
            for k in range(*multiples(*self._interval(axis), self._step)):
                yield self._line(axis, k * self._step / self._units.length_factor)

    def _line(self, axis: int, at: float) -> Array:
        """A line on the ground at one x (axis 0) or y (1), on the page, (n, 2)."""
        other = 1 - axis
        along = np.linspace(self._low[other], self._high[other], 2 * CELLS)
        x, y = (np.full_like(along, at), along)[:: 1 if axis == 0 else -1]
        places = np.stack([x, y, self._moving.ground(x, y)])
        return np.asarray(self._camera.page(places).T * self._units.length_factor)

    def _interval(self, axis: int) -> tuple[float, float]:
        """Middle and half width of the ground, in the units of the film."""
        low, high = (v[axis] * self._units.length_factor for v in (self._low, self._high))
        return (low + high) / 2, (high - low) / 2

    @property
    def _step(self) -> float:
        """Distance of rules in the units of the film."""
        return nice(self._interval(1)[1] / 6)

    def _draw_ruler(self, ax: Axes) -> None:
        """Limits, ticks and caption of the section."""
        factor, (low, high) = self._units.length_factor, self._levels
        middle, half = self._interval(1)
        pixels = 2 * half / (self._width - LEFT - RIGHT) / self._stretch
        spare = SIDE_ROOM * pixels
        ax.set(xlim=(middle - half, middle + half), aspect=self._stretch)
        ax.set(ylim=(low * factor - spare, high * factor + spare), yticks=[], facecolor="none")
        ax.spines[:].set_visible(False)
        ax.xaxis.set_major_locator(MultipleLocator(2 * self._step))
        ax.tick_params(length=0)
        ax.set_xlabel(f"$y$ ({self._units.length})", loc="right", labelpad=2)
        scale = "to scale" if self._stretch == 1 else f"heights × {self._stretch:g} in both views"
        note = f"section along the middle, {scale}; {self._moving.words}"
        if self._exaggerate != 1:
            note += f", displacement x {self._exaggerate:g}"
        place = 0, 1 + 9 / self._side
        ax.text(*place, note, transform=ax.transAxes, va="center", color="0.35", size=7)

    def _moving_parts(self, axes: list[Axes], index: int, frame: Frame, trail: Array) -> Iterator[Any]:
        """See Stage."""
        view, side = axes
        factor, page = self._units.length_factor, self._camera.page
        yield self._shadow(view, frame)
        yield from self._sheet(view, frame)
        yield from self._arrows(view, index)
        yield from draw_trail(view, page(trail) * factor)
        height = 1 + 26 / self._height
        yield view.text(0, height, self._words(frame), transform=view.transAxes, va="center")
        yield from self._wave(view, frame.heading)
        yield from self._section(side, index)

    def _shadow(self, ax: Axes, frame: Frame) -> Any:
        """Of the sheet on the ground below it, which shows where it is lifted."""
        x, y, z = frame.place
        below = np.stack([x, y, np.minimum(self._moving.ground(x, y), z)])
        seen: Any = (self._camera.page(below) * self._units.length_factor).T[self._triangles]
        shadow = PolyCollection(seen, facecolors=SHADOW, edgecolors=SHADOW, lw=0.5)
        return ax.add_collection(shadow, autolim=False)

    def _sheet(self, ax: Axes, frame: Frame) -> Iterator[Any]:
        """The sheet in its colours."""
        surface = Surface(frame.place, self._triangles)
        colors, factor = self._colors(self._tint.at(frame)), self._units.length_factor
        yield from paint(ax, surface, colors, self._camera, factor)

    def _colors(self, values: Array) -> Array:
        """RGB colours (n, 3) of values of the tint."""
        return np.asarray(GROWTH_MAP(0.5 + values / (2 * (self._tint.most or 1.0)))[:, :3])

    def _arrows(self, ax: Axes, index: int) -> Iterator[Any]:
        """Friction, parallel to the plane z = 0."""
        if self._friction.acts:
            arrows, factor = self._friction.at(index), self._units.length_factor
            level = np.concatenate([arrows.ways, np.zeros((1, arrows.ways.shape[1]))])
            tails = self._camera.page(self._shown(arrows.frame).place)
            yield draw_arrows(ax, tails * factor, self._camera.page(level) * factor)

    @cached_property
    def _middle(self) -> Any:
        """Frames of the middle line of the sheet, and its pieces without holes."""
        line, found = middle_line(self._points, self._triangles, SECTION)
        pieces = np.split(np.arange(found.size), np.flatnonzero(np.diff(found) > 1) + 1)
        return self._again(line[:, found]), pieces

    def _section(self, ax: Axes, index: int) -> Iterator[Any]:
        """The ground and the middle line of the sheet, seen along x."""
        frames, pieces = self._middle
        frame, factor = self._shown(frames[index]), self._units.length_factor
        y = np.linspace(self._low[1], self._high[1], 400)
        ground = self._moving.ground(np.full_like(y, frame.place[0].mean()), y) * factor
        bottom = ax.get_ylim()[0]
        yield ax.fill_between(y * factor, ground, bottom, color=GROUND, linewidth=0)
        yield from ax.plot(y * factor, ground, color="0.4", linewidth=0.8)
        for piece in pieces:
            points = (frame.place[1:, piece] * factor).T
            yield from ax.plot(*points.T, color="0.15", linewidth=4.0, solid_capstyle="round")
            lap = (points[1:] - points[:-1]) / 4  # without gaps where the line bends
            ends = np.stack([points[:-1] - lap, points[1:] + lap], axis=1)
            values = self._tint.at(frame)[piece]
            colors = self._colors((values[1:] + values[:-1]) / 2)
            lines = LineCollection(list(ends), color=colors, linewidth=2.6, capstyle="butt")
            yield ax.add_collection(lines, autolim=False)

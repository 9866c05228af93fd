"""The frames of a film: the sheet on ruled ground, its path, the time, the direction of the wave."""

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.film.arrows import Friction
from fem_check.output.look import styled
from fem_check.output.moving import Frame, Moving
from fem_check.output.panels import (
    GROWTH_MAP,
    WAVE,
    add_sheet,
    add_side,
    draw_ground,
)
from fem_check.output.tint import tint_of

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]

DPI = 100

TOP, BOTTOM, LEFT, RIGHT = 42, 42, 14, 14
"""Margins around the ground in pixels: text and colour scale above it, the ruler below."""

SIDE = 76
"""Height of the side view of a sheet in space, in pixels."""

ARROW = 40
"""Length of the arrow for the wave in pixels."""

LEAST, MOST = 90, 640
"""Height of the ground in pixels."""

ROOMY = 500
"""Width in pixels from which there is room for the colour scale beside the time."""

MARGIN = 0.12
"""Margin of ground around the sheet, in lengths of the sheet."""

LOOKED_AT = 60
"""Number of frames from which the extent of the ground is determined."""

GROUND, RULES = "#EFEFEF", "#D2D2D2"


class Stage:
    """The frames of one film as pictures.

    periods: of `frames` frames each; width: in pixels; exaggerate: factor on the displacement within
    the sheet; name: of the motion, if it has to be told from another one.
    """

    def __init__(
        self,
        moving: Moving,
        units: Units,
        periods: int,
        frames: int,
        width: int,
        exaggerate: float,
        name: str = "",
    ) -> None:
        self._moving, self._units, self._exaggerate = moving, units, exaggerate
        self._title = name
        self._points, self._triangles = moving.covering()
        self._again = partial(moving.frames, periods=periods, samples=frames)
        self._frames, self._total = self._again(self._points), periods * frames
        self._friction = Friction(moving, periods, frames)
        self._tint = tint_of(moving, self._points)
        first = self._frames[0]
        self._start = first.centre
        # A trajectory has its own times; a speed has only those of one period.
        self._zero = first.time if moving.most_periods is None else 0.0
        self._low, self._high = self._extent()
        self._width = width - width % 2

    @staticmethod
    def joined(stages: "Sequence[Stage]") -> None:
        """Give stages that have not been drawn yet one extent, and one scale of what colours them."""
        low = np.min([one._low for one in stages], axis=0)
        high = np.max([one._high for one in stages], axis=0)
        alike = len({one._tint.label for one in stages}) == 1
        most = max(one._tint.most for one in stages)
        for one in stages:
            one._low, one._high = low, high
            if alike:
                one._tint = one._tint._replace(most=most)

    def __len__(self) -> int:
        return self._total

    def pictures(self, order: Iterable[int] | None = None) -> Iterator[Pixels]:
        """RGB pictures (height, width, 3); width and height are even, as encoders require.

        order: of the frames; each once, as they come, by default.
        """
        with styled():
            canvas, axes = self._set_up()
            canvas.draw()
        ground = canvas.copy_from_bbox(canvas.figure.bbox)
        trail = []
        for k in range(self._total) if order is None else order:
            frame = self._shown(self._frames[k])
            trail.append(self._spot(frame))
            canvas.restore_region(ground)
            with styled():
                for artist in self._moving_parts(axes, k, frame, np.array(trail).T):
                    artist.axes.draw_artist(artist)
                    artist.remove()
            yield np.asarray(canvas.buffer_rgba())[:, :, :3].copy()

    def _spot(self, frame: Frame) -> Array:
        """The centre of mass, whose path is drawn."""
        return frame.centre

    def _moving_parts(self, axes: list[Axes], index: int, frame: Frame, trail: Array) -> Iterator[Any]:
        """Parts redrawn on every picture, from back to front."""
        top, *side = axes
        factor = self._units.length_factor
        place, colours = frame.place * factor, self._tint.at(frame)
        yield from add_sheet(top, place, colours, self._triangles, self._tint.most)
        yield from self._arrows(top, index)
        yield from draw_trail(top, trail[::-1] * factor)
        height = 1 + 26 / self._height
        yield top.text(0, height, self._words(frame), transform=top.transAxes, va="center")
        yield from self._wave(top, frame.heading)
        for ax in side:
            yield from add_side(ax, frame, self._triangles, factor, self._tint)

    def _arrows(self, ax: Axes, index: int) -> Iterator[Any]:
        """Friction."""
        if self._friction.acts:
            arrows = self._friction.at(index)
            tails = self._shown(arrows.frame).place[:2]
            factor = self._units.length_factor
            yield draw_arrows(ax, tails[::-1] * factor, arrows.ways[::-1] * factor)

    def _wave(self, ax: Axes, heading: float) -> Iterator[Any]:
        """The direction of the wave, which turns with the sheet."""
        direction = self._moving.direction
        if not direction:
            return
        half = 0.5 * ARROW * direction * np.array([np.cos(heading), np.sin(heading)])
        middle = np.array([60 + ARROW / 2, self._height - 8 - ARROW / 2 * abs(np.sin(heading))])
        look = {"arrowstyle": "-|>", "color": WAVE, "lw": 1.5, "shrinkA": 0, "shrinkB": 0}
        head, tail = ((float(p[0]), float(p[1])) for p in (middle + half, middle - half))
        yield ax.annotate("", head, tail, xycoords="axes pixels", arrowprops=look)
        yield ax.annotate(
            "wave", (6, self._height - 8), xycoords="axes pixels", va="center", color=WAVE
        )

    def _words(self, frame: Frame) -> str:
        """Time and distance."""
        units = self._units
        way = (frame.centre - self._start)[1] * units.length_factor
        time = (frame.time - self._zero) * units.time_factor
        size = self._moving.length * units.length_factor
        digits = max(0, 2 - int(np.floor(np.log10(size))))
        span = self._moving.period * units.time_factor
        decimals = max(0, 2 - int(np.floor(np.log10(span))))
        way = round(way, digits) + 0.0  # no minus before 0.0
        title = f"{self._title}    " if self._title else ""
        moved = f"moved {way:+.{digits}f} {units.length}"
        words = f"{title}t = {time:.{decimals}f} {units.time}    {moved}"
        return words.replace("-", "\N{MINUS SIGN}")

    def _shown(self, frame: Frame) -> Frame:
        """The frame with exaggerated displacements."""
        if self._exaggerate == 1:
            return frame
        return frame._replace(place=frame.still + self._exaggerate * (frame.place - frame.still))

    def _extent(self) -> tuple[Array, Array]:
        """Smallest and largest x and y (and z) in view."""
        some = np.unique(np.linspace(0, self._total - 1, LOOKED_AT).astype(int))
        places = [self._shown(self._frames[int(k)]).place for k in some]
        low = np.min([place.min(1) for place in places], axis=0)
        high = np.max([place.max(1) for place in places], axis=0)
        margin = MARGIN * self._moving.length
        return low - margin, high + margin

    def _heights(self) -> tuple[float, float]:
        """Limits of z in the side view."""
        margin = MARGIN * self._moving.length
        low, high = (self._low[2] + margin, self._high[2] - margin)
        spare = 0.15 * max(high - low, 1e-3 * self._moving.length)
        return (low - spare) * self._units.length_factor, (high + spare) * self._units.length_factor

    @property
    def _height(self) -> int:
        """Height of the ground in pixels."""
        across, along = (self._high - self._low)[:2]
        return int(np.clip(round((self._width - LEFT - RIGHT) * across / along), LEAST, MOST))

    def _set_up(self) -> tuple[Any, list[Axes]]:
        """The ground and all static parts."""
        side = SIDE if self._moving.components == 3 else 0
        height = TOP + self._height + BOTTOM + side
        height += height % 2
        fig = Figure(figsize=(self._width / DPI, height / DPI), dpi=DPI)
        fig.set_layout_engine("none")
        canvas: Any = FigureCanvasAgg(fig)
        span = (self._width - LEFT - RIGHT) / self._width
        bottom = height - TOP - self._height
        box = LEFT / self._width, bottom / height, span, self._height / height
        top = fig.add_axes(box)
        self._rule(top)
        self._name(top)
        self._add_scale(fig, height)
        if not side:
            return canvas, [top]
        below = fig.add_axes((LEFT / self._width, 8 / height, span, (side - 12) / height))
        below.set(xticks=[], yticks=[], facecolor="white")
        below.set(xlim=top.get_xlim(), ylim=self._heights())
        below.spines[:].set_visible(False)
        draw_ground(below, self._moving, self._low[1], self._high[1], self._units.length_factor)
        below.text(0.005, 0.95, "side, height not to scale", transform=below.transAxes, va="top")
        return canvas, [top, below]

    def _rule(self, ax: Axes) -> None:
        factor = self._units.length_factor
        low, high = self._low * factor, self._high * factor
        # Ground beyond the height range of the picture is cut off, missing ground continued evenly.
        middle, half = (low + high) / 2, (high - low) / 2
        aspect = self._height / (self._width - LEFT - RIGHT)
        half[1] = max(half[1], half[0] / aspect)
        half[0] = half[1] * aspect
        ax.set(xlim=(middle[1] - half[1], middle[1] + half[1]))
        ax.set(ylim=(middle[0] + half[0], middle[0] - half[0]), facecolor=GROUND)
        step = nice(2 * half[1] / 12)
        for at, draw in ((1, ax.axvline), (0, ax.axhline)):
            for k in range(*multiples(middle[at], half[at], step)):
                draw(k * step, color=RULES, linewidth=0.8, zorder=0)
        ax.xaxis.set_major_locator(MultipleLocator(2 * step))
        ax.tick_params(length=0)
        ax.set_yticks([])
        ax.set_xlabel(f"$y$ ({self._units.length})", loc="right", labelpad=2)
        for spine in ax.spines.values():
            spine.set_visible(False)
        start = self._start[1] * factor
        ax.axvline(start, color="black", linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)

    def _name(self, ax: Axes) -> None:
        """Add the description of the shape."""
        note = self._moving.words
        if self._exaggerate != 1:
            note += f", displacement x {self._exaggerate:g}"
        place = 0, -30 / self._height
        ax.text(*place, note, transform=ax.transAxes, va="center", color="0.35", size=7)

    def _add_scale(self, fig: Figure, height: int) -> None:
        """The colour scale, at the top right."""
        tint = self._tint
        if not tint.most:
            return
        box = 1 - 118 / self._width, 1 - 26 / height, 90 / self._width, 9 / height
        ax = fig.add_axes(box)
        ends = -tint.most, tint.most
        ax.imshow(np.linspace(*ends, 128)[None], aspect="auto", cmap=GROWTH_MAP, extent=(*ends, 0, 1))
        ax.set(yticks=[], xticks=[])
        for at, sign in enumerate(("\N{MINUS SIGN}", "+")):
            text = f"{sign}{tint.most:.3g} {tint.unit}".rstrip()
            ax.text(at, -0.35, text, transform=ax.transAxes, va="top", ha="center", size=7)
        if self._width < ROOMY:
            return
        ax.text(-0.12, 0.5, tint.label, transform=ax.transAxes, va="center", ha="right")


def draw_trail(ax: Axes, trail: Array) -> Iterator[Any]:
    """The path of the centre so far, (2, n) on the page."""
    yield from ax.plot(*trail, color="black", linewidth=1.2)
    yield from ax.plot(*trail[:, -1:], "o", color="black", mec="white", markersize=6)


def draw_arrows(ax: Axes, tails: Array, ways: Array) -> Any:
    """Arrows (2, n) on the page, with their middles at the tails."""
    return ax.quiver(
        *tails,
        *ways,
        angles="xy",
        scale_units="xy",
        scale=1,
        pivot="mid",
        units="inches",
        width=0.016,
        zorder=4,
    )


def multiples(middle: float, half: float, step: float) -> tuple[int, int]:
    """First multiple of a step in an interval, and the first one beyond it."""
    return int(np.ceil((middle - half) / step)), int(np.floor((middle + half) / step)) + 1


def nice(step: float) -> float:
    """The next larger of 1, 2, 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(step))
    return float(power * next(n for n in (1, 2, 5, 10) if n * power >= step * (1 - 1e-9)))

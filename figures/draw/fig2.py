"""Figure 2 of the seed paper: a gait in space, its wave, and how it moves along the sheet.

    python -m figures.draw.fig2 [--out FOLDER] [--formats png pdf]

The backward gait, alpha = -0.25 and kappa = -0.15/h, under viscous friction, in its third cycle. (A)
The sheet at one time with its elements, coloured by c, arrows of friction, the undeformed sheet below;
(B, C) c and the displacement along the sheet over y and time, which includes half a cycle in which
growth rises; (D) eight poses in one cycle, from the side, with points every eighth of the length. Ten
seconds.
"""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.film.camera import Camera
from fem_check.output.film.surface import Surface, paint
from fem_check.output.geometry import middle_line, refined
from fem_check.output.kymographs import Quantity, draw_kymograph
from fem_check.output.panels import GROWTH_MAP
from fem_check.output.simulated import Simulated
from figures.common import style
from figures.measure.paper.paper_gait import BACKWARD, CELLS, READINGS, SHEET, moved, paper_scene

Array = NDArray[np.float64]

STEPS, SHOWN = 64, 2.375
"""Steps a cycle, and the time of (A) in cycles."""

POSES = 8
"""In one cycle."""

BELOW, APART = 0.3, 0.24
"""Of the undeformed sheet in (A) and between poses in (D), L."""

FRICTION = 0.12
"""Longest arrow, L."""

CAMERA = Camera.over(0.0)


def simulated() -> Simulated:
    """The gait."""
    alpha, beta = BACKWARD
    return Simulated(moved(paper_scene(alpha, beta * READINGS["thickness"]), STEPS))


def draw_snapshot(ax: Axes, moving: Simulated) -> None:
    """The sheet, its elements and friction, over the undeformed one."""
    points, triangles = refined(*refined(*moving.covering()))
    frame = moving.at(points, SHOWN)
    most = float(np.abs(frame.wave).max())
    colours = GROWTH_MAP(0.5 + 0.5 * frame.wave / most)[:, :3]
    list(paint(ax, Surface(frame.place, triangles), colours, CAMERA, 1.0))
    for line in element_lines():
        here = moving.at(line, SHOWN)
        ax.plot(*CAMERA.page(here.place), color="0.2", linewidth=0.3)
        ax.plot(*CAMERA.page(here.still - [[0], [0], [BELOW]]), color="0.5", linewidth=0.5)
    _draw_friction(ax, moving)
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_axis_off()


def _draw_friction(ax: Axes, moving: Simulated) -> None:
    """Arrows along the ground, at the middles of a grid."""
    x, y = (((np.arange(n) + 0.5) / n - 0.5) for n in (4, 10))
    places = np.stack([v.ravel() for v in np.meshgrid(x * SHEET.width, y * SHEET.length)])
    tails, force = moving.at(places, SHOWN).place, moving.friction(places, SHOWN)
    force *= FRICTION / float(np.hypot(*force).max())
    ways = CAMERA.page(np.concatenate([force, np.zeros_like(force[:1])]))
    look: dict[str, Any] = {
        "angles": "xy",
        "scale_units": "xy",
        "scale": 1,
        "width": 0.006,
        "zorder": 5,
    }
    ax.quiver(*CAMERA.page(tails), *ways, **look)


def element_lines() -> Iterator[Array]:
    """Points (2, n) along the lines of the mesh."""
    fine = np.linspace(-0.5, 0.5, 41)
    for x in np.linspace(-0.5, 0.5, CELLS[0] + 1):
        yield np.stack([np.full_like(fine, x) * SHEET.width, fine * SHEET.length])
    for y in np.linspace(-0.5, 0.5, CELLS[1] + 1):
        yield np.stack([fine * SHEET.width, np.full_like(fine, y) * SHEET.length])


def draw_poses(ax: Axes, moving: Simulated) -> None:
    """Sections of the third cycle from the side, one below the other, coloured by c."""
    points = middle_line(*moving.covering(), 81)[0]
    frames = [moving.at(points, 2 + k / POSES) for k in range(POSES)]
    most = max(float(np.abs(frame.wave).max()) for frame in frames)
    start = frames[0].centre[1]
    for k, frame in enumerate(frames):
        line = np.stack([frame.place[1] - start, frame.place[2] - k * APART], axis=1)
        pieces = np.stack([line[:-1], line[1:]], axis=1)
        ax.axhline(-k * APART, color="0.75", linewidth=0.6, zorder=0)
        ax.add_collection(LineCollection(list(pieces), color="0.15", lw=3.2, capstyle="round"))
        colours = GROWTH_MAP(0.5 + 0.5 * frame.wave[:-1] / most)
        ax.add_collection(LineCollection(list(pieces), color=colours, lw=2.2, capstyle="round"))
        ax.plot(*line[::10].T, ".", color="black", markersize=2, zorder=3)
        ax.text(0.62, -k * APART, f"{2 + k / POSES:.3g}", va="bottom", ha="right", size=7)
    ax.set(xlim=(-0.64, 0.64), ylim=(-(POSES - 0.6) * APART, 1.1 * APART), yticks=[])
    ax.set(xlabel="$y/L$")
    ax.set_title("(D) one cycle, from the side", loc="left")
    ax.set_aspect("equal")


def draw(moving: Simulated) -> Any:
    """The figure."""
    fig = style.figure(style.DOUBLE_CM, 11.5)
    panels = fig.subplot_mosaic([["A", "D"], ["B", "D"], ["C", "D"]], height_ratios=[1.3, 1, 1])
    draw_snapshot(panels["A"], moving)
    panels["A"].set_title("(A) $c$ as in (B), arrows: friction", loc="left")
    kinds = {"B": Quantity.WAVE, "C": Quantity.DISPLACEMENT}
    for letter, quantity in kinds.items():
        draw_kymograph(
            panels[letter], moving, Units("L", "cycles", 1.0, 1 / moving.period), quantity, 3
        )
        panels[letter].set_title(f"({letter})", loc="left")
    draw_poses(panels["D"], moving)
    return fig


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw and write the figure."""
    options = style.options("fig2", __doc__, arguments)
    for path in style.save(draw(simulated()), "fig2", options.out, tuple(options.formats)):
        print(path)


if __name__ == "__main__":
    main()

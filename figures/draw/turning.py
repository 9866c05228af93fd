"""Paths of two sheets over many periods: an oblique wave, and one that is stronger on one side.

    python -m figures.draw.turning [--out FOLDER] [--rtol 3e-3] [--formats png pdf]

The sheet is that of the paper, alpha = 0.2, friction dry. Drawn are the path of linear theory, that of
the nonlinear sheet with its outline every 20 periods, and the first periods of a sheet stepped in time
(`figures.measure.turning`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon
from matplotlib.ticker import MultipleLocator
from numpy.typing import NDArray

from fem_check.shell.cycle.speed import cycle_speed
from figures.common import output, style
from figures.common.records import write_csv
from figures.common.scenes import smooth_scene
from figures.measure.turning import ALPHA, SHEET, TABLE, WAVES, Row
from linear_theory import crawl_speed, rigid_path, ritz_field
from linear_theory.speed import path as paths

Array = NDArray[np.float64]

RTOL = 3e-3
"""Relative error of the speeds, on a few lengths of way less than a line is wide; of the nonlinear
sheet never less, since its mesh does not allow it."""

CELLS = (4, 8)
"""Elements across and along of the nonlinear sheet (BFS): their error is below 1e-3 of its speed."""

FIELD_RTOL = 1e-3
"""Of the displacement of the outlines, which are drawn to a per cent."""

PERIODS = {"oblique": 40, "unequal": 96}
"""So many are drawn: some lengths of the sheet, and one circle of the nonlinear sheet."""

EVERY = 20
"""Periods from one outline, and one dot on the line of theory, to the next."""

STEPPED_EVERY = 5
"""Periods from one symbol of the stepped sheet to the next."""


@dataclass(frozen=True)
class Track:
    """What is drawn of one wave: paths at the ends of the periods, and the outline in the body frame.

    outline: (2, n), at the phase at which the periods begin; growth: (3, m, m), x, y and c there.
    """

    name: str
    theory: paths.Path
    nonlinear: paths.Path
    stepped: tuple[Row, ...]
    outline: Array
    growth: Array


def compute(rtol: float = RTOL) -> list[Track]:
    """Both waves; the stepped sheets are read. Raises RuntimeError if a speed misses its tolerance."""
    table = TABLE.read()
    return [track(name, rtol, [row for row in table if row.wave == name]) for name in WAVES]


def track(name: str, rtol: float, stepped: Sequence[Row]) -> Track:
    """Paths of one wave."""
    wave = WAVES[name]
    sheet = smooth_scene(SHEET, wave, ALPHA, CELLS)
    speeds = (
        crawl_speed(SHEET, wave, ALPHA, rtol=rtol),
        cycle_speed(sheet, "current", rtol=max(rtol, RTOL)),
    )
    for speed in speeds:
        if not speed.converged:
            found = f"errors {speed.rigid_error} of {speed.rigid_mean}"
            raise RuntimeError(f"{name}: {found} miss {rtol:g}")
    theory, nonlinear = (rigid_path(s, PERIODS[name], samples=1) for s in speeds)
    return Track(name, theory, nonlinear, tuple(stepped), outline(name), growth(name))


def outline(name: str, count: int = 60) -> Array:
    """The deformed edge in the body frame at t = 0, by linear theory, (2, 4 count)."""
    share = np.linspace(-0.5, 0.5, count, endpoint=False)
    half = np.full(count, 0.5)
    x = SHEET.width * np.concatenate([share, half, -share, -half])
    y = SHEET.length * np.concatenate([-half, share, half, -share])
    field = ritz_field(SHEET, WAVES[name], rtol=FIELD_RTOL)
    return np.asarray(np.stack([x, y]) + ALPHA * field.displacement(x, y, 0.0))


def growth(name: str, count: int = 41) -> Array:
    """x, y of deformed points and c there at t = 0, (3, count, count)."""
    x = np.linspace(-0.5, 0.5, count)[:, None] * SHEET.width + np.zeros(count)
    y = np.linspace(-0.5, 0.5, count) * SHEET.length + np.zeros((count, 1))
    field = ritz_field(SHEET, WAVES[name], rtol=FIELD_RTOL)
    place = np.stack([x, y]) + ALPHA * field.displacement(x, y, 0.0)
    return np.asarray(np.stack([*place, WAVES[name].value(x, y, 0.0)]))


def placed(points: Array, path: paths.Poses, index: int) -> Array:
    """Points (2, ...) of the body frame in the lab at one pose."""
    turned = (points[0] + 1j * points[1]) * np.exp(1j * path.heading[index])
    x, y = path.position[:, index]
    return np.asarray(np.stack([x + turned.real, y + turned.imag]))


THEORY, NONLINEAR, STEPPED = style.COLORS["vermillion"], style.COLORS["blue"], style.COLORS["black"]

TITLES = {"oblique": "(a) oblique", "unequal": "(b) unequal, 1 : 3"}

ARROWS = {
    "oblique": (((-0.17, -0.35), (0.04, -0.14)),),
    "unequal": (((-0.15, -0.35), (-0.15, -0.22)), ((0.13, -0.35), (0.13, 0.04))),
}
"""Tails and heads of arrows on the first sheet along the wave, as long as its amplitude."""


def draw(tracks: Sequence[Track]) -> Figure:
    """Two panels of one scale."""
    fig = style.figure(height=8.4)
    limits = [extent(track) for track in tracks]
    widths = [limit[1] - limit[0] for limit in limits]
    height = max(limit[3] - limit[2] for limit in limits)
    panels = fig.subplots(1, len(tracks), width_ratios=widths)
    for axes, track, limit in zip(panels, tracks, limits, strict=True):
        _draw_track(axes, track)
        middle = (limit[2] + limit[3]) / 2
        axes.set(xlim=limit[:2], ylim=(middle - height / 2, middle + height / 2), aspect="equal")
        axes.set_xlabel("$x/L$")
        axes.set_title(TITLES[track.name], loc="left")
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(MultipleLocator(1))
            axis.set_major_formatter("{x:.0f}")
    panels[0].set_ylabel("$y/L$")
    fig.legend(handles=_handles(), loc="outside upper center", ncols=2, columnspacing=1.5)
    return fig


def extent(track: Track, margin: float = 0.15) -> tuple[float, float, float, float]:
    """Smallest and largest x and y that are drawn."""
    drawn = [placed(track.outline, track.nonlinear, i) for i in _marked(track)]
    points = np.concatenate([*drawn, track.nonlinear.position, track.theory.position], axis=1)
    low, high = points.min(1) - margin, points.max(1) + margin
    return float(low[0]), float(high[0]), float(low[1]), float(high[1])


def _marked(track: Track) -> range:
    return range(0, track.nonlinear.times.size, EVERY)


def _draw_track(axes: Axes, track: Track) -> None:
    for i in _marked(track):
        edge = placed(track.outline, track.nonlinear, i).T
        axes.add_patch(Polygon(edge, closed=True, facecolor="none", edgecolor="0.55", linewidth=0.6))
    x, y, c = track.growth
    first = placed(np.stack([x, y]), track.nonlinear, 0)
    axes.pcolormesh(*first, c, cmap="PuOr", vmin=-2.5, vmax=2.5, shading="gouraud", rasterized=True)
    look = {"arrowstyle": "->", "lw": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6}
    for tail, head in ARROWS[track.name]:
        axes.annotate("", head, tail, arrowprops=look)
    axes.plot(*track.theory.position, color=THEORY, linestyle="--", linewidth=1.0)
    axes.plot(*track.theory.position[:, ::EVERY], "o", color=THEORY, markersize=2.5)
    axes.plot(*track.nonlinear.position, color=NONLINEAR)
    axes.plot(*track.nonlinear.position[:, ::EVERY], "o", color=NONLINEAR, markersize=2.5)
    shown = np.array([(row.x, row.y) for row in track.stepped if row.period % STEPPED_EVERY == 0])
    axes.plot(*shown.T, "+", color=STEPPED, markersize=5, markeredgewidth=0.8)


def _handles() -> list[Line2D]:
    """Legend entries."""
    line: dict[str, Any] = {"marker": "o", "markersize": 2.5}
    return [
        Line2D([], [], color=THEORY, linestyle="--", linewidth=1.0, label="linear theory", **line),
        Line2D([], [], color=NONLINEAR, label="nonlinear sheet", **line),
        Line2D([], [], color=STEPPED, ls="none", marker="+", markersize=5, label="stepped in time"),
        Line2D([], [], color="0.55", linewidth=0.6, label=f"outline, every {EVERY} periods"),
    ]


def numbers_shown(tracks: Sequence[Track]) -> dict[str, object]:
    """What the JSON beside the figure holds; a radius that is infinite is null."""
    return {track.name: _numbers(track) for track in tracks} | {"alpha": ALPHA}


def _numbers(track: Track) -> dict[str, object]:
    found: dict[str, object] = {}
    for name in ("theory", "nonlinear"):
        path: paths.Path = getattr(track, name)
        found[name] = {
            "step": path.step,
            "step_error": path.step_error,
            "turn": path.turn,
            "turn_error": path.turn_error,
            "radius": np.nan if path.is_straight else path.radius,
            "speed": path.speed,
        }
    last = track.stepped[-1]
    cycle = track.nonlinear.position[:, last.period]
    found["stepped"] = {
        "periods": last.period,
        "pose": [last.x, last.y, last.heading],
        "errors": [last.error, last.heading_error],
        "distance_from_nonlinear": float(np.hypot(*(cycle - [last.x, last.y]))),
        "heading_from_nonlinear": last.heading - float(track.nonlinear.heading[last.period]),
    }
    return found


def write(tracks: Sequence[Track], out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure, paths (CSV) and numbers (JSON) in the folder `out`; returns their paths."""
    columns: dict[str, list[float | str]] = {
        n: [] for n in ("wave", "model", "period", "x", "y", "heading")
    }
    for track in tracks:
        for model in ("theory", "nonlinear"):
            path: paths.Path = getattr(track, model)
            poses = zip(*path.position, path.heading, strict=True)
            for k, pose in enumerate(poses):
                for column, value in zip(columns.values(), (track.name, model, k, *pose), strict=True):
                    column.append(value)
    return [
        *style.save(draw(tracks), "turning", out, tuple(formats)),
        write_csv(style.output_path("turning.csv", out), columns),
        output.write_json(style.output_path("turning.json", out), numbers_shown(tracks)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute, draw and write the figure of paths."""
    options = style.options("turning", __doc__, arguments, rtol=(RTOL, "error of the speeds"))
    for path in write(compute(options.rtol), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

"""Figure 3: friction under a crawling sheet at one instant, and its mean speed in 1D and 2D.

    python -m figures.fig3 [--out FOLDER] [--rtol 1e-4] [--formats png pdf]

Panel A: friction by the Airy series (top) and by linear finite elements (bottom). Panel B: mean
speed against the growth coupling, lines from theory, symbols from simulation, signs as they come
out. In 2D the load is 'current', weight per current area as in eq. 11; friction is dry (Coulomb).
"""

import argparse
import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from fem_check.plane_stress import PlaneStressField, plane_stress_field
from figures import output, style
from linear_theory import Sheet, SineWave, airy_series, field_speed, friction_field, line_speed
from linear_theory.field import LinearField

Array = NDArray[np.float64]

RTOL = 1e-4
"""Relative error of the speeds from theory; those from finite elements get FEM_FACTOR of it."""

FEM_FACTOR = 10.0
FEM_COST = 10.0
"""Finite elements bring more cells than the balance needs: they get a tolerance FEM_FACTOR looser, and
one speed still costs about FEM_COST of those from the series."""

FEM_SIZE = 1 / 6
"""Longest side of the triangles, of degree 4, over the length of the sheet."""

ALPHA_SHOWN = 0.25
"""Growth coupling in panel A, and where the JSON compares speeds."""

PHASE_SHOWN = 0.0
"""Time of panel A over the period."""

FEM_ALPHAS = (0.04, 0.11, 0.18, ALPHA_SHOWN, 0.32, 0.39)

SMALL_ALPHA = 1e-6
"""V/alpha^2 differs from its limit by alpha^2 relative."""

LEADING_FACTOR = 0.01
"""Share of rtol for the coefficient of alpha^2, and for the deformation, which costs little."""

THEORY_POINTS, LINE_POINTS = 13, 201
"""Couplings of the curves in 2D and 1D."""

CLEARANCE = 0.96
"""Share of the largest alpha with positive load that the curves reach."""

GRID, ARROWS = (41, 81), (5, 11)
"""Points of colour, and arrows, across and along the sheet."""


@dataclass(frozen=True)
class Snapshot:
    """The deformed sheet and its friction at one instant; vectors (2, ...) are (x, y), lengths in L.

    label: source; position, growth: on GRID; feet: reference points of the arrows, moved: where they
    are, force: friction per reference area over mu times the weight per area; edges: deformed sides
    of the triangles, (sides, points, 2), none for a series.
    """

    label: str
    position: Array
    growth: Array
    feet: Array
    moved: Array
    force: Array
    edges: Array | None


@dataclass(frozen=True)
class Series:
    """Mean speeds against alpha, each (n,), in L/T; error: estimated numerical error of speed.

    kind: "theory", "law" (leading power of alpha), "printed" or "simulation"; dimension: 1 or 2.
    """

    label: str
    kind: str
    dimension: int
    alpha: Array
    speed: Array
    error: Array


@dataclass(frozen=True)
class Fig3Data:
    """What the figure shows.

    coefficients: V/alpha^2 as alpha -> 0 and its error, in L/T, by dimension; largest_alpha: at which
    the load is no longer positive somewhere.
    """

    snapshots: tuple[Snapshot, Snapshot]
    series: tuple[Series, ...]
    coefficients: dict[int, tuple[float, float]]
    largest_alpha: float


def compute(rtol: float = RTOL) -> Fig3Data:
    """Friction and speeds for the paper's sheet and wave; rtol: of the speeds from theory."""
    sheet, wave = Sheet(), SineWave()
    theory = airy_series(sheet, wave, rtol=LEADING_FACTOR * rtol)
    elements = plane_stress_field(sheet, wave, size=FEM_SIZE)
    limit = largest_alpha(theory)
    alphas = np.union1d(np.linspace(0, CLEARANCE * limit, THEORY_POINTS), [ALPHA_SHOWN])
    with output.Progress("figure 3", alphas.size + 1 + FEM_COST * len(FEM_ALPHAS)) as progress:
        leading = leading_coefficient(theory, LEADING_FACTOR * rtol)
        progress.advance()
        curve = sheet_speeds("2D, theory", "theory", theory, alphas, rtol, progress.advance)
        symbols = simulated(elements, FEM_FACTOR * rtol, lambda: progress.advance(FEM_COST))
    coefficients = {1: (float(line_speed(SMALL_ALPHA)) / SMALL_ALPHA**2, SMALL_ALPHA**2), 2: leading}
    laws = [law_speeds(dimension, c, alphas) for dimension, (c, _) in coefficients.items()]
    return Fig3Data(
        snapshots=(snapshot(theory, "Airy series"), snapshot(elements, "linear FEM")),
        series=(curve, *line_speeds(alphas), *laws, *symbols),
        coefficients=coefficients,
        largest_alpha=limit,
    )


def simulated(elements: LinearField, rtol: float, advance: Callable[[], None]) -> list[Series]:
    """All that panel B shows as symbols; further models of the sheet join the list."""
    alphas = np.array(FEM_ALPHAS)
    return [sheet_speeds("2D, linear FEM", "simulation", elements, alphas, rtol, advance)]


def sheet_speeds(
    label: str,
    kind: str,
    field: LinearField,
    alphas: Array,
    rtol: float,
    advance: Callable[[], None],
) -> Series:
    """Speeds of the sheet, by the balance of dry friction under the 'current' load."""
    speeds = []
    for alpha in alphas.tolist():
        found = field_speed(field, alpha, load="current", friction="coulomb", rtol=rtol)
        speeds.append((found.mean, found.error))
        advance()
    mean, error = np.array(speeds).T
    return Series(label, kind, 2, alphas, mean, error)


def line_speeds(alphas: Array) -> list[Series]:
    """The closed form in 1D, right to 2 ulp, and the printed one."""
    found = []
    for form, label, kind in (
        ("corrected", "1D, theory", "theory"),
        ("printed", "1D, printed", "printed"),
    ):
        speed = line_speed(alphas, form=form)
        found.append(Series(label, kind, 1, alphas, speed, 2 * np.spacing(abs(speed))))
    return found


def leading_coefficient(field: LinearField, rtol: float) -> tuple[float, float]:
    """V/alpha^2 as alpha -> 0, and its error; under the 'current' load."""
    found = field_speed(field, SMALL_ALPHA, load="current", friction="coulomb", rtol=rtol)
    return found.mean / SMALL_ALPHA**2, found.error / SMALL_ALPHA**2


def law_speeds(dimension: int, coefficient: float, alphas: Array) -> Series:
    """The leading term, proportional to alpha^2; drawn as it is, it has no error."""
    label = f"{dimension}D, α² law"
    return Series(label, "law", dimension, alphas, coefficient * alphas**2, np.zeros_like(alphas))


def largest_alpha(field: LinearField) -> float:
    """At which the area element 1 + alpha tr(strain) reaches 0 at some point and time."""
    x, y = grid(field.sheet, GRID, ends=True)
    times = np.linspace(0, field.wave.period, GRID[1])
    lowest = min(field.strain(x, y, t)[:2].sum(0).min() for t in times)
    return float(-1 / lowest)


def grid(sheet: Sheet, counts: tuple[int, int], ends: bool) -> tuple[Array, Array]:
    """Points x (n, 1) and y (m,) over the sheet, from edge to edge or in the middle of n x m cells."""
    across, along = (
        np.linspace(-0.5, 0.5, n) if ends else (np.arange(n) + 0.5) / n - 0.5 for n in counts
    )
    return sheet.width * across[:, None], sheet.length * along


def snapshot(field: LinearField, label: str) -> Snapshot:
    """The sheet at ALPHA_SHOWN and PHASE_SHOWN, in the frame of its mean motion."""
    t = PHASE_SHOWN * field.wave.period
    x, y = grid(field.sheet, GRID, ends=True)
    feet = np.stack(np.broadcast_arrays(*grid(field.sheet, ARROWS, ends=False)))
    return Snapshot(
        label=label,
        position=moved(field, np.stack(np.broadcast_arrays(x, y)), t),
        growth=field.wave.value(x, y, t, field.sheet.length),
        feet=feet,
        moved=moved(field, feet, t),
        force=friction_field(field, ALPHA_SHOWN, feet[0], feet[1], t, load="current").force,
        edges=moved_edges(field, t) if isinstance(field, PlaneStressField) else None,
    )


def moved(field: LinearField, points: Array, t: float) -> Array:
    """Where the reference points (2, ...) are at time t: deformation as it is, not exaggerated."""
    return np.asarray(points + ALPHA_SHOWN * field.displacement(points[0], points[1], t))


def moved_edges(field: PlaneStressField, t: float, points: int = 9) -> Array:
    """Sides of the triangles at time t, (sides, points, 2)."""
    start, end = field.mesh.p[:, field.mesh.facets].transpose(1, 0, 2)
    share = np.linspace(0, 1, points)
    along = start[:, :, None] * (1 - share) + end[:, :, None] * share
    return np.moveaxis(moved(field, along, t), 0, -1)


ARROW_LOOK: dict[str, Any] = {
    "angles": "xy",
    "scale_units": "xy",
    "scale": 14,
    "width": 0.0055,
    "pivot": "mid",
    "zorder": 3,
}
LINE_LOOKS: dict[str, dict[str, Any]] = {
    "theory": {"linestyle": "-", "linewidth": 1.2},
    "printed": {"linestyle": "--", "linewidth": 1.0},
    "law": {"linestyle": ":", "linewidth": 0.8},
}
COLOURS = {1: style.COLORS["vermillion"], 2: style.COLORS["blue"]}
MARKERS = ("o", "s", "^")
"""Of the simulated series, in their order."""


def draw(data: Fig3Data) -> Figure:
    """Panel A on the left, with y to the right; panel B on the right."""
    fig = style.figure(width=style.DOUBLE_CM, height=9.4)
    cells = fig.add_gridspec(1, 2, width_ratios=(1.1, 1))
    left, right = fig.add_subfigure(cells[0]), fig.add_subfigure(cells[1])
    panels = left.subplots(2, 1, sharex=True, sharey=True)
    for axes, shot in zip(panels, data.snapshots, strict=True):
        colours = _draw_sheet(axes, shot)
    _draw_keys(panels)
    bar = left.colorbar(colours, ax=panels, shrink=0.4, aspect=18, ticks=[-1, 0, 1])
    bar.set_label("growth $c$", labelpad=0)
    _draw_speeds(right.subplots(), data)
    instant = rf"$\alpha$ = {ALPHA_SHOWN:g}, $t/T$ = {PHASE_SHOWN:g}"
    left.suptitle(rf"$\mathbf{{A}}$   friction on the sheet at {instant}", x=0.01, ha="left")
    right.suptitle(r"$\mathbf{B}$   mean speed, positive along the wave", x=0.01, ha="left")
    return fig


def _draw_sheet(axes: Axes, shot: Snapshot) -> QuadMesh:
    """Colour, triangles, outline, sheet at rest and arrows of one snapshot."""
    x, y = shot.position
    colours = axes.pcolormesh(
        y, x, shot.growth, cmap=_colour_map(), vmin=-1, vmax=1, shading="gouraud", rasterized=True
    )
    if shot.edges is not None:
        sides = LineCollection(list(shot.edges[..., ::-1]), colors="0.35", linewidths=0.25, zorder=2)
        axes.add_collection(sides)
    axes.plot(_around(y), _around(x), color="black", linewidth=0.7)
    axes.quiver(*shot.moved[::-1], *shot.force[::-1], **ARROW_LOOK)
    axes.set(aspect="equal", xlabel="$y/L$", ylabel="$x/L$")
    axes.use_sticky_edges = False
    axes.margins(0.04)
    axes.set(xticks=[-0.5, 0, 0.5], yticks=[-0.25, 0, 0.25])
    axes.label_outer()
    axes.set_title(shot.label, loc="left")
    return colours


def _draw_keys(panels: Sequence[Axes]) -> None:
    """Beside the titles: the way of the wave, and the length of an arrow of friction."""
    top, bottom = panels
    place: dict[str, Any] = {"xycoords": "axes fraction", "va": "center"}
    top.annotate("", (1, 1.07), (0.84, 1.07), arrowprops={"arrowstyle": "-|>", "lw": 1.5}, **place)
    top.annotate("wave", (0.82, 1.07), ha="right", fontsize=7, **place)
    key = bottom.quiver([0], [0], [0], [0], **ARROW_LOOK)
    label = r"friction $\mu w$"
    bottom.quiverkey(
        key, 0.95, 1.07, 1.0, label, labelpos="W", labelsep=0.15, fontproperties={"size": 7}
    )


def _colour_map() -> LinearSegmentedColormap:
    """Blue to red without the darkest ends, on which black arrows would not show."""
    shades = mpl.colormaps["RdBu_r"](np.linspace(0.18, 0.82, 256))
    return LinearSegmentedColormap.from_list("growth", shades)


def _around(values: Array) -> Array:
    """Values on a grid, once around its edge."""
    return np.concatenate([values[0], values[:, -1], values[-1, ::-1], values[::-1, 0]])


def _draw_speeds(axes: Axes, data: Fig3Data) -> None:
    """Lines, symbols and the largest alpha of panel B."""
    for series in data.series:
        if series.kind != "simulation":
            _draw_line(axes, series)
    simulated = [series for series in data.series if series.kind == "simulation"]
    for series, marker in zip(simulated, itertools.cycle(MARKERS)):
        axes.errorbar(
            series.alpha, series.speed, series.error, ls="none", marker=marker, mfc="white",
            color=COLOURS[series.dimension], label=series.label, zorder=3,
        )  # fmt: skip
    axes.axhline(0, color="black", linewidth=0.6)
    axes.axvline(data.largest_alpha, color="0.6", linewidth=0.6)
    note: dict[str, Any] = {"textcoords": "offset points", "fontsize": 7}
    axes.annotate(
        "load reaches 0",
        (data.largest_alpha, 0),
        (-2, -6),
        rotation=90,
        ha="right",
        va="top",
        color="0.4",
        **note,
    )
    axes.annotate(
        "2D: load 'current',\nCoulomb friction",
        (0, 0.04),
        (6, 0),
        xycoords=("data", "axes fraction"),
        **note,
    )
    axes.set(xlim=(0, None), xlabel=r"growth coupling $\alpha$", ylabel="mean speed $V$  ($L/T$)")
    axes.legend(loc="upper left")


def _draw_line(axes: Axes, series: Series) -> None:
    """Through the speeds by a cubic spline, level at alpha = 0 where V is of second order."""
    alphas = np.linspace(series.alpha[0], series.alpha[-1], LINE_POINTS)
    speeds = CubicSpline(series.alpha, series.speed, bc_type=((1, 0.0), "not-a-knot"))(alphas)
    look = LINE_LOOKS[series.kind]
    axes.plot(alphas, speeds, color=COLOURS[series.dimension], label=series.label, **look)


def numbers_shown(data: Fig3Data) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    shown = {}
    for series in data.series:
        at = np.flatnonzero(series.alpha == ALPHA_SHOWN)[0]
        shown[series.label] = {"speed": series.speed[at], "error": series.error[at]}
    coefficients = {
        f"{dimension}D": {"value": value, "error": error}
        for dimension, (value, error) in data.coefficients.items()
    }
    top, bottom = data.snapshots
    difference = np.hypot(*(top.force - bottom.force))
    return {
        "alpha_shown": ALPHA_SHOWN,
        "speeds_at_alpha_shown": shown,
        "speed_over_alpha_squared_as_alpha_to_0": coefficients,
        "largest_alpha": data.largest_alpha,
        "largest_difference_of_friction": difference.max(),
    }


def write(data: Fig3Data, out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure, data (CSV) and numbers (JSON) in the folder `out`; returns their paths."""
    rows = [
        (series.label, series.kind, *numbers)
        for series in data.series
        for numbers in zip(series.alpha, series.speed, series.error, strict=True)
    ]
    speeds = dict(
        zip(("series", "kind", "alpha", "speed", "error"), zip(*rows, strict=True), strict=True)
    )
    arrows: dict[str, ArrayLike] = {
        "source": np.repeat([shot.label for shot in data.snapshots], math.prod(ARROWS))
    }
    for name, vectors in (("", "feet"), ("moved_", "moved"), ("force_", "force")):
        for i, axis in enumerate("xy"):
            arrows[name + axis] = np.ravel([getattr(shot, vectors)[i] for shot in data.snapshots])
    return [
        *style.save(draw(data), "fig3", out, tuple(formats)),
        output.write_csv(style.output_path("fig3_speed.csv", out), speeds),
        output.write_csv(style.output_path("fig3_friction.csv", out), arrows),
        output.write_json(style.output_path("fig3.json", out), numbers_shown(data)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute, draw and write figure 3."""
    parser = argparse.ArgumentParser(prog="figures.fig3", description=main.__doc__)
    parser.add_argument("--out", type=Path, help="folder of the files (figures/out)")
    parser.add_argument("--rtol", type=float, default=RTOL, help="error of the speeds (%(default)g)")
    parser.add_argument("--formats", nargs="+", choices=list(style.METADATA), default=["png", "pdf"])
    options = parser.parse_args(arguments)
    for path in write(compute(options.rtol), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

"""Figure on the saddle of V over growth and curvature near the origin, and on how far its form holds.

    python -m figures.draw.saddle [--out FOLDER] [--formats png pdf]

Left: V of the quadratic form over (alpha, beta) for the paper's sheet and ground, from the table of
`figures.measure.saddle`, between the curvatures at which the sheet lifts off. Right: along the lines
beta = +-100 alpha/L of two equal layers, on that ground and on one 100 times as stiff, from
`figures.measure.plate.saddle_range`: V/alpha^2 of the form (lines, dashed beyond lift-off), of cycles
of shapes and of the stepper (symbols), and V over that of the form, with bands of 5 and 10 %. A sine
wave, the tanh law with a slip speed of 0.3 |alpha| L/T.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figures.common import output, style
from figures.measure import saddle
from figures.measure.plate import saddle_range
from figures.measure.plate.saddle_range import BILAYER, GROUNDS
from linear_theory import Estimate
from linear_theory.speed.plate.quadratic_form import QuadraticForm

LAW = "tanh"

SHARES = (0.05, 0.1)
"""Of V, by which form and cycles may differ: the two bands."""

MOST_ALPHA = 0.06

LINES, MOST_SPEED = (-3, -2, -1, 2, 4, 6, 8, 10, 12), 12e-3
"""V of the labelled lines, over 1e-3 L/T, and at the ends of the colours."""

SHADES = np.linspace(-MOST_SPEED, MOST_SPEED, 97)
"""Levels of the colours: so many that no steps are seen."""

TICKS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 3.0)

GROUND_COLORS = {"paper": style.COLORS["blue"], "stiff ground": style.COLORS["vermillion"]}
GROUND_WORDS = {"paper": "paper's ground", "stiff ground": "100 times as stiff"}
MARKERS = {-1: "o", 1: "s"}


def form_of(rows: Sequence[saddle.Row], place: str, law: str = LAW) -> QuadraticForm:
    """The quadratic form of a sheet under a sine. Raises ValueError where the table has none."""
    for r in rows:
        if (r.place, r.wave, r.law) == (place, "sine", law):
            limit = r.beta / saddle.OF_LIFT_OFF
            return QuadraticForm(
                alpha=Estimate(0.0, 0.0),
                alpha_alpha=Estimate(r.theory_aa, r.error_aa),
                alpha_beta=Estimate(r.theory_ab, r.error_ab),
                beta_beta=Estimate(r.theory_bb, r.error_bb),
                lift_off=(-limit, limit),
            )
    raise ValueError(f"no {place}, sine, {law} in the table; `{saddle.TABLE.command}` makes it")


def draw(rows: Sequence[saddle.Row], along: Sequence[saddle_range.Row]) -> Figure:
    """The map, and the two rays."""
    fig = style.figure(width=style.DOUBLE_CM, height=8.6)
    halves: Any = fig.subfigures(1, 2, width_ratios=[1.0, 1.05])
    left, right = halves
    _draw_map(left.subplots(), form_of(rows, "paper"))
    speeds, ratios = right.subplots(2, 1, sharex=True, height_ratios=[1.25, 1])
    for ground in GROUNDS:
        for way in (-1, 1):
            ray = saddle_range.ray(along, ground, LAW, way)
            _draw_speeds(speeds, ray)
            _draw_ratios(ratios, ray)
    _label(speeds, ratios)
    return fig


def _draw_map(axes: Axes, form: QuadraticForm) -> None:
    limit = form.lift_off[1]
    alpha = np.linspace(-MOST_ALPHA, MOST_ALPHA, 201)
    beta = np.linspace(-limit, limit, 203)[1:-1]
    speed = np.array([[form.at(a, b).value for a in alpha] for b in beta])
    colors: dict[str, Any] = {"cmap": "RdBu_r", "vmin": -MOST_SPEED, "vmax": MOST_SPEED}
    axes.contourf(alpha, beta, speed, levels=SHADES, extend="both", **colors)
    levels = [1e-3 * v for v in LINES]
    lines = axes.contour(alpha, beta, speed, levels, colors="0.3", linewidths=0.5, linestyles="-")
    axes.clabel(lines, fmt=lambda v: f"{1e3 * v:.0f}".replace("-", "−"), fontsize=7)
    axes.contour(alpha, beta, speed, [0.0], colors="black", linewidths=1.4)
    for way in (1, -1):
        ends = np.array([-limit, limit])
        axes.plot(way * ends / BILAYER, ends, "--", color=style.COLORS["green"], linewidth=1.0)
    for end, above in ((limit, "bottom"), (-limit, "top")):
        axes.axhline(end, color="black", linewidth=0.8, linestyle=":")
        axes.annotate("lift-off", (-0.96 * MOST_ALPHA, end), va=above, fontsize=7)
    axes.annotate(
        "two equal layers\n" r"$\beta=\pm100\,\alpha/L$",
        (limit * 0.93 / BILAYER, limit * 0.93),
        (0.014, 1.06 * limit),
        color=style.COLORS["green"],
        fontsize=7,
        arrowprops={"arrowstyle": "-", "color": style.COLORS["green"], "linewidth": 0.6},
    )
    axes.set_xticks([-0.05, 0, 0.05])
    axes.set(xlim=(-MOST_ALPHA, MOST_ALPHA), ylim=(-1.3 * limit, 1.3 * limit))
    axes.set(xlabel=r"growth $\alpha$", ylabel=r"curvature $\beta$  ($1/L$)")
    axes.set_title(r"$V$ of the quadratic form ($10^{-3}\,L/T$); bold: $V=0$")


def _draw_speeds(axes: Axes, ray: Sequence[saddle_range.Row]) -> None:
    first, color = ray[0], GROUND_COLORS[ray[0].ground]
    inside = np.geomspace(ray[0].beta, first.lift_off, 30)
    beyond = np.geomspace(first.lift_off, ray[-1].beta, 30)
    for beta, dashes in ((inside, "-"), (beyond, (0, (2, 2)))):
        axes.plot(beta, np.full_like(beta, first.form), color=color, linestyle=dashes)
    _symbols(axes, ray, lambda r, v: v)


def _draw_ratios(axes: Axes, ray: Sequence[saddle_range.Row]) -> None:
    axes.axvline(ray[0].lift_off, color=GROUND_COLORS[ray[0].ground], linestyle=":", linewidth=0.8)
    if ray[0].way > 0:
        name: dict[str, Any] = {"fontsize": 7, "color": GROUND_COLORS[ray[0].ground]}
        axes.annotate(
            "lift-off", (ray[0].lift_off, 0.44), (-3, 0), textcoords="offset points", ha="right", **name
        )
    _symbols(axes, ray, lambda r, v: v / r.form)


def _symbols(axes: Axes, ray: Sequence[saddle_range.Row], value: Any) -> None:
    color, way = GROUND_COLORS[ray[0].ground], ray[0].way
    beta = [r.beta for r in ray]
    cycles = [value(r, r.cycle) for r in ray]
    axes.plot(beta, cycles, MARKERS[way], color=color, markersize=3.4, markerfacecolor="none")
    axes.plot(beta, [value(r, r.stepper) for r in ray], "x", color=color, markersize=4.2)


def _label(speeds: Axes, ratios: Axes) -> None:
    speeds.axhline(0, color="0.6", linewidth=0.6)
    speeds.set(xscale="log", ylabel=r"$V/\alpha^2$  ($L/T$)", ylim=(-60, 110))
    speeds.set_title(r"along the lines $\beta=\pm100\,\alpha/L$")
    for share, shade in zip(reversed(SHARES), ("0.93", "0.85"), strict=True):
        ratios.axhspan(1 / (1 + share), 1 / (1 - share), color=shade, linewidth=0, zorder=0)
        place = (3.35, 1 / (1 - share) - 0.005)
        ratios.annotate(f"{100 * share:.0f} %", place, ha="right", va="top", fontsize=6.5)
    ratios.set(xlabel=r"$|\beta|$  ($1/L$)", ylabel="$V$ / form", xlim=(0.03, 3.5), ylim=(0.4, 1.2))
    ratios.set_xticks(TICKS, [f"{t:g}" for t in TICKS])
    ratios.minorticks_off()
    handles = [speeds.plot([], [], color=GROUND_COLORS[g], label=GROUND_WORDS[g])[0] for g in GROUNDS]
    for label, marker in (
        (r"cycle, $\beta=-100\,\alpha/L$", MARKERS[-1]),
        (r"cycle, $\beta=+100\,\alpha/L$", MARKERS[1]),
        ("stepper", "x"),
    ):
        kind: dict[str, Any] = {"ls": "none", "color": "0.3", "markersize": 3.4, "label": label}
        handles += speeds.plot([], [], marker, markerfacecolor="none", **kind)
    speeds.legend(handles=handles, loc="upper left", labelspacing=0.2, ncols=2)


def numbers_shown(rows: Sequence[saddle.Row], along: Sequence[saddle_range.Row]) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    return {
        "lift_off": form_of(rows, "paper").lift_off[1],
        "within": {
            f"{ground}, {share:g}": saddle_range.within(along, ground, LAW, share)
            for ground in GROUNDS
            for share in SHARES
        },
    }


def write(out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure and numbers (JSON) in the folder `out`; returns their paths. Its data are the tables."""
    rows, along = saddle.TABLE.read(), saddle_range.TABLE.read()
    return [
        *style.save(draw(rows, along), "saddle", out, tuple(formats)),
        output.write_json(style.output_path("saddle.json", out), numbers_shown(rows, along)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its tables."""
    options = style.options("saddle", __doc__, arguments)
    for path in write(options.out, options.formats):
        print(path)

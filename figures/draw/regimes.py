"""Figure on friction: V/alpha^2 against the slip speed, from dry through mixed to viscous friction.

    python -m figures.draw.regimes [--out FOLDER] [--formats png pdf]

Lines are theory, symbols simulations of the nonlinear sheet, by static shapes and by time steps; their
estimated errors are smaller. Shaded are the slip speeds at which the nonlinear sheet meets dry and
viscous friction (`CrawlSpeed.regime`). Speeds are read from the table of `figures.measure.regimes`.

Bars mark where the paper's law, v0 = 1 with L = 1, stands for alpha from 0.02 to 0.4 if the
period is T = L/v0, or 29.5 L/v0, to which its eqs 12 settle: v0/(alpha L/T) is T/alpha in these units.
The paper states no period, so what it prints does not show that its simulations were of dry friction:
they were if T was below 0.09 alpha L/v0 (0.023 L/v0 at alpha = 0.25), and of viscous friction, with
speeds a third lower, if T was above 1.84 alpha L/v0, as it is for all that is marked.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from figures.common import output, style
from figures.measure import regimes as regimes_table
from linear_theory.friction.regime import DRY_RATIO, VISCOUS_RATIO

Array = NDArray[np.float64]

PAPER_ALPHAS = (0.02, 0.4)
"""Smallest and largest growth coupling that is marked."""

PERIODS = {"$T=L/v_0$": 1.0, "$T=29.5\\,L/v_0$ (eqs 12)": 29.5}
"""In L/v0, v0 = 1, by their labels. Eqs 12 with the printed values, uniform in space, settle to
oscillations of this period (LSODA to 1e-9), of amplitude 0.12."""

LINES: dict[str, dict[str, Any]] = {
    "linear": {"label": "2D, linear theory", "color": style.COLORS["blue"], "linestyle": "--"},
    "second order": {"label": "2D, second order", "color": style.COLORS["blue"]},
    "line": {"label": "1D, theory", "color": style.COLORS["vermillion"]},
}
SYMBOLS: dict[str, dict[str, Any]] = {
    "nonlinear": {"label": "2D, nonlinear", "color": style.COLORS["black"], "marker": "s"},
    "stepped": {"label": "the same, stepped", "color": style.COLORS["green"], "marker": "o"},
}
SIZES = {"nonlinear": 3.2, "stepped": 6.5}

LINE_POINTS = 241

ENDS = (7e-4, 1.5e3)
"""Of the axis."""

LAST_LABEL = 60.0
"""Middle of labels on the right."""

SHADE = "0.9"


def select(rows: Sequence[regimes_table.Row], model: str) -> dict[str, Array]:
    """Columns of one model between the limits, by ascending slip speed.

    Raises ValueError, naming the command that makes the table, if there are none.
    """
    chosen = [r for r in rows if r.model == model and 0 < r.slip < np.inf]
    if not chosen:
        raise ValueError(f"no {model} sheet in the table; `{regimes_table.TABLE.command}` makes it")
    names = ("slip", "coefficient", "error", "slip_ratio")
    return {name: np.array([getattr(r, name) for r in chosen]) for name in names}


def limits(rows: Sequence[regimes_table.Row], model: str) -> dict[str, float]:
    """Coefficients of dry and of viscous friction."""
    ends = {r.slip: r.coefficient for r in rows if r.model == model}
    return {"dry": ends[0.0], "viscous": ends[np.inf]}


def boundaries(rows: Sequence[regimes_table.Row]) -> tuple[float, float]:
    """Slip speeds over alpha L/T up to which the nonlinear sheet is dry, and from which viscous."""
    found = select(rows, "nonlinear")
    at = np.interp(
        np.log([DRY_RATIO, VISCOUS_RATIO]), np.log(found["slip_ratio"]), np.log(found["slip"])
    )
    dry, viscous = np.exp(at).tolist()
    return dry, viscous


def draw(rows: Sequence[regimes_table.Row]) -> Figure:
    """One panel."""
    fig = style.figure(height=7.6)
    axes = fig.subplots()
    _shade(axes, boundaries(rows))
    for model, look in LINES.items():
        _draw_line(axes, select(rows, model), look)
    for model, look in SYMBOLS.items():
        found = select(rows, model)
        axes.errorbar(
            found["slip"], found["coefficient"], found["error"], ls="none", markersize=SIZES[model],
            mfc="none" if model == "stepped" else look["color"], zorder=3, **look,
        )  # fmt: skip
    _mark_paper(axes)
    axes.set_xscale("log")
    axes.set(xlim=ENDS, ylim=(0.2, 2.1))
    axes.set(xlabel=r"slip speed $v_0$  ($\alpha L/T$)", ylabel=r"$V/\alpha^2$  ($L/T$)")
    axes.legend(loc="lower left", bbox_to_anchor=(0, 0.02), labelspacing=0.3)
    return fig


def _shade(axes: Axes, ends: tuple[float, float]) -> None:
    """Dry and viscous friction, and the names of all three."""
    dry, viscous = ends
    axes.axvspan(ENDS[0], dry, color=SHADE, linewidth=0, zorder=0)
    axes.axvspan(viscous, ENDS[1], color=SHADE, linewidth=0, zorder=0)
    middles = np.sqrt([ENDS[0] * dry, dry * viscous, viscous * ENDS[1]])
    for name, middle in zip(("dry", "mixed", "viscous"), middles, strict=True):
        axes.annotate(name, (middle, 2.02), ha="center", fontsize=8)


def _draw_line(axes: Axes, found: dict[str, Array], look: dict[str, Any]) -> None:
    """A curve through the points."""
    slip = np.geomspace(found["slip"][0], found["slip"][-1], LINE_POINTS)
    curve = CubicSpline(np.log(found["slip"]), found["coefficient"])
    axes.plot(slip, curve(np.log(slip)), **look)


def _mark_paper(axes: Axes) -> None:
    """Where v0 = 1, L = 1 stands for each of PERIODS."""
    small, large = PAPER_ALPHAS
    note: dict[str, Any] = {"ha": "center", "fontsize": 7, "textcoords": "offset points"}
    for height, (label, period) in zip((1.62, 1.3), PERIODS.items(), strict=True):
        ends = period / large, period / small
        axes.plot(ends, (height, height), color=style.COLORS["purple"], linewidth=3)
        place = min(np.sqrt(ends[0] * ends[1]), LAST_LABEL)
        axes.annotate(label, (place, height), (0, 4), **note)
    words = "paper, $v_0=1$, $L=1$,\n" rf"$\alpha={large:g}$ to ${small:g}$:"
    axes.annotate(words, (LAST_LABEL, 1.78), (0, 0), **note)


def numbers_shown(rows: Sequence[regimes_table.Row]) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    dry, viscous = boundaries(rows)
    return {
        "alpha": regimes_table.ALPHA,
        "regimes": {
            "slip_ratio": {"dry_up_to": DRY_RATIO, "viscous_from": VISCOUS_RATIO},
            "slip_speed_over_alpha": {"dry_up_to": dry, "viscous_from": viscous},
        },
        "speed_over_alpha_squared": {model: limits(rows, model) for model in (*LINES, "nonlinear")},
        "paper_slip_speed_over_alpha": {
            f"T = {period:g} L/v0": [period / alpha for alpha in PAPER_ALPHAS[::-1]]
            for period in PERIODS.values()
        },
        "paper_period_over_alpha": {"dry_up_to": dry, "viscous_from": viscous},
    }


def write(rows: Sequence[regimes_table.Row], out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure and numbers (JSON) in the folder `out`; returns their paths. Its data are the table."""
    return [
        *style.save(draw(rows), "regimes", out, tuple(formats)),
        output.write_json(style.output_path("regimes.json", out), numbers_shown(rows)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("regimes", __doc__, arguments)
    for path in write(regimes_table.TABLE.read(), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

"""Figure on friction with a direction: is a wave or a breath the faster way to crawl?

    python -m figures.draw.directional [--out FOLDER] [--formats png pdf]

Left: V/alpha against r = (mu_b - mu_f)/(mu_b + mu_f) at alpha = 0.1, from the table of
`figures.measure.directional`; lines are theory, symbols the nonlinear sheet, whose estimated errors are
smaller. Right: the r at which both are equally fast, for a body on a line that grows by alpha with n
waves on it, by theta - alpha cos theta = (pi/2) r, V = (alpha/nT) sin theta for the wave and by
2 r alpha/T for the breath (stretch 1 + alpha c).
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.optimize import brentq

from figures.common import output, style
from figures.measure import directional as table

Array = NDArray[np.float64]

COLORS = {"wave": style.COLORS["blue"], "breathing": style.COLORS["vermillion"]}
LINES: dict[str, dict[str, Any]] = {
    "line": {"linestyle": "-", "words": "on a line"},
    "theory": {"linestyle": "--", "words": "2:1 sheet, small strain"},
}
SYMBOL: dict[str, Any] = {"marker": "s", "ls": "none", "markersize": 3.4}

COUNTS = (1, 2, 4)
"""Waves on the body, right."""

ALPHAS = np.linspace(0.01, 0.4, 40)


def select(rows: Sequence[table.Row], model: str, wave: str) -> tuple[Array, Array]:
    """r and V/alpha. Raises ValueError, naming the command that makes the table, if there are none."""
    chosen = [(row.r, row.coefficient) for row in rows if (row.model, row.wave) == (model, wave)]
    if not chosen:
        raise ValueError(f"no {model} {wave} in the table; `{table.TABLE.command}` makes it")
    r, speed = np.array(chosen).T
    return r, speed


def wave_speed(alpha: float, r: float, count: int = 1) -> float:
    """T V/L of a sine wave on a line, stretch 1 + alpha c."""
    theta = brentq(lambda a: a - alpha * math.cos(a) - math.pi / 2 * r, -2, 2)
    return alpha * math.sin(theta) / count


def equal_at(alpha: float, count: int) -> float:
    """The r at which wave and breath are equally fast."""
    return float(brentq(lambda r: wave_speed(alpha, r, count) - 2 * r * alpha, 0.0, 1.0))


def draw(rows: Sequence[table.Row]) -> Figure:
    """Two panels."""
    fig = style.figure(width=style.DOUBLE_CM, height=7.2)
    left, right = fig.subplots(1, 2)
    _draw_speeds(left, rows)
    _draw_borders(right)
    return fig


def _draw_speeds(axes: Axes, rows: Sequence[table.Row]) -> None:
    for wave, color in COLORS.items():
        for model, look in LINES.items():
            label = f"{wave}, {look['words']}"
            axes.plot(*select(rows, model, wave), color=color, linestyle=look["linestyle"], label=label)
        label = f"{wave}, nonlinear sheet"
        axes.plot(*select(rows, "nonlinear", wave), color=color, label=label, **SYMBOL)
    axes.set(xlim=(0, 1), ylim=(0, 2.1))
    axes.set(xlabel=r"$r=(\mu_b-\mu_f)/(\mu_b+\mu_f)$", ylabel=r"$V/\alpha$  ($L/T$)")
    axes.legend(loc="upper left", labelspacing=0.25)


def _draw_borders(axes: Axes) -> None:
    for count in COUNTS:
        border = [equal_at(alpha, count) for alpha in ALPHAS]
        axes.plot(ALPHAS, border, color=style.COLORS["black"])
        name = "1 wave" if count == 1 else f"{count} waves"
        axes.annotate(name, (ALPHAS[-1], border[-1]), (3, 0), textcoords="offset points", va="center")
    note: dict[str, Any] = {"ha": "center", "fontsize": 8}
    above, below = "above a line breathing is faster", "below it the wave is faster"
    axes.annotate(above, (0.2, 0.45), color=COLORS["breathing"], **note)
    axes.annotate(below, (0.26, 0.19), color=COLORS["wave"], **note)
    axes.set(xlim=(0, 0.5), ylim=(0, 0.5))
    axes.set(xlabel=r"growth $\alpha$", ylabel="$r$ at which both are equally fast")


def numbers_shown(rows: Sequence[table.Row]) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    return {
        "alpha": table.ALPHA,
        "equal_at": {str(n): equal_at(table.ALPHA, n) for n in COUNTS},
        "speed_over_alpha": {
            f"{model}, {wave}": {f"{r:g}": v for r, v in zip(*select(rows, model, wave), strict=True)}
            for model in ("line", "theory", "nonlinear")
            for wave in COLORS
        },
    }


def write(rows: Sequence[table.Row], out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure and numbers (JSON) in the folder `out`; returns their paths. Its data are the table."""
    return [
        *style.save(draw(rows), "directional", out, tuple(formats)),
        output.write_json(style.output_path("directional.json", out), numbers_shown(rows)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("directional", __doc__, arguments)
    for path in write(table.TABLE.read(), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

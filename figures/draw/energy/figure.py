"""Figure on energy: what a wave and a breath cost, with bristles and without.

    python -m figures.draw.energy [--out FOLDER] [--formats png pdf]

From the table of `figures.measure.energy.gaits`; lines are the body on a line, symbols the nonlinear
2:1 sheet, whose estimated errors are smaller. Left: cost of transport over mu against r = (mu_b -
mu_f)/(mu_b + mu_f), with that of the sheet that is dragged forward, 1 - r. Middle: efficiency, the
quotient of both. Right: cost of transport against alpha.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from numpy.typing import NDArray

from figures.common import output, style
from figures.measure.energy import gaits as table

Array = NDArray[np.float64]

COLORS = {"wave": style.COLORS["blue"], "breathing": style.COLORS["vermillion"]}
SYMBOLS: dict[str, dict[str, Any]] = {
    wave: {"marker": marker, "ls": "none", "markersize": 3.8, "clip_on": False, "zorder": 3}
    for wave, marker in {"wave": "o", "breathing": "s"}.items()
}
DRAGGED: dict[str, Any] = {"color": style.COLORS["black"], "linestyle": ":"}

TICKS = (0.01, 0.03, 0.1, 0.3)
"""Of alpha."""


def select(
    rows: Sequence[table.Row], model: str, wave: str, name: str, r: float | None = None
) -> tuple[Array, Array]:
    """r and values of that name at ALPHA; or, with an r, alpha and values at that r.

    Raises ValueError, naming the command that makes the table, if there are none.
    """
    own = [row for row in rows if (row.model, row.wave) == (model, wave)]
    if r is None:
        chosen = [(row.r, getattr(row, name)) for row in own if row.alpha == table.ALPHA]
    else:
        chosen = [(row.alpha, getattr(row, name)) for row in own if row.r == r]
    if not chosen:
        raise ValueError(f"no {model} {wave} in the table; `{table.TABLE.command}` makes it")
    place, value = np.array(sorted(chosen)).T
    return place, value


def draw(rows: Sequence[table.Row]) -> Figure:
    """Three panels."""
    fig = style.figure(width=style.DOUBLE_CM, height=6.4)
    left, middle, right = fig.subplots(1, 3)
    _draw_over_r(left, rows, "cost")
    _draw_over_r(middle, rows, "efficiency")
    _draw_over_alpha(right, rows)
    return fig


def _draw_over_r(axes: Axes, rows: Sequence[table.Row], name: str) -> None:
    for wave, color in COLORS.items():
        axes.plot(*select(rows, "line", wave, name), color=color, label=f"{wave}, on a line")
        label = f"{wave}, 2:1 sheet"
        axes.plot(*select(rows, "nonlinear", wave, name), color=color, label=label, **SYMBOLS[wave])
    axes.set(xlim=(0, 1), xlabel=r"$r=(\mu_b-\mu_f)/(\mu_b+\mu_f)$")
    if name == "efficiency":
        axes.set(ylim=(0, 1.1), ylabel="efficiency")
        axes.axhline(1.0, **DRAGGED)
        return
    r = np.linspace(0, 0.99, 100)
    axes.plot(r, 1 - r, label="dragged", **DRAGGED)
    axes.set(yscale="log", ylim=(0.05, 20), ylabel=r"cost of transport / $\mu$")
    axes.legend(loc="upper right", labelspacing=0.2, fontsize=6.5, handlelength=1.4)


def _draw_over_alpha(axes: Axes, rows: Sequence[table.Row]) -> None:
    for wave, color in COLORS.items():
        for r in table.RS:
            if r or wave == "wave":
                axes.plot(*select(rows, "line", wave, "cost", r), color=color)
                axes.plot(*select(rows, "nonlinear", wave, "cost", r), color=color, **SYMBOLS[wave])
    bristles = max(table.RS)
    axes.annotate("wave, $r=0$", (0.055, 20), color=COLORS["wave"], fontsize=8)
    axes.annotate(f"both, $r={bristles:g}$", (0.011, 1.6), fontsize=8)
    axes.set(xscale="log", yscale="log", xlim=(0.01, 0.4), ylim=(0.5, 100))
    axes.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set(xlabel=r"growth $\alpha$", ylabel=r"cost of transport / $\mu$")


def numbers_shown(rows: Sequence[table.Row]) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    return {
        "alpha": table.ALPHA,
        **{
            f"{name} over r": {
                f"{model}, {wave}": {
                    f"{r:g}": v for r, v in zip(*select(rows, model, wave, name), strict=True)
                }
                for model in table.GRID
                for wave in COLORS
            }
            for name in ("cost", "efficiency")
        },
    }


def write(rows: Sequence[table.Row], out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure and numbers (JSON) in the folder `out`; returns their paths. Its data are the table."""
    return [
        *style.save(draw(rows), "energy", out, tuple(formats)),
        output.write_json(style.output_path("energy.json", out), numbers_shown(rows)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("energy", __doc__, arguments)
    for path in write(table.TABLE.read(), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

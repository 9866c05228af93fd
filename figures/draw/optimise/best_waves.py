"""Figure of the best waves: on dry ground by their harmonics, on viscous ground in a finite body.

    python -m figures.draw.optimise.best_waves [--out FOLDER] [--formats png pdf]

Top: for |c| <= 1 and dry friction the wave of N harmonics with the largest median c - mean c, by a
linear program, and the one that none has. Middle: its speed, from the table of
`figures.measure.optimise.line`, below the bound K/(K + 1), K = floor(N/2). Bottom: for a given mean
square and viscous friction, c on the body through a period: the sine, and the wave that is
faster by 28 % (`linear_theory.line.best.viscous`).
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from fem_check.output.panels import GROWTH_MAP
from figures.common import output, style
from figures.measure.optimise.line import TABLE, Row
from figures.measure.optimise.one_arc import wave_of_one_arc
from linear_theory import SineWave
from linear_theory.line.best.dry import SUPREMUM, dry_bound
from linear_theory.line.best.viscous import best_viscous
from linear_theory.wave.protocol import Wave

SHOWN: dict[int, dict[str, Any]] = {
    2: {"color": style.COLORS["orange"], "linewidth": 1.0},
    5: {"color": style.COLORS["green"], "linewidth": 1.0, "linestyle": (0, (5, 1))},
    10: {"color": style.COLORS["vermillion"], "linewidth": 1.0, "linestyle": (0, (3, 1, 1, 1))},
    20: {"color": style.COLORS["blue"], "linewidth": 1.4},
}
"""Harmonics whose waves are drawn."""

POINTS = 1201

MEAN_SQUARE = 0.5
"""Of the sine."""

MOST = 1.4
"""Of the colours: the best viscous wave has peaks above those of the sine."""


def draw(rows: Sequence[Row]) -> Figure:
    """Four panels."""
    fig = style.figure(height=14.5)
    grid = fig.add_gridspec(3, 2, height_ratios=(1.1, 1, 1.05))
    waves, speeds = (fig.add_subplot(grid[k, :]) for k in (0, 1))
    left, right = (fig.add_subplot(grid[2, k]) for k in (0, 1))
    _draw_waves(waves)
    _draw_speeds(speeds, rows)
    best = best_viscous()
    _draw_course(left, SineWave())
    drawn = _draw_course(right, best.wave(MEAN_SQUARE))
    left.set_ylabel("place $y$  ($L$)")
    right.set_yticklabels([])
    fig.colorbar(
        drawn, ax=[left, right], label="wave $c$", ticks=[-1, 0, 1], location="bottom", aspect=40
    )
    titles = (
        "dry friction, $|c|\\leq1$",
        "its speed",
        "viscous, sine",
        f"best: {best.gain:.2f} times $V$",
    )
    for ax, letter, title in zip((waves, speeds, left, right), "abcd", titles, strict=True):
        ax.set_title(f"({letter}) {title}", loc="left")
    return fig


def _draw_waves(ax: Axes) -> None:
    """Over a wavelength, the half that stands still in the middle."""
    share = np.linspace(-0.5, 0.5, POINTS)
    ax.axvspan(-0.25, 0.25, color="0.93", linewidth=0, zorder=0)
    for harmonics, look in SHOWN.items():
        wave = wave_of_one_arc(harmonics)
        ax.plot(share, wave.profile(2 * np.pi * share), label=f"{harmonics}", **look)
    square = np.where(abs(share) <= 0.25, 1.0, -1.0)
    ax.plot(share, square, color="black", linestyle=":", linewidth=1.0, label="limit")
    ax.set(xlim=(-0.5, 0.5), ylim=(-1.1, 1.9), yticks=[-1, 0, 1])
    ax.set(xlabel="place along the wave  (wavelengths)", ylabel="wave $c$")
    words = "best wave of $N$ harmonics, $N=$"
    ax.legend(
        title=words, title_fontsize=7, ncols=5, loc="upper center", columnspacing=1.0, handlelength=1.8
    )
    ax.text(0, -0.95, "stands still", ha="center", fontsize=7, color="0.35")


def _draw_speeds(ax: Axes, rows: Sequence[Row]) -> None:
    """Over the number of harmonics."""
    harmonics = np.array([row.harmonics for row in rows])
    steps = np.arange(2, 51)
    bound = [dry_bound(int(n)) for n in steps]
    ax.axhline(SUPREMUM, color="black", linestyle=":", linewidth=1.0)
    ax.text(2.02, SUPREMUM + 0.015, "supremum, no wave has it", fontsize=7)
    ax.step(steps, bound, where="post", color="0.5", label="bound $K/(K+1)$")
    ax.plot(
        harmonics, [row.reached for row in rows], "s", color=style.COLORS["black"], mfc="none",
        markersize=6, label="linear program",
    )  # fmt: skip
    ax.plot(
        harmonics, [row.best for row in rows], "o", color=style.COLORS["vermillion"], markersize=3,
        label="optimiser",
    )  # fmt: skip
    ax.set_xscale("log")
    ticks = harmonics.tolist()
    ax.set_xticks(ticks, labels=[str(n) for n in ticks], minor=False)
    ax.set_xticks([], minor=True)
    ax.set(xlim=(1.85, 50), ylim=(0.38, 1.1))
    ax.set(xlabel="harmonics $N$", ylabel=r"$V$  ($\alpha L/nT$)")
    ax.legend(loc="lower right")


def _draw_course(ax: Axes, wave: Wave) -> Any:
    """c on the body through a period."""
    y, t = np.linspace(-0.5, 0.5, 181), np.linspace(0, 1, 181)
    c = wave.value(0.0, y[:, None], t[None, :])
    drawn = ax.pcolormesh(t, y, c, cmap=GROWTH_MAP, vmin=-MOST, vmax=MOST, rasterized=True)
    ax.contour(t, y, c, levels=[0.0], colors="black", linewidths=0.7)
    ax.set(xlabel="time $t$  ($T$)", xticks=[0, 0.5, 1], yticks=[-0.5, 0, 0.5])
    return drawn


def numbers_shown(rows: Sequence[Row]) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    best = best_viscous()
    return {
        "dry": {
            str(row.harmonics): {
                "bound": row.bound,
                "linear_program": row.reached,
                "optimiser": row.best,
            }
            for row in rows
        },
        "viscous": {
            "gain": best.gain,
            "wavelength": 2 * np.pi / best.theta,
            "breathing": best.breathing,
        },
    }


def write(rows: Sequence[Row], out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure and numbers (JSON) in the folder `out`; returns their paths."""
    return [
        *style.save(draw(rows), "best_waves", out, tuple(formats)),
        output.write_json(style.output_path("best_waves.json", out), numbers_shown(rows)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the figure from its table."""
    options = style.options("optimise.best_waves", __doc__, arguments)
    for path in write(TABLE.read(), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

"""Figure 7: amplitudes of the first twenty modes of the Airy series, and the law of their tails.

    python -m figures.draw.fig7 [--out FOLDER] [--rtol 1e-8] [--formats png pdf]

Families A and C answer the unit growth cos(2 pi y/L), even in y; B and D answer sin(2 pi y/L). The
travelling sine is the one or the other at two of its phases. Drawn are the paper's plain truncation,
its equations as printed, and the converged amplitudes, whose tails are summed.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from figures.common import output, style
from figures.common.records import write_csv
from linear_theory import AirySeries, Sheet, SineWave, airy_series

Array = NDArray[np.float64]

MODES = 20
"""Modes of each family that are drawn, and kept by the plain truncation, as in the paper."""

RTOL = 1e-8
"""Relative error of the converged displacement; the amplitudes drawn then have none that shows."""

EVEN_PHASE, ODD_PHASE = 0.75, 0.0
"""Times in periods at which sin(2 pi y/L - 2 pi t/T) is cos(2 pi y/L) and sin(2 pi y/L)."""


@dataclass(frozen=True)
class Family:
    """One of the four families: its numbers index = 1, 1 + step, ... and the law of its tail.

    The law is factor (-1)^k constant/number for the k-th number, k = 0, 1, ...; `law` is its formula.
    """

    name: str
    index: str
    load: str
    step: int
    factor: float
    constant: str
    law: str

    def numbers(self, count: int) -> Array:
        """The first numbers m, r or s, (count,)."""
        return np.arange(1.0, self.step * count + 1, self.step)

    def unit_tail(self, count: int) -> Array:
        """The law of the tail for the constant 1, (count,)."""
        return np.asarray(self.factor * (-1.0) ** np.arange(count) / self.numbers(count))

    def amplitudes(self, field: AirySeries) -> Array:
        """All amplitudes of the family under its unit load, per unit alpha, (modes,)."""
        phase = EVEN_PHASE if self.load == "even" else ODD_PHASE
        return np.asarray(getattr(field.amplitudes(phase * field.wave.period), self.name))


FAMILIES = (
    Family("A", "m", "even", 1, -1.0, "K", r"(-1)^m\,K/m"),
    Family("C", "r", "even", 1, 1.0, "K", r"-(-1)^r\,K/r"),
    Family("B", "m", "odd", 1, -1.0, "K'", r"(-1)^m\,K'/m"),
    Family("D", "s", "odd", 2, -2.0, "K'", r"-2\,(-1)^{(s-1)/2}\,K'/s"),
)


@dataclass(frozen=True)
class Amplitudes:
    """Of the first modes of one family, (modes,), per unit alpha and load; tail: the law."""

    family: Family
    numbers: Array
    converged: Array
    plain: Array
    printed: Array
    tail: Array


@dataclass(frozen=True)
class Fig7Data:
    """What the figure shows.

    constants: K and K' of the tails; converged_modes: kept (across, along) by the converged series;
    errors: estimated relative L2 errors of the displacement, converged and plain.
    """

    amplitudes: tuple[Amplitudes, ...]
    constants: dict[str, float]
    converged_modes: tuple[int, int]
    errors: dict[str, float]


def compute(rtol: float = RTOL) -> Fig7Data:
    """Amplitudes for the paper's sheet and wave; rtol: of the converged displacement."""
    sheet, wave = Sheet(), SineWave()
    converged = airy_series(sheet, wave, rtol=rtol)
    if min(converged.modes) < MODES:
        converged = airy_series(sheet, wave, modes=MODES)
    plain = airy_series(sheet, wave, modes=MODES, tail=False)
    printed = airy_series(sheet, wave, modes=MODES, form="printed")
    constants = tail_constants(converged)
    amplitudes = []
    for family in FAMILIES:
        found = {
            name: family.amplitudes(field)[:MODES]
            for name, field in (("converged", converged), ("plain", plain), ("printed", printed))
        }
        tail = constants[family.constant] * family.unit_tail(MODES)
        amplitudes.append(Amplitudes(family, family.numbers(MODES), tail=tail, **found))
    errors = {"converged": converged.error, "plain": plain.error}
    return Fig7Data(tuple(amplitudes), constants, converged.modes, errors)


def tail_constants(field: AirySeries) -> dict[str, float]:
    """K and K' for the unit even and the unit odd load."""
    quarter = field.wave.period / 4  # c = sin(2 pi y/L) at t = 0 and -cos(2 pi y/L) a quarter later
    even, odd = float(field.tail_constants(quarter)[0]), float(field.tail_constants(0.0)[1])
    return {"K": -even, "K'": odd}


LOOKS: dict[str, dict[str, Any]] = {
    "converged": {"color": style.COLORS["black"], "marker": "o", "markersize": 2.2, "zorder": 4},
    "plain": {"color": style.COLORS["sky"], "marker": "o", "markersize": 5.5, "zorder": 2},
    "printed": {"color": style.COLORS["vermillion"], "marker": "D", "markersize": 3.2, "zorder": 3},
}

TICKS = {1: (1, 2, 3, 5, 10, 15, 20), 2: (1, 3, 5, 9, 19, 39)}
"""Labelled mode numbers where all numbers occur, and where only odd ones do."""

LAW_LOOK: dict[str, Any] = {"color": "0.45", "linewidth": 0.8, "zorder": 1}


def draw(data: Fig7Data) -> Figure:
    """Four panels: absolute amplitude against mode number; a sign that is not the law's is named."""
    fig = style.figure(width=style.DOUBLE_CM, height=11.5)
    panels = fig.subplots(2, 2, sharey=True)
    for letter, axes, amplitudes in zip("abcd", panels.flat, data.amplitudes, strict=True):
        _draw_family(axes, amplitudes)
        _mark_sign(axes, amplitudes)
        _describe(axes, letter, amplitudes.family, data.constants)
    for axes in panels[:, 0]:
        axes.set_ylabel("absolute amplitude")
    fig.legend(handles=_handles(), loc="outside upper center", ncols=4, columnspacing=2.0)
    return fig


def _draw_family(axes: Axes, amplitudes: Amplitudes) -> None:
    numbers = amplitudes.numbers
    axes.loglog(numbers, abs(amplitudes.tail), **LAW_LOOK)
    for name, look in LOOKS.items():
        axes.loglog(numbers, abs(getattr(amplitudes, name)), ls="none", **look)
    axes.set_xticks([n for n in TICKS[amplitudes.family.step] if n <= numbers[-1]])
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_xticks(numbers, minor=True)
    axes.xaxis.set_minor_formatter("")


def _mark_sign(axes: Axes, amplitudes: Amplitudes) -> None:
    """Say where a converged amplitude has the sign that the law of the tail does not."""
    values, tail = amplitudes.converged, amplitudes.tail
    for i in np.flatnonzero(values * tail < 0):
        place = amplitudes.numbers[i], abs(values[i])
        arrow = {"arrowstyle": "-", "linewidth": 0.5, "shrinkB": 4}
        axes.annotate(
            "sign opposite\nto the law", place, (2, -34), fontsize=7,
            textcoords="offset points", arrowprops=arrow,
        )  # fmt: skip


def _describe(axes: Axes, letter: str, family: Family, constants: dict[str, float]) -> None:
    wave = {"even": r"\cos", "odd": r"\sin"}[family.load]
    name = f"${family.name}_{family.index}$"
    axes.set_title(rf"({letter})  {name}, {family.load} load ${wave}(2\pi y/L)$", loc="left")
    axes.set_xlabel(f"mode number ${family.index}$")
    law = f"${family.law}$,  ${family.constant} = {constants[family.constant]:.4f}$"
    axes.annotate(f"law: {law}", (0.03, 0.06), xycoords="axes fraction", fontsize=7)


def _handles() -> list[Line2D]:
    """Legend entries in the order of trust."""
    labels = {
        "converged": "converged, tails summed",
        "plain": f"plain truncation, {MODES} modes",
        "printed": f"printed equations, {MODES} modes",
    }
    points = [Line2D([], [], ls="none", label=labels[name], **look) for name, look in LOOKS.items()]
    return [*points, Line2D([], [], label="law of the tail", **LAW_LOOK)]


def numbers_shown(data: Fig7Data) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    families: dict[str, object] = {}
    for a in data.amplitudes:
        families[a.family.name] = {
            "numbers": a.numbers.astype(int),
            "converged": a.converged,
            "plain": a.plain,
            "printed": a.printed,
            "tail_law": a.tail,
            "last_over_tail_law": {name: float(getattr(a, name)[-1] / a.tail[-1]) for name in LOOKS},
        }
    return {
        "families": families,
        "tail_constants": data.constants,
        "converged_modes": data.converged_modes,
        "displacement_error": data.errors,
    }


def write(data: Fig7Data, out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure, data (CSV) and numbers (JSON) in the folder `out`; returns their paths."""
    columns: dict[str, list[Any]] = {"family": [], "number": [], **{name: [] for name in LOOKS}}
    columns["tail_law"] = []
    for a in data.amplitudes:
        columns["family"] += [a.family.name] * a.numbers.size
        columns["number"] += a.numbers.astype(int).tolist()
        columns["tail_law"] += a.tail.tolist()
        for name in LOOKS:
            columns[name] += getattr(a, name).tolist()
    return [
        *style.save(draw(data), "fig7", out, tuple(formats)),
        write_csv(style.output_path("fig7.csv", out), columns),
        output.write_json(style.output_path("fig7.json", out), numbers_shown(data)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute, draw and write figure 7."""
    options = style.options("fig7", __doc__, arguments, rtol=(RTOL, "error of the displacement"))
    for path in write(compute(options.rtol), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()

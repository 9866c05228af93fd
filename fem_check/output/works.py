"""The balance of power of a simulation: where the work of growth goes."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.look import COLORS

Array = NDArray[np.float64]

LOOKS = {
    "growth": ("work of growth", "black", "-"),
    "friction": ("friction", COLORS["vermillion"], "-"),
    "damping": ("damping", COLORS["orange"], "-"),
    "elastic": ("elastic", COLORS["blue"], "-"),
    "weight": ("weight", COLORS["green"], "--"),
    "ground": ("ground", COLORS["purple"], "--"),
    "kinetic": ("kinetic", COLORS["sky"], "-."),
    "residual": ("residual", "0.6", ":"),
}
"""Names, colours and line styles: work done, dissipation, stored energy, and the rest."""

NONE = 1e-9
"""Share of the largest energy below which one is not drawn: it is 0 up to roundoff."""


ROUNDOFF = 1e-9
"""Of times, relative to the length of the run."""

LEGEND = 0.45
"""Room for the legend above the curves, as a share of their range."""


class Energies(NamedTuple):
    """Energies of a run by name (see `fem_check.shell.stepping.power.Works`), each (n,), from 0 at the
    first of the times (n,); with the residual."""

    times: Array
    works: Mapping[str, Array]


def since(times: Array, works: Mapping[str, Array], start: float) -> Energies:
    """Energies from a time on, each (n,), counted from 0 there."""
    counted = times >= start - ROUNDOFF * (times[-1] - start)
    return Energies(times[counted], {k: v[counted] - v[counted][0] for k, v in works.items()})


def draw_power(ax: Axes, energies: Energies, units: Units) -> None:
    """Work of growth, and what of it is stored and dissipated, since the end of the ramp.

    In units of the scene's stress E (Young's modulus where that is 1) times length cubed.
    """
    times, works = energies.times * units.time_factor, energies.works
    most = max(float(np.abs(values).max()) for values in works.values())
    factor = units.length_factor**3
    power = int(np.floor(np.log10(most * factor))) if most else 0

    for name, (words, color, style) in LOOKS.items():
        values = works[name]
        if name != "residual" and np.abs(values).max() <= NONE * most:
            continue
        ax.plot(times, values * factor / 10.0**power, color=color, linestyle=style, label=words)
    ax.set(xlabel=f"time $t$ ({units.time})")
    ax.set_ylabel(rf"work ($10^{{{power}}}\,E\,${units.length}$^3$)")
    ax.set_xlim(times[0], times[-1])
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + LEGEND * (high - low))
    ax.set_title("work of growth = stored + dissipated + residual", loc="left")
    ax.legend(loc="upper left", ncols=3, columnspacing=1.0, handlelength=1.5)

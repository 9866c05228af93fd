"""Curves of a picture: V(t), and the path of the sheet."""

import numpy as np
from matplotlib.axes import Axes

from fem_check.answer.units import Units
from fem_check.output.look import COLORS
from fem_check.output.moving import Moving
from fem_check.output.panels import label_ground, on_page, outline

DOTS = 20
"""Approximate largest number of dots on a path."""

MEAN, BAND = COLORS["vermillion"], "#F2B48F"


def draw_speed(ax: Axes, moving: Moving, units: Units) -> None:
    """V(t) with its mean, and the numerical plus model error of the mean as a band."""
    course, speed = moving.course(), moving.speed
    times, velocity = course.times * units.time_factor, course.velocity * units.speed_factor
    ax.plot(times, velocity, color=COLORS["blue"], label="$V(t)$")
    error = speed.error + (0.0 if np.isnan(speed.model_error) else speed.model_error)
    mean, error = (v * units.speed_factor for v in (speed.mean, error))
    counted = [t * units.time_factor for t in course.counted]
    known = np.isfinite(error)
    if known:
        ax.fill_between(counted, mean - error, mean + error, color=BAND, linewidth=0, label="error")
    ax.plot(counted, [mean, mean], color=MEAN, label="mean")
    ax.axhline(0, color="0.6", linewidth=0.5, zorder=0)
    told = "band: error" if known else "error unknown"
    ax.set_title(f"mean {in_words(mean, error)} {units.speed}, {told}", loc="left")
    ax.set(xlabel=f"time $t$ ({units.time})", ylabel=f"$V(t)$ ({units.speed})")
    ax.set_xlim(*(t * units.time_factor for t in course.shown))


def in_words(mean: float, error: float) -> str:
    """Mean and error to the digits resolved by the error, five at most; an infinite one is left out.

    >>> from fem_check.output.curves import in_words
    >>> print(in_words(-0.19177, 5.2e-4), "|", in_words(0.071, 0.0113), "|", in_words(0.0779601, 5e-16))
    −0.19177 ± 0.00052 | 0.071 ± 0.011 | 0.07796 ± 5e−16
    """
    if np.isinf(error):
        return f"{mean:.3g}".replace("-", "\N{MINUS SIGN}")
    digits = 99
    if np.isfinite(error) and error > 0:
        digits = 1 - int(np.floor(np.log10(error)))
    if digits > 6 or digits < 0:
        words = f"{mean:.5g} ± {error:.1g}" if error else f"{mean:.5g}"
    else:
        words = f"{mean:.{digits}f} ± {error:.{digits}f}"
    return words.replace("-", "\N{MINUS SIGN}")


def draw_path(ax: Axes, moving: Moving, units: Units, periods: int) -> None:
    """The path of the centre, with dots at the ends of periods and the outline at both ends."""
    _, way = moving.way(periods, 16)
    factor = units.length_factor
    if moving.has_shape:
        points, triangles = moving.covering()
        frames = moving.frames(points, periods, 1)
        for index, grey in ((0, "0.75"), (len(frames) - 1, "0.3")):
            ax.add_collection(outline(frames[index].place * factor, triangles, color=grey))
        centres = np.array([frame.centre for frame in frames]).T
    else:
        centres = way[:, ::16]
    every = -(-periods // DOTS)
    ax.plot(*on_page(way * factor), color=MEAN)
    ax.plot(*on_page(centres[:, ::every] * factor), "o", color=MEAN, markersize=2)
    label_ground(ax, units)
    ax.set_aspect("equal", adjustable="datalim")
    ax.autoscale_view()
    ax.margins(0.06)
    if not ax.yaxis_inverted():
        ax.invert_yaxis()
    dots = "" if every == 1 else f", a dot every {every}"
    ax.set_title(f"path of {periods} period{'s' * (periods != 1)}{dots}", loc="left")

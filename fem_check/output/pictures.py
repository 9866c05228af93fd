"""`.plot()`: one panel in given axes, or a figure of all."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.choice.prediction import Prediction
from fem_check.output.crawling import Crawling
from fem_check.output.look import CM_PER_INCH, COLUMN_CM, styled
from fem_check.output.moving import Moving
from fem_check.output.panels import draw_path, draw_sheet, draw_side, draw_speed
from fem_check.output.simulated import Simulated
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.speed.result import CrawlSpeed

PANELS = ("speed", "sheet", "side", "path")

HEIGHTS = {"speed": 3.8, "sheet": 4.0, "side": 2.9, "path": 3.6}
"""Heights of the panels in centimetres, including labels."""

PERIODS, MOST_PERIODS = 10, 10_000
"""Default and largest number of periods of a path."""


def plot(
    result: Any,
    what: str | None = None,
    *,
    ax: Axes | None = None,
    phase: float = 0.0,
    periods: int | None = None,
    units: Units | None = None,
) -> Axes | NDArray[Any]:
    """See `linear_theory.common.drawable.Drawable.plot`.

    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.2, rtol=1e-2)
    >>> axes = speed.plot()  # axes[0].figure.savefig("speed.png") writes it
    >>> print([a.get_xlabel() for a in axes])
    ['time $t$ (T)', '$y$ (L)', '$y$ (L)']
    """
    moving = moving_of(result)
    phase = validation.real("phase", phase)
    periods, units = checked_periods(moving, periods, PERIODS), checked_units(moving, units)
    if what is not None:
        _check_panel(moving, validation.choice("what", what, PANELS))
        if ax is None:
            ax = _new_axes((what,))[0]
        validation.instance("ax", ax, Axes, "as from matplotlib's subplots()")
        _draw(ax, what, moving, units, phase, periods)
        return ax
    if ax is not None:
        raise ValueError(f"what = None: must be one of {', '.join(panels(moving))} if ax is given")
    with styled():
        axes = _new_axes(panels(moving))
        for panel, name in zip(axes, panels(moving), strict=True):
            _draw(panel, name, moving, units, phase, periods)
    return axes


def moving_of(result: Any) -> Moving:
    """The drawing interface of a result. Raises ValueError for a result without motion."""
    if isinstance(result, Prediction):
        result = result.speed
    if isinstance(result, CrawlSpeed):
        return Crawling(result)
    if isinstance(result, Moving):  # a recorded motion
        return result
    hint = "use crawl_speed, field_speed, cycle_speed, predict or simulate"
    return Simulated(validation.instance("result", result, Trajectory, hint))


def panels(moving: Moving) -> tuple[str, ...]:
    """Names of the panels for which there are data."""
    shown = {"speed": True, "sheet": moving.has_shape, "side": moving.components == 3, "path": True}
    return tuple(name for name in PANELS if shown[name])


def checked_units(moving: Moving, units: Units | None) -> Units:
    """The given units, by default those of the sheet."""
    if units is None:
        return Units.of_sheet(moving.length, moving.period)
    return validation.instance("units", units, Units, 'as Units("mm", "s", 40.0, 8.0)')


def checked_periods(moving: Moving, periods: int | None, usual: int) -> int:
    """A number of periods that can be shown, by default `usual` or all available."""
    most = MOST_PERIODS if moving.most_periods is None else moving.most_periods
    if periods is None:
        return most if moving.most_periods is not None else usual
    if not 1 <= validation.integer("periods", periods, 1) <= most:
        raise ValueError(f"periods = {periods}: must be in [1, {most}]")
    return periods


def _check_panel(moving: Moving, what: str) -> None:
    if what in panels(moving):
        return
    why = {
        "sheet": "a speed of a body on a line, or a copied or unpickled one, has no shape to draw",
        "side": "the sheet lies in the plane",
    }
    raise ValueError(f"what = {what!r}: {why[what]}; must be one of {', '.join(panels(moving))}")


def _new_axes(names: tuple[str, ...]) -> NDArray[Any]:
    """Axes (panels,) of a new figure, one above the other."""
    # pyplot, so that show() and notebooks find the figure; imported here, since it selects a backend
    import matplotlib.pyplot as plt

    heights = [HEIGHTS[name] for name in names]
    with styled():
        size = 1.4 * COLUMN_CM / CM_PER_INCH, 1.4 * sum(heights) / CM_PER_INCH
        fig, axes = plt.subplots(
            len(names), figsize=size, height_ratios=heights, squeeze=False, dpi=150
        )
    fig.set_layout_engine("constrained")
    return np.asarray(axes[:, 0])


def _draw(ax: Axes, what: str, moving: Moving, units: Units, phase: float, periods: int) -> None:
    if what == "speed":
        draw_speed(ax, moving, units)
    elif what == "sheet":
        draw_sheet(ax, moving, units, phase)
    elif what == "side":
        draw_side(ax, moving, units, phase)
    else:
        draw_path(ax, moving, units, periods)

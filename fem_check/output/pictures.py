"""`.plot()`: one panel in given axes, or a figure of all."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.choice.result import Prediction
from fem_check.output.crawling import Crawling
from fem_check.output.curves import draw_path, draw_speed
from fem_check.output.kymographs import Quantity, draw_kymograph
from fem_check.output.look import CM_PER_INCH, COLUMN_CM, styled
from fem_check.output.moving import Moving
from fem_check.output.panels import draw_friction, draw_pressure, draw_sheet, draw_side
from fem_check.output.simulated import Simulated
from fem_check.output.works import draw_power
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.speed.result import CrawlSpeed

MOST_IN_A_COLUMN = 4
"""Number of panels from which on a figure has two columns."""

MOST_PERIODS = 10_000
"""Largest number of periods of a path."""


class Panel(NamedTuple):
    """A panel. draw(ax, moving, units, phase, periods); height in centimetres, with labels; periods:
    shown by default, of a motion that repeats; missing: why some results lack it."""

    draw: Callable[[Axes, Moving, Units, float, int], None]
    height: float
    has: Callable[[Moving], bool]
    missing: str = ""
    periods: int = 2


def _has_shape(moving: Moving) -> bool:
    return moving.has_shape


def _rubs(moving: Moving) -> bool:
    return moving.has_shape and moving.speed.regime != "none"


def _in_space(moving: Moving) -> bool:
    return moving.components == 3


def _line(quantity: Quantity, has: Callable[[Moving], bool], missing: str) -> Panel:
    """A kymograph."""

    def draw(ax: Axes, moving: Moving, units: Units, phase: float, periods: int) -> None:
        draw_kymograph(ax, moving, units, quantity, periods)

    return Panel(draw, 4.6, has, missing)


def _draw_works(ax: Axes, moving: Moving, units: Units, phase: float, periods: int) -> None:
    assert moving.energies is not None
    draw_power(ax, moving.energies, units)


NO_SHAPE = "a speed of a body on a line, or a copied or unpickled one, has no shape to draw"
FLAT = "the sheet lies in the plane"

PANELS = {
    "speed": Panel(lambda ax, m, u, phase, n: draw_speed(ax, m, u), 3.8, lambda moving: True),
    "sheet": Panel(lambda ax, m, u, phase, n: draw_sheet(ax, m, u, phase), 4.0, _has_shape, NO_SHAPE),
    "friction": Panel(
        lambda ax, m, u, phase, n: draw_friction(ax, m, u, phase),
        4.0,
        _rubs,
        "a scene without friction, a body on a line, and a copied speed have no friction field",
    ),
    "pressure": Panel(
        lambda ax, m, u, phase, n: draw_pressure(ax, m, u, phase),
        4.0,
        lambda moving: moving.presses,
        "the sheet lies in the plane, or nothing is known to press on the ground",
    ),
    "side": Panel(lambda ax, m, u, phase, n: draw_side(ax, m, u, phase), 2.9, _in_space, FLAT),
    "kymograph": _line(Quantity.WAVE, _has_shape, NO_SHAPE),
    "displacement": _line(Quantity.DISPLACEMENT, _has_shape, NO_SHAPE),
    "height": _line(Quantity.HEIGHT, _in_space, FLAT),
    "power": Panel(
        _draw_works,
        4.2,
        lambda moving: moving.energies is not None,
        "only a motion stepped in time (simulate) has a balance of power",
    ),
    "path": Panel(
        lambda ax, m, u, phase, n: draw_path(ax, m, u, n), 3.6, lambda moving: True, periods=10
    ),
}
"""All panels by name, in the order in which they are drawn."""


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
    ['time $t$ (T)', '$y$ (L)', '$y$ (L)', '$y$ (L)', '$y$ (L)', '$y$ (L)']
    """
    moving = moving_of(result)
    phase = validation.real("phase", phase)
    checked_periods(moving, periods, MOST_PERIODS)
    units = checked_units(moving, units)
    if what is None:
        if ax is not None:
            raise ValueError(f"what = None: must be one of {', '.join(panels(moving))} if ax is given")
        return draw_figure(panels(moving), moving, units, phase, periods)
    _check_panel(moving, validation.choice("what", what, tuple(PANELS)))
    if ax is None:
        return draw_figure((what,), moving, units, phase, periods)[0]
    validation.instance("ax", ax, Axes, "as from matplotlib's subplots()")
    _draw(ax, what, moving, units, phase, periods)
    return ax


def draw_figure(
    names: tuple[str, ...], moving: Moving, units: Units, phase: float, periods: int | None
) -> NDArray[Any]:
    """A figure of some panels; its axes, (panels,)."""
    with styled():
        axes = _new_axes(names)
        for panel, name in zip(axes, names, strict=True):
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
    return tuple(name for name, panel in PANELS.items() if panel.has(moving))


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
        recorded = "" if moving.most_periods is None else f": the run recorded {_counted(most)}"
        raise ValueError(f"periods = {periods}: must be in [1, {most}]{recorded}")
    return periods


def _counted(periods: int) -> str:
    return "1 period" if periods == 1 else f"{periods} periods"


def _check_panel(moving: Moving, what: str) -> None:
    if not PANELS[what].has(moving):
        names = ", ".join(panels(moving))
        raise ValueError(f"what = {what!r}: {PANELS[what].missing}; must be one of {names}")


def _new_axes(names: tuple[str, ...]) -> NDArray[Any]:
    """Axes (panels,) of a new figure: one above the other, two side by side if there are many."""
    # pyplot, so that show() and notebooks find the figure; imported here, since it selects a backend
    import matplotlib.pyplot as plt

    columns = 1 if len(names) <= MOST_IN_A_COLUMN else 2
    rows = [names[k : k + columns] for k in range(0, len(names), columns)]
    heights = [max(PANELS[name].height for name in row) for row in rows]
    with styled():
        size = columns * COLUMN_CM / CM_PER_INCH, sum(heights) / CM_PER_INCH
        fig = plt.figure(figsize=size, dpi=150, layout="constrained")
        grid = fig.add_gridspec(len(rows), columns, height_ratios=heights)
        places = [(k // columns, k % columns) for k in range(len(names))]
        return np.array([fig.add_subplot(grid[place]) for place in places])


def _draw(ax: Axes, what: str, moving: Moving, units: Units, phase: float, periods: int | None) -> None:
    panel = PANELS[what]
    panel.draw(ax, moving, units, phase, checked_periods(moving, periods, panel.periods))

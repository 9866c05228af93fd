"""Waves that make a sheet turn, and motions that are made up, for the tests of paths."""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

from linear_theory import CrawlSpeed, FieldWave, Sheet, crawl_speed, rigid_path
from linear_theory.balance.time_grid import TimeGrid
from linear_theory.speed.path import Path
from linear_theory.speed.result import Estimate, RigidSpeed

Array = NDArray[np.float64]
Growth = Callable[[Array, Array, Array], Array]

PAPER, SQUARE = Sheet(), Sheet(width=1.0)
TAU = 2 * np.pi


def oblique(degrees: float) -> Growth:
    """A sine of wavelength L that runs to the right of +y by that angle."""
    x_share, y_share = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    return lambda x, y, t: np.sin(TAU * (x_share * x + y_share * y - t))


def unequal(x: Array, y: Array, t: Array) -> Array:
    """A sine with three times the amplitude at the right edge of the paper's sheet."""
    return (1 + x / PAPER.width) * np.sin(TAU * (y - t))


def unequal_pulse(x: Array, y: Array, t: Array) -> Array:
    """The same of a wave that is not half-period antisymmetric."""
    phase = TAU * (y - t)
    return (1 + x / PAPER.width) * (0.5 * np.cos(phase) + 0.3 * np.cos(2 * phase))


@cache
def theory(
    growth: Growth, sheet: Sheet = PAPER, alpha: float = 0.1, rtol: float = 1e-3, periods: int = 1
) -> Path:
    """Path in linear theory."""
    speed = crawl_speed(sheet, FieldWave(growth, 1.0), alpha, rtol=rtol)
    return rigid_path(speed, periods, samples=1)


def made_up(rigid: Callable[[Array], Array], panels: int = 6, period: float = 1.0) -> CrawlSpeed:
    """A speed with V_x, V_y, Omega (3, T) given as functions of time over the period."""
    times = np.linspace(0, period, 4 * panels + 1)
    values = rigid(times / period)
    means, errors = TimeGrid(times).means(values)
    return CrawlSpeed(
        estimate=Estimate(float(means[1]), float(errors[1])),
        model_error=np.nan,
        converged=True,
        times=times[:-1],
        velocity=values[1, :-1],
        seconds=0.0,
        model="made up",
        slip_ratio=0.0,
        turning=RigidSpeed(values[:, :-1], means, errors),
    )


def constant(t: Array) -> Array:
    return np.stack([0.3 + 0 * t, 0.4 + 0 * t, 1.7 + 0 * t])


def swinging(t: Array) -> Array:
    """To and fro and turning, with harmonics up to the second."""
    return np.stack(
        [
            0.2 + np.sin(TAU * t),
            0.1 + np.cos(TAU * t) + 0.3 * np.sin(2 * TAU * t),
            0.4 + 2 * np.sin(TAU * t + 0.5),
        ]
    )

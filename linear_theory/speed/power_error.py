"""Model error of the power: how far the theories are from the nonlinear sheet.

Small strain and second order are exact to first and second order in x = |alpha c|, and where
c(t + T/2) = -c(t) the power is even in alpha; a narrow strip neglects that wide sheets slide sideways,
too. Relative to the power of the nonlinear sheet the distances r were measured for 40 random sheets,
waves, growths and laws of friction (`python -m figures.measure.power_error 40 5`); the largest were

    first order   1.03 x, or 2.35 x^2 where c(t + T/2) = -c(t),
    second order  2.03 x^2,
    strip         1.11 W n/L.

The bounds are about half as much more, as r/(1 - r) of the power by theory.
"""

import math
from dataclasses import replace

from linear_theory.friction.laws import FRICTION_LAWS
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed

LARGEST_GROWTH, NARROWEST, WIDEST = 0.35, 0.1, 1.0
"""Range of x and of widths over L within which distances were measured."""

FIRST, FIRST_EVEN, SECOND, STRIP, STRIP_MOST = 1.6, 3.5, 3.3, 1.6, 0.8
"""Bounds of the coefficients, see the module docstring, and of the strip's r."""


def power_error(level: str, scene: Scene, power: float) -> float:
    """Bound of |P - P_nonlinear|, in the unit of the power; NaN where it was not measured.

    level: "strip", "first order" or "second order".
    """
    sheet, growth, series = scene.sheet, scene.growth, scene.drive.series
    if growth.alpha == 0 or (series is not None and not series.moves):
        return 0.0
    size = abs(growth.alpha) * float(abs(scene.extremes).max())
    ratio = sheet.width / sheet.length
    known = (
        series is not None
        and growth.law in GROWTH_LAWS.values()
        and type(scene.contact.friction) in FRICTION_LAWS.values()
        and size <= LARGEST_GROWTH
        and (ratio >= NARROWEST or level == "strip")
        and ratio <= WIDEST
        and sheet.poisson >= 0
    )
    if series is None or not known:
        return math.nan
    if level == "strip":
        share = min(STRIP * ratio * abs(series.count), STRIP_MOST)
    elif level == "second order":
        share = SECOND * size**2
    else:
        share = FIRST_EVEN * size**2 if scene.drive.changes_sign else FIRST * size
    return share / (1 - share) * power


def with_power_error(found: CrawlSpeed, level: str, scene: Scene) -> CrawlSpeed:
    """The speed by a theory with the model error of its power."""
    if found.energy is None:
        return found
    distance = power_error(level, scene, found.power.value)
    return replace(found, energy=replace(found.energy, model_error=distance))

"""Speeds against the growth coupling for figure 3: theory, finite elements, and the nonlinear table."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from figures import nonlinear
from linear_theory import field_speed, line_speed
from linear_theory.field import LinearField

Array = NDArray[np.float64]

SMALL_ALPHA = 1e-6
"""V/alpha^2 differs from its limit by alpha^2 relative."""

REGIMES = ("dry", "mixed", "viscous")
"""Of panel C, keys of `nonlinear.SLIPS`."""


@dataclass(frozen=True)
class Series:
    """Mean speeds against alpha, each (n,), in L/T; error: estimated numerical error of speed.

    kind: "theory", "law" (leading power of alpha), "printed" or "simulation"; dimension: 1 or 2;
    friction: a key of `nonlinear.SLIPS`, all but "coulomb" in panel C.
    """

    label: str
    kind: str
    dimension: int
    alpha: Array
    speed: Array
    error: Array
    friction: str = "coulomb"


def sheet_speeds(
    label: str,
    kind: str,
    field: LinearField,
    alphas: Array,
    rtol: float,
    advance: Callable[[], None],
    friction: str = "coulomb",
) -> Series:
    """Speeds of the sheet by the balance of friction under the 'current' load."""
    speeds = []
    for alpha in alphas.tolist():
        speeds.append(mean_speed(field, alpha, friction, rtol))
        advance()
    mean, error = np.array(speeds).T
    return Series(label, kind, 2, alphas, mean, error, friction)


def mean_speed(field: LinearField, alpha: float, friction: str, rtol: float) -> tuple[float, float]:
    """One speed and its error; the slip speed is in proportion to alpha, as in the table."""
    slip = nonlinear.SLIPS[friction] * alpha
    law, slip_speed = ("tanh", slip) if slip else ("coulomb", None)
    found = field_speed(field, alpha, "current", law, slip_speed, rtol)
    return found.mean, found.error


def leading_coefficients(field: LinearField, rtol: float) -> dict[int, tuple[float, float]]:
    """V/alpha^2 as alpha -> 0, and its error, by dimension; under dry friction."""
    line = float(line_speed(SMALL_ALPHA)) / SMALL_ALPHA**2
    mean, error = mean_speed(field, SMALL_ALPHA, "coulomb", rtol)
    return {1: (line, SMALL_ALPHA**2), 2: (mean / SMALL_ALPHA**2, error / SMALL_ALPHA**2)}


def line_speeds(alphas: Array) -> list[Series]:
    """The closed form in 1D, right to 2 ulp, and the printed one."""
    found = []
    for form, label, kind in (
        ("corrected", "1D, theory", "theory"),
        ("printed", "1D, printed", "printed"),
    ):
        speed = line_speed(alphas, form=form)
        found.append(Series(label, kind, 1, alphas, speed, 2 * np.spacing(abs(speed))))
    return found


def law_speeds(dimension: int, coefficient: float, alphas: Array) -> Series:
    """The leading term, proportional to alpha^2; drawn as it is, it has no error."""
    label = f"{dimension}D, α² law"
    return Series(label, "law", dimension, alphas, coefficient * alphas**2, np.zeros_like(alphas))


def nonlinear_speeds(table: Sequence[nonlinear.Speed]) -> list[Series]:
    """Sheet and bar at finite strain under dry friction, for panel B."""
    sheet = table_speeds(table, "2D, nonlinear sheet", "sheet", "coulomb")
    return [sheet, table_speeds(table, "1D, finite strain", "bar", "coulomb")]


def slip_speeds(
    table: Sequence[nonlinear.Speed],
    field: LinearField,
    alphas: Array,
    rtol: float,
    advance: Callable[[], None],
) -> list[Series]:
    """Linear theory and the nonlinear sheet by turns, under the friction of each of REGIMES."""
    found = []
    for name in REGIMES:
        found.append(sheet_speeds(f"{name}, theory", "theory", field, alphas, rtol, advance, name))
        found.append(table_speeds(table, f"{name}, nonlinear sheet", "sheet", name))
    return found


def table_speeds(table: Sequence[nonlinear.Speed], label: str, body: str, friction: str) -> Series:
    """What the table holds of one body. Raises ValueError, naming the command, if that is nothing."""
    alpha, speed, error = nonlinear.select(table, body, friction)
    if not alpha.size:
        raise ValueError(f"no {friction} {body} in the table of speeds; `{nonlinear.COMMAND}` makes it")
    return Series(label, "simulation", 1 if body == "bar" else 2, alpha, speed, error, friction)

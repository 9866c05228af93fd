"""Speeds against the growth coupling for figure 3: theories, finite elements, and the nonlinear
table."""

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from figures.common.scenes import friction_law
from figures.measure import nonlinear
from linear_theory import Sheet, SineWave, field_speed, line_speed, second_order
from linear_theory.common.errors import BeyondReachWarning, ViscousRegimeWarning
from linear_theory.deformation.field import LinearField

Array = NDArray[np.float64]

SMALL_ALPHA = 1e-6
"""V/alpha^2 differs from its limit by alpha^2 relative."""

REGIMES = ("dry", "mixed", "viscous")
"""Of panel D, keys of `nonlinear.SLIPS`."""

LABELS = {
    "first": "1st order, linear strains",
    "elements": "1st order, linear FEM",
    "second": "2nd order, exp growth",
    "sheet": "nonlinear sheet, exp growth",
    "line": "1D, linear growth",
    "bar": "1D, exp growth",
    "printed": "1D as printed, eq. 8",
}
"""Of panels B and C: what each model assumes."""


@dataclass(frozen=True)
class Series:
    """Mean speeds against alpha, each (n,), in L/T; error: estimated numerical error of speed.

    kind: "theory", "second" (to second order in alpha), "printed" or "simulation"; dimension: 1 or 2;
    friction: a key of `nonlinear.SLIPS`, all but "coulomb" in panel D.
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
    law = friction_law(nonlinear.SLIPS[friction] * alpha)
    with warnings.catch_warnings():
        # viscous crawling and the end of the theory are shown on purpose
        warnings.simplefilter("ignore", ViscousRegimeWarning)
        warnings.simplefilter("ignore", BeyondReachWarning)
        found = field_speed(field, alpha, "current", rtol=rtol, **law)
    return found.mean, found.error


def leading_coefficients(field: LinearField, rtol: float) -> dict[str, tuple[float, float]]:
    """V/alpha^2 as alpha -> 0, and its error, by key of LABELS; under dry friction."""
    line = float(line_speed(SMALL_ALPHA)) / SMALL_ALPHA**2
    mean, error = mean_speed(field, SMALL_ALPHA, "coulomb", rtol)
    nonlinear_sheet = second_order(Sheet(), SineWave(), rtol=rtol)
    return {
        "line": (line, SMALL_ALPHA**2),
        "first": (mean / SMALL_ALPHA**2, error / SMALL_ALPHA**2),
        "second": (nonlinear_sheet.second, nonlinear_sheet.second_error),
    }


def line_speeds(alphas: Array) -> list[Series]:
    """The closed form in 1D, right to 2 ulp, and the printed one."""
    found = []
    for form, name, kind in (("corrected", "line", "theory"), ("printed", "printed", "printed")):
        speed = line_speed(alphas, form=form)
        found.append(Series(LABELS[name], kind, 1, alphas, speed, 2 * np.spacing(abs(speed))))
    return found


def second_order_speeds(coefficient: float, error: float, alphas: Array) -> Series:
    """V_2 alpha^2 of the nonlinear sheet."""
    square = alphas**2
    return Series(LABELS["second"], "second", 2, alphas, coefficient * square, error * square)


def nonlinear_speeds(table: Sequence[nonlinear.Speed]) -> list[Series]:
    """Sheet and bar at finite strain under dry friction, for panels B and C."""
    return [table_speeds(table, LABELS[body], body, "coulomb") for body in ("sheet", "bar")]


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
        command = nonlinear.TABLE.command
        raise ValueError(f"no {friction} {body} in the table of speeds; `{command}` makes it")
    return Series(label, "simulation", 1 if body == "bar" else 2, alpha, speed, error, friction)

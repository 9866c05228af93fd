"""Numbers about the speed of sheets: load, wave, order, steps (F1 to F3)."""

import warnings

import numpy as np
from numpy.typing import NDArray

from fem_check import cycle_speed, simulate
from figures.measure import nonlinear
from figures.measure import second_order as second_order_table
from linear_theory import (
    TravellingWave,
    ViscousRegimeWarning,
    airy_series,
    crawl_speed,
    line_balance,
    second_order,
)
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.field import LinearField
from linear_theory.friction.load import WEIGHTS as LOADS
from paper.numbers.number import SHEET, SHOWN_ALPHA, SMALL_ALPHA, WAVE, Number, Numbers
from tests.shell.shell_scenes import planar

Array = NDArray[np.float64]


def sheet() -> Numbers:
    """Eqs 10 and 11 on the original paper's sheet, and what sideways slip costs (F1, F2)."""
    numbers = {
        f"sheet.{load}": Number(
            crawl_speed(SHEET, WAVE, SMALL_ALPHA, load=load, rtol=1e-5).mean / SMALL_ALPHA**2,
            f"crawl_speed(alpha=1e-5, load={load!r})/alpha^2",
        )
        for load in LOADS
    }
    field = airy_series(SHEET, WAVE, rtol=1e-7)
    slipping = crawl_speed(SHEET, WAVE, 0.1, rtol=1e-5).mean
    alone = _without_sideways_slip(field, 0.1)
    numbers["sheet.sideways"] = Number(1 - slipping / alone, "1 - V/(V without v_x), alpha = 0.1")
    return numbers


def _without_sideways_slip(field: LinearField, alpha: float) -> float:
    """Mean speed where v_x is left out of eq. 11: at every time a weighted median of v_y."""
    nodes, weights = gauss_legendre(160)
    x, y = nodes[:, None] * SHEET.width / 2, nodes * SHEET.length / 2
    weights = np.multiply.outer(weights, weights)
    times = (np.arange(64) + 0.5) / 64
    return float(np.mean([-_median(field, alpha, x, y, weights, t) for t in times]))


def _median(field: LinearField, alpha: float, x: Array, y: Array, weights: Array, t: float) -> float:
    """Of alpha v_y with the weight J, interpolated between points."""
    values = alpha * field.velocity(x, y, t)[1].ravel()
    load = (weights * (1 + alpha * field.strain(x, y, t)[:2].sum(0))).ravel()
    order = np.argsort(values, kind="stable")
    below = np.cumsum(load[order]) - load[order] / 2
    return float(np.interp(load.sum() / 2, below, values[order]))


def pulses() -> Numbers:
    """Waves with a speed of first order (F2b), and one of the others."""
    waves = {
        "shifted": TravellingWave(np.array([0.0, 1.0]), np.array([1.0, 0.0])),
        "two": TravellingWave(np.zeros(2), np.ones(2)),
    }
    return {
        f"pulse.{name}": Number(
            line_balance(wave, 0.01).first_order, f"line_balance({name}).first_order, in L/T"
        )
        for name, wave in waves.items()
    }


def reach() -> Numbers:
    """How far both orders are from the nonlinear sheet, on the table that figure 3 reads (F3)."""
    rows = [r for r in nonlinear.TABLE.read() if (r.body, r.friction) == ("sheet", "coulomb")]
    coefficient = second_order(SHEET, WAVE, rtol=3e-4).second
    first = [crawl_speed(SHEET, WAVE, r.alpha, rtol=1e-4).mean for r in rows]
    table = second_order_table.TABLE.read()
    sines = [r for r in table if r.wave != "pulse" and r.first == 0]
    return {
        "reach.second": Number(coefficient, "second_order(Sheet(), SineWave()).second, in L/T"),
        "reach.ratio": Number(
            coefficient * SMALL_ALPHA**2 / crawl_speed(SHEET, WAVE, SMALL_ALPHA, rtol=1e-5).mean,
            "second_order over crawl_speed as alpha -> 0",
        ),
        "reach.alpha": Number([r.alpha for r in rows], "figures/data/nonlinear.csv, dry sheet"),
        "reach.sheet": Number([r.speed / r.alpha**2 for r in rows], "the same, V/alpha^2"),
        "reach.first_off": Number(
            [v / r.speed - 1 for v, r in zip(first, rows, strict=True)],
            "crawl_speed over that - 1",
        ),
        "reach.second_off": Number(
            [coefficient * r.alpha**2 / r.speed - 1 for r in rows], "V_2 alpha^2 over that - 1"
        ),
        "reach.rows": Number(float(len(table)), "rows of figures/data/second_order.csv"),
        "reach.sines": Number(float(len(sines)), "of them sine waves"),
        "reach.worst": Number(
            max(abs(r.second - r.nonlinear_second) for r in sines), "largest difference in V_2, sines"
        ),
        "reach.worst_share": Number(
            max(
                abs(r.second - r.nonlinear_second) / (r.second_error + r.nonlinear_second_error)
                for r in table
            ),
            "largest difference in V_2 over the sum of the stated errors, all rows",
        ),
    }


def stepping() -> Numbers:
    """Steps in time, extrapolated from 32 and 64 a period, against the cycle of shapes."""
    numbers = {}
    for name, slip in (("dry", 1e-3), ("viscous", 10.0)):
        scene = planar(SHOWN_ALPHA, slip=slip)
        with warnings.catch_warnings():  # viscous on purpose
            warnings.simplefilter("ignore", ViscousRegimeWarning)
            few, many = (simulate(scene, steps=n, periods=1).speed.mean for n in (32, 64))
            cycle = cycle_speed(scene, rtol=3e-4).mean
        numbers[f"step.{name}_off"] = Number(
            (4 * many - few) / 3 / cycle - 1, f"simulate over cycle_speed - 1, slip_speed={slip:g}"
        )
    return numbers

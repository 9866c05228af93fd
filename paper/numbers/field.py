"""Numbers about one dimension, the Airy series and its print (E1 to E13)."""

import math

import mpmath
import numpy as np

from fem_check.plane_stress.field import plane_stress_field
from figures.draw import fig7
from linear_theory import (
    LAPLACE_LIMIT,
    AirySeries,
    airy_series,
    line_speed,
    ritz_field,
)
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.field import LinearField
from paper.numbers.number import SHEET, SHOWN_ALPHA, WAVE, Number, Numbers

MODES = (5, 10, 20, 40)
"""Of each family, where truncations are compared; 20 in the original paper."""


def line() -> Numbers:
    """The body on a line (E2 to E4)."""
    root = mpmath.findroot(lambda z: z - mpmath.cos(z), 0.7)
    return {
        "line.shown_alpha": Number(SHOWN_ALPHA, "SHOWN_ALPHA"),
        "line.cosine": Number(float(root), "root of theta = cos(theta)"),
        "line.laplace": Number(LAPLACE_LIMIT, "linear_theory.LAPLACE_LIMIT"),
        "line.dry": Number(float(line_speed(SHOWN_ALPHA)), "line_speed(0.25)"),
        "line.printed": Number(
            float(line_speed(SHOWN_ALPHA, form="printed")), 'line_speed(0.25, form="printed")'
        ),
    }


def corner() -> Numbers:
    """Exponents of the free corner (E13), and what the printed couplings are wrong by (E11, E12)."""
    numbers = {}
    for name, sign, start in (("first", -1, 2.7 + 1.1j), ("second", 1, 4.8 + 1.5j)):
        root = mpmath.findroot(lambda z, a=sign: mpmath.sin(mpmath.pi * z / 2) - a * z, start)
        origin = f"root of sin(pi z/2) = {'' if sign > 0 else '-'}z near {start}"
        numbers[f"corner.{name}_re"] = Number(float(root.real), origin)
        numbers[f"corner.{name}_im"] = Number(float(root.imag), origin)
    for name, side in (("a", math.pi / 2), ("b", math.pi / 4)):
        ratio = 2 * math.tanh(side) / math.tanh(math.pi)
        numbers[f"print.ratio_{name}"] = Number(ratio, f"2 tanh({side:.4f})/tanh(pi)")
    return numbers


def truncation() -> Numbers:
    """Tails, tractions and truncation errors of the series (E11 to E13)."""
    exact = airy_series(SHEET, WAVE, rtol=1e-9)
    constants = fig7.tail_constants(exact)
    plain = [airy_series(SHEET, WAVE, modes=m, tail=False) for m in MODES]
    carried = [airy_series(SHEET, WAVE, modes=m) for m in MODES]
    origin = "sigma_xx(0, 0) of the unit even load against rtol=1e-9"
    return {
        "series.tail_even": Number(constants["K"], "figures.draw.fig7.tail_constants"),
        "series.tail_odd": Number(constants["K'"], "figures.draw.fig7.tail_constants"),
        "series.modes": Number([float(m) for m in MODES], "MODES"),
        "series.plain": Number([_central_error(f, exact) for f in plain], origin),
        "series.carried": Number([_central_error(f, exact) for f in carried], origin),
        "series.edge_printed": Number(
            _end_traction(airy_series(SHEET, WAVE, modes=20, form="printed")), "_end_traction, printed"
        ),
        "series.edge_corrected": Number(
            _end_traction(airy_series(SHEET, WAVE, modes=20, tail=False)), "_end_traction, corrected"
        ),
    }


def _central_error(field: AirySeries, exact: AirySeries) -> float:
    quarter = WAVE.period / 4  # the sine is -cos(2 pi y/L) there
    return float(abs(field.stress(0.0, 0.0, quarter)[0] - exact.stress(0.0, 0.0, quarter)[0]))


def _end_traction(field: AirySeries) -> float:
    """Root mean square of sigma_yy on the middle 80 % of the end, unit even load."""
    nodes, weights = gauss_legendre(40)
    x = 0.8 * nodes * SHEET.width / 2
    return float(np.sqrt(weights @ field.stress(x, SHEET.length / 2, WAVE.period / 4)[1] ** 2 / 2))


def agreement() -> Numbers:
    """Largest relative differences of the displacements of three solvers, over the sheet."""
    fields = {
        "ritz": ritz_field(SHEET, WAVE, rtol=1e-8),
        "fem": plane_stress_field(SHEET, WAVE, size=1 / 12),
    }
    exact = airy_series(SHEET, WAVE, rtol=1e-8)
    x, y = np.linspace(-0.25, 0.25, 21)[:, None], np.linspace(-0.5, 0.5, 41)
    size = max(abs(exact.displacement(x, y, t)).max() for t in (0.0, 0.25))
    times = (0.0, 0.13, 0.25)

    def largest(found: LinearField) -> float:
        differences = [found.displacement(x, y, t) - exact.displacement(x, y, t) for t in times]
        return float(max(abs(d).max() for d in differences) / size)

    return {
        f"agree.{name}": Number(
            largest(field), f"{name} against airy_series(rtol=1e-8): largest difference over largest u"
        )
        for name, field in fields.items()
    }

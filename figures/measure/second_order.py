"""Coefficients of V = V_1 alpha + V_2 alpha^2 from theory beside those of the nonlinear sheet.

    python -m figures.measure.second_order [--out FILE] [--rtol 3e-4]

Writes figures/data/second_order.csv: a quarter of an hour of computing. Every growth law, area measure
and load for sine waves on six sheets and for two pulses on the paper's sheet. The nonlinear sheet is
planar, its shapes static and not affected by friction (`cycle_speed`), at two small alphas and
their opposites; what is even and odd in alpha is extrapolated to 0 (Richardson), and the error is that
of the speeds plus a tenth of the step of the extrapolation.
"""

import functools
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from fem_check.shell.cycle.speed import Cycle
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import smooth_scene
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import WEIGHTS as LOADS
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.second_order import second_order
from linear_theory.wave.travelling import SineWave, TravellingWave

RTOL = 3e-4
"""Relative error asked of V_2 by theory and of the nonlinear speeds: agreement is asked to 2e-3."""

ALPHA = 0.03
"""Smaller growth coupling of the nonlinear sheet; the larger is twice that. V/alpha^2 changes by about
alpha^2, of which the extrapolation leaves some alpha^4."""

PULSE_FACTOR, PULSE_SHARE = 2.0, 0.2
"""For pulses, of ALPHA and of the tolerance: V_1 alpha must not hide V_2 alpha^2."""

RESIDUE = 0.1
"""Share of the step of the extrapolation that counts as its error: twice ALPHA^2 is some per cent."""

WAVES = {
    "sine": SineWave(),
    "two sines": SineWave(2),
    "pulse": TravellingWave(np.array([0.5, 0.3]), np.array([0.2, 0.1])),
    "sharp pulse": TravellingWave(np.array([0.5, 0.3, 0.1]), np.array([0.2, 0.1, 0.3])),
}

SINES = (
    (0.5, 0.5, "sine", (4, 8)),
    (0.1, 0.0, "sine", (2, 16)),
    (0.25, 0.3, "two sines", (4, 16)),
    (0.5, 0.0, "two sines", (6, 12)),
    (1.0, 0.5, "sine", (8, 8)),
    (2.0, 0.3, "sine", (12, 8)),
)
"""Width over L, Poisson ratio, key of WAVES, elements across and along."""

PULSES = (
    (0.5, 0.5, "pulse", (4, 8)),
    (0.5, 0.5, "sharp pulse", (6, 12)),
)

DIGITS = 7
"""Significant digits written."""


@dataclass(frozen=True)
class Case:
    """One sheet, wave (key of WAVES) and model; cells: elements across and along."""

    width: float
    poisson: float
    wave: str
    cells: tuple[int, int]
    growth_law: str
    area: str
    load: str

    @property
    def sheet(self) -> Sheet:
        """Of length 1."""
        return Sheet(width=self.width, poisson=self.poisson)


@dataclass(frozen=True)
class Row:
    """V_1 and V_2 by theory and by the nonlinear sheet, and their errors, in L/T."""

    width: float
    poisson: float
    wave: str
    growth_law: str
    area: str
    load: str
    first: float
    first_error: float
    nonlinear_first: float
    nonlinear_first_error: float
    second: float
    second_error: float
    nonlinear_second: float
    nonlinear_second_error: float


TABLE = Table(
    DATA / "second_order.csv",
    Row,
    "python -m figures.measure.second_order",
    "width in L, coefficients and errors in L/T",
    DIGITS,
)


def cases() -> Iterator[Case]:
    """All rows of the table."""
    models = list(itertools.product(GROWTH_LAWS, Reference, LOADS))
    for sheet, model in itertools.product((*SINES, *PULSES), models):
        yield Case(*sheet, *model)


def row(case: Case, rtol: float = RTOL) -> Row:
    """Both coefficients, both ways."""
    model = case.growth_law, case.area, case.load
    theory = second_order(case.sheet, WAVES[case.wave], *model, rtol=rtol)
    first, second = nonlinear_coefficients(case, rtol)
    return Row(
        case.width,
        case.poisson,
        case.wave,
        *model,
        theory.first,
        theory.first_error,
        *first,
        theory.second,
        theory.second_error,
        *second,
    )


def nonlinear_coefficients(
    case: Case, rtol: float, alpha: float = ALPHA
) -> tuple[tuple[float, float], tuple[float, float]]:
    """V_1 and V_2 of the nonlinear sheet as alpha -> 0, each with its error, in L/T."""
    if not WAVES[case.wave].is_half_period_antisymmetric:
        alpha, rtol = PULSE_FACTOR * alpha, PULSE_SHARE * rtol
    pairs = [odd_and_even(case, size, rtol) for size in (alpha, 2 * alpha)]
    first, second = (
        extrapolated([pair[i] for pair in pairs], [pair[i + 2] for pair in pairs]) for i in (0, 1)
    )
    return first, second


def odd_and_even(case: Case, alpha: float, rtol: float) -> tuple[float, float, float, float]:
    """[V(a) - V(-a)]/(2 a), [V(a) + V(-a)]/(2 a^2), and the errors of both; L/T."""
    plus, error = nonlinear_speed(case, alpha, rtol)
    if WAVES[case.wave].is_half_period_antisymmetric:  # (-alpha, c) is (alpha, c half a period later)
        return 0.0, plus / alpha**2, 0.0, error / alpha**2
    minus, other = nonlinear_speed(case, -alpha, rtol)
    error = max(error, other)
    odd, even = (plus - minus) / (2 * alpha), (plus + minus) / (2 * alpha**2)
    return odd, even, error / alpha, error / alpha**2


def nonlinear_speed(case: Case, alpha: float, rtol: float) -> tuple[float, float]:
    """Mean speed and its error, L/T; with an absolute tolerance where V_2 is next to 0."""
    cycle = cycle_of(replace(case, load=LOADS[0]), alpha)
    speed = cycle.speed(Tolerance(rtol, 0.1 * rtol * alpha**2), Contact.named(case.load))
    return speed.mean, speed.error


@functools.lru_cache(maxsize=4)  # the loads of a case follow each other, with four alphas each
def cycle_of(case: Case, alpha: float) -> Cycle:
    """Static shapes, whatever the load."""
    wave = WAVES[case.wave]
    return Cycle(smooth_scene(case.sheet, wave, alpha, case.cells, case.growth_law, case.area))


def extrapolated(values: Sequence[float], errors: Sequence[float]) -> tuple[float, float]:
    """Limit and error from values at alpha and 2 alpha that differ by terms of order alpha^2."""
    near, far = values
    step = (near - far) / 3
    return near + step, (4 * errors[0] + errors[1]) / 3 + RESIDUE * abs(step)


def compute(chosen: Sequence[Case], rtol: float = RTOL) -> list[Row]:
    """Rows of the table, saying how far it is."""
    return [row(case, rtol) for case in tracked("second order", chosen)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, rtol=(RTOL, "relative error of the speeds"))
    TABLE.write(compute(list(cases()), options.rtol), options.out)


if __name__ == "__main__":
    main()

"""What figure 3 shows: friction at one instant by two solvers, and speeds against the coupling."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.plane_stress.field import PlaneStressField, plane_stress_field
from figures.common import output
from figures.draw.fig3.speeds import (
    LABELS,
    REGIMES,
    SMALL_ALPHA,
    Series,
    leading_coefficients,
    line_speeds,
    nonlinear_speeds,
    second_order_speeds,
    sheet_speeds,
    slip_speeds,
)
from figures.measure import nonlinear
from linear_theory import Sheet, SineWave, airy_series, friction_field
from linear_theory.deformation.field import LinearField

Array = NDArray[np.float64]

RTOL = 1e-4
"""Relative error of the speeds from theory; those from finite elements get FEM_FACTOR of it."""

FEM_FACTOR = 10.0
FEM_COST = 10.0
"""Finite elements bring more cells than the balance needs: they get a tolerance FEM_FACTOR looser, and
one speed still costs about FEM_COST of those from the series."""

FEM_SIZE = 1 / 6
"""Longest side of the triangles, of degree 4, over the length of the sheet."""

ALPHA_SHOWN = 0.25
"""Growth coupling in panel A, and where the JSON compares speeds."""

PHASE_SHOWN = 0.0
"""Time of panel A over the period."""

FEM_ALPHAS = (0.04, 0.11, 0.18, ALPHA_SHOWN, 0.32, 0.39)

LEADING_FACTOR = 0.01
"""Share of rtol for the coefficient of alpha^2, and for the deformation, which costs little."""

THEORY_POINTS, SLIP_POINTS = 13, 7
"""Couplings of the curves of panels B and C, and of D, besides ALPHA_SHOWN."""

LINE_POINTS = 201
"""Points of a drawn line."""

CLEARANCE = 0.96
"""Share of the largest alpha with positive load that the curves reach."""

GRID, ARROWS = (41, 81), (5, 11)
"""Points of colour, and arrows, across and along the sheet."""


@dataclass(frozen=True)
class Snapshot:
    """The deformed sheet and its friction at one instant; vectors (2, ...) are (x, y), lengths in L.

    label: source; position, growth: on GRID; feet: reference points of the arrows, moved: where they
    are, force: friction per reference area over mu times the weight per area; edges: deformed sides
    of the triangles, (sides, points, 2), none for a series.
    """

    label: str
    position: Array
    growth: Array
    feet: Array
    moved: Array
    force: Array
    edges: Array | None


@dataclass(frozen=True)
class Fig3Data:
    """What the figure shows.

    series: panels B and C, dry friction; slips: panel D, theory and sheet in turn, in the order of
    REGIMES; coefficients: V/alpha^2 as alpha -> 0 and its error, in L/T, by key of LABELS;
    largest_alpha: at which the load of linear strains is no longer positive somewhere.
    """

    snapshots: tuple[Snapshot, Snapshot]
    series: tuple[Series, ...]
    slips: tuple[Series, ...]
    coefficients: dict[str, tuple[float, float]]
    largest_alpha: float


def compute(rtol: float = RTOL) -> Fig3Data:
    """Friction and speeds for the paper's sheet and wave; rtol: of the speeds from theory."""
    sheet, wave = Sheet(), SineWave()
    table = nonlinear.TABLE.read()
    theory = airy_series(sheet, wave, rtol=LEADING_FACTOR * rtol)
    elements = plane_stress_field(sheet, wave, size=FEM_SIZE)
    limit = largest_alpha(theory)
    # From a small alpha on: at 0 V/alpha^2 would be 0/0.
    alphas, few = (couplings(SMALL_ALPHA, limit, n) for n in (THEORY_POINTS, SLIP_POINTS))
    work = alphas.size + 1 + len(REGIMES) * few.size + FEM_COST * len(FEM_ALPHAS)
    with output.Progress("figure 3", work) as progress:
        coefficients = leading_coefficients(theory, LEADING_FACTOR * rtol)
        progress.advance()
        curve = sheet_speeds(LABELS["first"], "theory", theory, alphas, rtol, progress.advance)
        slips = slip_speeds(table, theory, few, rtol, progress.advance)
        symbols = element_speeds(elements, FEM_FACTOR * rtol, progress)
    second = second_order_speeds(*coefficients["second"], alphas)
    return Fig3Data(
        snapshots=(snapshot(theory, "Airy series"), snapshot(elements, "linear FEM")),
        series=(curve, symbols, second, *nonlinear_speeds(table), *line_speeds(alphas)),
        slips=tuple(slips),
        coefficients=coefficients,
        largest_alpha=limit,
    )


def couplings(start: float, limit: float, points: int) -> Array:
    """From `start` to just below the largest alpha, with ALPHA_SHOWN."""
    return np.union1d(np.linspace(start, CLEARANCE * limit, points), [ALPHA_SHOWN])


def element_speeds(elements: LinearField, rtol: float, progress: output.Progress) -> Series:
    """Linear finite elements under dry friction, symbols of panels B and C."""
    return sheet_speeds(
        LABELS["elements"],
        "simulation",
        elements,
        np.array(FEM_ALPHAS),
        rtol,
        lambda: progress.advance(FEM_COST),
    )


def largest_alpha(field: LinearField) -> float:
    """At which the area element 1 + alpha tr(strain) reaches 0 at some point and time."""
    x, y = grid(field.sheet, GRID, ends=True)
    times = np.linspace(0, field.wave.period, GRID[1])
    lowest = min(field.strain(x, y, t)[:2].sum(0).min() for t in times)
    return float(-1 / lowest)


def grid(sheet: Sheet, counts: tuple[int, int], ends: bool) -> tuple[Array, Array]:
    """Points x (n, 1) and y (m,) over the sheet, from edge to edge or in the middle of n x m cells."""
    across, along = (
        np.linspace(-0.5, 0.5, n) if ends else (np.arange(n) + 0.5) / n - 0.5 for n in counts
    )
    return sheet.width * across[:, None], sheet.length * along


def snapshot(field: LinearField, label: str) -> Snapshot:
    """The sheet at ALPHA_SHOWN and PHASE_SHOWN, in the frame of its mean motion."""
    t = PHASE_SHOWN * field.wave.period
    x, y = grid(field.sheet, GRID, ends=True)
    feet = np.stack(np.broadcast_arrays(*grid(field.sheet, ARROWS, ends=False)))
    return Snapshot(
        label=label,
        position=moved(field, np.stack(np.broadcast_arrays(x, y)), t),
        growth=field.wave.value(x, y, t, field.sheet.length),
        feet=feet,
        moved=moved(field, feet, t),
        force=friction_field(field, ALPHA_SHOWN, feet[0], feet[1], t, load="current").force,
        edges=moved_edges(field, t) if isinstance(field, PlaneStressField) else None,
    )


def moved(field: LinearField, points: Array, t: float) -> Array:
    """Where the reference points (2, ...) are at time t: deformation as it is, not exaggerated."""
    return np.asarray(points + ALPHA_SHOWN * field.displacement(points[0], points[1], t))


def moved_edges(field: PlaneStressField, t: float, points: int = 9) -> Array:
    """Sides of the triangles at time t, (sides, points, 2)."""
    start, end = field.mesh.p[:, field.mesh.facets].transpose(1, 0, 2)
    share = np.linspace(0, 1, points)
    along = start[:, :, None] * (1 - share) + end[:, :, None] * share
    return np.moveaxis(moved(field, along, t), 0, -1)

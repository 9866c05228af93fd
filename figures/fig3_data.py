"""What figure 3 shows: friction at one instant by two solvers, and speeds against the coupling."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.plane_stress import PlaneStressField, plane_stress_field
from figures import output
from linear_theory import Sheet, SineWave, airy_series, field_speed, friction_field, line_speed
from linear_theory.field import LinearField

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

SMALL_ALPHA = 1e-6
"""V/alpha^2 differs from its limit by alpha^2 relative."""

LEADING_FACTOR = 0.01
"""Share of rtol for the coefficient of alpha^2, and for the deformation, which costs little."""

THEORY_POINTS, LINE_POINTS = 13, 201
"""Couplings of the curves in 2D and 1D."""

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
class Series:
    """Mean speeds against alpha, each (n,), in L/T; error: estimated numerical error of speed.

    kind: "theory", "law" (leading power of alpha), "printed" or "simulation"; dimension: 1 or 2.
    """

    label: str
    kind: str
    dimension: int
    alpha: Array
    speed: Array
    error: Array


@dataclass(frozen=True)
class Fig3Data:
    """What the figure shows.

    coefficients: V/alpha^2 as alpha -> 0 and its error, in L/T, by dimension; largest_alpha: at which
    the load is no longer positive somewhere.
    """

    snapshots: tuple[Snapshot, Snapshot]
    series: tuple[Series, ...]
    coefficients: dict[int, tuple[float, float]]
    largest_alpha: float


def compute(rtol: float = RTOL) -> Fig3Data:
    """Friction and speeds for the paper's sheet and wave; rtol: of the speeds from theory."""
    sheet, wave = Sheet(), SineWave()
    theory = airy_series(sheet, wave, rtol=LEADING_FACTOR * rtol)
    elements = plane_stress_field(sheet, wave, size=FEM_SIZE)
    limit = largest_alpha(theory)
    alphas = np.union1d(np.linspace(0, CLEARANCE * limit, THEORY_POINTS), [ALPHA_SHOWN])
    with output.Progress("figure 3", alphas.size + 1 + FEM_COST * len(FEM_ALPHAS)) as progress:
        leading = leading_coefficient(theory, LEADING_FACTOR * rtol)
        progress.advance()
        curve = sheet_speeds("2D, theory", "theory", theory, alphas, rtol, progress.advance)
        symbols = simulated(elements, FEM_FACTOR * rtol, lambda: progress.advance(FEM_COST))
    coefficients = {1: (float(line_speed(SMALL_ALPHA)) / SMALL_ALPHA**2, SMALL_ALPHA**2), 2: leading}
    laws = [law_speeds(dimension, c, alphas) for dimension, (c, _) in coefficients.items()]
    return Fig3Data(
        snapshots=(snapshot(theory, "Airy series"), snapshot(elements, "linear FEM")),
        series=(curve, *line_speeds(alphas), *laws, *symbols),
        coefficients=coefficients,
        largest_alpha=limit,
    )


def simulated(elements: LinearField, rtol: float, advance: Callable[[], None]) -> list[Series]:
    """All that panel B shows as symbols; further models of the sheet join the list."""
    alphas = np.array(FEM_ALPHAS)
    return [sheet_speeds("2D, linear FEM", "simulation", elements, alphas, rtol, advance)]


def sheet_speeds(
    label: str,
    kind: str,
    field: LinearField,
    alphas: Array,
    rtol: float,
    advance: Callable[[], None],
) -> Series:
    """Speeds of the sheet, by the balance of dry friction under the 'current' load."""
    speeds = []
    for alpha in alphas.tolist():
        found = field_speed(field, alpha, load="current", friction="coulomb", rtol=rtol)
        speeds.append((found.mean, found.error))
        advance()
    mean, error = np.array(speeds).T
    return Series(label, kind, 2, alphas, mean, error)


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


def leading_coefficient(field: LinearField, rtol: float) -> tuple[float, float]:
    """V/alpha^2 as alpha -> 0, and its error; under the 'current' load."""
    found = field_speed(field, SMALL_ALPHA, load="current", friction="coulomb", rtol=rtol)
    return found.mean / SMALL_ALPHA**2, found.error / SMALL_ALPHA**2


def law_speeds(dimension: int, coefficient: float, alphas: Array) -> Series:
    """The leading term, proportional to alpha^2; drawn as it is, it has no error."""
    label = f"{dimension}D, α² law"
    return Series(label, "law", dimension, alphas, coefficient * alphas**2, np.zeros_like(alphas))


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

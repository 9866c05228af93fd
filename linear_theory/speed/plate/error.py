"""Model error of the second order in (alpha, beta): its distance to a cycle of nonlinear shapes.

For a sine V is even under (alpha, beta) -> -(alpha, beta), and what second order leaves out is of
fourth. With P, M and N the terms in alpha^2, alpha beta and beta^2, the bound is

    |V - V_cycle| <= 1.5 alpha^2 |P| + (0.05 b^2 + 0.02 m^2 + q) (|M| + |N|).

b is beta over that at which the sheet lifts off: the ground is not linear. m = alpha h W/(L sqrt(D s)),
E = 1, compares the forces that growth makes in the plane with those that hold the sheet flat, by its
rigidity D and the rate s of the ground; at m = 18 sheets buckle. q is the slip by bending over that by
growth, 0 for viscous friction: under other laws the two do not add up. The four numbers are from the
rows below `FITTED` of a table of random sheets, grounds, weights and laws (`python -m
figures.measure.plate.model_error`), where the distance was at most 0.7 times the
bound, or below its numerical error.
"""

import math

from linear_theory.deformation.plate import Foundation, foundation
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.load import Load
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import Exp
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.plate.terms import PlateTerms
from linear_theory.speed.second_order import second_order

PLANE, CONTACT, TENSION, SLIP = 1.5, 0.05, 0.02, 1.0

FITTED = 46
"""Rows of the table from which the numbers are; the others are for tests of the bound."""

RANGES = {
    "width over length": (0.2, 1.0),
    "Poisson ratio": (0.0, 0.5),
    "thickness over length": (0.01, 0.06),
    "edge layer over length": (0.04, 0.3),
    "depth over thickness": (0.1, 2.0),
    "alpha": (0.0, 0.3),
    "share of lift-off": (0.0, 0.95),
    "tension": (0.0, 2.5),
    "slip": (0.0, 0.2),
}
"""Of the sheets, grounds and couplings in the table, for which the bound stands."""

RTOL = 1e-2
"""Of the coefficients in the bound."""


def plate_error(scene: Scene) -> float:
    """Bound of |V - V_cycle| for a bending scene, absolute, length/time; without numerical errors.

    NaN where the distance was not measured: waves other than a sine with one wave on the sheet, growth
    other than exp(alpha c), areas other than the grown one, friction with a direction, a map or on the
    lower face, and sheets, grounds and couplings out of `RANGES`.
    """
    if not _measured(scene):
        return math.nan
    form = second_order(scene, rtol=RTOL).coefficients
    numbers = groups(scene, PlateTerms.of(scene, RTOL))
    if not all(low <= numbers[name] <= high for name, (low, high) in RANGES.items()):
        return math.nan
    alpha, beta = scene.alpha, scene.curvature_coupling
    return bound(
        numbers,
        alpha**2 * form.alpha_alpha.value,
        abs(alpha * beta * form.alpha_beta.value) + beta**2 * abs(form.beta_beta.value),
    )


def bound(numbers: dict[str, float], planar: float, bent: float) -> float:
    """Of the terms P and |M| + |N|, in their unit; numbers: as from `groups`."""
    share = CONTACT * numbers["share of lift-off"] ** 2 + TENSION * numbers["tension"] ** 2
    return PLANE * numbers["alpha"] ** 2 * abs(planar) + (share + SLIP * numbers["slip"]) * abs(bent)


def groups(scene: Scene, terms: PlateTerms) -> dict[str, float]:
    """The numbers of `RANGES`."""
    beta, series, ground = scene.curvature_coupling, scene.drive.series, terms.plate.foundation
    size = 1.0 if series is None or series.sine_amplitude is None else series.sine_amplitude
    alpha, limit = abs(scene.alpha) * size, terms.lift_off[1 if beta > 0 else 0]
    return {
        **_of_sheet(scene.sheet, ground),
        "alpha": alpha,
        "share of lift-off": beta / limit,
        "tension": tension(alpha, scene.sheet, ground),
        "slip": slip_ratio(scene, terms),
    }


def slip_ratio(scene: Scene, terms: PlateTerms) -> float:
    """q: beta^2 times the root mean square of v_b over |alpha| L/T; 0 for viscous friction."""
    if not scene.contact.friction.limited:
        return 0.0
    slip = scene.curvature_coupling**2 * terms.stretch.speed
    return slip / (abs(scene.alpha) * scene.unit)


def tension(alpha: float, sheet: Sheet, ground: Foundation) -> float:
    """m, from E h = 12 (1 - nu^2) D/h^2."""
    forces = alpha * 12 * (1 - sheet.poisson**2) * ground.rigidity / sheet.thickness**2
    return forces * sheet.width / sheet.length / math.sqrt(ground.rigidity * ground.spring)


def _of_sheet(sheet: Sheet, ground: Foundation) -> dict[str, float]:
    return {
        "width over length": sheet.width / sheet.length,
        "Poisson ratio": sheet.poisson,
        "thickness over length": sheet.thickness / sheet.length,
        "edge layer over length": ground.layer / sheet.length,
        "depth over thickness": ground.depth / sheet.thickness,
    }


def _measured(scene: Scene) -> bool:
    """Whether wave, growth, areas and law are of a kind that the table has."""
    series, growth, law = scene.drive.series, scene.growth, scene.contact.friction
    if scene.alpha == 0:  # not a quadratic form there
        return False
    if series is None or series.sine_amplitude is None or abs(series.count) != 1:
        return False
    areas = growth.curvature, growth.energy_area
    if not isinstance(growth.law, Exp) or areas != (Reference.GROWN, Reference.GROWN):
        return False
    return isinstance(law, Isotropic) and foundation(scene.effects).load is Load.GROWN

"""Model error of the second order in (alpha, beta): its distance to a cycle of nonlinear shapes.

For a sine V is even under (alpha, beta) -> -(alpha, beta), and what second order leaves out is of
fourth. With P, M and N the terms in alpha^2, alpha beta and beta^2, the bound is

    |V - V_cycle| <= 0.8 alpha^2 |P| + (0.05 b^2 + 0.02 m^2) (|M| + |N|),

b = beta over that at which the sheet lifts off: the ground is not linear, and m = alpha h W/(L sqrt(D
s)), E = 1: the forces that growth makes in the plane against those that hold the sheet flat, by its
rigidity D and the rate s of the ground. The bound stands up to m = 2.5; at m = 18 sheets buckle. The
three numbers are from the first rows, those below `FITTED`, of a table of random sheets, grounds,
weights and laws (`python -m figures.measure.plate.model_error`), where the distance was at most 0.7
times the bound.
"""

import math

from linear_theory.deformation.plate import Foundation, foundation
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.load import Load
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import Exp
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.quadratic_form import QuadraticForm
from linear_theory.speed.second_order import second_order

PLANE, CONTACT, TENSION = 0.8, 0.05, 0.02

FITTED = 15
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
    form, ground = second_order(scene, rtol=RTOL).coefficients, foundation(scene.effects)
    numbers = groups(scene, form, ground)
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
    return PLANE * numbers["alpha"] ** 2 * abs(planar) + share * abs(bent)


def groups(scene: Scene, form: QuadraticForm, ground: Foundation) -> dict[str, float]:
    """The numbers of `RANGES`."""
    beta, series = scene.curvature_coupling, scene.drive.series
    size = 1.0 if series is None or series.sine_amplitude is None else series.sine_amplitude
    alpha = abs(scene.alpha) * size
    return {
        **_of_sheet(scene.sheet, ground),
        "alpha": alpha,
        "share of lift-off": beta / form.lift_off[1] if beta > 0 else beta / form.lift_off[0],
        "tension": tension(alpha, scene.sheet, ground),
    }


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

"""The speed as a quadratic form of the growth coupling alpha and the curvature coupling beta."""

import math
from dataclasses import dataclass

from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.speed.result import Estimate

NOTHING = Estimate(0.0, 0.0)


@dataclass(frozen=True)
class QuadraticForm(Shown):
    """V = V_a alpha + V_aa alpha^2 + V_ab alpha beta + V_bb beta^2 + ..., length/time.

    alpha, alpha_alpha: V_a and V_aa, length/time; alpha_beta: V_ab, length^2/time; beta_beta: V_bb,
    length^3/time, each with its numerical error, absolute. lift_off: the beta, negative and positive,
    at which the pressure of the ground vanishes at some point and time, 1/length; infinite for a sheet
    that does not bend, whose V_ab and V_bb are 0. There the form ends.

    For dry friction the form holds while beta^2 times the slip by bending is small compared with alpha
    times that by growth: at alpha = 0 the speed is another multiple of beta^2, see
    `terms.BendingAlone`. Friction with a direction: for alpha > 0. With friction on the lower
    face V is such a form only if that is viscous (see `lower_face`); under other laws alpha_beta and
    beta_beta are NaN, with infinite errors.
    """

    alpha: Estimate
    alpha_alpha: Estimate
    alpha_beta: Estimate = NOTHING
    beta_beta: Estimate = NOTHING
    lift_off: tuple[float, float] = (-math.inf, math.inf)

    def at(self, alpha: float, beta: float) -> Estimate:
        """V and its numerical error at given couplings.

        Raises ValueError for a beta at or beyond lift-off.

        >>> from linear_theory.speed.plate.quadratic_form import QuadraticForm
        >>> from linear_theory import Estimate
        >>> form = QuadraticForm(Estimate(0, 0), Estimate(1.5, 0.01), Estimate(-0.2, 0.001))
        >>> print(f"{form.at(alpha=0.1, beta=0.5).value:.3f}")
        0.005
        """
        alpha, beta = validation.real("alpha", alpha), validation.real("beta", beta)
        check_contact(beta, self.lift_off, "beta")
        powers = (alpha, alpha**2, alpha * beta, beta**2)
        parts = (self.alpha, self.alpha_alpha, self.alpha_beta, self.beta_beta)
        value = sum(p * e.value for p, e in zip(powers, parts, strict=True))
        return Estimate(value, sum(abs(p) * e.error for p, e in zip(powers, parts, strict=True)))


def check_contact(beta: float, lift_off: tuple[float, float], name: str = "curvature_coupling") -> None:
    """Raise ValueError for a beta at which the sheet lifts off the ground somewhere."""
    low, high = lift_off
    if not low < beta < high:
        raise ValueError(
            f"{name} = {beta:g}: must be in ({low:.4g}, {high:.4g}), beyond which the sheet lifts off "
            "the ground at some point and time (the pressure rho g + beta p vanishes); cycles of "
            "shapes and steps in time go further"
        )

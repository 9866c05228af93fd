"""The speed as a quadratic form of the growth coupling alpha and the curvature coupling beta."""

import math
from dataclasses import dataclass

import numpy as np

from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.speed.result import Estimate

NOTHING = Estimate(0.0, 0.0)


@dataclass(frozen=True)
class BestCouplings(Shown):
    """alpha >= 0 and beta, 1/length, of the largest V, and that, length/time; -alpha, -beta are as
    good."""

    alpha: float
    beta: float
    speed: Estimate


@dataclass(frozen=True)
class QuadraticForm(Shown):
    """V = V_a alpha + V_aa alpha^2 + V_ab alpha beta + V_bb beta^2 + ..., length/time.

    alpha, alpha_alpha: V_a and V_aa, length/time; alpha_beta: V_ab, length^2/time; beta_beta: V_bb,
    length^3/time, each with its numerical error, absolute. lift_off: the beta, negative and positive,
    at which the pressure of the ground vanishes at some point and time, 1/length; infinite for a sheet
    that does not bend, whose V_ab and V_bb are 0. There the form ends. converged: whether these errors
    meet the tolerance that was asked for, see `second_order`.

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
    converged: bool = True

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

    def best(self, alpha: float, beta: float, towards: int = 1) -> "BestCouplings":
        """The couplings of the largest V in a budget (alpha/alpha_0)^2 + (beta/beta_0)^2 = 1.

        alpha, beta: alpha_0 and beta_0 > 0 (1/length); towards: 1 for +y, -1 for the largest speed
        towards -y. V is then the largest eigenvalue of the form in units of the budget, and the
        couplings its eigenvector, or the opposite one. Raises ValueError for other numbers, a form that
        has a part of first degree (c(t + T/2) != -c(t)) or coefficients that are not known, and
        couplings at which the sheet lifts off: the budget must be smaller then.

        >>> from linear_theory.speed.plate.quadratic_form import QuadraticForm
        >>> from linear_theory import Estimate
        >>> nothing, mixed = Estimate(0, 0), Estimate(-0.2, 0)
        >>> best = QuadraticForm(nothing, Estimate(1.5, 0), mixed).best(alpha=0.1, beta=0.5)
        >>> print(f"{best.alpha:.4f} {best.beta:.4f} {best.speed.value:.4f}")
        0.0957 -0.1449 0.0165
        """
        alpha, beta = validation.positive("alpha", alpha), validation.positive("beta", beta)
        if towards not in (1, -1):
            raise ValueError(f"towards = {validation.shown(towards)}: must be 1 or -1")
        if self.alpha != NOTHING:
            raise ValueError(
                "alpha: the form has a part of first degree in alpha, by which V is no quadratic form; "
                "only waves with c(t + T/2) = -c(t) have none"
            )
        parts = self.alpha_alpha, self.alpha_beta, self.beta_beta
        if not all(math.isfinite(part.error) for part in parts):
            raise ValueError("coefficients: must be known, which they are not where V is no such form")
        units = np.array([alpha**2, alpha * beta, beta**2])
        (aa, ab, bb), (e_aa, e_ab, e_bb) = (
            units * [getattr(part, name) for part in parts] for name in ("value", "error")
        )
        values, vectors = np.linalg.eigh(towards * np.array([[aa, ab / 2], [ab / 2, bb]]))
        doubt = float(np.linalg.norm([[e_aa, e_ab / 2], [e_ab / 2, e_bb]], 2))
        share = vectors[:, 1] * np.sign(vectors[0, 1] or 1.0)
        found = Estimate(float(towards * values[1]), doubt)
        check_contact(float(beta * share[1]), self.lift_off, "beta")
        return BestCouplings(float(alpha * share[0]), float(beta * share[1]), found)


def check_contact(beta: float, lift_off: tuple[float, float], name: str = "curvature_coupling") -> None:
    """Raise ValueError for a beta at which the sheet lifts off the ground somewhere."""
    low, high = lift_off
    if not low < beta < high:
        raise ValueError(
            f"{name} = {beta:g}: must be in ({low:.4g}, {high:.4g}), beyond which the sheet lifts off "
            "the ground at some point and time (the pressure rho g + beta p vanishes); cycles of "
            "shapes and steps in time go further"
        )

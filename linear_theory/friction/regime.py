"""Whether friction is dry, mixed or viscous, as the sheet meets it: by its slip ratio."""

import warnings
from typing import Literal

import numpy as np

from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.friction.law import FrictionLaw

Regime = Literal["dry", "mixed", "viscous", "none"]

DRY_RATIO = 0.05
"""Slip ratio up to which tanh(v/v0) is dry friction. The speed of the paper's sheet has gone there 0.2
to 1.2 % of the way from its dry to its viscous value under a sine wave (alpha from 0.02 to 0.3), 4 to
9 % under a pulse of two harmonics, whose speed is of first order."""

VISCOUS_RATIO = 1.0
"""Slip ratio from which it is viscous: v0 is above all speeds at all times. The speed of the paper's
sheet has gone there 90 % of the way under a sine wave, 94 to 96 % under the pulse."""

ROUNDING = 1e-13
"""Largest speed (L/T) at which nothing moves: what is left are errors of rounding."""


def regime_of(slip_ratio: float) -> Regime:
    """Regime of friction at a slip ratio (see `CrawlSpeed`); "none" for NaN, which is no friction."""
    if np.isnan(slip_ratio):
        return "none"
    if slip_ratio <= DRY_RATIO:
        return "dry"
    return "viscous" if slip_ratio >= VISCOUS_RATIO else "mixed"


def warn_if_viscous(law: FrictionLaw, slip_ratio: float) -> None:
    """Warn where a law that stands for dry friction acts as viscous.

    To be called by the function that the user calls, to whose line the warning points. No warning where
    nothing moves but by rounding.
    """
    if not law.regularised or regime_of(slip_ratio) != "viscous":
        return
    fastest = law.width / slip_ratio
    if fastest <= ROUNDING:
        return
    warnings.warn(
        f"slip_speed = {law.width:.4g} is {slip_ratio:.3g} times the largest speed against the "
        f"ground, {fastest:.3g}: friction {law.formula} acts as viscous; at such speeds it is dry "
        f"for a slip_speed below about {DRY_RATIO * fastest:.3g}",
        ViscousRegimeWarning,
        stacklevel=3,
    )

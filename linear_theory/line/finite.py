"""A sine wave on a line at finite strain: the exact speed of a growing bar or narrow strip.

A body 0 <= S <= 1 (L = 1) grows by the stretch s(alpha c), c = sin(phi), phi = 2 pi (n S - t/T), so
that x(S, t) = int_0^S s dS'. Without forces along the body this is the shape of the nonlinear sheet in
one dimension. In the frame of the mean motion v = -(s - mean s)/(nT), and friction (eq. 7 with the
weight w = s^p of `growth`) balances for

    dry       nTV = s(alpha sin(theta)) - mean s,   int_(-pi/2)^theta w = int_theta^(pi/2) w,
    viscous   nTV = mean(s w)/mean(w) - mean s.

Stretch 1 + s_1 e + s_2 e^2 and weight 1 + w_1 e, e = alpha c, give to leading order nTV/alpha^2 =
s_1 w_1 - s_2/2 (dry) and s_1 w_1/2 (viscous): all growth laws agree to first order in alpha c, but not
in V, which is of second. In closed form, with M = mean s and M_3 = mean s^3,

    growth law   line, current load         strip, current load            weight conserved
    exp                                                                    1 - I_0(alpha)
    linear       alpha sin(theta)           alpha sin(theta')              0
    metric                                  s(alpha sin(theta_2)) - M      1 - M
    exp          I_0(2 a)/I_0(a) - I_0(a)   I_0(3 a)/I_0(2 a) - I_0(a)     0             (viscous,
    linear       alpha^2/2                  2 alpha^2/(2 + alpha^2)        0              a = alpha)
    metric       1/M - M                    M_3 - M                        0

theta = alpha cos(theta) (`line_speed`), theta_2 = 2 alpha cos(theta_2),
theta' (1 + alpha^2/2) - (alpha^2/4) sin(2 theta') = 2 alpha cos(theta'). For "metric", with complete
elliptic integrals of parameter m = 4 alpha/(1 + 2 alpha), M = (2/pi) (1 + 2 alpha)^(1/2) E and
M_3 = (2/(3 pi)) (1 + 2 alpha)^(1/2) [4 E - (1 - 2 alpha) K]; for "exp" M = I_0(alpha).
As differences these lose their digits for small alpha; the integrals below do not.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.friction.laws import Coulomb, Viscous
from linear_theory.line.piece import Piece
from linear_theory.line.roots import bracketed_newton

Array = NDArray[np.float64]

FRICTIONS = {law.name: law for law in (Coulomb(), Viscous())}
"""Friction laws with a speed in closed form."""

POINTS = 32
"""Gauss points between phase 0 and the median, where stretches are >= 1 and hence smooth functions of
the phase, and as many more as the exponent of the weight is large."""

STEP, ENDS = 1 / 24, 76
"""Points of the double exponential rule for a quarter period. Stretches may vanish at one end of it:
the square root of "metric" then has a branch point arbitrarily close, near which points accumulate."""

BLOCK = 4096
"""Number of values of alpha per batch: some MB of quadrature points."""


def line_cycle_speed(
    alpha: ArrayLike,
    growth_law: str = "exp",
    load: str = "current",
    count: int = 1,
    period: float = 1.0,
    body: str = "line",
    friction: str = "coulomb",
) -> Array:
    """Exact speed of a growing body under a sine wave, dry or viscous friction; see `line_balance`.

    alpha: dimensionless growth coupling, any shape; |alpha| < 1 for "linear", 1/2 for "metric" and 100
    for "exp". growth_law: the stretch, "exp" exp(alpha c), "linear" 1 + alpha c or "metric"
    (1 + 2 alpha c)^(1/2). load: "current" or "grown" (the same here), weight per length of a "line" and
    per area of a narrow "strip" that grows in both directions (`body`); or "material": conserved.
    count: waves on the body, any non-zero integer. period: units of time. friction: "coulomb" or
    "viscous"; for the law tanh(v/v0) and for other waves use `line_balance`.

    Returns speeds of the shape of alpha, in body lengths per time, positive towards +y, with an error
    of about 1e-15 relative to the terms of the formulas above. Raises ValueError for unknown names and
    for |alpha| so large that a length would vanish.

    >>> from linear_theory import line_cycle_speed
    >>> for body in ("line", "strip"):
    ...     print(f"{body}: V = {line_cycle_speed(0.25, body=body):.5f} L/T")
    line: V = 0.04662 L/T
    strip: V = 0.10128 L/T
    """
    strength = validation.real_array("alpha", alpha)
    growth = Piece.of(growth_law, load, body)
    unit = validation.wave_count(count) * validation.positive("period", period)
    dry = is_dry(friction)
    lowest, highest = growth.law.bounds(growth.extreme)
    limit = min(-lowest, highest)
    worst = strength.flat[abs(strength).argmax()] if strength.size else 0.0
    if abs(worst) >= limit:
        raise ValueError(
            f"alpha = {worst:g}: must be in (-{limit:g}, {limit:g}) for growth_law = {growth_law!r}"
        )
    # (alpha, c) and (-alpha, -c) are equivalent up to half a period.
    size = abs(strength).ravel()
    solve = _dry if dry else _viscous
    blocks = [solve(size[i : i + BLOCK], growth) for i in range(0, size.size, BLOCK)]
    return np.asarray(np.concatenate([*blocks, size[:0]]).reshape(strength.shape) / unit)


def is_dry(friction: str) -> bool:
    """Whether the friction law with that name is Coulomb's. Raises ValueError for unknown names."""
    return FRICTIONS[validation.choice("friction", friction, FRICTIONS)] == Coulomb()


def _dry(alpha: Array, growth: Piece) -> Array:
    sine = np.sin(_median_angle(alpha, growth))
    return np.asarray(growth.rise(alpha * sine) - _mean_rise(alpha, growth))


def _viscous(alpha: Array, growth: Piece) -> Array:
    x, weights = _strains(alpha)
    gain, mean = growth.gain(x), _mean_rise(alpha, growth)
    moment = np.sum(weights * gain * (growth.rise(x) - mean[:, None]), axis=1)
    return np.asarray(moment / (1 + np.sum(weights * gain, axis=1)))


def _mean_rise(alpha: Array, growth: Piece) -> Array:
    """mean s - 1: the mean of the linear part is 0."""
    x, weights = _strains(alpha)
    return np.asarray(np.sum(weights * x**2 * growth.bend(x), axis=1))


def _median_angle(alpha: Array, growth: Piece) -> Array:
    """theta: the weight between phases 0 and theta is half the difference of both signs' weights."""
    if growth.power == 0:
        return np.zeros(alpha.shape)
    x, weights = _strains(alpha)
    target = np.pi / 2 * np.sum(weights * abs(growth.gain(x)), axis=1)
    exponent = growth.power * alpha.max(initial=0.0)
    nodes, shares = gauss_legendre(POINTS + math.ceil(exponent))

    def balance(angle: Array) -> tuple[Array, Array]:
        phase = angle[:, None] / 2 * (1 + nodes)
        gain = growth.gain(alpha[:, None] * np.sin(phase)) @ shares / 2
        return angle * (1 + gain) - target, 1 + growth.gain(alpha * np.sin(angle))

    return bracketed_newton(balance, np.zeros(alpha.shape), np.pi / 2, np.minimum(alpha, 1.0))


def _strains(alpha: Array) -> tuple[Array, Array]:
    """alpha sin(phi) at the points of a quarter period with both signs, and the weights of the mean."""
    t = STEP * np.arange(-ENDS, ENDS + 1.0)
    # The phase from the turning point, pi/2 (1 + tanh(pi/2 sinh t))/2
    share = 1 / (1 + np.exp(-np.pi * np.sinh(t)))
    weights = STEP * np.pi * np.cosh(t) * share * (1 - share) / 2
    sine = np.cos(np.pi / 2 * share)
    return alpha[:, None] * np.concatenate([sine, -sine]), np.concatenate([weights, weights])

"""A sine wave on a line at finite strain: the exact speed of a bar whose lengths grow by a given law.

A body 0 <= S <= 1 (L = 1) grows by the factor s(c), c = sin(phi), phi = 2 pi (n S - t/T), so that
x(S, t) = int_0^S s dS'. Without forces along the bar this is the shape of the nonlinear sheet in one
dimension. As s_t = -s_S/(nT), a material point moves in the frame of the mean motion with

    v = -(s - mean s)/(nT).

Dry friction balances where (eq. 7 with the weight s per length, or 1 if weight is conserved)

    V = (m - mean s)/(nT),   m the weighted median of s: constant in time.

All laws agree to first order in alpha c, but not in V, which is of second order: with the load on the
current length V -> 3/4, 1, 5/4 alpha^2/(nT) for "exp", "linear" and "metric", and with conserved weight
-1/4, 0, 1/4 (F3 of the list of corrections). "linear" is eq. 5, and V that of `line_speed`.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory import validation
from linear_theory.friction import LOADS
from linear_theory.line.roots import bracketed_newton

Array = NDArray[np.float64]

STRETCHES: dict[str, Callable[[Array], Array]] = {
    "exp": np.expm1,
    "linear": np.positive,
    "metric": lambda strain: 2 * strain / (1 + np.sqrt(1 + 2 * strain)),
}
"""s - 1 as a function of alpha c: s = exp(alpha c), 1 + alpha c and sqrt(1 + 2 alpha c)."""

LARGEST = {"exp": np.inf, "linear": 1.0, "metric": 0.5}
"""Bounds of |alpha|, beyond which lengths would vanish."""

POINTS = 64
"""Gauss points on either side of the median: enough for rounding up to |alpha| = 0.49 ("metric") and
9 ("exp"), where 200 points were compared."""


def line_cycle_speed(
    alpha: ArrayLike,
    law: str = "exp",
    load: str = "current",
    count: int = 1,
    period: float = 1.0,
) -> Array:
    """Speed of the growing bar with dry friction, exact.

    alpha: dimensionless growth coupling, any shape. law: "exp", "linear" or "metric" (the square of the
    stretch is 1 + 2 alpha c). load: "current" or "grown" (the same on a line: weight per length of the
    grown body) or "material". count: waves on the body, any non-zero integer. period: units of time.

    Returns the shape of alpha, length/time, positive towards +y; absolute error about 1e-15/(nT).
    Raises ValueError for other names and for |alpha| so large that a length would vanish.
    """
    strength = validation.real_array("alpha", alpha)
    validation.choice("law", law, tuple(STRETCHES))
    grows = validation.choice("load", load, LOADS) != "material"
    unit = validation.wave_count(count) * validation.positive("period", period)
    worst = strength.flat[abs(strength).argmax()] if strength.size else 0.0
    if abs(worst) >= LARGEST[law]:
        raise ValueError(
            f"alpha = {worst:g}: must be in (-{LARGEST[law]:g}, {LARGEST[law]:g}) for {law!r}"
        )
    change = STRETCHES[law]
    # (alpha, c) and (-alpha, -c) are the same growth, half a period apart.
    size = abs(strength)
    angle = _median_angle(size, change) if grows else np.zeros(size.shape)
    return np.asarray((change(size * np.sin(angle)) - _mean(size, change)) / unit)


def _mean(alpha: Array, change: Callable[[Array], Array]) -> Array:
    """Mean of s - 1 over the phase."""
    below, above = _halves(alpha, np.zeros(alpha.shape), change)
    return np.asarray((below + above) / np.pi)


def _median_angle(alpha: Array, change: Callable[[Array], Array]) -> Array:
    """theta with the weight s on (-pi/2, theta) equal to that on (theta, pi/2)."""

    def balance(angle: Array) -> tuple[Array, Array]:
        below, above = _halves(alpha, angle, change)
        return 2 * angle + below - above, 2 * (1 + change(alpha * np.sin(angle)))

    return bracketed_newton(balance, np.zeros(alpha.shape), np.pi / 2, np.minimum(alpha, 1.0))


def _halves(alpha: Array, angle: Array, change: Callable[[Array], Array]) -> tuple[Array, Array]:
    """Integrals of s - 1 over phases from -pi/2 to `angle` and from there to pi/2."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    sums = []
    for end in (-np.pi / 2, np.pi / 2):
        half = (angle - end)[..., None] / 2
        values = change(alpha[..., None] * np.sin(end + half * (1 + nodes)))
        sums.append(np.asarray(abs(half[..., 0]) * (values @ weights)))
    return sums[0], sums[1]

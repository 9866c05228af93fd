"""A sine wave on a line: the speed in closed form (paper section 3.1, eqs 5-9).

A body 0 <= S <= 1 (L = 1) grows by the factor 1 + alpha c, c = sin(phi), phi = 2 pi (n S - t/T).
Integrating eq. 5 and removing the mean (eq. 6) gives v_cm = -(alpha/nT) sin(phi), with the sign
opposite to the printed one. Dry friction on the current length (eq. 7) then balances where, with
V = (alpha/nT) sin(theta),

    theta = alpha cos(theta),                                            (eq. 8, corrected)
    V = (alpha^2/nT) (1 - (2/3) alpha^2 + ...),                          (eq. 9, corrected)

against the printed arcsin(q) + alpha sqrt(1 - 2 q^2) = 0, q = nTV/alpha, and V = -alpha^2/(nT).
The body crawls along the wave; with viscous friction it moves in the same direction, half as fast. Both
are limits of the law tanh(v/v0). theta = alpha cos(theta) is Kepler's equation E + alpha sin(E) = pi/2
with E = pi/2 - theta.

All speeds are in units of L over the unit of `period`, positive towards +y; for count < 0 the wave
runs towards -y and V is negative.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.line.roots import bracketed_newton

Array = NDArray[np.float64]

FORMS = ("corrected", "printed")

KEPLER_STEPS = 3
"""Newton steps from the cubic start, plus the one with a compensated residual: converged for all
|alpha| < 1 (the start is within 0.02, and each step squares the error)."""

PRINTED_STEPS = 6
"""Newton steps for the printed equation; the start is within 0.03 of the root."""

NARROW = 0.0135
"""Slip speed over wave speed below which the tanh law is treated as a narrow smoothing of dry friction.

Then the smoothing kernel (19 slip speeds wide for 1e-16) does not reach the turning points
|sin(phi)| = 1, because |q| <= 0.7391 and 19 * 0.0135 < 1 - 0.7391; above this ratio the trapezoidal
rule resolves the layer.
"""

BLOCK = 512
"""Number of speeds per batch for the tanh law: a few MB of quadrature points."""


def line_speed(alpha: ArrayLike, count: int = 1, period: float = 1.0, form: str = "corrected") -> Array:
    """Speed of the sine wave with dry friction, eq. 8: V = (alpha/nT) sin(theta).

    alpha: dimensionless growth coupling, any shape, |alpha| < 1; count: waves on the body, any
    non-zero integer; period: units of time. Returns speeds of the shape of alpha, in body lengths per
    time, within 2 ulp for count = period = 1 and 3 ulp otherwise, as alpha/count/period is rounded too.
    form="printed" solves eq. 8 as printed in the paper, which does not satisfy the balance eq. 7.
    Raises ValueError for |alpha| >= 1, where the length of a contracted part would vanish.

    >>> from linear_theory import line_speed
    >>> print(line_speed([0.01, 0.25]).round(6))  # L/T; alpha^2 where alpha is small
    [0.0001   0.060075]
    """
    alpha, scale = _checked(alpha, count, period)
    if validation.choice("form", form, FORMS) == "printed":
        return np.asarray(-scale * np.sign(alpha) * np.sin(_printed_angle(abs(alpha))))
    head, tail = _kepler_sine(alpha)
    # Mantissa and exponent separately: the exact product below must neither overflow nor lose its tail.
    mantissa, exponent = np.frexp(scale)
    product = mantissa * head
    tail = mantissa * tail + _product_error(mantissa, head, product)
    return np.asarray(np.ldexp(product + tail, exponent))


def line_power(alpha: ArrayLike, count: int = 1, period: float = 1.0) -> Array:
    """Power of growth of the sine wave with dry friction, over mu times the weight, in closed form.

        P = |alpha/(pi nT)| cos(theta) (2 + |alpha| sin(theta) - alpha^2),   theta = |alpha| cos(theta),

    the mean of (1 + alpha sin(phi)) |V - (alpha/nT) sin(phi)|: over a period the work of friction is
    that of growth. P/V is the cost of transport over mu, and V/P the efficiency, pi |alpha|/2 for small
    alpha (see `CrawlSpeed.efficiency`). Arguments and units as for `line_speed`. Raises ValueError as
    it does.

    >>> from linear_theory import line_power, line_speed
    >>> print(f"efficiency {line_speed(0.1) / line_power(0.1):.4f}")
    efficiency 0.1568
    """
    alpha, scale = _checked(alpha, count, period)
    size, (sine, _) = abs(alpha), _kepler_sine(abs(alpha))
    cosine = np.sqrt((1 - sine) * (1 + sine))
    return np.asarray(abs(scale) / np.pi * cosine * (2 + size * sine - size**2))


def line_speed_viscous(alpha: ArrayLike, count: int = 1, period: float = 1.0) -> Array:
    """Speed of the sine wave with viscous friction on the current length: alpha^2/(2nT), exactly.

    Arguments and units as for `line_speed`. Raises ValueError as it does.

    >>> from linear_theory import line_speed, line_speed_viscous
    >>> ratio = line_speed_viscous(0.01) / line_speed(0.01)
    >>> print(f"{ratio:.3f} of the speed with dry friction")
    0.500 of the speed with dry friction
    """
    alpha, scale = _checked(alpha, count, period)
    return np.asarray(alpha / 2 * scale)


def line_speed_tanh(
    alpha: ArrayLike, slip_speed: ArrayLike, count: int = 1, period: float = 1.0
) -> Array:
    """Speed of the sine wave with friction tanh(v/v0), for any v0 = slip_speed > 0.

    The root V of int (1 + alpha sin phi) tanh((V - (alpha/nT) sin phi)/v0) dphi = 0; alpha and
    slip_speed (body lengths per time) broadcast, other arguments as for `line_speed`. The limits are
    dry (v0 -> 0) and viscous friction (v0 -> infinity); relative accuracy 1e-13. Raises ValueError as
    `line_speed` does and for slip_speed <= 0.

    The integrand is symmetrised under phi -> -phi analytically, so that the small speed (of order
    alpha^2) is not a difference of large numbers.

    >>> from linear_theory import line_speed_tanh
    >>> print(line_speed_tanh(0.25, slip_speed=[1e-6, 0.05, 1e3]).round(5))  # L/T, from dry to viscous
    [0.06007 0.05787 0.03125]
    """
    alpha, scale = _checked(alpha, count, period)
    slip = validation.real_array("slip_speed", slip_speed)
    if slip.size and slip.min() <= 0:
        raise ValueError(f"slip_speed = {slip.min():g}: must be > 0")
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        width = slip / abs(scale)  # infinite for alpha = 0, where V = 0 for any law
    strength, width = np.broadcast_arrays(abs(alpha), width)
    level = np.empty(strength.shape)
    order = np.argsort(width, axis=None)  # similar widths share one quadrature
    narrow = int(np.searchsorted(width.flat[order], NARROW))
    for part, solve in ((order[:narrow], _narrow_level), (order[narrow:], _wide_level)):
        for start in range(0, part.size, BLOCK):
            block = part[start : start + BLOCK]
            level.flat[block] = solve(strength.flat[block], width.flat[block])
    return np.asarray(scale * np.sign(alpha) * level)


def _checked(alpha: ArrayLike, count: int, period: float) -> tuple[Array, Array]:
    """alpha as an array, and alpha/(n T)."""
    strength = validation.real_array("alpha", alpha)
    validation.wave_count(count)
    period = validation.positive("period", period)
    worst = strength.flat[abs(strength).argmax()] if strength.size else 0.0
    if abs(worst) >= 1:
        raise ValueError(
            f"alpha = {worst:g}: must be in (-1, 1); otherwise the length factor 1 + alpha sin(phi) "
            "is not positive everywhere and the theory has no meaning"
        )
    return strength, np.asarray(strength / count / period)


def _kepler_sine(alpha: Array) -> tuple[Array, Array]:
    """sin(theta) of theta = alpha cos(theta), as a sum of a double and a small correction."""
    theta = alpha * (1 - alpha**2 * (0.5 - 0.24 * alpha**2))
    for _ in range(KEPLER_STEPS):
        theta += (alpha * np.cos(theta) - theta) / (1 + alpha * np.sin(theta))
    sine, cosine = np.sin(theta), np.cos(theta)
    product = alpha * cosine
    residual = (product - theta) + _product_error(alpha, cosine, product)
    correction = residual / (1 + alpha * sine) * cosine
    head = sine + correction
    return head, (sine - head) + correction


def _product_error(a: Array, b: Array, product: Array) -> Array:
    """a*b - product without rounding (Dekker), for |a|, |b| <= 1: halves of 26 bits."""

    def halves(x: Array) -> tuple[Array, Array]:
        shifted = 134217729.0 * x  # 2**27 + 1
        upper = shifted - (shifted - x)
        return upper, x - upper

    (a1, a2), (b1, b2) = halves(a), halves(b)
    return ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2


def _printed_angle(strength: Array) -> Array:
    """y >= 0 with y = |alpha| sqrt(cos 2y): eq. 8 as printed with q = -sin(y).

    y - strength*sqrt(cos 2y) is convex and increasing, so Newton converges from either side.
    """
    y = strength / np.sqrt(1 + 2 * strength**2)
    for _ in range(PRINTED_STEPS):
        root = np.sqrt(np.cos(2 * y))
        y -= (y - strength * root) / (1 + strength * np.sin(2 * y) / root)
    return np.asarray(y)


def _narrow_level(strength: Array, width: Array) -> Array:
    """q = nTV/alpha for a small slip speed: the dry balance smoothed by sech^2/2.

    tanh(x/s) is sgn(x - s z) averaged over z with weight sech(z)^2/2, and sgn gives the closed
    form: int sech(z)^2 [theta(q + s z) - alpha cos theta(q + s z)] dz = 0, sin(theta(p)) = p. The
    pair +-z is combined by tan((A - B)/2) = (sin A - sin B)/(cos A + cos B). The trapezoidal rule with
    step 1/4 is exact to 1e-16 here: the poles of sech^2 are at distance pi/2.
    """
    z = 0.25 * np.arange(77.0)
    weight = np.cosh(z) ** -2.0
    weight[0] /= 2

    def balance(q: Array) -> tuple[Array, Array]:
        up, down = q[:, None] + width[:, None] * z, q[:, None] - width[:, None] * z
        cos_up, cos_down = np.sqrt(1 - up**2), np.sqrt(1 - down**2)
        cosines = cos_up + cos_down
        value = 2 * np.arctan(2 * q[:, None] / cosines) - strength[:, None] * cosines
        slope = 1 / cos_up + 1 / cos_down + strength[:, None] * (up / cos_up + down / cos_down)
        return value @ weight, slope @ weight

    dry = np.sin(strength * (1 - strength**2 * (0.5 - 0.24 * strength**2)))
    return bracketed_newton(balance, 0.0, 0.7391, dry)


def _wide_level(strength: Array, width: Array) -> Array:
    """q = nTV/alpha for a slip speed that is not small: trapezoidal rule in phi.

    The pair +-phi combined, with a = sin(phi), X = q/s, A = a/s:
    mean of (sinh 2X - alpha a sinh 2A)/(cosh 2X + cosh 2A) = 0. Both terms are divided by 2/s, so
    that nothing underflows as s -> infinity. s >= NARROW keeps cosh(2/s) far from overflow.
    """
    points = _trapezoid_points(float(width.min()))
    a = np.sin(np.pi / 2 * (np.arange(points) + 0.5) / points)
    double = 2 / width[:, None]
    stretch = strength[:, None] * a**2 * _sinhc(double * a)
    cosh = np.cosh(double * a)

    def balance(q: Array) -> tuple[Array, Array]:
        x = double * q[:, None]
        total = cosh + np.cosh(x)
        value = (q[:, None] * _sinhc(x) - stretch) / total
        slope = (np.cosh(x) - double * np.sinh(x) * value) / total
        return value.mean(axis=1), slope.mean(axis=1)

    return bracketed_newton(balance, 0.0, 1.0, 0.7 * strength)


def _trapezoid_points(width: float) -> int:
    """Points on a quarter of the period for 1e-16: the poles are at Im phi >= asinh(pi s/2)."""
    return max(8, math.ceil(40 / (4 * math.asinh(min(width, 10.0) * math.pi / 2))))


def _sinhc(x: Array) -> Array:
    """sinh(x)/x for x >= 0."""
    x = np.maximum(x, 1e-300)
    return np.asarray(np.sinh(x) / x)

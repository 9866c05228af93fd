"""Slow, literal second implementations of the one-dimensional theory, most of them in mpmath."""

import math

import mpmath as mp
import numpy as np
from scipy import special

DIGITS = 50


def kepler_sine(alpha):
    """sin(theta) of theta = alpha cos(theta), by Newton from a double to 50 digits."""
    with mp.workdps(DIGITS):
        alpha = mp.mpf(float(alpha))
        theta = alpha / mp.sqrt(1 + alpha**2)
        for _ in range(9):  # each step doubles the digits
            theta -= (theta - alpha * mp.cos(theta)) / (1 + alpha * mp.sin(theta))
        return mp.sin(theta)


def kapteyn_terms(alpha, accuracy):
    """Terms of the Kapteyn series for that absolute accuracy of sin(theta).

    |J'_k(k a)| <= z^k/a, z = a exp(r)/(1 + r), r = sqrt(1 - a^2), so the terms fall like z^2.
    """
    r = math.sqrt(1 - alpha**2)
    log_z = math.log(abs(alpha)) + r - math.log1p(r)
    return max(1, math.ceil(math.log(accuracy * -log_z * abs(alpha)) / (2 * log_z)))


def kapteyn_sine(alpha, terms):
    """sin(theta) = cos(E), E - e sin(E) = pi/2, e = -alpha, as a Kapteyn series in Bessel functions.

    cos(E) = -e/2 + sum_k (2/k) J'_k(k e) cos(k pi/2): alpha/2 - sum_j (-1)^j/j J'_2j(2 j alpha).
    """
    j = np.arange(1, terms + 1)
    return alpha / 2 - math.fsum((-1.0) ** j / j * special.jvp(2 * j, 2 * j * alpha))


def tanh_level(alpha, width):
    """q with int (1 + alpha sin phi) tanh((q - sin phi)/width) dphi = 0, by adaptive quadrature."""
    with mp.workdps(20 + max(0, -math.floor(math.log10(alpha)))):  # q ~ alpha is a difference
        alpha, width = mp.mpf(alpha), mp.mpf(width)

        def balance(q):
            turn = mp.asin(min(mp.mpf(1), max(mp.mpf(-1), q)))
            ladder = [width * 4**k for k in range(-2, 40) if width * 4**k < 1]
            cuts = {-mp.pi / 2, mp.pi / 2, turn}
            cuts |= {turn + s * d for d in ladder for s in (-1, 1) if abs(turn + s * d) < mp.pi / 2}
            return mp.quad(
                lambda phi: (1 + alpha * mp.sin(phi)) * mp.tanh((q - mp.sin(phi)) / width), sorted(cuts)
            )

        return mp.findroot(balance, (alpha / 2, alpha * 0.9), tol=1e-30, verify=False)


def travelling_level(wave, alpha, grows, guess):
    """Weighted median m - mean of a travelling wave's profile to 30 digits, near a guess."""
    with mp.workdps(30):
        grid = np.linspace(0, 2 * np.pi, 4001)  # must tell any two crossings apart
        values = wave.profile(grid) - wave.mean
        p, q = [list(map(mp.mpf, map(float, a))) for a in (wave.cosine, wave.sine)]
        slope_weight = mp.mpf(alpha) if grows else mp.mpf(0)

        def series(phi, order):
            """Antiderivative (-1), value (0) or slope (1) of c - mean."""
            total = mp.mpf(0)
            for k, (a, b) in enumerate(zip(p, q, strict=True), 1):
                c, s = mp.cos(k * phi), mp.sin(k * phi)
                total += {-1: (a * s - b * c) / k, 0: a * c + b * s, 1: k * (b * c - a * s)}[order]
            return total

        def crossing(phi, level):
            for _ in range(5):
                phi -= (series(phi, 0) - level) / series(phi, 1)
            return phi

        def balance(level):
            """int w sgn(m - g) = (weight below) - (weight above)."""
            below = values < float(level)
            places = np.flatnonzero(below[1:] != below[:-1])
            total = (1 if below[0] else -1) * 2 * mp.pi * (1 + slope_weight * mp.mpf(wave.mean))
            for i in places:
                phi = crossing(mp.mpf(float(grid[i] + grid[i + 1]) / 2), level)
                left = 2 * mp.pi - phi  # from here on the sign is the other one
                weight = (1 + slope_weight * mp.mpf(wave.mean)) * left
                weight += slope_weight * (series(2 * mp.pi, -1) - series(phi, -1))
                total += (-2 if below[i] else 2) * weight
            return total

        start = mp.mpf(float(guess))
        return mp.findroot(balance, (start, start + mp.mpf("1e-9")), tol=1e-44, verify=False)


def force(wave, alpha, speed, time=0.0, cells=40000, velocity_sign=1.0):
    """Net dry friction of eq. 7, integrated as printed from eqs 5 and 6 on a grid of S.

    velocity_sign = -1 turns v_cm round, as the paper's formula for the sine does.
    """
    y = (np.arange(cells) + 0.5) / cells - 0.5
    rate = alpha * wave.rate(0.0, y, time)
    velocity = (np.cumsum(rate) - rate / 2) / cells
    velocity = velocity_sign * (velocity - velocity.mean())
    return -float(np.mean((1 + alpha * wave.value(0.0, y, time)) * np.sign(velocity + speed)))


def dissipation_minimum(velocity, weight):
    """V that makes sum weight |velocity + V| least, by trying every kink of this convex function."""
    loss = [np.sum(weight * abs(velocity - v)) for v in velocity]
    return -velocity[int(np.argmin(loss))]

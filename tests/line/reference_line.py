"""Slow, literal second implementations of the one-dimensional theory, most of them in mpmath."""

import itertools
import math
from typing import ClassVar

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


class FiniteStrain:
    """Speeds of a travelling wave at finite strain, summed literally in mpmath over one period.

    The period is cut into panels that shrink towards the phase of least sign*c, next to which the
    stretch may nearly vanish; each has Gauss points for 50 digits.
    """

    STRETCHES: ClassVar = {
        "exp": (mp.exp, mp.log, mp.exp),
        "linear": (lambda e: 1 + e, lambda s: s - 1, lambda e: mp.mpf(1)),
        "metric": (
            lambda e: mp.sqrt(1 + 2 * e),
            lambda s: (s * s - 1) / 2,
            lambda e: 1 / mp.sqrt(1 + 2 * e),
        ),
    }  # s(e), its inverse and its derivative

    def __init__(self, wave, sign=1, panels=16, points=32, ladder=12):
        self.wave, self.kept = wave, (None, None)
        with mp.workdps(DIGITS):
            self.amplitudes = [
                mp.mpc(float(p), -float(q)) for p, q in zip(wave.cosine, wave.sine, strict=True)
            ]
            nodes, weights = self._gauss(points)
            self.rule = list(zip(nodes, weights, strict=True))
            grid = np.linspace(0, 2 * np.pi, 20001)
            start = mp.mpf(float(grid[np.argmin(sign * wave.profile(grid))]))
            least = mp.findroot(self.slope, start, verify=False)  # a flat one need not be exact
            steps = [2 * mp.pi / panels * mp.mpf(2) ** -k for k in range(ladder)]
            ends = {least + 2 * mp.pi * k / panels for k in range(panels + 1)}
            ends |= {least + h for h in steps} | {least + 2 * mp.pi - h for h in steps}
            ends = sorted(ends)
            self.panels = list(itertools.pairwise(ends))
            self.values = [self._on(*panel) for panel in self.panels]

    @staticmethod
    def _gauss(points):
        """Nodes and weights on (0, 1): Newton from doubles."""
        nodes, weights = [], []
        for x in np.polynomial.legendre.leggauss(points)[0]:
            x = mp.mpf(float(x))
            for _ in range(3):
                before, here = mp.mpf(1), x
                for k in range(1, points):
                    before, here = here, ((2 * k + 1) * x * here - k * before) / (k + 1)
                slope = points * (x * here - before) / (x * x - 1)
                x -= here / slope
            nodes.append((1 + x) / 2)
            weights.append(1 / ((1 - x * x) * slope**2))
        return nodes, weights

    def growth(self, phi):
        z = mp.expj(phi)
        total = mp.mpc(0)
        for a in reversed(self.amplitudes):
            total = (total + a) * z
        return mp.mpf(float(self.wave.mean)) + total.real

    def slope(self, phi):
        z = mp.expj(phi)
        return sum((1j * k * a * z**k).real for k, a in enumerate(self.amplitudes, 1))

    def _on(self, left, right):
        """(weight, c) at the Gauss points between two phases."""
        return [(w * (right - left), self.growth(left + x * (right - left))) for x, w in self.rule]

    def speed(self, alpha, growth_law, power, width=0, guess=0.0):
        """nTV for a slip speed width/(nT), 0 dry, inf viscous. Newton's method from a guess."""
        with mp.workdps(DIGITS):
            alpha, width = mp.mpf(float(alpha)), mp.mpf(width)
            stretch, inverse, rate = self.STRETCHES[growth_law]
            table, mean = self._stretches(alpha, growth_law)
            flat = [(w * s**power, s - mean) for panel in table for w, s in panel]
            if mp.isinf(width):
                return sum(w * v for w, v in flat) / sum(w for w, v in flat)
            speed = mp.mpf(float(guess))
            while True:
                if width:
                    t = [(w, mp.tanh((speed - v) / width)) for w, v in flat]
                    value = sum(w * x for w, x in t)
                    slope = sum(w * (1 - x * x) for w, x in t) / width
                else:
                    level = inverse(speed + mean) / alpha
                    value, arcs = self._sign_integral(table, level, alpha, stretch, power)
                    slope = (
                        2 * stretch(alpha * level) ** power / rate(alpha * level) * arcs / abs(alpha)
                    )
                step = value / slope
                speed -= step
                if abs(step) <= mp.mpf("1e-12") * abs(speed) + mp.mpf("1e-40"):  # the next: its square
                    return speed

    def _stretches(self, alpha, growth_law):
        """(weight, s) at all points, and the mean of s; kept, as loads and frictions come in turn."""
        if self.kept[0] != (alpha, growth_law):
            stretch = self.STRETCHES[growth_law][0]
            table = [[(w, stretch(alpha * c)) for w, c in panel] for panel in self.values]
            mean = sum(w * s for panel in table for w, s in panel) / (2 * mp.pi)
            self.kept = (alpha, growth_law), (table, mean)
        return self.kept[1]

    def _sign_integral(self, table, level, alpha, stretch, power):
        """int w sgn(level - c) (sgn turned round for alpha < 0), and the sum of 1/|dc/dphi|."""
        total, arcs, turn = mp.mpf(0), mp.mpf(0), mp.sign(alpha)
        for (left, right), panel, values in zip(self.panels, table, self.values, strict=True):
            places = [left, *(left + x * (right - left) for x, _ in self.rule), right]
            ends = self.growth(left), self.growth(right)
            below = [c < level for c in (ends[0], *(c for _, c in values), ends[1])]
            if all(below) or not any(below):
                total += turn * (1 if below[0] else -1) * sum(w * s**power for w, s in panel)
                continue
            cuts = [left]
            for k in range(len(below) - 1):
                if below[k] != below[k + 1]:
                    phi = (places[k] + places[k + 1]) / 2
                    for _ in range(7):
                        phi -= (self.growth(phi) - level) / self.slope(phi)
                    cuts.append(phi)
                    arcs += 1 / abs(self.slope(phi))
            cuts.append(right)
            sign = 1 if below[0] else -1
            for a, b in itertools.pairwise(cuts):
                total += turn * sign * sum(w * stretch(alpha * c) ** power for w, c in self._on(a, b))
                sign = -sign
        return total, arcs


def finite_velocity(wave, alpha, stretch, power, time, cells, step=1e-5):
    """Velocity less its mean and weight at the middles of cells, from the positions x = int s dS."""
    y = (np.arange(cells) + 0.5) / cells - 0.5

    def position(t):
        s = stretch(alpha * wave.value(0.0, y, t)) / cells
        return np.cumsum(s) - s / 2

    velocity = (position(time + step) - position(time - step)) / (2 * step)
    return velocity - velocity.mean(), stretch(alpha * wave.value(0.0, y, time)) ** power

"""A strip on its linearised ground in one dimension, exactly, and its speed to second order in beta.

Euler and Bernoulli's beam of length 1 under a sine c = sin k(y - t), k = 2 pi, period 1:

    B w'''' + s w = -B c'',   w'' = -c and w''' = -c' at both ends,   p = -s w/(rho g).

w = cos(kt) w_s - sin(kt) w_c, with w_s and w_c due to sin ky and cos ky: each a multiple of these and
four exponentials. By growth the strip slips with v = -sin k(y - t), by bending with beta^2 du/dt,

    u' = -w'^2/2 - (h^2/12) (M w')',   M = w'' + c,

up to a rigid motion. Under viscous friction V_ab = -<p v>, V_bb = 0. A law f(v) counts the first
harmonic of f in V_ab and the second of df/dv in V_bb. Dry friction acts at the points without slip,
y = t and y = t + 1/2: twice the viscous V_ab, and V_bb = - int du/dt dy at t = y.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

K = 2 * np.pi

NODES, WEIGHTS = (a / 2 for a in np.polynomial.legendre.leggauss(600))
"""Of an integral over the strip; dense at its ends."""


@dataclass(frozen=True)
class Strip:
    """rigidity: B, force times length^2 per width; spring: s; weight: rho g; thickness: h."""

    rigidity: float
    spring: float
    weight: float
    thickness: float

    @property
    def layer(self) -> float:
        """l = (B/s)^(1/4)."""
        return float((self.rigidity / self.spring) ** 0.25)

    def shapes(self, y: Array, order: int = 0) -> Array:
        """Derivatives of w_s and w_c, (2, points)."""
        return self._share * _waves(y, order) + self._amplitudes @ self._exponentials(y, order)

    def deflection(self, y: Array, t: float) -> Array:
        """w at a time, (points,)."""
        return np.asarray(np.cos(K * t) * self.shapes(y)[0] - np.sin(K * t) * self.shapes(y)[1])

    @property
    def lift_off(self) -> float:
        """The beta at which the pressure vanishes at some point and time."""
        size = np.hypot(*self.shapes(np.linspace(-0.5, 0.5, 2001)))  # at the worst time
        return float(self.weight / (self.spring * size.max()))

    def mixed(self) -> float:
        """V_ab under viscous friction, (s/rho g) <w v>, L^2/T."""
        together = (self.shapes(NODES) * _waves(NODES, 0)).sum(0) @ WEIGHTS
        return float(-self.spring / self.weight * together / 2)

    def bent(self) -> float:
        """V_bb under dry friction, L^3/T; the shortening integrated by parts."""
        slope, moment = self.shapes(NODES, 1), self.shapes(NODES, 2) + _waves(NODES, 0)
        sine, cosine = np.sin(2 * K * NODES), np.cos(2 * K * NODES)
        shortened = (slope[0] ** 2 - slope[1] ** 2) * (1 - cosine) / 2 + slope[0] * slope[1] * sine
        turned = sine * (moment[0] * slope[0] - moment[1] * slope[1])
        turned += cosine * (moment[0] * slope[1] + moment[1] * slope[0])
        return float((shortened / 2 - self.thickness**2 / 12 * K * turned) @ WEIGHTS)

    @property
    def _share(self) -> float:
        """Of c in w where no end is near."""
        return self.rigidity * K**2 / (self.rigidity * K**4 + self.spring)

    def _exponentials(self, y: Array, order: int) -> Array:
        """Derivatives of the solutions of B w'''' + s w = 0, two from each end, (4, points)."""
        rate = np.exp(0.75j * np.pi) / self.layer
        right, left = ((sign * rate) ** order * np.exp(rate * (0.5 + sign * y)) for sign in (-1, 1))
        return np.stack([right.real, right.imag, left.real, left.imag])

    @cached_property
    def _amplitudes(self) -> Array:
        """Of the exponentials in w_s and w_c, (2, 4): moment and shear vanish at both ends."""
        ends = np.array([-0.5, 0.5])
        rows, given = [], []
        for n in (2, 3):
            scale = self.layer**n
            rows.append(scale * self._exponentials(ends, n))
            given.append(scale * (self._share * _waves(ends, n) + _waves(ends, n - 2)))
        return -np.linalg.solve(np.concatenate(rows, 1).T, np.concatenate(given, 1).T).T


def _waves(y: Array, order: int) -> Array:
    """Derivatives of sin ky and cos ky, (2, points)."""
    return np.stack([K**order * np.sin(K * y + (order + phase) * np.pi / 2) for phase in (0, 1)])

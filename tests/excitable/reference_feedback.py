"""A slow, literal rod whose strain acts back on its wave: cells, differences, and scipy's integrator.

Poisson ratio 0 and a narrow rod: its width grows freely by exp(alpha c), and eq. 1a leaves the tension
N = (h/2) s (s²/g - 1) at a stretch s, per width, with g = exp(2 alpha c). Friction balances its
differences, mu p tanh(v/v0) = dN/dS, so that v follows from the shape: all of it is one system of
ordinary differential equations.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rod:
    """Of length 1. numbers: threshold, recovery decay and rate, diffusion length, feedback."""

    numbers: tuple[float, float, float, float, float]
    alpha: float
    thickness: float
    weight: float
    slip_speed: float
    ramp: Callable[[float], float]
    cells: int

    def end(self, until: float) -> tuple[Array, Array, float]:
        """Places and c of the cells, and the place of the centre, from c = s²/(1 + s²) on."""
        n, s = self.cells, (np.arange(self.cells) + 0.5) / self.cells
        start = np.concatenate([s**2 / (1 + s**2), np.zeros(n), np.linspace(0, 1, n + 1)])
        found = solve_ivp(self.rates, (0, until), start, "BDF", rtol=1e-6, atol=1e-8)
        y = found.y[2 * n :, -1]
        share = np.full(n + 1, 1 / n)
        share[[0, -1]] /= 2
        return s, found.y[:n, -1], float(share @ y - 0.5)

    def rates(self, t: float, u: Array) -> Array:
        n, (threshold, decay, rate, length, feedback) = self.cells, self.numbers
        c, w, y = u[:n], u[n : 2 * n], u[2 * n :]
        stretch, grown = np.diff(y) * n, np.exp(self.alpha * self.ramp(t) * c)
        wide = np.concatenate([c[:1], c, c[-1:]])
        spread = length**2 * (wide[2:] - 2 * c + wide[:-2]) * n**2
        strain = np.log(stretch * grown)
        dc = spread + c * (1 - c) * (c - threshold) - w + feedback * strain
        tension = self.thickness / 2 * stretch * ((stretch / grown) ** 2 - 1)
        force = np.diff(np.concatenate([[0.0], tension, [0.0]]))
        force[[0, -1]] *= 2  # of half a cell
        share = np.clip(force * n / self.weight, -1 + 1e-12, 1 - 1e-12)
        return np.concatenate([dc, rate * (c - decay * w), self.slip_speed * np.arctanh(share)])

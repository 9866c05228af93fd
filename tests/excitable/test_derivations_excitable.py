"""Eq. 12 near rest, proved: how fast waves grow, and the amplitude at which growth ends.

c_t = gamma^2 c_yy + f(c) - w, w_t = epsilon (c - kappa w), f = c(1 - c)(c - nu).
"""

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

C, PHASE = sp.symbols("c s", real=True)
NU, KAPPA, EPSILON, GAMMA, K, A = sp.symbols("nu kappa epsilon gamma k A", positive=True)
REACTION = C * (1 - C) * (C - NU)


def growth_rate():
    """Mean of both rates of exp(iky): the real part of each while they are complex."""
    at_rest = sp.diff(REACTION, C).subs(C, 0)
    matrix = sp.Matrix([[at_rest - GAMMA**2 * K**2, -1], [EPSILON, -EPSILON * KAPPA]])
    return matrix.trace() / 2


def work_of_a_cycle():
    """Of the reaction on c = A cos s, over A^2: kappa = 0 makes c_tt + epsilon c = f'(c) c_t.

    The energy (c_t^2 + epsilon c^2)/2 changes by the integral of f'(c) c_t^2, c_t prop -A sin s.
    """
    slope = sp.diff(REACTION, C).subs(C, A * sp.cos(PHASE))
    return sp.expand(sp.integrate(sp.expand(slope * sp.sin(PHASE) ** 2), (PHASE, 0, 2 * sp.pi)))


def amplitude_squared():
    """At which that work vanishes."""
    (root,) = sp.solve(work_of_a_cycle().subs(A, sp.sqrt(C)), C)
    return root


def test_work_has_the_amplitude_of_the_text():
    assert sp.simplify(amplitude_squared() + 4 * NU / 3) == 0


def test_rates_are_those_of_the_linear_equation():
    values = {NU: -0.02, KAPPA: 0.3, EPSILON: 0.05, GAMMA: 0.02, K: 4.0}
    nu, kappa, epsilon, gamma, k = (float(x) for x in values.values())
    matrix = np.array([[-nu - gamma**2 * k**2, -1.0], [epsilon, -epsilon * kappa]])
    rates = np.linalg.eigvals(matrix)
    assert rates.imag.any()
    assert float(growth_rate().subs(values)) == pytest.approx(rates.real[0], rel=1e-12)


def swing(nu, epsilon=0.05):
    """Amplitude of the oscillation of c over that of the text, solved in time."""

    def rate(_, z):
        c, w = z
        return [c * (1 - c) * (c - nu) - w, epsilon * c]

    expected = 2 * np.sqrt(-nu / 3)
    times = np.linspace(6 / -nu, 6 / -nu + 60, 2000)  # what is left of the start decays with -nu
    found = solve_ivp(rate, (0, times[-1]), [expected, 0.0], "LSODA", times, rtol=1e-8, atol=1e-11)
    return np.ptp(found.y[0]) / 2 / expected


def test_small_oscillations_have_that_amplitude():
    # the next term is of relative order nu/epsilon, and drops out between the two
    one, half = swing(-0.004), swing(-0.002)
    assert abs(half - 1) < abs(one - 1)
    assert 2 * half - one == pytest.approx(1, abs=1e-3)

"""Functions of `linear_theory.special` against mpmath with 50 digits."""

import mpmath as mp
import numpy as np
import pytest

from linear_theory.deformation.airy import special
from linear_theory.deformation.airy.dilogarithm import dilogarithm

mp.mp.dps = 50


def relative(value, exact):
    return abs(mp.mpf(float(value)) / exact - 1)


@pytest.mark.parametrize("x", [1e-8, 1e-3, 0.3, 0.999, 1.001, 5.0, 40.0, 700.0])
def test_one_plus_x_over_sinh_keeps_its_digits_where_it_vanishes(x):
    # just above x = 1 the difference cancels most, to 0.15: 7 ulp
    exact = 1 - mp.mpf(x) / mp.sinh(mp.mpf(x))
    assert relative(special.one_plus_x_over_sinh(np.array([x]), np.array([-1.0]))[0], exact) < 1.6e-15


@pytest.mark.parametrize("x", [1e-8, 0.3, 5.0, 40.0, 700.0])
def test_x_over_sinh(x):
    # exp(-x) alone costs x ulp/2 of relative accuracy, since x is a rounded number
    exact = mp.mpf(x) / mp.sinh(mp.mpf(x))
    assert relative(special.x_over_sinh(np.array([x]))[0], exact) < 4e-16 + 1.2e-16 * x


def test_x_over_sinh_underflows_to_zero():
    assert special.x_over_sinh(np.array([1e4]))[0] == 0.0


def quartic_sum(b, start):
    """By partial fractions: sum 1/(z^2 + b^2)^2 with complex polygamma functions."""
    b, z = mp.mpf(b), mp.mpf(start) + mp.mpf(1) / 2
    plus, minus = z + 1j * b, z - 1j * b
    squares = -(mp.psi(1, minus) + mp.psi(1, plus)) / (4 * b**2)
    poles = 1j / (4 * b**3) * (mp.psi(0, minus) - mp.psi(0, plus))
    return (squares + poles).real


# the bounds stated in the docstring
@pytest.mark.parametrize(("start", "bound"), [(3.0, 2e-5), (5.0, 2e-8), (10.5, 1e-12), (20.0, 1e-15)])
@pytest.mark.parametrize("b", [1e-3, 0.1, 1.0, 7.0, 300.0])
def test_inverse_quartic_sum(b, start, bound):
    value = special.inverse_quartic_sum(np.array([b]), np.array([start]))[0]
    assert relative(value, quartic_sum(b, start)) < bound


def test_dilogarithm_in_the_half_plane_and_at_its_corners():
    random = np.random.default_rng(4)
    size, turn = 10 ** random.uniform(-9, 1.3, 30), random.uniform(-np.pi, np.pi, 30)
    corners = [1e-300 + 1e-300j, 1e-300 + 1j * np.pi, 1j * np.pi / 3, np.log(2), 40.0]
    z = np.concatenate([size + 1j * turn, size * np.exp(1j * turn / 2), corners])
    z = z[abs(z.imag) <= np.pi]
    found = dilogarithm(z, -np.expm1(-z))
    exact = [complex(mp.polylog(2, mp.exp(-mp.mpc(one)))) for one in z]
    assert abs(found - exact).max() < 1e-15

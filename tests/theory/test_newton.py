"""Many zeros at once: few evaluations, also where the zero is met to the last digit."""

import numpy as np
import pytest

from linear_theory.balance.newton import damped_newton, guarded_newton


class Counted:
    """A function of numbered variables that counts how often it is asked."""

    def __init__(self, function):
        self.function, self.evaluations = function, 0

    def __call__(self, x, which):
        self.evaluations += 1
        return self.function(x, which)


def test_a_linear_function_takes_two_evaluations():
    """The second finds a remainder of roundoff, for which the end of the bracket must not be left."""
    zeros = np.linspace(-1, 1, 101) / 3
    problem = Counted(lambda x, which: ((x - zeros[which]) * 0.7 + 1e-20, np.full(x.size, 0.7)))
    start = np.full(zeros.size, 0.9)
    found = guarded_newton(problem, start, np.full(101, -1e9), np.full(101, 1e9), 1e-18)
    np.testing.assert_allclose(found, zeros, atol=3e-16)  # roundoff of start
    assert problem.evaluations <= 4


def test_a_jump_is_found():
    problem = Counted(lambda x, which: (np.sign(x - 0.3) + 0.01 * (x - 0.3), np.full(x.size, 0.01)))
    found = guarded_newton(problem, np.array([0.9]), np.array([-1.0]), np.array([1.0]), 1e-12)
    assert found[0] == pytest.approx(0.3, abs=2e-12)


def test_infinite_slope_does_not_count_as_found():
    def root(x, which):
        return np.sign(x) * abs(x) ** 0.5 - 0.1, np.where(x == 0, np.inf, 0.5 / abs(x + 1e-300) ** 0.5)

    found = guarded_newton(root, np.array([0.0]), np.array([-1.0]), np.array([1.0]), 1e-10)
    assert found[0] == pytest.approx(0.01, abs=1e-9)


@pytest.mark.parametrize("near", [0.0, 1e-4])
def test_near_steps_end_where_newton_converges_quadratically(near):
    """x^2 = 2: an error e leaves e^2/(2 sqrt(2)), 4e-9 after a step of near."""
    problem = Counted(lambda x, which: (x * x - 2, 2 * x))
    found = guarded_newton(problem, np.array([1.5]), np.array([1.0]), np.array([2.0]), 1e-9, near)
    assert abs(found[0] - np.sqrt(2)) < 1e-9
    gradient = Counted(lambda x, which: (x * x - 2, 2 * x[:, :, None]))
    damped = damped_newton(gradient, np.array([[1.5]]), 1e-9, near)
    assert abs(damped[0, 0] - np.sqrt(2)) < 1e-9
    assert problem.evaluations == gradient.evaluations == (4 if near == 0 else 3)

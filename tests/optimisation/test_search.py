"""The search and its certificate on problems whose answers are known."""

import numpy as np
import pytest

from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.certificate import certificate
from linear_theory.optimisation.differences import Differences
from linear_theory.optimisation.problem import Ball, Evaluation, Linear, Region, Unusable
from linear_theory.optimisation.search import Ascent, climb
from linear_theory.optimisation.starts import starts

NAMES = ("a", "b")


def region(*constraints, low=-1.0, high=1.0, unknowns=2):
    ones = np.ones(unknowns)
    return Region(low * ones, high * ones, 0 * ones, 0.9 * ones, constraints)


def smooth(function, gradient):
    return lambda p: Evaluation(function(p), 0.0, gradient(p), np.zeros(p.size))


QUADRATIC = np.array([[-2.0, 0.5], [0.5, -1.0]])
TOP = np.array([0.3, -0.2])
hill = smooth(lambda p: 1 + (p - TOP) @ QUADRATIC @ (p - TOP) / 2, lambda p: QUADRATIC @ (p - TOP))
slope = smooth(lambda p: 2 * p[0] + p[1], lambda p: np.array([2.0, 1.0]))
saddle = smooth(lambda p: 1 + p[0] ** 2 - p[1] ** 2, lambda p: np.array([2 * p[0], -2 * p[1]]))


@pytest.mark.parametrize("method", ["SLSQP", "trust-constr"])
def test_a_hill_has_its_top_found_and_certified(method):
    for start in starts(region(), 3, seed=1):
        found = climb([hill], hill, region(), start, Ascent(method))
        np.testing.assert_allclose(found.point, TOP, atol=1e-3)
    proof = certificate(hill, region(), TOP, NAMES)
    assert proof.holds(1e-8)
    assert proof.highest == pytest.approx(np.linalg.eigvalsh(QUADRATIC)[-1], rel=1e-6)


def test_what_is_left_is_said():
    """Of a quadratic the gain that is left is exact, at any point."""
    for point in np.random.default_rng(0).uniform(-0.5, 0.5, size=(5, 2)):
        proof = certificate(hill, region(), point, NAMES)
        assert proof.gain == pytest.approx(1 - proof.value, rel=1e-4)
        assert not proof.holds(0.5 * proof.gain / proof.value)


def test_a_saddle_is_no_maximum():
    proof = certificate(saddle, region(), np.zeros(2), NAMES)
    assert proof.slope == 0
    assert proof.highest == pytest.approx(2.0)
    assert not proof.holds(0.1)
    assert certificate(saddle, region(), np.array([1.0, 0.0]), NAMES).holds(1e-6)  # at a bound it is


def test_bounds_and_constraints_hold_a_point():
    """The largest of 2 a + b: a corner; on a disc of radius 1/2 its edge, which curves."""
    corner = climb([slope], slope, region(), np.zeros(2), Ascent())
    proof = certificate(slope, region(), corner.point, NAMES)
    assert proof.held == ("upper bound of a", "upper bound of b")
    np.testing.assert_allclose(proof.multipliers, [2, 1])
    disc = region(Ball("size", np.ones(2), 0.25))
    edge = climb([slope], slope, disc, np.array([0.1, -0.3]), Ascent())
    assert edge.value == pytest.approx(np.sqrt(5) / 2, rel=1e-6)
    assert certificate(slope, disc, edge.point, NAMES).holds(1e-4)
    wrong = np.array([0.5, 0.0])  # also on the edge
    assert not certificate(slope, disc, wrong, NAMES).holds(0.05)
    line = region(Linear("sum", np.ones((1, 2)), np.array([0.3])))
    found = climb([slope], slope, line, np.zeros(2), Ascent())
    np.testing.assert_allclose(found.point, [1.0, -0.7], atol=1e-6)


def test_errors_of_differences_are_honest():
    """Against the exact gradient of random smooth functions, at points next to bounds, too."""
    random, worst = np.random.default_rng(2), 0.0
    for _ in range(40):
        k, phase = random.uniform(0.3, 2, size=(3, 2)), random.uniform(0, 6, size=3)
        noise = 10.0 ** random.uniform(-8, -3)

        def value(p, k=k, phase=phase, noise=noise):
            return Estimate(np.sin(k @ p + phase).sum() + noise * np.sin(1e6 * p.sum()) / 2, noise)

        point = random.choice([-1.0, 0.0, 0.99, 0.4], size=2)
        found = Differences(value, region(), careful=True)(point)
        exact = np.cos(k @ point + phase) @ k
        worst = max(worst, float((abs(found.gradient - exact) / found.doubt).max()))
    assert worst < 1.0, worst


def test_a_start_that_leaves_the_reach_keeps_its_best():
    def partly(p):
        if p[0] > 0.5:
            raise Unusable("a is above 0.5")
        return slope(p)

    found = climb([partly], partly, region(), np.zeros(2), Ascent())
    assert found.words == "left the reach: a is above 0.5"
    assert found.value >= 0


def test_bounds_that_leave_nothing_are_refused_by_name():
    with pytest.raises(ValueError, match="constraints: no point meets 'sum'"):
        region(Linear("sum", np.ones((1, 2)), np.array([-3.0])))
    with pytest.raises(ValueError, match="bounds of unknown 0: 1 must be < -1"):
        region(low=1.0, high=-1.0)
    with pytest.raises(ValueError, match="method = 'newton': must be one of 'SLSQP'"):
        Ascent("newton")


def hidden_hill(random, unknowns, doubt):
    """A random concave quadratic whose gradients are off by up to the doubt, anew each time."""
    root, top = random.normal(size=(unknowns, unknowns)), random.uniform(-0.6, 0.6, unknowns)
    curved = -root @ root.T - 0.1 * np.eye(unknowns)

    def evaluated(p):
        off = doubt * random.uniform(-1, 1, unknowns)
        value = 1 + (p - top) @ curved @ (p - top) / 2
        return Evaluation(value, 0.0, curved @ (p - top) + off, np.full(unknowns, doubt))

    return evaluated, top


def test_no_gain_is_understated_whatever_the_errors_of_the_gradient():
    random = np.random.default_rng(3)
    for number in range(300):
        unknowns = 1 + number % 3
        hill, top = hidden_hill(random, unknowns, 10 ** random.uniform(-4, 0))
        point = np.clip(top + random.normal(size=unknowns) * 0.1, -0.9, 0.9)
        names = "abc"[:unknowns]
        proof = certificate(hill, region(unknowns=unknowns), point, names)
        assert proof.gain >= 0.999 * (1 - proof.value), number


def test_a_kink_with_a_large_error_of_the_gradient_is_no_maximum():
    """Of 1 + 0.15 a, whose gradient is told to be -0.7 sign(a), with an error that admits 0.15."""

    def told(p):
        return Evaluation(1 + 0.15 * p[0], 0.0, -0.7 * np.sign(p), np.full(1, 0.85))

    proof = certificate(told, region(unknowns=1), np.zeros(1), ("a",))
    assert proof.highest < 0
    assert proof.gain >= 0.15
    assert not proof.holds(0.02)

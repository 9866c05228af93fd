"""Limits on computed numbers, equalities and the worst of several objectives, of known answers."""

import numpy as np
import pytest

from linear_theory.optimisation.certificate import certificate
from linear_theory.optimisation.limits import Limit, Mean, Worst
from linear_theory.optimisation.problem import Evaluation, Linear, Region
from linear_theory.optimisation.search import Ascent, climb
from linear_theory.optimisation.starts import starts

NAMES = ("a", "b")


def region(*constraints, centre=(0.0, 0.0), limits=()):
    ones = np.ones(2)
    return Region(-ones, ones, np.array(centre), 0.9 * ones, constraints, limits)


def smooth(function, gradient):
    return lambda p: Evaluation(function(p), 0.0, np.array(gradient(p)), np.zeros(2))


slope = smooth(lambda p: 2 * p[0] + p[1], lambda p: (2.0, 1.0))
square = smooth(lambda p: 1 + p @ p, lambda p: 2 * p)
DISC = Limit("1 + r^2 <= 1.25", square, bound=1.25, sign=1.0, scale=1.25)


@pytest.mark.parametrize("method", ["SLSQP", "trust-constr"])
@pytest.mark.parametrize("start", [(0.1, -0.3), (-0.9, 0.9)])
def test_a_limit_holds_and_its_multiplier_is_the_derivative_by_the_bound(method, start):
    """max 2a + b on r^2 <= s - 1 is sqrt(5 (s - 1)), whose derivative is sqrt(5/(s - 1))/2."""
    found = climb([slope], slope, region(), np.array(start), Ascent(method), limits=[[DISC], [DISC]])
    assert found.value == pytest.approx(np.sqrt(5) / 2, rel=1e-4)
    assert DISC.excess(found.point)[0] <= 0
    proof = certificate(slope, region(limits=(DISC,)), found.point, NAMES)
    assert proof.holds(2e-3)
    assert proof.held == (DISC.name,)
    assert proof.pushes[DISC.name] / DISC.scale == pytest.approx(np.sqrt(5 / 0.25) / 2, rel=1e-2)
    wrong = np.array([0.5, 0.0])
    assert not certificate(slope, region(limits=(DISC,)), wrong, NAMES).holds(0.05)


def test_a_limit_that_no_point_meets_leaves_no_value_and_says_the_nearest():
    far = Limit("1 + r^2 <= 0.5", square, bound=0.5, sign=1.0, scale=0.5)
    found = climb([slope], slope, region(), np.array([0.5, 0.2]), Ascent(), limits=[[far], [far]])
    assert found.found is None
    assert far.nearest == pytest.approx(1.0, abs=1e-3)


def test_a_feasible_corner_is_found_from_outside():
    """b >= 0.9 as a computed number, from the other end."""
    height = smooth(lambda p: p[1] ** 3, lambda p: (0.0, 3 * p[1] ** 2))
    limit = Limit("b^3 >= 0.729", height, bound=0.729, sign=-1.0, scale=0.729)
    fall = smooth(lambda p: -p[0] - p[1], lambda p: (-1.0, -1.0))
    found = climb([fall], fall, region(), np.array([0.9, -0.8]), Ascent(), limits=[[limit], [limit]])
    np.testing.assert_allclose(found.point, [-1.0, 0.9], atol=1e-4)


def test_an_equality_holds_starts_and_ends():
    """2a + b with a + b = 0.3: at a = 1; the multiplier is the derivative by 0.3."""
    line = Linear("sum", np.ones((1, 2)), np.array([0.3]), equal=True)
    kept = region(line, centre=(0.15, 0.15))
    for start in starts(kept, 4, seed=1):
        assert abs(start.sum() - 0.3) < 1e-11
        found = climb([slope], slope, kept, start, Ascent())
        np.testing.assert_allclose(found.point, [1.0, -0.7], atol=1e-6)
    proof = certificate(slope, kept, found.point, NAMES)
    assert proof.holds(1e-6)
    assert proof.pushes["sum"] == pytest.approx(1.0)
    with pytest.raises(ValueError, match="no point meets 'sum'"):
        region(line)


def test_the_worst_of_two_is_largest_where_they_cross():
    """Parabolas about (-1/2, 0) and (1/2, 0): on the axis between, by symmetry; weights 1/2 each. With
    the second one raised by 0.6 its top is nearer, at a = ((a + 1/2)^2 - (a - 1/2)^2 = -0.6)."""
    for raised, place in ((0.0, 0.0), (0.6, -0.3)):
        one = smooth(
            lambda p: 3 - (p[0] + 0.5) ** 2 - p[1] ** 2, lambda p: (-2 * (p[0] + 0.5), -2 * p[1])
        )
        other = smooth(
            lambda p, raised=raised: 3 + raised - (p[0] - 0.5) ** 2 - p[1] ** 2,
            lambda p: (-2 * (p[0] - 0.5), -2 * p[1]),
        )
        worst = Worst([one, other], ["one", "other"])
        found = climb([worst], worst, region(), np.array([0.8, 0.7]), Ascent())
        np.testing.assert_allclose(found.point, [place, 0.0], atol=2e-3)
        proof = certificate(worst, region(), found.point, NAMES)
        assert proof.value == pytest.approx(3 - (place + 0.5) ** 2, abs=1e-5)
        assert proof.holds(1e-3)
        assert proof.held == ("one", "other")
        shares = np.array([proof.pushes["one"], proof.pushes["other"]])
        np.testing.assert_allclose(shares / shares.sum(), [0.5 - place, 0.5 + place], atol=5e-3)
        assert not certificate(worst, region(), np.array([place, 0.2]), NAMES).holds(5e-3)
    mean = Mean([one, other], [0.75, 0.25])
    found = climb([mean], mean, region(), np.array([0.8, 0.7]), Ascent())
    np.testing.assert_allclose(found.point, [-0.25, 0.0], atol=1e-3)

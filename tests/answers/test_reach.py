"""How far the theories reach: coefficients, ranges and the map from the table of speeds."""

import json
import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from figures.draw import reach
from figures.measure import reach as reach_table
from figures.measure.reach import REACHES, SHARES, SPEEDS, Point
from linear_theory import Sheet, SineWave, crawl_speed, line_cycle_speed

POINTS, ROWS = SPEEDS.read(), REACHES.read()


def sheet_of(ratio, theory=None, error: float = 0.0, alphas=(0, *reach_table.ALPHAS)) -> list[Point]:
    """A sheet whose V/alpha^2 is ratio(alpha); the theory's is 1 + alpha^2 unless given."""
    theory = theory or (lambda a: 1 + a**2)
    return [Point(0.5, 0.5, a, ratio(a), error, theory(a), theory(a), ratio(0.0)) for a in alphas]


@pytest.mark.parametrize(("fourth", "sixth", "eighth"), [(-1.3, 3.0, -6.0), (0.1, 2.0, 20.0)])
def test_fourth_coefficient_of_a_series(fourth, sixth, eighth):
    def ratio(a: float) -> float:
        return 1.5 + fourth * a**2 + sixth * a**4 + eighth * a**6

    value, error = reach_table.fourth_coefficient(sheet_of(ratio))
    assert value == pytest.approx(fourth, abs=1e-9)  # three terms are fitted
    assert 0 < error < 0.5

    def longer(a: float) -> float:
        return 1.5 + 0.1 / (1 - a**2 / 0.3)  # singular at 0.55, where sheets lose their shape

    value, error = reach_table.fourth_coefficient(sheet_of(longer))
    assert abs(value - 0.1 / 0.3) <= error


def test_an_error_that_is_the_same_at_all_alpha_shows_in_that_of_the_coefficient():
    points = sheet_of(lambda a: 1.5 - 1.3 * a**2)
    shifted = [replace(p, nonlinear=p.nonlinear + 5e-4 * (p.alpha > 0)) for p in points]
    value, error = reach_table.fourth_coefficient(shifted)
    assert 0.01 < abs(value + 1.3) <= error


def test_few_points_have_no_fourth_coefficient():
    points = sheet_of(lambda a: 1 - a**2, alphas=(0, 0.05, 0.1, 0.15))
    assert all(math.isnan(v) for v in reach_table.fourth_coefficient(points))


def test_reach_of_a_known_difference():
    """1/(1 - a^2) - 1 = share at a = (share/(1 + share))^(1/2)."""
    points = sheet_of(lambda a: 1 - a**2, theory=lambda a: 0.9 * (1 - a**2))
    for share in SHARES:
        expected = math.sqrt(share / (1 + share))
        # a cubic spline through steps of 0.05
        assert reach_table.reached(points, "second_order", share) == pytest.approx(expected, abs=1e-4)
    assert reach_table.reached(points, "strip", 0.05) == 0
    assert reach_table.reached(points, "strip", 0.11) == points[-1].alpha


def test_table_of_reaches_follows_from_the_speeds():
    for found, kept in zip(reach_table.reaches(POINTS), ROWS, strict=True):
        again, written = (np.array(list(r.__dict__.values())) for r in (found, kept))
        np.testing.assert_allclose(again, written, rtol=2e-5, atol=1e-9)  # 6 digits of both tables


def test_a_point_of_the_speeds_is_what_the_command_makes():
    kept = next(p for p in POINTS if (p.width, p.poisson, p.alpha) == (0.35, 0.5, 0.2))
    case = reach_table.Case(kept.width, kept.poisson, 1, "exp", "grown")
    again = reach_table.point_at(case, kept.alpha, kept.second_order, reach_table.RTOL)
    assert again.nonlinear == pytest.approx(kept.nonlinear, rel=2e-5)
    first = crawl_speed(case.sheet, SineWave(), kept.alpha, rtol=1e-4)
    assert kept.first_order * kept.alpha**2 == pytest.approx(first.mean, rel=1e-3)


def test_order_two_reaches_as_far_as_the_table_says():
    """Speeds of `crawl_speed` at that alpha against the sheet's, interpolated in alpha^2."""
    row = next(r for r in ROWS if (r.width, r.poisson) == (0.5, 0.5))
    sheet = [p for p in POINTS if (p.width, p.poisson) == (0.5, 0.5)]
    for share in SHARES:
        alpha = getattr(row, f"second_order_{100 * share:.0f}")
        ratio = np.interp(alpha**2, [p.alpha**2 for p in sheet], [p.nonlinear for p in sheet])
        theory = crawl_speed(Sheet(), SineWave(), alpha, order=2, rtol=1e-3).mean / alpha**2
        # V_2 to 1e-3, of which a share of 1 % is a tenth, and straight lines between points
        assert theory / ratio - 1 == pytest.approx(share, abs=2e-3)


def test_reaches_grow_with_the_share_and_narrow_sheets_are_strips():
    for row in ROWS:
        chain = [0, row.second_order_1, row.second_order_5, row.second_order_10, row.limit]
        assert all(a <= b for a, b in pairwise(chain))
        assert row.strip_5 <= row.strip_10
    narrow = next(r for r in ROWS if (r.width, r.poisson) == (0.1, 0.5))
    alpha = np.array([0.02, 0.04])
    ratio = line_cycle_speed(alpha, body="strip") / alpha**2
    strip = (ratio[1] - ratio[0]) / np.diff(alpha**2)
    # (2 pi W/L)^2/4 is the order of what the width does to V_4
    assert narrow.fourth == pytest.approx(strip.item(), rel=0.1)


def test_the_map_goes_through_its_points():
    points = [p for p in POINTS if p.poisson == reach.POISSON]
    found = reach.compute(points)
    for point in (points[0], points[-1]):  # the corners
        column = -1 if point.alpha else 0
        row = -1 if point.width == max(p.width for p in points) else 0
        expected = point.second_order / point.nonlinear - 1
        assert found.second_order[row, column] == pytest.approx(expected, abs=1e-9)
        assert found.alpha[row, column] == pytest.approx(point.alpha)
        assert found.width[row, 0] == pytest.approx(point.width)
    assert np.all(np.diff(found.alpha, axis=1) > 0)


def test_the_figure_writes_the_same_bytes(tmp_path):
    first, second = (
        reach.write(POINTS, ROWS, tmp_path / name, ["png"]) for name in ("first", "second")
    )
    assert [p.name for p in first] == ["reach.png", "reach.json"]
    for one, two in zip(first, second, strict=True):
        assert one.read_bytes() == two.read_bytes()
    numbers = json.loads(first[1].read_text())
    row = next(r for r in ROWS if (r.width, r.poisson) == (0.5, 0.5))
    assert numbers["poisson 0.5"]["width 0.5"]["fourth"] == pytest.approx(row.fourth)


def test_an_absent_table_is_reported_with_its_command(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"python -m figures\.measure\.reach"):
        SPEEDS.read(tmp_path / "none.csv")
    again = SPEEDS.read(SPEEDS.write(POINTS[:3], tmp_path / "some.csv"))
    assert again == POINTS[:3]

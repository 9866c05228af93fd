"""The map of bending gaits: its table, what is drawn of it, and the page made from it."""

from dataclasses import replace

import numpy as np
import pytest

from figures.draw import fig4, gait_page
from figures.measure import gait_map
from figures.measure.gait_map import FRICTIONS, READINGS, TABLE, Row

ROWS = TABLE.read()


def test_the_page_is_that_of_the_table() -> None:
    assert gait_page.PAGE.read_text(encoding="utf-8") == gait_page.page(ROWS)


def test_every_reading_of_both_gaits_is_in_the_table() -> None:
    known = {(r.alpha, r.kappa, r.friction) for r in ROWS}
    for alpha, beta in (gait_map.BACKWARD, gait_map.FORWARD):
        for factor in READINGS.values():
            for law in FRICTIONS:
                assert (alpha, float(f"{beta * factor:.4g}"), law) in known


@pytest.mark.parametrize(("alpha", "kappa", "friction"), [(-0.02, 2.0, "viscous")])
def test_a_row_is_what_is_computed(alpha: float, kappa: float, friction: str) -> None:
    (kept,) = (r for r in ROWS if (r.alpha, r.kappa, r.friction) == (alpha, kappa, friction))
    found = gait_map.row(alpha, kappa, friction)
    # Digits of the table, and Newton's tolerance
    assert found.second == pytest.approx(kept.second, rel=2e-3)
    assert found.third == pytest.approx(kept.third, rel=2e-3)
    assert (found.snapped, found.crossed) == (kept.snapped, kept.crossed)


def test_the_signs_that_a_saddle_has() -> None:
    """V of small gaits under viscous friction is odd in alpha and in kappa, to first order of both."""
    small = {(np.sign(r.alpha), np.sign(r.kappa)): r for r in ROWS if abs(r.alpha) == 0.02}
    viscous = [r for r in ROWS if abs(r.alpha) == 0.02 and r.friction == "viscous"]
    assert len(small) == len(viscous) == 4
    assert all(np.sign(r.third) == -np.sign(r.alpha * r.kappa) for r in viscous)


ROW = Row(0.1, 2.0, "dry", 0.02, 0.03, 0, 0, 1.0, "")


@pytest.mark.parametrize(
    ("row", "told", "sign"),
    [
        (ROW, "+0.03", 1),
        (replace(ROW, second=-0.02), "−0.02 then +0.03", 0),
        (replace(ROW, second=-1e-4), "−0.0001 then +0.03", 1),
        (replace(ROW, crossed=3), "+0.03, crosses", 1),
        (replace(ROW, second=np.nan, third=np.nan), "stopped", 0),
        (None, "not run", 0),
    ],
)
def test_cells(row: Row | None, told: str, sign: int) -> None:
    assert gait_page.told(row) == told
    assert gait_page.sign(row) == sign


def test_the_grid_has_each_gait_at_its_place() -> None:
    rows = [
        replace(ROW, alpha=a, kappa=k, third=10 * a + k, crossed=int(k > 0))
        for a in (-0.1, 0.1)
        for k in (-2.0, 0.0, 2.0)
    ]
    rows.append(replace(ROW, alpha=0.05, kappa=1.0))  # a gait beside the grid
    alphas, kappas = np.array([-0.1, 0.1]), np.array([-2.0, 0.0, 2.0])
    speed, crossed = fig4.grid(rows, alphas, kappas)
    np.testing.assert_allclose(speed, 10 * alphas + kappas[:, None])
    np.testing.assert_array_equal(crossed, [[0, 0], [0, 0], [1, 1]])

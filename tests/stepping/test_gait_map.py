"""The map of bending gaits: its table, what is drawn of it, and the page made from it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from fem_check.mesh.location import covering
from fem_check.runs.lock import claimed
from figures.common.filling import Filling
from figures.draw import fig5, gait_page, speed_map
from figures.measure.paper import trapezoids
from figures.measure.paper.gait_map import TABLE, Place, Row, counts, place_of, row
from figures.measure.paper.paper_gait import BACKWARD, FORWARD, FRICTIONS, READINGS

ROWS = TABLE.read()


def test_the_page_is_that_of_the_table() -> None:
    assert gait_page.PAGE.read_text(encoding="utf-8") == gait_page.page(ROWS)


def test_every_reading_of_both_gaits_is_in_the_table() -> None:
    known = {(r.alpha, r.kappa, r.friction) for r in ROWS}
    for alpha, beta in (BACKWARD, FORWARD):
        for factor in READINGS.values():
            for law in FRICTIONS:
                assert (alpha, float(f"{beta * factor:.4g}"), law) in known


@pytest.mark.parametrize(("alpha", "kappa", "friction"), [(-0.02, 2.0, "viscous")])
def test_a_row_is_what_is_computed(alpha: float, kappa: float, friction: str) -> None:
    (kept,) = (r for r in ROWS if (r.alpha, r.kappa, r.friction) == (alpha, kappa, friction))
    found = row(Place(alpha, kappa, friction))
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


ROW = Row(0.1, 2.0, "dry", 0.02, 0.03, 1e-3, 0, 0, 1.0, "")


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
    found = speed_map.grid(rows, "alpha", "kappa")
    np.testing.assert_allclose(found.x, [-0.1, 0.1])
    np.testing.assert_allclose(found.speed, 10 * found.x + found.y[:, None])
    np.testing.assert_array_equal(found.crossed, [[0, 0], [0, 0], [1, 1]])


def _row(place: Place) -> Row:
    return replace(ROW, alpha=place.alpha, kappa=place.kappa, friction=place.friction)


@pytest.mark.parametrize("workers", [1, 2])
def test_a_table_goes_on_where_it_ends_and_computes_rows_without_error_again(
    tmp_path: Path, workers: int
) -> None:
    places = [Place(0.1, k, law) for law in FRICTIONS for k in (1.0, 2.0, 3.0)]
    path, other = tmp_path / "map.csv", replace(ROW, alpha=0.7)
    old = [replace(_row(places[1]), third=9.0), replace(_row(places[4]), error=np.nan), other]
    TABLE.write(old, path)
    filling = Filling(TABLE, path, place_of, counts)
    with pytest.raises(SystemExit, match="being filled by"), claimed(path.with_suffix(".lock")):
        filling.fill(places, _row, workers)
    filling.fill(places, _row, workers)
    rows = TABLE.read(path)
    assert [place_of(r) for r in rows] == [*places, place_of(other)]
    assert [r.third for r in rows] == [0.03, 9.0, 0.03, 0.03, 0.03, 0.03, 0.03]
    assert not any(np.isnan(r.error) for r in rows)


def test_drawn_triangles_of_an_outline_are_anticlockwise() -> None:
    points, triangles = covering(trapezoids.outline(0.5, 1.0).mesh(trapezoids.SIZE))
    a, b, c = points[:, triangles.T].swapaxes(0, 1)
    assert np.all((b - a)[0] * (c - a)[1] > (b - a)[1] * (c - a)[0])


def test_trapezoids_have_one_area_and_the_optimum_is_that_of_a_parabola() -> None:
    for ratio in trapezoids.RATIOS:
        shape = trapezoids.outline(ratio, 1.4)
        assert (shape.area, shape.length) == (pytest.approx(0.5), pytest.approx(1.4))
        assert np.ptp(shape.corners[:2, 0]) == pytest.approx(ratio * np.ptp(shape.corners[2:, 0]))
    y = np.array(trapezoids.LENGTHS)
    speed = (0.05 - (y - 0.93) ** 2)[:, None]
    found = speed_map.Grid(np.ones(1), y, speed, 0 * speed, 0 * speed)
    assert fig5.optimum(found, 1)[1.0] == pytest.approx(0.93)
    assert fig5.optimum(found, -1)[1.0] == y[-1]


def test_cells_below_their_error_are_hatched() -> None:
    """Each a rectangle around its place, with what is unknown left alone."""
    speed = np.array([[0.1, -0.1, np.nan], [0.1, 0.2, 0.1]])
    error = np.array([[0.2, 0.05, np.inf], [np.inf, 0.1, np.nan]])
    found = speed_map.Grid(np.array([0.0, 1.0, 3.0]), np.array([0.0, 2.0]), speed, error, 0 * speed)
    axes = Figure().add_subplot()
    speed_map.draw_speeds(axes, found, 0.2)
    boxes = {(p.get_x(), p.get_y(), p.get_width(), p.get_height(), p.get_hatch()) for p in axes.patches}
    assert boxes == {(-0.5, -1.0, 1.0, 2.0, speed_map.HATCH), (-0.5, 1.0, 1.0, 2.0, speed_map.HATCH)}

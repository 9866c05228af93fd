"""The figure of paths: what it computes, that the files hold what is drawn, the same bytes twice."""

import csv
import json
import pathlib

import numpy as np
import pytest

from figures.draw import turning
from figures.measure import turning as turning_table


@pytest.fixture(scope="module")
def tracks() -> list[turning.Track]:
    return turning.compute(rtol=1e-2)


def test_the_figure_draws_sheets_that_go_round(tracks: list[turning.Track]) -> None:
    straight, round_ = tracks
    assert straight.nonlinear.is_straight
    # the circle is closed to a step in as many periods as are drawn
    assert np.linalg.norm(round_.nonlinear.position[:, -1]) < 2 * np.linalg.norm(round_.nonlinear.step)
    for track in tracks:
        for row in track.stepped:
            place = track.nonlinear.position[:, row.period]
            error = track.nonlinear.position_error[row.period] + row.error
            # friction of slip speed 0.01 is not quite dry: 3e-3 of the way
            way = row.period * track.nonlinear.speed
            assert np.hypot(*(place - [row.x, row.y])) <= error + 3e-3 * way
            assert row.error <= 0.01 * way


def test_the_figure_writes_what_it_shows(tracks: list[turning.Track], tmp_path: pathlib.Path) -> None:
    once, again = (turning.write(tracks, tmp_path / name, ["png"]) for name in ("once", "again"))
    assert [p.name for p in once] == ["turning.png", "turning.csv", "turning.json"]
    assert [p.read_bytes() for p in once] == [p.read_bytes() for p in again]
    shown = json.loads(once[2].read_text())
    assert shown["oblique"]["nonlinear"]["radius"] is None
    circle = tracks[1].nonlinear
    assert shown["unequal"]["nonlinear"]["radius"] == pytest.approx(circle.radius, rel=1e-8)
    with once[1].open(newline="") as file:
        rows = [r for r in csv.DictReader(file) if (r["wave"], r["model"]) == ("unequal", "nonlinear")]
    written = [[float(r[name]) for r in rows] for name in ("x", "y", "heading")]
    np.testing.assert_allclose(written, [*circle.position, circle.heading], rtol=1e-8, atol=1e-12)
    # axis 1, third line: theory, its dots, the nonlinear sheet
    line = turning.draw(tracks).axes[1].lines[2]
    np.testing.assert_array_equal(line.get_xydata().T, circle.position)


def test_the_table_of_stepped_sheets(tmp_path: pathlib.Path) -> None:
    rows = turning_table.TABLE.read()
    assert {row.wave for row in rows} == set(turning_table.WAVES)
    again = turning_table.TABLE.write(rows, tmp_path / "again.csv")
    assert again.read_text() == turning_table.TABLE.path.read_text()
    with pytest.raises(FileNotFoundError, match=r"figures\.measure\.turning"):
        turning_table.TABLE.read(tmp_path / "none.csv")
    first = turning_table.stepped("unequal", 1, turning_table.STEPS)
    row = next(row for row in rows if (row.wave, row.period) == ("unequal", 1))
    # six digits are written; minimisations leave 1e-3 of the slip speed
    found = *first.position[:, 2], first.heading[2]
    assert found == pytest.approx((row.x, row.y, row.heading), abs=1e-5)
